//! Collision avoidance by detours: the heading that leads farthest towards the goal before somebody is in the way.
//!
//! After Moussaid, Helbing and Theraulaz 2011 (doi 10.1073/pnas.1016507108): people choose the visible direction that
//! brings them nearest to where they want to go. Lanes in counter flow follow from it.

use wide::f32x8;

use super::neighbours::{LANES, NOWHERE_M};
use super::perception::Perception;
use super::state::{BodyState, Traits};
use crate::math::vec2;

/// Distance up to which others are avoided, metres.
const HORIZON_M: f32 = 4.5;
/// Distance ahead of the place around which others are looked up, metres.
const CENTRE_M: f32 = 2.2;
/// Wanted gap between two who pass each other, metres beyond their exclusion distance.
const PASSING_M: f32 = 0.12;
/// Least distance that detours keep off walls, metres.
const LEAST_OFF_WALLS_M: f32 = 0.15;
/// Share of the distance from somebody touched within which runners take headings for blocked: the others lead past.
const ROLL_OFF: f32 = 0.8;
/// Share of the own speed at which others who go the same way need no detour.
const AS_FAST: f32 = 0.9;
/// Own speed up to which nobody overtakes, and from which on everybody does who may, metres per second: in a jam, ways
/// round those ahead lead nowhere, and who tries them stands across the way of others.
const OVERTAKING_M_S: [f32; 2] = [0.2, 0.8];
/// Largest number of obstacles that are weighed.
const MOST_WEIGHED: usize = 48;
/// Headings that are weighed against the straight one, from the least turn to the largest: cosine and sine.
const HEADINGS: [[f32; 2]; 9] = [
    [1.0, 0.0],
    [0.992_546, 0.121_869],
    [0.970_296, 0.241_922],
    [0.927_184, 0.374_607],
    [0.857_167, 0.515_038],
    [0.743_145, 0.669_131],
    [0.573_576, 0.819_152],
    [0.342_02, 0.939_693],
    [0.087_156, 0.996_195],
];
/// Share of a new heading that an agent takes at once; the rest follows at its next looks.
const TURNING: f32 = 0.7;
/// Speed below which an agent may be blocked, metres per second.
const BLOCKED_M_S: f32 = 0.15;
/// Gap within which somebody against it blocks it, metres beyond their exclusion distance.
const BLOCKING_M: f32 = 0.5;
/// Extra cost of turning left, and of leaving the heading taken before, as shares of the squared horizon.
const LEFT: f32 = 0.02;
const CHANGE: f32 = 0.15;

/// Turn out of the wanted direction round others: cosine and sine, counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Detour {
    cos: f32,
    sin: f32,
    /// Whether somebody ahead comes the other way.
    pub(super) against: bool,
}

impl Detour {
    /// Straight on.
    const NONE: Detour = Detour { cos: 1.0, sin: 0.0, against: false };

    /// The wanted direction turned by this detour.
    fn of(self, [x, y]: [f32; 2]) -> [f32; 2] {
        [x * self.cos - y * self.sin, x * self.sin + y * self.cos]
    }

    /// The heading of an agent that so far had the heading `before`, towards this detour from `wanted`.
    pub(super) fn turn(self, wanted: [f32; 2], before: [f32; 2]) -> [f32; 2] {
        let new = self.of(wanted);
        let x = before[0] + (new[0] - before[0]) * TURNING;
        let y = before[1] + (new[1] - before[1]) * TURNING;
        let length = (x * x + y * y).sqrt();
        // To turn right round takes no detour over half-way headings.
        if length > 0.5 { [x / length, y / length] } else { new }
    }
}

/// Cosine between headings from which on two go the same way.
const SAME_WAY: f32 = 0.7;
/// Bonus of detours on the side where people go the same way, as a share of the squared horizon at an alignment of 1 per
/// second.
const JOINING: f32 = 0.15;
/// Weight of oncoming people in that bonus.
const AGAINST: f32 = 5.0;

/// One quantity of all obstacles.
type Column = [[f32; LANES]; MOST_WEIGHED / LANES];

/// Others who may get in the way, relative to the agent.
#[derive(Default)]
struct Obstacles {
    count: usize,
    /// Side of those who go the same way: -1 all on the right, 1 all on the left.
    company: f32,
    /// Whether somebody comes the other way.
    against: bool,
    dx: Column,
    dy: Column,
    vx: Column,
    vy: Column,
    /// Squared distance, square metres.
    distance_m2: Column,
    /// Squared distance less the squared distance at which the two touch, square metres.
    gap_m2: Column,
    /// Which of them is farthest, once there is no room for more.
    farthest: usize,
}

impl Perception<'_> {
    /// The best detour of an agent that wants to go along the unit vector `wanted`.
    pub(super) fn detour(&self, me: &BodyState, traits: &Traits, wanted: [f32; 2]) -> Detour {
        let speed_m_s = traits.speed_m_s;
        let others = self.in_the_way(me, traits, wanted);
        if others.count == 0 {
            return Detour::NONE;
        }
        let before = [me.aim_x, me.aim_y];
        let mut best = (f32::INFINITY, Detour::NONE);
        for (k, [cos, sin]) in HEADINGS.into_iter().enumerate() {
            // However far this heading led, it and all that turn further would cost more than the best.
            let least = 2.0 * (1.0 - cos) - self.alignment * JOINING * sin;
            if least * HORIZON_M * HORIZON_M >= best.0 {
                break;
            }
            for side in [-1.0, 1.0].into_iter().take(if k == 0 { 1 } else { 2 }) {
                let sin = side * sin;
                let detour = Detour { cos, sin, against: others.against };
                let u = detour.of(wanted);
                let cost = |free_m: f32| {
                    // Farther on, the heading leads away from there again: runners would rather stand than step aside.
                    let free_m = if traits.runs() { free_m.min(HORIZON_M * cos) } else { free_m };
                    // Squared distance from where the heading leads to where straight on would lead.
                    let left_over = HORIZON_M * HORIZON_M + free_m * free_m - 2.0 * HORIZON_M * free_m * cos;
                    let left = if sin > 0.0 { LEFT } else { 0.0 };
                    let change = CHANGE * (1.0 - (u[0] * before[0] + u[1] * before[1]));
                    let joining = self.alignment * JOINING * others.company * sin;
                    left_over + (left + change - joining) * HORIZON_M * HORIZON_M
                };
                let free_m = others.free_m(u, speed_m_s);
                // Walls are looked up only for headings that would be taken.
                if cost(free_m) < best.0 {
                    let cost = cost(self.free_of_walls_m(me, traits.wall_exclusion_m, u, free_m));
                    if cost < best.0 {
                        best = (cost, detour);
                    }
                }
            }
        }
        best.1
    }

    /// Whether somebody who wants to go the other way blocks an agent.
    pub(super) fn is_blocked(&self, me: &BodyState, wanted: [f32; 2]) -> bool {
        if me.vx * wanted[0] + me.vy * wanted[1] > BLOCKED_M_S {
            return false;
        }
        let mut blocked = false;
        self.neighbours.around(me.x, me.y, |range, shift| {
            for body in &self.neighbours.bodies[range] {
                let (dx, dy) = (body.x + shift - me.x, body.y - me.y);
                let blocking_m = me.half_exclusion_m + body.half_exclusion_m + BLOCKING_M;
                let near = dx * dx + dy * dy < blocking_m * blocking_m;
                let ahead = dx * wanted[0] + dy * wanted[1] > 0.0;
                let against = body.aim_x * wanted[0] + body.aim_y * wanted[1] < -0.3;
                blocked |= near && ahead && against;
            }
        });
        blocked
    }

    /// Collects those ahead who do not go the same way as fast.
    fn in_the_way(&self, me: &BodyState, traits: &Traits, wanted: [f32; 2]) -> Obstacles {
        let speed_m_s = traits.speed_m_s;
        let mut others = Obstacles::default();
        let (cx, cy) = (me.x + wanted[0] * CENTRE_M, me.y + wanted[1] * CENTRE_M);
        let (mut left, mut company, mut against) = (0.0, 0.5, 0.0);
        let as_fast_m_s = AS_FAST * speed_m_s * overtaking(me.vx * wanted[0] + me.vy * wanted[1]);
        self.neighbours.around(cx, cy, |range, shift| {
            for body in &self.neighbours.bodies[range] {
                let (dx, dy) = (body.x + shift - me.x, body.y - me.y);
                let distance_m2 = dx * dx + dy * dy;
                let ahead = dx * wanted[0] + dy * wanted[1] > 0.05;
                let agree = body.aim_x * wanted[0] + body.aim_y * wanted[1];
                if ahead && agree.abs() > SAME_WAY {
                    // By how much they are to the left, and nearer ones more.
                    let weight = 1.0 / (1.0 + distance_m2);
                    if agree > 0.0 {
                        left += weight * (wanted[0] * dy - wanted[1] * dx).clamp(-1.0, 1.0);
                        company += weight;
                    } else {
                        against += weight;
                    }
                }
                let as_fast = body.vx * wanted[0] + body.vy * wanted[1] > as_fast_m_s;
                if !ahead || as_fast || distance_m2 > HORIZON_M * HORIZON_M || !others.has_room(distance_m2) {
                    continue;
                }
                let clear_m = me.clearance_m + body.clearance_m;
                if distance_m2 > clear_m * clear_m && !self.sees(me, dx, dy) {
                    continue;
                }
                let mut touching_m = me.half_exclusion_m + body.half_exclusion_m + PASSING_M;
                if traits.runs() {
                    touching_m = touching_m.min(ROLL_OFF * distance_m2.sqrt());
                }
                others.add(dx, dy, body, distance_m2, touching_m);
            }
        });
        // Without anybody who comes the other way there is no reason to fall in line.
        others.company = left / company * (against * AGAINST).min(1.0);
        others.against = against > 0.0;
        others.fill_up();
        others
    }

    /// Distance along `u` that is free of walls, at most `far`, metres.
    fn free_of_walls_m(&self, me: &BodyState, wall_exclusion_m: f32, u: [f32; 2], far: f32) -> f32 {
        let ground = self.environment.ground();
        let keep_m = (wall_exclusion_m - 0.1).max(LEAST_OFF_WALLS_M);
        let mut done = (me.clearance_m - (keep_m - LEAST_OFF_WALLS_M)).max(0.0);
        while done < far {
            let at = me.position() + vec2(f64::from(u[0]), f64::from(u[1])) * f64::from(done);
            // In gaps, as far off as there is room.
            let free = ground.clearance_m(at) as f32
                - keep_m.min((ground.gap_limit_m(at) as f32 - 0.1).max(LEAST_OFF_WALLS_M));
            if free < 0.03 {
                return done;
            }
            done += free.max(0.1);
        }
        far
    }
}

/// Share of the wish to overtake those ahead that is left at this own speed.
fn overtaking(speed_m_s: f32) -> f32 {
    let [none, full] = OVERTAKING_M_S;
    ((speed_m_s - none) / (full - none)).clamp(0.0, 1.0)
}

impl Obstacles {
    /// Whether an obstacle at this squared distance is weighed: when there are many, only the nearest are.
    #[inline]
    fn has_room(&self, distance_m2: f32) -> bool {
        self.count < MOST_WEIGHED || distance_m2 < self.distance_m2.as_flattened()[self.farthest]
    }

    /// Adds an obstacle for which there is room; when there are as many as are weighed, in place of the farthest.
    fn add(&mut self, dx: f32, dy: f32, body: &BodyState, distance_m2: f32, touching_m: f32) {
        let is_full = self.count == MOST_WEIGHED;
        let at = if is_full { self.farthest } else { self.count };
        self.set(at, dx, dy, [body.vx, body.vy], distance_m2, distance_m2 - touching_m * touching_m);
        self.count = (self.count + 1).min(MOST_WEIGHED);
        if self.count == MOST_WEIGHED {
            let all = self.distance_m2.as_flattened();
            let most = self.distance_m2.iter().fold(f32x8::ZERO, |most, &row| most.fast_max(f32x8::new(row)));
            let most_m2 = most.to_array().into_iter().fold(0.0, f32::max);
            self.farthest = all.iter().rposition(|&m2| m2 == most_m2).unwrap_or(0);
        }
    }

    #[inline]
    fn set(&mut self, at: usize, dx: f32, dy: f32, [vx, vy]: [f32; 2], distance_m2: f32, gap_m2: f32) {
        let (row, lane) = (at / LANES, at % LANES);
        self.dx[row][lane] = dx;
        self.dy[row][lane] = dy;
        self.vx[row][lane] = vx;
        self.vy[row][lane] = vy;
        self.distance_m2[row][lane] = distance_m2;
        self.gap_m2[row][lane] = gap_m2;
    }

    /// Fills the unused lanes with an obstacle out of reach.
    fn fill_up(&mut self) {
        for at in self.count..self.count.next_multiple_of(LANES) {
            self.set(at, NOWHERE_M, 0.0, [0.0; 2], NOWHERE_M * NOWHERE_M, NOWHERE_M * NOWHERE_M);
        }
    }

    /// Distance along the heading `u` at this speed before somebody is touched, at most [`HORIZON_M`], metres.
    ///
    /// Two who move on evenly touch at the first root of `|d + w t| = r`.
    fn free_m(&self, u: [f32; 2], speed_m_s: f32) -> f32 {
        let (ux, uy) = (f32x8::splat(u[0] * speed_m_s), f32x8::splat(u[1] * speed_m_s));
        let never_s = f32x8::splat(HORIZON_M / speed_m_s);
        let mut first_s = never_s;
        for row in 0..self.count.div_ceil(LANES) {
            let (wx, wy) = (ux - f32x8::new(self.vx[row]), uy - f32x8::new(self.vy[row]));
            let towards = f32x8::new(self.dx[row]) * wx + f32x8::new(self.dy[row]) * wy;
            let w2 = wx * wx + wy * wy + f32x8::splat(1e-6);
            let gap_m2 = f32x8::new(self.gap_m2[row]).fast_max(f32x8::ZERO);
            let discriminant = towards * towards - w2 * gap_m2;
            let touch_s = (towards - discriminant.fast_max(f32x8::ZERO).sqrt()) / w2;
            let touches = towards.simd_gt(f32x8::ZERO) & discriminant.simd_gt(f32x8::ZERO);
            first_s = first_s.fast_min(touches.bitselect(touch_s, never_s));
        }
        let first_s = first_s.to_array().into_iter().fold(f32::INFINITY, f32::min);
        (first_s * speed_m_s).clamp(0.0, HORIZON_M)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn others(list: &[[f32; 4]]) -> Obstacles {
        let mut others = Obstacles::default();
        for &[dx, dy, vx, vy] in list {
            let distance_m2 = dx * dx + dy * dy;
            if others.has_room(distance_m2) {
                others.add(dx, dy, &BodyState { vx, vy, ..BodyState::default() }, distance_m2, 0.5);
            }
        }
        others.fill_up();
        others
    }

    #[test]
    fn headings_have_length_one_and_turn_ever_further() {
        assert!(HEADINGS.iter().all(|[cos, sin]| (cos * cos + sin * sin - 1.0).abs() < 1e-4));
        assert!(HEADINGS.is_sorted_by(|a, b| a[0] > b[0]));
    }

    #[test]
    fn somebody_who_stands_ahead_is_reached_where_the_discs_touch() {
        let stands = others(&[[3.0, 0.0, 0.0, 0.0]]);
        assert!((stands.free_m([1.0, 0.0], 1.5) - 2.5).abs() < 1e-3);
        assert_eq!(stands.free_m([0.0, 1.0], 1.5), HORIZON_M);
    }

    #[test]
    fn somebody_who_comes_is_met_half_way_and_who_leaves_is_not_met() {
        assert!((others(&[[3.0, 0.0, -1.5, 0.0]]).free_m([1.0, 0.0], 1.5) - 1.25).abs() < 1e-3);
        assert_eq!(others(&[[3.0, 0.0, 1.5, 0.0]]).free_m([1.0, 0.0], 1.4), HORIZON_M);
        // Whoever is touched already leaves no way towards them, and all ways away from them.
        let touched = others(&[[0.4, 0.0, 0.0, 0.0]]);
        assert_eq!(touched.free_m([1.0, 0.0], 1.0), 0.0);
        assert_eq!(touched.free_m([-1.0, 0.0], 1.0), HORIZON_M);
    }

    #[test]
    fn with_more_people_than_are_weighed_the_nearest_count() {
        let far: Vec<[f32; 4]> = (0..60).map(|k| [4.0, 0.05 * k as f32 - 1.5, 0.0, 0.0]).collect();
        let mut list = far.clone();
        list.push([1.0, 0.0, 0.0, 0.0]);
        assert!((others(&list).free_m([1.0, 0.0], 1.0) - 0.5).abs() < 1e-3);
    }
}
