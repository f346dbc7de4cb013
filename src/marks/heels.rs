//! Heel marks: where a heel or a toe drags over the floor.

use rand::rngs::ChaCha8Rng;

use crate::math::{SplitMix64, Vec2, exp};
use crate::patterns::{Cause, Pattern, PatternLibrary};
use crate::walls::Walls;

use super::Mark;
use super::feet::{FootPlacement, turned_by};
use super::gait::GaitProgress;
use super::options::HeelOptions;
use super::rest::waiting;
use super::track::TICK_S;

/// Turns within this slack to either side do not count, radians.
const WIGGLE: f64 = 0.15;
/// Speed from which a turn counts fully, metres per second, and its share on the spot, where feet are lifted.
const TURNING_M_S: f64 = 1.0;
const ON_THE_SPOT: f64 = 0.15;
/// Path length between two checks for a narrow place, metres.
const CHECK_M: f64 = 0.15;
/// Limit on the factor of a small crowd's rates.
const MOST_SCALE: f64 = 10.0;
/// Cosine limit for two walls to lie on opposite sides.
const OPPOSITE: f64 = 0.95;
/// Ranges of a drag's length as a factor on its pattern's, and in metres; limit on its optical density.
const LENGTHS: [f32; 2] = [1.1, 2.2];
const LENGTH_M: [f64; 2] = [0.02, 0.12];
const MOST_DENSITY: f64 = 0.5;
/// Sagitta over length from which a pattern counts as bent.
const BENT: f64 = 0.03;

/// The heel patterns of a library and the rates at which they occur.
pub(super) struct HeelMarks {
    options: HeelOptions,
    /// Factor on the rates.
    scale: f64,
    all: Vec<HeelPattern>,
    /// Bent patterns, for turns.
    bent: Vec<HeelPattern>,
}

/// A heel pattern.
#[derive(Clone, Copy)]
struct HeelPattern {
    /// Index in the library.
    pattern: u16,
    share: f64,
    length_m: f64,
    /// Signed sagitta over length, positive where the drag turns to the left.
    bend: f64,
}

/// The state of one person's heel marks.
pub(super) struct HeelState {
    /// Expected number of marks until the next one; decreases by rate times metres, radians and events.
    until_next: f64,
    /// Turn within the slack of [`WIGGLE`], radians.
    slack_rad: f64,
    narrow: bool,
    since_check_m: f64,
}

impl HeelMarks {
    pub fn new(library: &PatternLibrary, options: &HeelOptions, people: usize) -> HeelMarks {
        let drag = |(place, pattern): (usize, &Pattern)| {
            let pattern_index = u16::try_from(place).ok().filter(|_| pattern.cause == Cause::Heel)?;
            let length_m = pattern.length_cm / 100.0;
            Some(HeelPattern { pattern: pattern_index, share: pattern.share, length_m, bend: bend_of(pattern) })
        };
        let all: Vec<HeelPattern> = library.patterns.iter().enumerate().filter_map(drag).collect();
        let bent: Vec<HeelPattern> = all.iter().copied().filter(|drag| drag.bend.abs() > BENT).collect();
        // A library without heel marks turns them off.
        let scale = if all.is_empty() { 0.0 } else { (options.people / people.max(1) as f64).min(MOST_SCALE) };
        HeelMarks { options: options.clone(), scale, bent: if bent.is_empty() { all.clone() } else { bent }, all }
    }

    /// Expected number of drags each time that somebody sits down or gets up.
    pub fn drags_per_sitting(&self) -> f64 {
        self.scale * self.options.per_sitting
    }

    /// Advances a person by a tick; calls `each` with the turn (0 for straight on) of each mark.
    pub fn walk(
        &self,
        state: &mut HeelState,
        rng: &mut ChaCha8Rng,
        progress: &GaitProgress,
        body: (Vec2, &Walls),
        mut each: impl FnMut(&mut ChaCha8Rng, f64),
    ) {
        if self.scale == 0.0 {
            return;
        }
        let turned = state.turn(progress.turned_rad);
        let events = self.options.per_stop * progress.stops
            + self.options.per_second_stood * progress.stood_s
            + self.options.per_passage * self.passages(state, progress.walked_m, body);
        let speed_m_s = progress.walked_m / TICK_S;
        let turning = self.options.per_radian * turned.abs() * (speed_m_s / TURNING_M_S).clamp(ON_THE_SPOT, 1.0);
        let straight = self.options.per_metre * progress.walked_m + events;
        state.until_next -= self.scale * (straight + turning);
        while state.until_next <= 0.0 {
            state.until_next += waiting(rng);
            each(rng, if turning > straight { turned } else { 0.0 });
        }
    }

    /// Passages of narrow places in a tick: 0.5 at each end of one, else 0.
    fn passages(&self, state: &mut HeelState, walked_m: f64, (place_m, walls): (Vec2, &Walls)) -> f64 {
        state.since_check_m += walked_m;
        if state.since_check_m < CHECK_M {
            return 0.0;
        }
        state.since_check_m %= CHECK_M;
        let narrow = is_narrow(walls, place_m, self.options.narrow_m);
        if std::mem::replace(&mut state.narrow, narrow) == narrow { 0.0 } else { 0.5 }
    }

    /// The heel mark of a drag of this foot.
    pub fn mark(
        &self,
        foot: &FootPlacement,
        sole_length_m: f64,
        turned_rad: f64,
        wear: u32,
        variation: u64,
    ) -> Option<Mark> {
        let draw = &mut SplitMix64::new(variation);
        let turning = turned_rad != 0.0;
        let drag = choose(if turning { &self.bent } else { &self.all }, f64::from(draw.unit()))?;
        let either_side = draw.unit() < 0.5;
        let mirrored = if turning { (drag.bend > 0.0) != (turned_rad > 0.0) } else { either_side };
        // Heels strike and slip; toes drag when they leave; turns are on the ball.
        let at_heel = draw.unit() < if turning { 0.4 } else { 0.65 };
        let along = if at_heel { -0.40 } else { 0.30 } + 0.06 * f64::from(draw.normal());
        let across_m = 0.012 * f64::from(draw.normal());
        let askew_rad = if turning { 0.5 } else { 0.2 } * f64::from(draw.normal());
        let length_m = drag.length_m * f64::from(draw.range(LENGTHS[0], LENGTHS[1]));
        let density = self.options.median_density * exp(self.options.sigma * f64::from(draw.normal()));
        Some(Mark {
            cause: Cause::Heel,
            place_m: foot.place_m + foot.heading * (along * sole_length_m) + foot.heading.left() * across_m,
            heading: turned_by(foot.heading, askew_rad),
            mirrored,
            pattern: drag.pattern,
            length_m: length_m.clamp(LENGTH_M[0], LENGTH_M[1]) as f32,
            smear_m: 0.0,
            twist_rad: 0.0,
            forefoot: 0.0,
            effort: 0.0,
            stood_s: 0.0,
            wheel_m: 0.0,
            strength: density.min(MOST_DENSITY) as f32,
            soil: 0.0,
            wet: 0.0,
            wear,
            variation: draw.next_u64(),
        })
    }
}

impl HeelState {
    pub fn new(rng: &mut ChaCha8Rng) -> HeelState {
        HeelState { until_next: waiting(rng), slack_rad: 0.0, narrow: false, since_check_m: 0.0 }
    }

    /// The part of a turn that goes beyond a wiggle.
    fn turn(&mut self, turned_rad: f64) -> f64 {
        let reached = self.slack_rad + turned_rad;
        self.slack_rad = reached.clamp(-WIGGLE, WIGGLE);
        reached - self.slack_rad
    }
}

/// Chooses by share; `draw` is uniform in `[0, 1)`.
fn choose(drags: &[HeelPattern], draw: f64) -> Option<HeelPattern> {
    let total: f64 = drags.iter().map(|drag| drag.share).sum();
    let mut left = draw * total;
    let found = drags.iter().find(|drag| {
        left -= drag.share;
        left < 0.0
    });
    found.or(drags.last()).copied()
}

/// Whether walls on both sides of a place are less than `clear_m` apart.
fn is_narrow(walls: &Walls, place_m: Vec2, clear_m: f64) -> bool {
    let Some(near) = walls.nearest(place_m, clear_m / 2.0) else { return false };
    let Some(towards) = (near.point_m - place_m).normalized() else { return false };
    // This disc holds the points on the other side within the rest of the width.
    let radius_m = (clear_m - near.distance_m) / 2.0;
    let Some(far) = walls.nearest(place_m - towards * radius_m, radius_m) else { return false };
    let across = far.point_m - place_m;
    -across.dot(towards) > OPPOSITE * across.length()
}

/// Signed sagitta of a pattern's middle line over its length; positive for a bend to the left.
fn bend_of(pattern: &Pattern) -> f64 {
    let (width, height) = (pattern.width_px as usize, pattern.height_px as usize);
    let middle = |from: usize, to: usize| {
        let (mut weight, mut moment) = (0.0, 0.0);
        for row in pattern.coverage.chunks_exact(width).zip(0..height) {
            let sum: f64 = row.0[from..to].iter().map(|&coverage| f64::from(coverage)).sum();
            weight += sum;
            // Rows count downward, y upward.
            moment -= sum * row.1 as f64;
        }
        if weight > 0.0 { moment / weight } else { 0.0 }
    };
    let third = width / 3;
    // A bend to the left begins and ends to the left of its middle.
    let sagitta = (middle(0, third) + middle(width - third, width)) / 2.0 - middle(third, width - third);
    sagitta / width.max(1) as f64
}
