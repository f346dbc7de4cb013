//! Going round others in good time: the heading that leads farthest towards the goal before somebody is in the way.
//!
//! After Moussaid, Helbing and Theraulaz 2011 (doi 10.1073/pnas.1016507108): people choose the direction that, for
//! what they see, brings them nearest to where they want to go. Lanes in counter flow follow from it.

use super::neighbours::Neighbours;
use super::state::{Body, Traits};
use crate::math::vec2;
use crate::routes::Ground;
use crate::walls::Walls;

/// How far ahead people look for somebody in the way, metres.
const HORIZON_M: f32 = 4.5;
/// Where the middle of what they look at lies ahead of them, metres.
const CENTRE_M: f32 = 2.2;
/// Room that is wanted between two who pass each other, metres beyond their exclusion distance.
const PASSING_M: f32 = 0.12;
/// Most people who are weighed; more are not taken in at a glance.
const MOST_WEIGHED: usize = 24;
/// Headings that are weighed against the straight one: cosine and sine, right before left.
const HEADINGS: [[f32; 2]; 13] = [
    [1.0, 0.0],
    [0.992_546, -0.121_869],
    [0.992_546, 0.121_869],
    [0.970_296, -0.241_922],
    [0.970_296, 0.241_922],
    [0.927_184, -0.374_607],
    [0.927_184, 0.374_607],
    [0.848_048, -0.529_919],
    [0.848_048, 0.529_919],
    [0.731_354, -0.681_998],
    [0.731_354, 0.681_998],
    [0.5, -0.866_025],
    [0.5, 0.866_025],
];
/// Whoever makes less way than this, metres per second, ...
const BLOCKED_M_S: f32 = 0.15;
/// ... with somebody against them within this, metres, is blocked.
const BLOCKING_M: f32 = 0.8;
/// Extra cost of the left, and of leaving the heading taken before, as shares of the squared horizon.
const LEFT: f32 = 0.02;
const CHANGE: f32 = 0.15;

/// Somebody who may get in the way.
#[derive(Clone, Copy, Debug, Default)]
struct Other {
    dx: f32,
    dy: f32,
    vx: f32,
    vy: f32,
    radius_m: f32,
}

/// What the choice looks at.
pub(super) struct Sights<'a> {
    pub(super) neighbours: &'a Neighbours,
    pub(super) ground: &'a Ground,
    pub(super) walls: &'a Walls,
}

impl Sights<'_> {
    /// The heading to take for somebody who wants to go along the unit vector `wanted`.
    pub(super) fn heading(&self, me: &Body, traits: &Traits, wanted: [f32; 2], before: [f32; 2]) -> [f32; 2] {
        let mut others = [Other::default(); MOST_WEIGHED];
        let count = self.in_the_way(me, wanted, &mut others);
        let others = &others[..count];
        let speed = traits.speed_m_s;
        let free = |u: [f32; 2]| {
            let nearest =
                others.iter().map(|o| meeting_s(o, [u[0] * speed, u[1] * speed])).fold(f32::INFINITY, f32::min);
            (nearest * speed).min(HORIZON_M)
        };
        let straight = free(wanted);
        if straight >= HORIZON_M {
            return wanted;
        }
        let mut best = (f32::INFINITY, wanted);
        for (k, [cos, sin]) in HEADINGS.into_iter().enumerate() {
            let u = [wanted[0] * cos - wanted[1] * sin, wanted[0] * sin + wanted[1] * cos];
            let far = if k == 0 { straight } else { free(u) };
            let cost = |far: f32| {
                let mut cost = HORIZON_M * HORIZON_M + far * far - 2.0 * HORIZON_M * far * cos;
                if sin > 0.0 {
                    cost += LEFT * HORIZON_M * HORIZON_M;
                }
                cost + CHANGE * HORIZON_M * HORIZON_M * (1.0 - (u[0] * before[0] + u[1] * before[1]))
            };
            if cost(far) < best.0 {
                let walled = cost(self.free_of_walls_m(me, u, far));
                if walled < best.0 {
                    best = (walled, u);
                }
            }
        }
        best.1
    }

    /// Whether somebody who wants to go the other way stands in the way.
    pub(super) fn is_blocked(&self, me: &Body, wanted: [f32; 2]) -> bool {
        if me.vx * wanted[0] + me.vy * wanted[1] > BLOCKED_M_S {
            return false;
        }
        let mut blocked = false;
        self.neighbours.around(me.x, me.y, |range| {
            for body in &self.neighbours.bodies[range] {
                let dx = self.neighbours.dx(me.x, body.x);
                let dy = body.y - me.y;
                let near = dx * dx + dy * dy < BLOCKING_M * BLOCKING_M;
                let ahead = dx * wanted[0] + dy * wanted[1] > 0.0;
                let against = body.aim_x * wanted[0] + body.aim_y * wanted[1] < -0.3;
                blocked |= near && ahead && against;
            }
        });
        blocked
    }

    /// Collects those ahead who are not on the same way at the same pace, the first ones found.
    fn in_the_way(&self, me: &Body, wanted: [f32; 2], others: &mut [Other; MOST_WEIGHED]) -> usize {
        let mut count = 0;
        let (cx, cy) = (me.x + wanted[0] * CENTRE_M, me.y + wanted[1] * CENTRE_M);
        self.neighbours.around(cx, cy, |range| {
            for body in &self.neighbours.bodies[range] {
                let dx = self.neighbours.dx(me.x, body.x);
                let dy = body.y - me.y;
                let ahead = dx * wanted[0] + dy * wanted[1];
                let d2 = dx * dx + dy * dy;
                if ahead <= 0.05 || d2 > HORIZON_M * HORIZON_M || count == MOST_WEIGHED {
                    continue;
                }
                let d = d2.sqrt();
                if d > me.clearance_m + body.clearance_m {
                    let at = me.position();
                    if !self.ground.sight(self.walls, at, at + vec2(f64::from(dx), f64::from(dy))) {
                        continue;
                    }
                }
                let radius_m = me.half_exclusion_m + body.half_exclusion_m + PASSING_M;
                others[count] = Other { dx, dy, vx: body.vx, vy: body.vy, radius_m };
                count += 1;
            }
        });
        count
    }

    /// How far the way along `u` is free of walls, at most `far`.
    fn free_of_walls_m(&self, me: &Body, u: [f32; 2], far: f32) -> f32 {
        let mut done = me.clearance_m;
        while done < far {
            let at = me.position() + vec2(f64::from(u[0]), f64::from(u[1])) * f64::from(done);
            let free = self.ground.clearance_m(at) as f32 - 0.15;
            if free < 0.03 {
                return done;
            }
            done += free.max(0.1);
        }
        far
    }
}

/// Seconds until the two touch if both keep on, infinite if they never do.
fn meeting_s(other: &Other, velocity: [f32; 2]) -> f32 {
    let (wx, wy) = (velocity[0] - other.vx, velocity[1] - other.vy);
    let towards = other.dx * wx + other.dy * wy;
    if towards <= 0.0 {
        return f32::INFINITY;
    }
    let w2 = wx * wx + wy * wy;
    let gap = other.dx * other.dx + other.dy * other.dy - other.radius_m * other.radius_m;
    if gap <= 0.0 {
        return 0.0;
    }
    let discriminant = towards * towards - w2 * gap;
    if discriminant <= 0.0 {
        return f32::INFINITY;
    }
    (towards - discriminant.sqrt()) / w2
}
