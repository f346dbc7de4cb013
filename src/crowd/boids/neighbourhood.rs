//! Neighbourhood of an agent: all others within sensing distance, weighed eight at a time.

use wide::f32x8;

use crate::crowd::neighbours::{LANES, NOWHERE_M, NeighbourGrid};
use crate::crowd::perception::SENSE_M;
use crate::crowd::state::{BodyState, Traits};

/// Largest number of others within sensing distance; more do not fit there.
const MOST_SEEN: usize = 96;
/// Cosine between headings from which on two go the same way.
const ALIKE: f32 = 0.3;
/// Weight of those who come the other way in the density ahead: people walk behind others, but dodge those who come.
///
/// Counter flow passes about as many people as one-way flow (Zhang et al. 2012, J. Stat. Mech. P02002).
const AGAINST: f32 = 0.3;
/// People per square metre at which the acceptable distance is half way down to the exclusion distance.
const CROWDED: f32 = 1.2;
/// Time over which people foresee others, seconds.
const FORESIGHT_S: f32 = 1.2;
/// Sidestep of those who meet head on, to their right, metres: somebody has to begin.
const SIDESTEP_M: f32 = 0.08;
/// Least time in which two people close the gap between them, seconds.
const CLOSING_S: f32 = 0.35;
/// Gap beyond which people do not collide, metres.
const BUMPING_M: f32 = 1.2;

/// One quantity of all others.
type Column<T = f32> = [[T; LANES]; MOST_SEEN / LANES];

/// All others around an agent, relative to it. Reused from agent to agent.
#[derive(Clone, Debug, Default)]
pub(super) struct Neighbourhood {
    count: usize,
    /// Indices into [`NeighbourGrid::bodies`].
    index: Column<u32>,
    dx: Column,
    dy: Column,
    vx: Column,
    vy: Column,
    aim_x: Column,
    aim_y: Column,
    half_exclusion_m: Column,
}

/// Weighted sums over the neighbourhood.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct NeighbourSums {
    /// Weighted count of the people ahead.
    pub(super) count: f32,
    /// Weighted count and velocity of those among them who go the same way.
    pub(super) alike: f32,
    pub(super) alike_vx: f32,
    pub(super) alike_vy: f32,
}

impl Neighbourhood {
    /// Finds all others within sensing distance; `sees` tells of those who may be behind a wall.
    pub(super) fn find(&mut self, neighbours: &NeighbourGrid, index: usize, sees: impl Fn(f32, f32) -> bool) {
        let me = neighbours.bodies[index];
        let reach2 = (SENSE_M * SENSE_M) as f32;
        let mut count = 0;
        neighbours.around(me.x, me.y, |range, shift| {
            let x = me.x - shift;
            let start = range.start;
            for (k, body) in neighbours.bodies[range].iter().enumerate() {
                let (dx, dy) = (body.x - x, body.y - me.y);
                let d2 = dx * dx + dy * dy;
                let other = start + k;
                if d2 >= reach2 || other == index || count == MOST_SEEN {
                    continue;
                }
                let clear_m = me.clearance_m + body.clearance_m;
                if d2 > clear_m * clear_m && !sees(dx, dy) {
                    continue;
                }
                self.set(count, other as u32, dx, dy, body);
                count += 1;
            }
        });
        self.count = count;
        let far = BodyState { vx: me.vx, vy: me.vy, ..BodyState::default() };
        while count % LANES != 0 {
            self.set(count, 0, NOWHERE_M, 0.0, &far);
            count += 1;
        }
    }

    #[inline]
    fn set(&mut self, at: usize, index: u32, dx: f32, dy: f32, body: &BodyState) {
        let (row, lane) = (at / LANES, at % LANES);
        self.index[row][lane] = index;
        self.dx[row][lane] = dx;
        self.dy[row][lane] = dy;
        self.vx[row][lane] = body.vx;
        self.vy[row][lane] = body.vy;
        self.aim_x[row][lane] = body.aim_x;
        self.aim_y[row][lane] = body.aim_y;
        self.half_exclusion_m[row][lane] = body.half_exclusion_m;
    }

    #[inline]
    fn rows(&self) -> usize {
        self.count.div_ceil(LANES)
    }

    /// Sums over all others, weighted by distance and by how far ahead they are, see [`kernel`](super::floor::kernel).
    pub(super) fn weigh(&self, me: &BodyState) -> NeighbourSums {
        let [mut count, mut alike, mut alike_vx, mut alike_vy] = [f32x8::ZERO; 4];
        let (aim_x, aim_y) = (f32x8::splat(me.aim_x), f32x8::splat(me.aim_y));
        for row in 0..self.rows() {
            let (dx, dy) = (f32x8::new(self.dx[row]), f32x8::new(self.dy[row]));
            let d2 = dx * dx + dy * dy;
            let inside = (f32x8::ONE - d2 * f32x8::splat((1.0 / (SENSE_M * SENSE_M)) as f32)).fast_max(f32x8::ZERO);
            let ahead = (dx * aim_x + dy * aim_y) / d2.sqrt().fast_max(f32x8::splat(1e-4));
            let weight = inside * inside * f32x8::HALF * (f32x8::ONE + ahead);
            let agree = f32x8::new(self.aim_x[row]) * aim_x + f32x8::new(self.aim_y[row]) * aim_y;
            let against = agree.simd_lt(f32x8::splat(-ALIKE)) & weight;
            count += weight - f32x8::splat(1.0 - AGAINST) * against;
            let weight = agree.simd_gt(f32x8::splat(ALIKE)) & weight;
            alike += weight;
            alike_vx += weight * f32x8::new(self.vx[row]);
            alike_vy += weight * f32x8::new(self.vy[row]);
        }
        let [count, alike, alike_vx, alike_vy] = [count, alike, alike_vx, alike_vy].map(sum);
        NeighbourSums { count, alike, alike_vx, alike_vy }
    }

    /// Separation: sum of the pushes away from others who come nearer than the acceptable distance, now or soon.
    pub(super) fn separate(&self, me: &BodyState, traits: &Traits, people_per_m2: f32) -> [f32; 2] {
        let crowded = 1.0 / (1.0 + people_per_m2 / CROWDED);
        let beyond_m = f32x8::splat((traits.acceptable_m - traits.exclusion_m).max(0.05) * crowded);
        let own_half_m = f32x8::splat(me.half_exclusion_m);
        let (aim_x, aim_y) = (f32x8::splat(me.aim_x), f32x8::splat(me.aim_y));
        let (own_vx, own_vy) = (f32x8::splat(me.vx), f32x8::splat(me.vy));
        let least = f32x8::splat(1e-3);
        let foresight_s = f32x8::splat(FORESIGHT_S);
        let [mut push_x, mut push_y] = [f32x8::ZERO; 2];
        for row in 0..self.rows() {
            let (dx, dy) = (f32x8::new(self.dx[row]), f32x8::new(self.dy[row]));
            let (vx, vy) = (f32x8::new(self.vx[row]), f32x8::new(self.vy[row]));
            let acceptable_m = own_half_m + f32x8::new(self.half_exclusion_m[row]) + beyond_m;
            let (wx, wy) = (vx - own_vx, vy - own_vy);
            let w2 = wx * wx + wy * wy;
            // When the two come nearest, within the time that people foresee.
            let nearest_s = (-(dx * wx + dy * wy)) / (w2 + least);
            let soon_s = nearest_s.fast_max(f32x8::ZERO).fast_min(foresight_s);
            let ahead = dx * aim_x + dy * aim_y;
            // Head on: as if the other came a little more from the left.
            let head_on = soon_s.simd_gt(f32x8::ZERO)
                & ahead.simd_gt(f32x8::ZERO)
                & (vx * aim_x + vy * aim_y).simd_lt(f32x8::ZERO);
            let aside = head_on & f32x8::splat(SIDESTEP_M);
            let qx = dx + wx * soon_s - aim_y * aside;
            let qy = dy + wy * soon_s + aim_x * aside;
            let q = (qx * qx + qy * qy).sqrt().fast_max(least);
            let d = (dx * dx + dy * dy).sqrt().fast_max(least);
            let seen = f32x8::splat(0.625) + f32x8::splat(0.375) * (ahead / d);
            let near = (f32x8::ONE - q / acceptable_m).fast_max(f32x8::ZERO);
            let strength = near * (f32x8::ONE - soon_s / foresight_s) * seen / q;
            push_x -= qx * strength;
            push_y -= qy * strength;
        }
        [sum(push_x), sum(push_y)]
    }

    /// Reduces a velocity that would close the gap between two bodies too fast; each of them takes half.
    pub(super) fn keep_from_bumping(&self, me: &BodyState, velocity: &mut [f32; 2]) {
        let own_half_m = f32x8::splat(me.half_exclusion_m);
        for row in 0..self.rows() {
            let (dx, dy) = (f32x8::new(self.dx[row]), f32x8::new(self.dy[row]));
            let d = (dx * dx + dy * dy).sqrt().fast_max(f32x8::splat(1e-3));
            let exclusion_m = own_half_m + f32x8::new(self.half_exclusion_m[row]);
            let gap_m = d - exclusion_m;
            let allowed_m_s = gap_m.fast_max(f32x8::ZERO) / f32x8::splat(CLOSING_S);
            let (nx, ny) = (dx / d, dy / d);
            let (vx, vy) = (f32x8::new(self.vx[row]), f32x8::new(self.vy[row]));
            let [own_x, own_y] = velocity.map(f32x8::splat);
            let closing = (own_x - vx) * nx + (own_y - vy) * ny;
            let mut bumps = (closing.simd_gt(allowed_m_s) & gap_m.simd_lt(f32x8::splat(BUMPING_M))).to_bitmask();
            if bumps == 0 {
                continue;
            }
            let [nx, ny, allowed_m_s, vx, vy] = [nx, ny, allowed_m_s, vx, vy].map(f32x8::to_array);
            // One after the other: what was given up for one counts for the next.
            while bumps != 0 {
                let lane = bumps.trailing_zeros() as usize;
                bumps &= bumps - 1;
                let closing = (velocity[0] - vx[lane]) * nx[lane] + (velocity[1] - vy[lane]) * ny[lane];
                let too_fast = (closing - allowed_m_s[lane]).max(0.0);
                velocity[0] -= 0.5 * too_fast * nx[lane];
                velocity[1] -= 0.5 * too_fast * ny[lane];
            }
        }
    }

    /// Calls `each` with the indices of others who will be within `gap_m` of touching after `dt` seconds.
    ///
    /// Others keep their velocity, the agent has this one.
    pub(super) fn within(&self, me: &BodyState, velocity: [f32; 2], dt: f32, gap_m: f32, mut each: impl FnMut(u32)) {
        let reach_m = f32x8::splat(me.half_exclusion_m + gap_m);
        let [own_x, own_y] = velocity.map(f32x8::splat);
        let dt = f32x8::splat(dt);
        for row in 0..self.rows() {
            let x = f32x8::new(self.dx[row]) + (f32x8::new(self.vx[row]) - own_x) * dt;
            let y = f32x8::new(self.dy[row]) + (f32x8::new(self.vy[row]) - own_y) * dt;
            let reach_m = reach_m + f32x8::new(self.half_exclusion_m[row]);
            let mut near = (x * x + y * y).simd_lt(reach_m * reach_m).to_bitmask();
            while near != 0 {
                let lane = near.trailing_zeros() as usize;
                near &= near - 1;
                each(self.index[row][lane]);
            }
        }
    }
}

/// Sum of all lanes in their order: a horizontal sum of the machine's may add in another.
#[inline]
fn sum(lanes: f32x8) -> f32 {
    lanes.to_array().into_iter().sum()
}
