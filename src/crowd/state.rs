//! What the crowd knows of everybody present.

use crate::math::{Distribution, Purpose, Vec2, person_stream, vec2};

use super::CrowdOptions;

/// What others see of a person.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Body {
    /// Position, metres.
    pub(super) x: f32,
    pub(super) y: f32,
    /// Velocity, metres per second.
    pub(super) vx: f32,
    pub(super) vy: f32,
    /// Unit vector towards where the person wants to go.
    pub(super) aim_x: f32,
    pub(super) aim_y: f32,
    /// Half of the exclusion distance, metres.
    pub(super) half_exclusion_m: f32,
    /// A distance that no wall comes nearer than, metres.
    pub(super) clearance_m: f32,
}

impl Body {
    pub(super) fn position(&self) -> Vec2 {
        vec2(f64::from(self.x), f64::from(self.y))
    }
}

/// What a person is like: drawn once, a function of (seed, id).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Traits {
    pub(super) speed_m_s: f32,
    pub(super) exclusion_m: f32,
    pub(super) acceptable_m: f32,
    pub(super) wall_exclusion_m: f32,
    pub(super) wall_acceptable_m: f32,
    /// Which share of the way's width, from the left, the person likes to walk at.
    pub(super) lane: f32,
    /// Uniform in `[0, 1)`: where the person vanishes.
    pub(super) goal_draw: f32,
}

impl Traits {
    pub(super) fn draw(seed: u64, id: u32, options: &CrowdOptions) -> Traits {
        let rng = &mut person_stream(seed, id, Purpose::Walk);
        let mut draw = |d: &Distribution| d.draw(rng) as f32;
        let exclusion_m = draw(&options.exclusion);
        let wall_exclusion_m = draw(&options.wall_exclusion);
        let unit = Distribution::Uniform([0.0, 1.0]);
        Traits {
            speed_m_s: draw(&options.speed),
            exclusion_m,
            // Nobody accepts less than what is possible at all.
            acceptable_m: draw(&options.acceptable).max(exclusion_m),
            wall_exclusion_m,
            wall_acceptable_m: draw(&options.wall_acceptable).max(wall_exclusion_m),
            lane: draw(&unit),
            goal_draw: draw(&unit),
        }
    }
}

/// Where a person is on the route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Course {
    pub(super) id: u32,
    pub(super) route: u32,
    /// The next gate; as many as there are gates once all are passed.
    pub(super) gate: u32,
    /// The least distance left so far, metres, legs behind included.
    pub(super) least_left_m: f32,
    /// When that was last improved, seconds.
    pub(super) improved_s: f64,
    /// Where in a goal area the person vanishes, metres; for openings, x is the depth beyond the edge.
    pub(super) end_m: Vec2,
    /// Share of the speed that the person wants now: less when about to stop.
    pub(super) pace: f32,
    /// For how long somebody who comes the other way has been in the way, seconds.
    pub(super) blocked_s: f32,
}

impl Course {
    /// Share of the exclusion distance that the person claims: those who block each other turn sideways after a while
    /// and squeeze past, as in a passage for one.
    pub(super) fn squeeze(&self) -> f32 {
        (1.0 - (self.blocked_s - SQUEEZE_AFTER_S) / SQUEEZE_OVER_S).clamp(SQUEEZED, 1.0)
    }
}

/// People who block each other wait so long, seconds, ...
const SQUEEZE_AFTER_S: f32 = 4.0;
/// ... then get thinner over so long, seconds ...
const SQUEEZE_OVER_S: f32 = 8.0;
/// ... down to this share of their exclusion distance.
const SQUEEZED: f32 = 0.35;
