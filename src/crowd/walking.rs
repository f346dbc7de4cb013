//! The rules by which people choose their next velocity: a pure function of everybody's current state.

use super::neighbours::Neighbours;
use super::options::{LEAST_SPEED_M_S, SpeedTable};
use super::seen::Seen;
use super::state::{Body, Traits};
use super::surroundings::Surroundings;
use crate::math::{Vec2, vec2};
use crate::routes::Ground;
use crate::walls::Walls;

/// Most bodies that are looked at for overlap; more do not fit around one.
pub(super) const MOST_CONTACTS: usize = 16;
/// Time in which the desired velocity is taken up, seconds.
const RELAXATION_S: f32 = 0.5;
/// Acceleration of making way for others, metres per second squared.
const SEPARATION: f32 = 3.2;
/// Acceleration away from a wall, metres per second squared.
const WALL_PUSH: f32 = 1.6;
/// The largest acceleration of a walking person, metres per second squared.
pub(super) const MOST_ACCELERATION: f32 = 5.0;
/// Whoever was led faster than they walk themselves slows down to that so hard, metres per second squared.
pub(super) const CALMS_DOWN_M_S2: f32 = 2.5;
/// Whoever may come nearer than this to touching in a step, metres, is moved apart if need be.
const CONTACT_M: f32 = 0.25;
/// A body is moved by no more than this in a step, metres: what lies farther off a wall need not be looked up.
const MOST_MOVED_M: f32 = 0.6;

/// Share of the speed that is lost in a turn by a right angle ...
const BEND: f32 = 0.4;
/// ... above this speed, metres per second: whoever starts may turn as they like.
const TURNING_M_S: f32 = 0.4;

/// What one step looks at.
pub(super) struct Scene<'a> {
    pub(super) neighbours: &'a Neighbours,
    pub(super) surroundings: &'a Surroundings,
    pub(super) ground: &'a Ground,
    pub(super) walls: &'a Walls,
    pub(super) speeds: &'a SpeedTable,
    pub(super) alignment: f32,
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
    /// Whether this body gives way to nothing.
    pub(super) fixed: bool,
}

impl Scene<'_> {
    /// The next move of the body at this index of the sorted list.
    pub(super) fn next(&self, index: usize, traits: &Traits, pace: f32, seen: &mut Seen) -> Move {
        let me = &self.neighbours.bodies[index];
        let at = me.position();
        seen.find(self.neighbours, index, |dx, dy| self.sees(me, dx, dy));
        let around = seen.weigh(me);
        let density = around.count / self.surroundings.floor_ahead_m2(at, me.clearance_m, [me.aim_x, me.aim_y]);
        let wanted_speed = traits.speed_m_s * pace * self.bend(me);
        // Density alone brings nobody to rest, but who wants to stand stands.
        let most_speed = (wanted_speed * self.speeds.factor(density)).max(wanted_speed.min(LEAST_SPEED_M_S));

        let mut ax = (me.aim_x * most_speed - me.vx) / RELAXATION_S;
        let mut ay = (me.aim_y * most_speed - me.vy) / RELAXATION_S;
        let separation = seen.separate(me, traits, density);
        // Making way is stepping aside. Slowing down is left to the law and to not bumping into others; nobody is
        // pushed backwards.
        let back = (separation[0] * me.aim_x + separation[1] * me.aim_y).min(0.0);
        // Whoever walks up to a spot to stand there heads for the spot, not for room.
        let heed = pace.min(1.0);
        ax += SEPARATION * heed * (separation[0] - back * me.aim_x);
        ay += SEPARATION * heed * (separation[1] - back * me.aim_y);
        if around.alike > 0.0 {
            // Only across the own way: overtaking stays possible.
            let across = (-me.aim_y, me.aim_x);
            let theirs = (around.alike_vx * across.0 + around.alike_vy * across.1) / around.alike;
            let own = me.vx * across.0 + me.vy * across.1;
            let pull = self.alignment * (theirs - own) * around.alike.min(1.0);
            ax += pull * across.0;
            ay += pull * across.1;
        }
        let mut wall_limit_m = traits.wall_exclusion_m;
        if me.clearance_m < traits.wall_acceptable_m.max(wall_limit_m + MOST_MOVED_M) {
            let gap_limit_m = self.ground.gap_limit_m(at) as f32;
            wall_limit_m = wall_limit_m.min(gap_limit_m);
            if let Some((nx, ny, push)) = self.keep_off_wall(me, traits, wall_limit_m, gap_limit_m) {
                ax += push * heed * nx;
                ay += push * heed * ny;
            }
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
        let mut velocity = [vx, vy];
        seen.keep_from_bumping(me, &mut velocity);
        let mut next =
            Move { x: me.x + velocity[0] * self.dt, y: me.y + velocity[1] * self.dt, wall_limit_m, ..Move::default() };
        seen.within(me, velocity, self.dt, CONTACT_M, |other| {
            if let Some(contact) = next.contacts.get_mut(next.contact_count as usize) {
                *contact = other;
                next.contact_count += 1;
            }
        });
        next
    }

    /// Share of the speed that is kept in a bend: people slow down where they turn (Hicheur et al. 2005,
    /// Exp. Brain Res. 162), by how far they look into it from where they go.
    fn bend(&self, me: &Body) -> f32 {
        let speed = (me.vx * me.vx + me.vy * me.vy).sqrt();
        if speed < TURNING_M_S {
            return 1.0;
        }
        let cos = (me.vx * me.aim_x + me.vy * me.aim_y) / speed;
        1.0 - BEND * (1.0 - cos.max(0.0))
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
        // Little at first: what people like to keep they give up easily.
        let near = 1.0 - share.clamp(0.0, 1.0);
        let push = WALL_PUSH * near * near;
        Some((away.x as f32, away.y as f32, push))
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
