//! Social forces as pure functions, see [`SocialForceOptions`] and [`GroupOptions`].

use super::{GroupOptions, SocialForceOptions};
use crate::math::{SplitMix64, atan2, exp_f32};

/// Share of the strongest interaction below which others exert no force: natural logarithm of 0.001.
const LEAST_SHARE_LN: f32 = -6.907_755;
/// Interval between draws of the random acceleration, seconds.
const FLUCTUATION_S: f64 = 1.0;
/// Odd number that sets the draws of one interval apart from those of the next.
const KNOT: u64 = 0xd1b5_4a32_d192_ed03;
/// Distance over which the forces of the group grow from nothing to all, metres: a step would make people tremble.
const SOFT_M: f32 = 0.1;

/// The forces with their parameters.
#[derive(Clone, Debug)]
pub(super) struct Forces {
    options: SocialForceOptions,
    groups: GroupOptions,
}

impl Forces {
    pub(super) fn new(options: &SocialForceOptions, groups: &GroupOptions) -> Forces {
        Forces { options: options.clone(), groups: groups.clone() }
    }

    /// Time in which the desired velocity is taken up, seconds.
    pub(super) fn relaxation_s(&self) -> f32 {
        self.options.relaxation as f32
    }

    /// Acceleration by another at the offset `d` and the relative velocity `w`; `aim` is the agent's wanted direction.
    pub(super) fn by_person(&self, d: [f32; 2], w: [f32; 2], aim: [f32; 2]) -> [f32; 2] {
        let distance_m = (d[0] * d[0] + d[1] * d[1]).sqrt().max(1e-3);
        let e = [d[0] / distance_m, d[1] / distance_m];
        let interaction = [e[0] - self.options.foresight as f32 * w[0], e[1] - self.options.foresight as f32 * w[1]];
        let length = (interaction[0] * interaction[0] + interaction[1] * interaction[1]).sqrt();
        let range_m = self.options.range as f32 * length;
        if distance_m > -LEAST_SHARE_LN * range_m {
            return [0.0; 2];
        }
        let t = [interaction[0] / length, interaction[1] / length];
        let n = [-t[1], t[0]];
        let sin = t[0] * e[1] - t[1] * e[0];
        let theta = angle(sin, t[0] * e[0] + t[1] * e[1]);
        let slowing = self.options.slowing_width as f32 * range_m * theta;
        let aside = self.options.aside_width as f32 * range_m * theta;
        let along = exp_f32(-distance_m / range_m - slowing * slowing);
        let across = self.side(theta, range_m) * exp_f32(-distance_m / range_m - aside * aside);
        let ahead = 0.5 * (1.0 + e[0] * aim[0] + e[1] * aim[1]);
        let strength =
            -self.options.strength as f32 * (self.options.behind as f32 + (1.0 - self.options.behind as f32) * ahead);
        [strength * (along * t[0] + across * n[0]), strength * (along * t[1] + across * n[1])]
    }

    /// Acceleration out of the way of somebody who gives way to nobody, at the offset `d` and the relative velocity `w`.
    ///
    /// It points away from where they will be nearest, until they pass at `apart_m`, middle to middle.
    pub(super) fn out_of_the_way(d: [f32; 2], w: [f32; 2], apart_m: f32) -> [f32; 2] {
        let closing = -(d[0] * w[0] + d[1] * w[1]);
        let w2 = w[0] * w[0] + w[1] * w[1];
        if closing <= 0.0 || closing > w2 * FORESEEN_S {
            return [0.0; 2];
        }
        let nearest_s = closing / w2;
        let miss = [d[0] + w[0] * nearest_s, d[1] + w[1] * nearest_s];
        let miss_m = (miss[0] * miss[0] + miss[1] * miss[1]).sqrt();
        if miss_m >= apart_m {
            return [0.0; 2];
        }
        // Head on, to the right.
        let length = w2.sqrt();
        let away = match miss_m > HEAD_ON_M {
            true => [-miss[0] / miss_m, -miss[1] / miss_m],
            false => [-w[1] / length, w[0] / length],
        };
        let needed_m_s = (apart_m - miss_m) / nearest_s.max(SOONEST_S);
        away.map(|axis| axis * needed_m_s * EAGERNESS_PER_S)
    }

    /// Acceleration that keeps somebody from running into another, `gap_m` away, at the offset `d` and the relative velocity
    /// `w`: as hard as is needed, once it is needed.
    pub(super) fn brake(d: [f32; 2], w: [f32; 2], gap_m: f32) -> [f32; 2] {
        let distance_m = (d[0] * d[0] + d[1] * d[1]).sqrt().max(1e-3);
        let e = [d[0] / distance_m, d[1] / distance_m];
        let closing_m_s = -(e[0] * w[0] + e[1] * w[1]);
        let needed = closing_m_s * closing_m_s / (2.0 * gap_m.max(LEAST_GAP_M));
        if closing_m_s <= 0.0 || needed < BRAKES_M_S2 {
            [0.0; 2]
        } else {
            e.map(|axis| -axis * needed.min(MOST_BRAKING))
        }
    }

    /// Side on which another is: 1 on the left, -1 on the right, in between straight ahead.
    fn side(&self, theta: f32, range_m: f32) -> f32 {
        let comes = (range_m - self.options.range as f32).max(0.0);
        ((theta + LEFT_RAD_M * comes) / STRAIGHT_RAD).clamp(-1.0, 1.0)
    }

    /// Random acceleration of an agent at a time, the same for any time step.
    ///
    /// It is drawn every [`FLUCTUATION_S`] and interpolated linearly in between.
    pub(super) fn by_chance(&self, wander: u64, time_s: f64) -> [f32; 2] {
        if self.options.fluctuation as f32 == 0.0 {
            return [0.0; 2];
        }
        let at = time_s / FLUCTUATION_S;
        let (knot, share) = (at as u64, at.fract() as f32);
        let [before, after] = [knot, knot + 1].map(|knot| {
            let mut draws = SplitMix64::new(wander.wrapping_add(knot.wrapping_mul(KNOT)));
            [draws.range(-1.0, 1.0), draws.range(-1.0, 1.0)]
        });
        // Uniform in [-1, 1] deviates by 1 / sqrt(3).
        let scale = self.options.fluctuation as f32 * 1.732_050_8;
        [0, 1].map(|axis| scale * (before[axis] + (after[axis] - before[axis]) * share))
    }

    /// Acceleration away from a wall at this distance from the body's edge, metres per second squared.
    pub(super) fn by_wall(&self, gap_m: f32) -> f32 {
        self.options.wall_strength as f32 * exp_f32(-gap_m.max(0.0) / self.options.wall_range as f32)
    }

    /// Distance from the body's edge beyond which a wall exerts no force, metres.
    pub(super) fn wall_reach_m(&self) -> f32 {
        -LEAST_SHARE_LN * self.options.wall_range as f32
    }

    /// Acceleration towards the group: the others are at the offsets `mates`, the agent walks at `velocity`.
    ///
    /// ```text
    /// -beta1 alpha v                 alpha: the head's turn beyond the field of view that shows the others' middle
    /// +beta2 U   if |U'| > r (N - 1) U: towards the middle of all N
    /// -beta3 W   if |W'| < d0        W: towards each other member
    /// ```
    pub(super) fn by_group(&self, mates: &[[f32; 2]], velocity: [f32; 2]) -> [f32; 2] {
        let others = mates.len() as f32;
        let [mut ax, mut ay] = [0.0; 2];
        let [mut cx, mut cy] = [0.0; 2];
        for &[dx, dy] in mates {
            cx += dx;
            cy += dy;
            let distance_m = (dx * dx + dy * dy).sqrt().max(1e-3);
            let near =
                self.groups.repulsion as f32 * ((self.groups.distance as f32 - distance_m) / SOFT_M).clamp(0.0, 1.0);
            ax -= near * dx / distance_m;
            ay -= near * dy / distance_m;
        }
        // People look at the middle of the others; the middle of the whole group is nearer to them.
        let middle_m = (cx * cx + cy * cy).sqrt() / (others + 1.0);
        if middle_m < 1e-3 {
            return [ax, ay];
        }
        let [ux, uy] = [cx / (middle_m * (others + 1.0)), cy / (middle_m * (others + 1.0))];
        let far =
            self.groups.cohesion as f32 * ((middle_m - self.groups.reach as f32 * others) / SOFT_M).clamp(0.0, 1.0);
        let [vx, vy] = velocity;
        let turned = angle(vx * uy - vy * ux, vx * ux + vy * uy).abs();
        let gaze = self.groups.gaze as f32 * (turned - self.groups.view_deg.to_radians() as f32).max(0.0);
        [ax + far * ux - gaze * vx, ay + far * uy - gaze * vy]
    }
}

/// Angle whose sine and cosine are in this proportion, radians.
fn angle(sin: f32, cos: f32) -> f32 {
    atan2(f64::from(sin), f64::from(cos)) as f32
}

/// Bias of oncoming people to the left per metre of the interaction's range, radians: those who meet step to the right.
///
/// Ours; Moussaid et al. 2009 have such a bias too, for everybody: `theta + epsilon B`, epsilon about 0.005.
const LEFT_RAD_M: f32 = 0.01;
/// How far ahead people foresee who gives way to nobody, and the least time that they reckon with, seconds.
const FORESEEN_S: f32 = 3.0;
const SOONEST_S: f32 = 0.3;
/// How quickly they take up the velocity that leads them past, per second.
const EAGERNESS_PER_S: f32 = 8.0;
/// Distance at which others pass up to which they come head on, metres.
const HEAD_ON_M: f32 = 0.05;
/// Gap that braking reckons with at least, metres, and the deceleration from which on people brake, and the hardest, metres
/// per second squared.
const LEAST_GAP_M: f32 = 0.03;
const BRAKES_M_S2: f32 = 1.5;
const MOST_BRAKING: f32 = 8.0;
/// Angle from straight ahead over which one side blends into the other, radians: a step would make followers swerve.
const STRAIGHT_RAD: f32 = 0.02;

#[cfg(test)]
mod tests {
    use super::*;

    fn forces() -> Forces {
        Forces::new(&SocialForceOptions::default(), &GroupOptions::default())
    }

    fn naive(d: [f64; 2], w: [f64; 2]) -> [f64; 2] {
        let (a, gamma, n, n_prime, lambda) = (4.5f64, 0.35f64, 2.0f64, 3.0f64, 2.0f64);
        let distance = (d[0] * d[0] + d[1] * d[1]).sqrt();
        let e = [d[0] / distance, d[1] / distance];
        let big_d = [e[0] - lambda * w[0], e[1] - lambda * w[1]];
        let length = (big_d[0] * big_d[0] + big_d[1] * big_d[1]).sqrt();
        let t = [big_d[0] / length, big_d[1] / length];
        let theta = libm::atan2(t[0] * e[1] - t[1] * e[0], t[0] * e[0] + t[1] * e[1]);
        let b = gamma * length;
        let f_v = -a * libm::exp(-distance / b - (n_prime * b * theta) * (n_prime * b * theta));
        let f_theta = -a * theta.signum() * libm::exp(-distance / b - (n * b * theta) * (n * b * theta));
        [f_v * t[0] - f_theta * t[1], f_v * t[1] + f_theta * t[0]]
    }

    #[test]
    fn the_interaction_is_the_published_one() {
        let options = SocialForceOptions { behind: 1.0, ..SocialForceOptions::default() };
        let all_round = Forces::new(&options, &GroupOptions::default());
        for (d, w) in [([1.0, 0.4], [-1.5, 0.2]), ([2.5, -0.5], [-2.6, 0.0]), ([0.3, 0.4], [0.2, 0.1])] {
            let found = all_round.by_person(d, w, [1.0, 0.0]);
            let published = naive(d.map(f64::from), w.map(f64::from));
            for axis in 0..2 {
                assert!((f64::from(found[axis]) - published[axis]).abs() < 1e-4, "{found:?} {published:?}");
            }
        }
    }

    #[test]
    fn who_comes_head_on_is_passed_on_the_right_and_who_is_behind_hardly_counts() {
        let forces = forces();
        let [ax, ay] = forces.by_person([2.0, 0.0], [-2.6, 0.0], [1.0, 0.0]);
        assert!(ax < -0.5 && ay < -0.5, "{ax} {ay}");
        let [ahead, _] = forces.by_person([0.8, 0.0], [0.0, 0.0], [1.0, 0.0]);
        let [behind, _] = forces.by_person([-0.8, 0.0], [0.0, 0.0], [1.0, 0.0]);
        assert!((behind / -ahead - 0.06).abs() < 1e-3, "{behind} {ahead}");
    }

    #[test]
    fn who_gives_way_to_nobody_is_passed_in_time_and_nobody_is_run_into() {
        let [ax, ay] = Forces::out_of_the_way([3.0, 0.0], [-2.4, 0.0], 0.6);
        assert!(ax.abs() < 1e-6 && ay < -2.0, "{ax} {ay}");
        assert!(Forces::out_of_the_way([3.0, 0.2], [-2.4, 0.0], 0.6)[1] < -1.0);
        assert_eq!(Forces::out_of_the_way([3.0, 0.7], [-2.4, 0.0], 0.6), [0.0; 2]);
        assert_eq!(Forces::out_of_the_way([3.0, 0.0], [2.4, 0.0], 0.6), [0.0; 2]);
        assert_eq!(Forces::brake([1.0, 0.0], [-1.0, 0.0], 0.7), [0.0; 2]);
        assert!((Forces::brake([1.0, 0.0], [-2.0, 0.0], 0.5)[0] + 4.0).abs() < 1e-5);
        assert_eq!(Forces::brake([1.0, 0.0], [2.0, 0.0], 0.5), [0.0; 2]);
    }

    #[test]
    fn a_group_waits_for_who_is_behind_and_pulls_in_who_is_far() {
        let forces = forces();
        // The other a little behind: brake. A little ahead: go on.
        // What pulls both together is the same in both cases, mirrored.
        let [behind, _] = forces.by_group(&[[-0.3, 0.85]], [1.2, 0.0]);
        let [ahead, _] = forces.by_group(&[[0.3, 0.85]], [1.2, 0.0]);
        assert!(behind < -0.5 && ahead >= 0.0 && behind + ahead < -0.5, "{behind} {ahead}");
        let [_, far] = forces.by_group(&[[0.0, 1.4]], [1.2, 0.0]);
        let [_, near] = forces.by_group(&[[0.0, 0.5]], [1.2, 0.0]);
        assert!((far - 3.0).abs() < 1e-5 && (near + 1.0).abs() < 1e-5, "{far} {near}");
        // The outer ones of three may be farther from the middle.
        assert_eq!(forces.by_group(&[[0.0, 0.81], [0.0, 1.55]], [1.2, 0.0]), [0.0, 0.0]);
        // Nobody to be with, and all in one place.
        assert_eq!(forces.by_group(&[], [1.2, 0.0]), [0.0, 0.0]);
        assert!(forces.by_group(&[[0.0, 0.0]], [0.0, 0.0]).iter().all(|a| a.is_finite()));
    }
}
