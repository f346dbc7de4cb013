//! Heel marks: where a heel or a toe drags over the floor.

use rand::rngs::ChaCha8Rng;

use crate::math::{SplitMix64, Vec2, exp};
use crate::patterns::{Cause, Pattern, PatternLibrary};
use crate::walls::Walls;

use super::Mark;
use super::feet::{Step, turned_by};
use super::gait::Progress;
use super::options::HeelOptions;
use super::rest::waiting;
use super::track::TICK_S;

/// Turns that are not more than a wiggle about the way, radians to either side, do not count.
const WIGGLE: f64 = 0.15;
/// A turn pushes aside as hard as it is fast: it counts in full from this speed on, and in this share on the spot, where
/// feet are lifted. Metres per second.
const TURNING_M_S: f64 = 1.0;
const ON_THE_SPOT: f64 = 0.15;
/// Way between two looks for a narrow place, metres.
const LOOK_M: f64 = 0.15;
/// The rates of a small crowd are raised at most this many times.
const MOST_SCALE: f64 = 10.0;
/// Two walls are on both sides if they lie in directions less than this cosine from opposite.
const OPPOSITE: f64 = 0.95;
/// Range of a drag's length as shares of its pattern's, and in metres; and of its density.
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
    all: Vec<Drag>,
    /// Those that bend: for turns.
    bent: Vec<Drag>,
}

/// A heel pattern.
#[derive(Clone, Copy)]
struct Drag {
    /// Its place in the library.
    pattern: u16,
    share: f64,
    length_m: f64,
    /// Signed sagitta over length, positive where the drag turns to the left.
    bend: f64,
}

/// What one person's heels have been through.
pub(super) struct Wear {
    /// Expected marks until the next one: runs down by rate times metres, radians and events.
    until_next: f64,
    /// Turn within the slack of [`WIGGLE`], radians.
    slack_rad: f64,
    narrow: bool,
    since_look_m: f64,
}

impl HeelMarks {
    pub fn new(library: &PatternLibrary, options: &HeelOptions, people: usize) -> HeelMarks {
        let drag = |(place, pattern): (usize, &Pattern)| {
            let pattern_index = u16::try_from(place).ok().filter(|_| pattern.cause == Cause::Heel)?;
            let length_m = pattern.length_cm / 100.0;
            Some(Drag { pattern: pattern_index, share: pattern.share, length_m, bend: bend_of(pattern) })
        };
        let all: Vec<Drag> = library.patterns.iter().enumerate().filter_map(drag).collect();
        let bent: Vec<Drag> = all.iter().copied().filter(|drag| drag.bend.abs() > BENT).collect();
        // A library without heel marks is one whose shoes leave none.
        let scale = if all.is_empty() { 0.0 } else { (options.people / people.max(1) as f64).min(MOST_SCALE) };
        HeelMarks { options: options.clone(), scale, bent: if bent.is_empty() { all.clone() } else { bent }, all }
    }

    /// Runs a person's heels over what happened in a tick; gives each mark's turn (0 straight on) to `each`.
    pub fn walk(
        &self,
        wear: &mut Wear,
        rng: &mut ChaCha8Rng,
        progress: &Progress,
        body: (Vec2, &Walls),
        mut each: impl FnMut(&mut ChaCha8Rng, f64),
    ) {
        if self.scale == 0.0 {
            return;
        }
        let turned = wear.turn(progress.turned_rad);
        let events = self.options.per_stop * progress.stops
            + self.options.per_second_stood * progress.stood_s
            + self.options.per_passage * self.passages(wear, progress.walked_m, body);
        let speed_m_s = progress.walked_m / TICK_S;
        let turning = self.options.per_radian * turned.abs() * (speed_m_s / TURNING_M_S).clamp(ON_THE_SPOT, 1.0);
        let straight = self.options.per_metre * progress.walked_m + events;
        wear.until_next -= self.scale * (straight + turning);
        while wear.until_next <= 0.0 {
            wear.until_next += waiting(rng);
            each(rng, if turning > straight { turned } else { 0.0 });
        }
    }

    /// Half a passage for each end of a narrow place: 0 or 0.5.
    fn passages(&self, wear: &mut Wear, walked_m: f64, (place_m, walls): (Vec2, &Walls)) -> f64 {
        wear.since_look_m += walked_m;
        if wear.since_look_m < LOOK_M {
            return 0.0;
        }
        wear.since_look_m %= LOOK_M;
        let narrow = is_narrow(walls, place_m, self.options.narrow_m);
        if std::mem::replace(&mut wear.narrow, narrow) == narrow { 0.0 } else { 0.5 }
    }

    /// The mark that a drag of this foot leaves.
    pub fn mark(&self, foot: &Step, sole_length_m: f64, turned_rad: f64, wear: u32, variation: u64) -> Option<Mark> {
        let draw = &mut SplitMix64::new(variation);
        let turning = turned_rad != 0.0;
        let drag = choose(if turning { &self.bent } else { &self.all }, f64::from(draw.unit()))?;
        let either_side = draw.unit() < 0.5;
        let mirrored = if turning { (drag.bend > 0.0) != (turned_rad > 0.0) } else { either_side };
        // Heels strike and slip; toes drag when they leave, and the ball is what turns.
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
            strength: density.min(MOST_DENSITY) as f32,
            soil: 0.0,
            wear,
            variation: draw.next_u64(),
        })
    }
}

impl Wear {
    pub fn new(rng: &mut ChaCha8Rng) -> Wear {
        Wear { until_next: waiting(rng), slack_rad: 0.0, narrow: false, since_look_m: 0.0 }
    }

    /// The part of a turn that goes beyond a wiggle.
    fn turn(&mut self, turned_rad: f64) -> f64 {
        let reached = self.slack_rad + turned_rad;
        self.slack_rad = reached.clamp(-WIGGLE, WIGGLE);
        reached - self.slack_rad
    }
}

/// Chooses by share; `draw` is uniform in `[0, 1)`.
fn choose(drags: &[Drag], draw: f64) -> Option<Drag> {
    let total: f64 = drags.iter().map(|drag| drag.share).sum();
    let mut left = draw * total;
    let found = drags.iter().find(|drag| {
        left -= drag.share;
        left < 0.0
    });
    found.or(drags.last()).copied()
}

/// Whether there are walls on both sides of a place, less than `clear_m` from each other.
fn is_narrow(walls: &Walls, place_m: Vec2, clear_m: f64) -> bool {
    let Some(near) = walls.nearest(place_m, clear_m / 2.0) else { return false };
    let Some(towards) = (near.point_m - place_m).normalized() else { return false };
    // All that lies on the other side, no farther than the rest of the width, lies in this disc.
    let radius_m = (clear_m - near.distance_m) / 2.0;
    let Some(far) = walls.nearest(place_m - towards * radius_m, radius_m) else { return false };
    let across = far.point_m - place_m;
    -across.dot(towards) > OPPOSITE * across.length()
}

/// How far a pattern's middle line leaves the chord, as a share of its length; positive where it turns to the left.
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
    // Whoever turns left begins and ends to the left of the middle of the way.
    let sagitta = (middle(0, third) + middle(width - third, width)) / 2.0 - middle(third, width - third);
    sagitta / width.max(1) as f64
}
