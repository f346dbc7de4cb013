//! The rules by which people choose their next velocity: a pure function of everybody's current state.

use super::neighbours::Neighbours;
use super::options::{LEAST_SPEED_M_S, SpeedTable};
use super::state::{Body, Traits};
use super::surroundings::{SENSE_M, Surroundings, kernel};
use crate::math::{Vec2, vec2};
use crate::routes::Ground;
use crate::walls::Walls;

/// Most bodies that are looked at for overlap; more do not fit around one.
pub(super) const MOST_CONTACTS: usize = 16;
/// Time in which the desired velocity is taken up, seconds.
const RELAXATION_S: f32 = 0.5;
/// How far ahead in time people see others come near, seconds.
const FORESIGHT_S: f32 = 1.2;
/// Acceleration of making way for others, metres per second squared.
const SEPARATION: f32 = 3.2;
/// Rate at which sideways speed is matched to those who go the same way, per second.
const ALIGNMENT: f32 = 0.6;
/// Acceleration away from a wall, metres per second squared.
const WALL_PUSH: f32 = 1.6;
/// The largest acceleration of a walking person, metres per second squared.
const MOST_ACCELERATION: f32 = 5.0;
/// Density at which the acceptable distance has halved the way to the exclusion distance, persons per square metre.
const CROWDED: f32 = 1.2;
/// Two people never close the gap between them in less than this, seconds.
const CLOSING_S: f32 = 0.35;
/// Sidestep of those who meet head on, to their right, metres: somebody has to begin.
const SIDESTEP_M: f32 = 0.08;

/// What one step looks at.
pub(super) struct Scene<'a> {
    pub(super) neighbours: &'a Neighbours,
    pub(super) surroundings: &'a Surroundings,
    pub(super) ground: &'a Ground,
    pub(super) walls: &'a Walls,
    pub(super) speeds: &'a SpeedTable,
    pub(super) dt: f32,
}

/// What a person does in one step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Move {
    /// Where the velocity leads, before anything is corrected, metres.
    pub(super) x: f32,
    pub(super) y: f32,
    /// Bodies that may come to overlap with this one, as indices into [`Neighbours::bodies`].
    pub(super) contacts: [u32; MOST_CONTACTS],
    pub(super) contact_count: u32,
    /// How near a wall this body may come here, metres.
    pub(super) wall_limit_m: f32,
}

impl Scene<'_> {
    /// The next move of the body at this index of the sorted list.
    pub(super) fn next(&self, index: usize, traits: &Traits, pace: f32, seen: &mut Seen) -> Move {
        let me = &self.neighbours.bodies[index];
        let at = me.position();
        let gap_limit_m = self.ground.gap_limit_m(at) as f32;
        self.look_around(index, me, traits, seen);
        let floor_m2 = self.surroundings.floor_ahead_m2(at, [me.aim_x, me.aim_y]);
        let density = seen.count / floor_m2;
        let most_speed = (traits.speed_m_s * pace * self.speeds.factor(density)).max(LEAST_SPEED_M_S);

        let mut ax = (me.aim_x * most_speed - me.vx) / RELAXATION_S;
        let mut ay = (me.aim_y * most_speed - me.vy) / RELAXATION_S;
        let separation = separate(me, traits, density, &seen.near);
        // Making way is stepping aside. Slowing down is left to the law and to not bumping into others; nobody is
        // pushed backwards.
        let back = (separation[0] * me.aim_x + separation[1] * me.aim_y).min(0.0);
        ax += SEPARATION * (separation[0] - back * me.aim_x);
        ay += SEPARATION * (separation[1] - back * me.aim_y);
        if seen.alike > 0.0 {
            // Only across the own way: overtaking stays possible.
            let across = (-me.aim_y, me.aim_x);
            let theirs = (seen.alike_vx * across.0 + seen.alike_vy * across.1) / seen.alike;
            let own = me.vx * across.0 + me.vy * across.1;
            let pull = ALIGNMENT * (theirs - own) * seen.alike.min(1.0);
            ax += pull * across.0;
            ay += pull * across.1;
        }
        let wall_limit_m = traits.wall_exclusion_m.min(gap_limit_m);
        let wall = self.keep_off_wall(me, traits, wall_limit_m, gap_limit_m);
        if let Some((nx, ny, push)) = wall {
            ax += push * nx;
            ay += push * ny;
        }
        let a = (ax * ax + ay * ay).sqrt();
        let ease = if a > MOST_ACCELERATION { MOST_ACCELERATION / a } else { 1.0 };
        let mut vx = me.vx + ax * ease * self.dt;
        let mut vy = me.vy + ay * ease * self.dt;
        let speed = (vx * vx + vy * vy).sqrt();
        if speed > most_speed {
            // Slowing down takes its time too, but no longer than speeding up.
            let own = (me.vx * me.vx + me.vy * me.vy).sqrt();
            let allowed = most_speed.max(own - MOST_ACCELERATION * self.dt);
            if speed > allowed {
                vx *= allowed / speed;
                vy *= allowed / speed;
            }
        }
        keep_from_bumping(me, &seen.near, &mut vx, &mut vy);
        Move {
            x: me.x + vx * self.dt,
            y: me.y + vy * self.dt,
            contacts: seen.contacts,
            contact_count: seen.contact_count as u32,
            wall_limit_m,
        }
    }

    /// Finds everybody within reach who is not behind a wall, and weighs them.
    fn look_around(&self, index: usize, me: &Body, traits: &Traits, seen: &mut Seen) {
        seen.clear();
        let reach2 = (SENSE_M * SENSE_M) as f32;
        self.neighbours.around(me.x, me.y, |range| {
            for other in range {
                let body = &self.neighbours.bodies[other];
                let dx = self.neighbours.dx(me.x, body.x);
                let dy = body.y - me.y;
                let d2 = dx * dx + dy * dy;
                if d2 >= reach2 || other == index {
                    continue;
                }
                let d = d2.sqrt();
                if d > me.clearance_m + body.clearance_m && !self.sees(me, dx, dy) {
                    continue;
                }
                let inverse = 1.0 / d.max(1e-4);
                let ahead = (dx * me.aim_x + dy * me.aim_y) * inverse;
                let weight = kernel(d2) * 0.5 * (1.0 + ahead);
                seen.count += weight;
                let alike = me.aim_x * body.aim_x + me.aim_y * body.aim_y;
                if alike > 0.3 {
                    seen.alike += weight;
                    seen.alike_vx += weight * body.vx;
                    seen.alike_vy += weight * body.vy;
                }
                if d < traits.exclusion_m + 0.55 && seen.contact_count < MOST_CONTACTS {
                    seen.contacts[seen.contact_count] = other as u32;
                    seen.contact_count += 1;
                }
                let half_exclusion_m = body.half_exclusion_m;
                seen.near.push(Near { dx, dy, vx: body.vx, vy: body.vy, half_exclusion_m });
            }
        });
    }

    fn sees(&self, me: &Body, dx: f32, dy: f32) -> bool {
        let at = me.position();
        self.ground.sight(self.walls, at, at + vec2(f64::from(dx), f64::from(dy)))
    }

    /// Direction away from a near wall, and the acceleration.
    fn keep_off_wall(&self, me: &Body, traits: &Traits, limit_m: f32, gap_limit_m: f32) -> Option<(f32, f32, f32)> {
        // In a gap nobody keeps farther off one wall than the other lets them.
        let acceptable_m = traits.wall_acceptable_m.min(gap_limit_m + 0.15).max(limit_m + 0.02);
        if me.clearance_m >= acceptable_m {
            return None;
        }
        let at = me.position();
        let nearest = self.walls.nearest(at, f64::from(acceptable_m))?;
        let away = (at - nearest.point_m).normalized()?;
        let share = (nearest.distance_m as f32 - limit_m) / (acceptable_m - limit_m);
        let push = WALL_PUSH * (1.0 - share.clamp(0.0, 1.0));
        Some((away.x as f32, away.y as f32, push))
    }
}

/// Separation: the sum of pushes away from those who come nearer than the acceptable distance, now or soon.
fn separate(me: &Body, traits: &Traits, density: f32, others: &[Near]) -> [f32; 2] {
    let crowded = 1.0 / (1.0 + density / CROWDED);
    let mut push = [0.0f32; 2];
    for near in others {
        let exclusion_m = me.half_exclusion_m + near.half_exclusion_m;
        let acceptable_m = exclusion_m + (traits.acceptable_m - traits.exclusion_m).max(0.05) * crowded;
        let (wx, wy) = (near.vx - me.vx, near.vy - me.vy);
        let w2 = wx * wx + wy * wy;
        // When the two come nearest, within the time that people foresee.
        let soon = (-(near.dx * wx + near.dy * wy) / (w2 + 1e-3)).clamp(0.0, FORESIGHT_S);
        let (mut qx, mut qy) = (near.dx + wx * soon, near.dy + wy * soon);
        let ahead = near.dx * me.aim_x + near.dy * me.aim_y;
        if soon > 0.0 && ahead > 0.0 && near.vx * me.aim_x + near.vy * me.aim_y < 0.0 {
            // Head on: as if the other came a little more from the left.
            qx += -me.aim_y * SIDESTEP_M;
            qy += me.aim_x * SIDESTEP_M;
        }
        let q2 = qx * qx + qy * qy;
        if q2 >= acceptable_m * acceptable_m {
            continue;
        }
        let q = q2.sqrt().max(1e-3);
        let d = (near.dx * near.dx + near.dy * near.dy).sqrt().max(1e-3);
        let ahead = 0.5 + 0.5 * ahead / d;
        let strength = (1.0 - q / acceptable_m) * (1.0 - soon / FORESIGHT_S) * (0.25 + 0.75 * ahead);
        push[0] -= qx / q * strength;
        push[1] -= qy / q * strength;
    }
    push
}

/// Takes away the speed at which a gap between two bodies would close too fast; each of them takes half.
fn keep_from_bumping(me: &Body, others: &[Near], vx: &mut f32, vy: &mut f32) {
    for near in others {
        let d2 = near.dx * near.dx + near.dy * near.dy;
        let exclusion_m = me.half_exclusion_m + near.half_exclusion_m;
        if d2 > (exclusion_m + 1.2) * (exclusion_m + 1.2) {
            continue;
        }
        let d = d2.sqrt().max(1e-3);
        let (nx, ny) = (near.dx / d, near.dy / d);
        let closing = (*vx - near.vx) * nx + (*vy - near.vy) * ny;
        let too_fast = closing - (d - exclusion_m).max(0.0) / CLOSING_S;
        if too_fast > 0.0 {
            *vx -= 0.5 * too_fast * nx;
            *vy -= 0.5 * too_fast * ny;
        }
    }
}

/// Somebody in sight, relative to the one who looks.
#[derive(Clone, Copy, Debug, Default)]
struct Near {
    dx: f32,
    dy: f32,
    vx: f32,
    vy: f32,
    half_exclusion_m: f32,
}

/// Everybody around a person, weighed. Reused from person to person.
#[derive(Clone, Debug, Default)]
pub(super) struct Seen {
    /// Weighted count of the people ahead.
    count: f32,
    /// Weighted count and velocity of those among them who go the same way.
    alike: f32,
    alike_vx: f32,
    alike_vy: f32,
    near: Vec<Near>,
    contacts: [u32; MOST_CONTACTS],
    contact_count: usize,
}

impl Seen {
    fn clear(&mut self) {
        self.near.clear();
        self.contact_count = 0;
        [self.count, self.alike, self.alike_vx, self.alike_vy] = [0.0; 4];
    }
}

/// Moves a body out of a wall, exactly: from `from`, which is free, towards `to`, ending at least `limit_m` off
/// every wall if there is such a place near, and never beyond one.
pub(super) fn off_walls(ground: &Ground, walls: &Walls, from: Vec2, to: Vec2, limit_m: f64) -> Vec2 {
    // Aprons are open at their far ends, but nobody goes there.
    let to = ground.within_aprons(to);
    let free = ground.clearance_at_least_m(to);
    if free >= limit_m && ground.clearance_at_least_m(from) + free >= from.distance(to) {
        return to;
    }
    let step = to - from;
    let straight = pushed_out(ground, walls, from, to, limit_m);
    let found = straight.or_else(|| {
        // Along the wall that is in the way, or half as far.
        let nearest = walls.nearest(from, limit_m + step.length())?;
        let away = (from - nearest.point_m).normalized()?;
        let along = step - away * step.dot(away).min(0.0);
        pushed_out(ground, walls, from, from + along, limit_m)
            .or_else(|| pushed_out(ground, walls, from, from + along * 0.5, limit_m))
    });
    found.unwrap_or(from)
}

/// `to`, moved at least `limit_m` off every wall; `None` if there is no such place that can be reached from `from`.
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
