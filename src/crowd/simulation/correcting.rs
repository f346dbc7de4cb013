//! Bodies are no points, and walls have the last word.

use super::{Crowd, in_chunks};
use crate::crowd::neighbours::Neighbours;
use crate::crowd::walking::{Move, off_walls};
use crate::math::vec2;

/// Rounds of moving bodies apart and out of walls in each step.
const CORRECTIONS: usize = 4;

impl Crowd<'_> {
    /// Moves bodies apart where they overlap, and out of walls, which have the last word.
    pub(in crate::crowd) fn correct(&mut self) {
        let [now, next] = &mut self.places;
        now.clear();
        now.extend(self.moves.iter().map(|m| [m.x, m.y]));
        next.resize(now.len(), [0.0; 2]);
        let (moves, neighbours) = (&self.moves, &self.neighbours);
        let (ground, walls) = (&self.navigation.ground, self.walls);
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
    }
}

/// The place of a body after it and its neighbours have each given half of their overlap; to those who give nothing it
/// leaves all of it.
fn apart(index: usize, moves: &[Move], places: &[[f32; 2]], neighbours: &Neighbours) -> [f32; 2] {
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
    // Several pushes at once overshoot: in part they say the same.
    let ease = 1.1 / (0.6 + 0.4 * count).max(1.0);
    [x + px * ease, y + py * ease]
}
