//! Exclusion of bodies and walls: moves are corrected so that bodies do not overlap and stay out of walls.

use super::agents::in_chunks;
use super::environment::Environment;
use super::moves::Move;
use super::neighbours::NeighbourGrid;
use crate::math::{Vec2, vec2};
use crate::routes::Ground;
use crate::walls::Walls;

/// Rounds of moving bodies apart and out of walls in each step.
const CORRECTIONS: usize = 4;

/// Places that moves lead to, corrected round by round.
#[derive(Debug, Default)]
pub(super) struct Collisions {
    /// Places in the order of the neighbours' grid, and those of the round before, metres.
    places: [Vec<[f32; 2]>; 2],
}

impl Collisions {
    /// Corrected places of these moves, in the order of the neighbours' grid; walls have the last word.
    pub(super) fn correct(
        &mut self,
        moves: &[Move],
        neighbours: &NeighbourGrid,
        environment: &Environment<'_>,
    ) -> &[[f32; 2]] {
        let [now, next] = &mut self.places;
        now.clear();
        now.extend(moves.iter().map(|m| [m.x, m.y]));
        next.resize(now.len(), [0.0; 2]);
        let (ground, walls) = (environment.ground(), environment.walls);
        for round in 0..CORRECTIONS {
            let before: &[[f32; 2]] = now;
            in_chunks(next, |start, places| {
                for (k, place) in places.iter_mut().enumerate() {
                    let index = start + k;
                    let own = &moves[index];
                    if own.fixed || own.contact_count == 0 && round > 0 {
                        *place = before[index];
                        continue;
                    }
                    let body = &neighbours.bodies[index];
                    let pushed = apart(index, moves, before, neighbours);
                    let (dx, dy) = (pushed[0] - body.x, pushed[1] - body.y);
                    let clear_m = body.clearance_m - own.wall_limit_m;
                    *place = if clear_m > 0.0 && dx * dx + dy * dy < clear_m * clear_m {
                        pushed
                    } else {
                        let to = vec2(f64::from(pushed[0]), f64::from(pushed[1]));
                        let free = off_walls(ground, walls, body.position(), to, f64::from(own.wall_limit_m));
                        [free.x as f32, free.y as f32]
                    };
                }
            });
            std::mem::swap(now, next);
        }
        now
    }
}

/// Place of a body after it and its neighbours have each given half of their overlap, fixed ones none.
fn apart(index: usize, moves: &[Move], places: &[[f32; 2]], neighbours: &NeighbourGrid) -> [f32; 2] {
    let [x, y] = places[index];
    let own = &moves[index];
    let half_m = neighbours.bodies[index].half_exclusion_m;
    let (mut px, mut py, mut count) = (0.0f32, 0.0f32, 0.0f32);
    for &other in &own.contacts[..own.contact_count as usize] {
        let other = other as usize;
        let [ox, oy] = places[other];
        let (dx, dy) = (neighbours.dx(x, ox), oy - y);
        let exclusion_m = half_m + neighbours.bodies[other].half_exclusion_m;
        let d2 = dx * dx + dy * dy;
        if d2 >= exclusion_m * exclusion_m {
            continue;
        }
        let d = d2.sqrt();
        // Two in one place part along x, the first one to the left.
        let (nx, ny) = if d > 1e-5 { (dx / d, dy / d) } else { (if index < other { 1.0 } else { -1.0 }, 0.0) };
        let share = if moves[other].fixed { 1.0 } else { 0.5 };
        let push = share * (exclusion_m - d);
        px -= push * nx;
        py -= push * ny;
        count += 1.0;
    }
    if count == 0.0 {
        return [x, y];
    }
    // Several pushes at once overshoot: in part they point the same way.
    let ease = 1.1 / (0.6 + 0.4 * count).max(1.0);
    [x + px * ease, y + py * ease]
}

/// Moves a body from the free place `from` towards `to`, and out of walls.
///
/// The result is at least `limit_m` off every wall if there is such a place near, and never beyond a wall.
fn off_walls(ground: &Ground, walls: &Walls, from: Vec2, to: Vec2, limit_m: f64) -> Vec2 {
    // Aprons are open at their far ends; agents stay within them.
    let to = ground.within_aprons(to);
    let free = ground.clearance_at_least_m(to);
    if free >= limit_m && ground.clearance_at_least_m(from) + free >= from.distance(to) {
        return to;
    }
    let step = to - from;
    let straight = pushed_out(ground, walls, from, to, limit_m);
    let found = straight.or_else(|| {
        // Slides along the wall, or half as far.
        let nearest = walls.nearest(from, limit_m + step.length())?;
        let away = (from - nearest.point_m).normalized()?;
        let along = step - away * step.dot(away).min(0.0);
        pushed_out(ground, walls, from, from + along, limit_m)
            .or_else(|| pushed_out(ground, walls, from, from + along * 0.5, limit_m))
    });
    found.unwrap_or(from)
}

/// The place `to`, moved at least `limit_m` off every wall; `None` if `from` cannot reach it.
fn pushed_out(ground: &Ground, walls: &Walls, from: Vec2, to: Vec2, limit_m: f64) -> Option<Vec2> {
    if !ground.sight(walls, from, to) {
        return None;
    }
    let mut p = to;
    for _ in 0..4 {
        let Some(nearest) = walls.nearest(p, limit_m) else { return Some(p) };
        let away = (p - nearest.point_m).normalized()?;
        // A hair more, so that rounding does not leave it nearer.
        let moved = nearest.point_m + away * (limit_m + 1e-4);
        if !ground.sight(walls, p, moved) {
            break;
        }
        p = moved;
    }
    // In a nook narrower than that: as far off as it was, at least.
    let clear_m = walls.nearest(p, limit_m).map_or(limit_m, |n| n.distance_m);
    let before_m = walls.nearest(from, limit_m).map_or(limit_m, |n| n.distance_m);
    (clear_m + 1e-3 >= before_m && ground.sight(walls, from, p)).then_some(p)
}
