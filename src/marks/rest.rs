//! Standing: feet come together when the body stops, and shift now and then.

use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::math::{Vec2, ln};

use super::feet::{EFFORT_OF_STOP, Feet, FootPlacement, Landing, normal};
use super::track::TICK_S;

/// Time without walking or turning after which a person stands, seconds.
const REST_S: f64 = 0.4;
/// Lag from which a foot is drawn after the standing body, and from which the other foot is set beside it, metres.
const LAGS_M: f64 = 0.13;
const BESIDE_M: f64 = 0.07;
/// Cosine of the angle between foot and body from which a foot is set anew: 23 degrees.
const ASKEW: f64 = 0.92;
/// Path length from which a stop or a start counts fully, and below which it does not count, metres.
const FULL_STOP_M: f64 = 1.0;
const LEAST_STOP_M: f64 = 0.1;
/// Standard deviations of a shifting foot's place, metres, and angle to the body's heading, radians.
const SHIFT_M: f64 = 0.035;
const SHIFT_RAD: f64 = 0.17;
/// Share of shifts that move both feet, and the standard deviation of their new place, metres.
const BOTH_SHIFT: f64 = 0.3;
const NEW_PLACE_M: f64 = 0.05;

/// The standing state of a person.
pub(super) struct Rest {
    still_s: f64,
    rests: bool,
    /// Path length since the last stop, metres.
    moved_m: f64,
    /// Expected number of shifts until the next one.
    until_shift: f64,
    /// Position of the standing body, metres.
    place_m: Vec2,
}

/// A tick of a person's path.
pub(super) struct RestTick {
    pub body_m: Vec2,
    pub facing: Vec2,
    pub walked_m: f64,
    pub turned_rad: f64,
    /// Distance to the body's position two seconds later, metres.
    pub ahead_m: f64,
    /// Shifts of the feet per second.
    pub shifts_per_s: f64,
}

/// Stops and standing time in a tick.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stood {
    pub stood_s: f64,
    /// 1 for a stop or a start, less after a short shuffle.
    pub stops: f64,
    /// Whether the body came to stand in this tick, with its feet side by side.
    pub came_to_rest: bool,
}

impl Rest {
    pub fn new(rng: &mut ChaCha8Rng) -> Rest {
        Rest { still_s: 0.0, rests: false, moved_m: 0.0, until_shift: waiting(rng), place_m: Vec2::ZERO }
    }

    /// Clears the state after a gap in the path.
    pub fn forget(&mut self) {
        (self.still_s, self.rests, self.moved_m) = (0.0, false, 0.0);
    }

    /// Path length since the last stop, metres.
    pub fn moved_m(&self) -> f64 {
        self.moved_m
    }

    /// Advances by a tick; calls `each` with the footfalls of feet that come together or shift.
    pub fn pass(
        &mut self,
        feet: &mut Feet,
        rng: &mut ChaCha8Rng,
        tick: &RestTick,
        each: &mut impl FnMut(FootPlacement),
    ) -> Stood {
        self.moved_m += tick.walked_m;
        if tick.walked_m > 0.0 || tick.turned_rad != 0.0 {
            self.still_s = 0.0;
            let starts = std::mem::take(&mut self.rests) && tick.ahead_m > LEAST_STOP_M;
            return Stood { stops: if starts { event(tick.ahead_m) } else { 0.0 }, ..Stood::default() };
        }
        self.still_s += TICK_S;
        if self.still_s < REST_S {
            return Stood::default();
        }
        if self.rests {
            self.shift(feet, rng, tick, each);
            return Stood { stood_s: TICK_S, ..Stood::default() };
        }
        self.rests = true;
        self.place_m = tick.body_m;
        close(feet, rng, tick, each);
        let stops = self.moved_m > LEAST_STOP_M;
        let stood = Stood { stood_s: TICK_S, stops: if stops { event(self.moved_m) } else { 0.0 }, came_to_rest: true };
        if stops {
            self.moved_m = 0.0;
        }
        stood
    }

    /// Shifts the weight if due: one foot or both to another place and angle.
    fn shift(&mut self, feet: &mut Feet, rng: &mut ChaCha8Rng, tick: &RestTick, each: &mut impl FnMut(FootPlacement)) {
        self.until_shift -= tick.shifts_per_s * TICK_S;
        while self.until_shift <= 0.0 {
            self.until_shift += waiting(rng);
            let left = rng.random::<bool>();
            let both = rng.random::<f64>() < BOTH_SHIFT;
            let [along, across] = std::array::from_fn(|_| NEW_PLACE_M * normal(rng));
            let moved = if both { tick.facing * along + tick.facing.left() * across } else { Vec2::ZERO };
            for left in [Some(left), both.then_some(!left)].into_iter().flatten() {
                let [along, across, askew] = std::array::from_fn(|_| normal(rng));
                let spread = tick.facing * (SHIFT_M * along) + tick.facing.left() * (SHIFT_M * across);
                let landing = standing(feet, tick, self.place_m + moved + spread, SHIFT_RAD * askew);
                each(feet.set_down(rng, left, &landing));
            }
        }
    }
}

/// Draws the feet of a body that has just stopped together, so that they end side by side.
fn close(feet: &mut Feet, rng: &mut ChaCha8Rng, tick: &RestTick, each: &mut impl FnMut(FootPlacement)) {
    let facing = tick.facing;
    // Offset of a foot ahead of the body, if it stands and points like the body.
    let ahead_m = |feet: &Feet, left: bool| {
        let stance = feet.stance(left).filter(|stance| stance.facing.dot(facing) > ASKEW)?;
        let offset = stance.place_m - tick.body_m;
        let side = if left { 1.0 } else { -1.0 };
        let aside_m = side * facing.left().dot(offset) - feet.standing_half_width_m();
        (aside_m.abs() < LAGS_M).then_some(facing.dot(offset))
    };
    let [right_m, left_m] = [false, true].map(|left| ahead_m(feet, left));
    let lag_m = |ahead_m: Option<f64>| ahead_m.map_or(f64::INFINITY, f64::abs);
    let trailing_left = lag_m(left_m) > lag_m(right_m);
    let (trailing_m, leading_m) = if trailing_left { (left_m, right_m) } else { (right_m, left_m) };
    let stays_m = leading_m.filter(|ahead_m| ahead_m.abs() < LAGS_M);
    let beside_m = stays_m.unwrap_or(0.0);
    if trailing_m.is_none_or(|ahead_m| (ahead_m - beside_m).abs() > BESIDE_M) {
        let landing = standing(feet, tick, tick.body_m + facing * beside_m, 0.0);
        each(stopped(feet.set_down(rng, trailing_left, &landing)));
    }
    if stays_m.is_none() {
        let landing = standing(feet, tick, tick.body_m, 0.0);
        each(stopped(feet.set_down(rng, !trailing_left, &landing)));
    }
}

/// A footfall that ends a walk.
fn stopped(step: FootPlacement) -> FootPlacement {
    FootPlacement { effort: EFFORT_OF_STOP, ..step }
}

/// The landing of a foot under a standing body.
fn standing(feet: &Feet, tick: &RestTick, body_m: Vec2, askew_rad: f64) -> Landing {
    Landing {
        body_m,
        facing: tick.facing,
        half_width_m: feet.standing_half_width_m(),
        askew_rad,
        speed_m_s: 0.0,
        braking_m_s2: 0.0,
        turn_rad: 0.0,
    }
}

/// Weight of a stop or a start after a path of this length, 0 to 1.
fn event(way_m: f64) -> f64 {
    (way_m / FULL_STOP_M).min(1.0)
}

/// Draws the expected number of events until the next one: exponential with mean 1.
pub(super) fn waiting(rng: &mut ChaCha8Rng) -> f64 {
    (-ln(1.0 - rng.random::<f64>())).max(1e-6)
}
