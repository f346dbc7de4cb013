//! Standing: feet that come together when the body stops, and shift now and then while it stands.

use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::math::{Vec2, ln};

use super::feet::{Feet, Landing, Step, normal};
use super::track::TICK_S;

/// Whoever goes no way and does not turn for so long stands, seconds.
const REST_S: f64 = 0.4;
/// A foot that lags behind the standing body by more than this is drawn after it, metres; the other is set beside it
/// if it stands farther off than the second.
const LAGS_M: f64 = 0.13;
const BESIDE_M: f64 = 0.07;
/// The same for a foot that points another way than the body, as the cosine of the angle: 23 degrees.
const ASKEW: f64 = 0.92;
/// Way that counts as a stop, and as a start, in full; shorter shuffles count in proportion, those of less than the
/// second not at all. Metres.
const FULL_STOP_M: f64 = 1.0;
const LEAST_STOP_M: f64 = 0.1;
/// Spread of a shifting foot about its place (metres) and about the body's heading (radians): standing feet point
/// every way a little.
const SHIFT_M: f64 = 0.035;
const SHIFT_RAD: f64 = 0.17;
/// Share of shifts in which both feet move, to a new place so far off (standard deviation, metres).
const BOTH_SHIFT: f64 = 0.3;
const NEW_PLACE_M: f64 = 0.05;

/// What somebody who may stand has been through.
pub(super) struct Rest {
    still_s: f64,
    rests: bool,
    /// Way gone since the last stop, metres.
    moved_m: f64,
    /// Expected shifts until the next one.
    until_shift: f64,
    /// Where the body stands.
    place_m: Vec2,
}

/// What a tick did to somebody who may stand.
pub(super) struct Tick {
    pub body_m: Vec2,
    pub facing: Vec2,
    pub walked_m: f64,
    pub turned_rad: f64,
    /// How far the body goes in the next two seconds, metres.
    pub ahead_m: f64,
    /// Shifts of the feet per second.
    pub shifts_per_s: f64,
}

/// What came of it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stood {
    pub stood_s: f64,
    /// 1 for a stop or a start, less for that of a short shuffle.
    pub stops: f64,
    /// Whether it was now that the body came to stand, feet side by side: the next step starts from there.
    pub came_to_rest: bool,
}

impl Rest {
    pub fn new(rng: &mut ChaCha8Rng) -> Rest {
        Rest { still_s: 0.0, rests: false, moved_m: 0.0, until_shift: waiting(rng), place_m: Vec2::ZERO }
    }

    /// Forgets that anybody stood.
    pub fn forget(&mut self) {
        (self.still_s, self.rests, self.moved_m) = (0.0, false, 0.0);
    }

    /// Way gone since the last stop, metres.
    pub fn moved_m(&self) -> f64 {
        self.moved_m
    }

    /// Stands on, or not, for a tick; gives the feet that come together or shift to `each`.
    pub fn pass(&mut self, feet: &mut Feet, rng: &mut ChaCha8Rng, tick: &Tick, each: &mut impl FnMut(Step)) -> Stood {
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

    /// Shifts the weight if it is time to: one foot or both to another place and angle.
    fn shift(&mut self, feet: &mut Feet, rng: &mut ChaCha8Rng, tick: &Tick, each: &mut impl FnMut(Step)) {
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

/// Draws the feet under a body that has just stopped: whichever is too far off, so that they end side by side.
fn close(feet: &mut Feet, rng: &mut ChaCha8Rng, tick: &Tick, each: &mut impl FnMut(Step)) {
    let facing = tick.facing;
    // How far ahead of the body a foot stands, if it stands somewhere and points as the body does.
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
        each(feet.set_down(rng, trailing_left, &landing));
    }
    if stays_m.is_none() {
        let landing = standing(feet, tick, tick.body_m, 0.0);
        each(feet.set_down(rng, !trailing_left, &landing));
    }
}

/// How a foot comes down under a body that stands.
fn standing(feet: &Feet, tick: &Tick, body_m: Vec2, askew_rad: f64) -> Landing {
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

/// How much of a stop or a start a way is.
fn event(way_m: f64) -> f64 {
    (way_m / FULL_STOP_M).min(1.0)
}

/// Expected events between two: exponential with mean 1.
pub(super) fn waiting(rng: &mut ChaCha8Rng) -> f64 {
    (-ln(1.0 - rng.random::<f64>())).max(1e-6)
}
