//! Gait: the times and places of footfalls.

use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::math::{Purpose, Vec2, atan2, person_stream, vec2};
use crate::motion::Person;

use super::feet::{Feet, FootPlacement, Landing, turned_by};
use super::rest::{self, Rest};
use super::track::{TICK_S, TrackSample};

/// Length of the leash on which a point follows the body to measure the path, metres: sway does not count as walking.
const LEASH_M: f64 = 0.05;
/// Limit on the turn rate of a body with unknown facing, radians per second: half a turn takes 1.3 s.
const FASTEST_TURN: f64 = 2.4;
/// Least path length per radian of such a turn, metres: small shifts while standing do not turn the body.
const TURNING_WAY_M: f64 = 0.08;
/// Lengths of the leash for such a facing, metres, for walking and for shuffling, at these speeds, metres per second.
const HEADING_LEASH_M: [f64; 2] = [0.05, 0.25];
const HEADING_SPEEDS_M_S: [f64; 2] = [0.6, 0.2];
/// Cosine between path and heading below which a step is aside or back ...
const ASIDE: f64 = 0.3;
/// ... unless the path is longer than this, metres: then the body turns.
const STEP_ASIDE_M: f64 = 0.45;
/// Slack of the turn of a standing body, radians.
const TURN_SLACK: f64 = 0.12;
/// Angle per step of a turn on the spot, radians.
const TURN_PER_STEP: f64 = 0.8;
/// Largest shortening of steps aside or back, and the cosine between path and heading where it begins.
const ASIDE_SHORTER: f64 = 0.35;
const AHEAD: f64 = 0.8;
/// Phase of the first step after standing: with feet side by side it is short.
const SETTING_OUT: f64 = 0.35;
/// Longest path of a shuffle between two stands, and its longest step, metres.
const SHUFFLE_M: f64 = 1.0;
const SHUFFLE_STEP_M: f64 = 0.5;

/// Walking, turning and standing in a tick.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct GaitProgress {
    /// Distance walked, metres.
    pub walked_m: f64,
    /// Turn of the body, radians counter-clockwise.
    pub turned_rad: f64,
    /// Stops and starts: 1 each, less for a short shuffle.
    pub stops: f64,
    /// Time stood, seconds.
    pub stood_s: f64,
}

/// The gait state of one person.
pub(super) struct GaitState {
    rng: ChaCha8Rng,
    shifts_per_s: f64,
    /// Number of steps, with the fraction of the current one.
    phase: f64,
    left_next: bool,
    feet: Feet,
    rest: Rest,
    previous: Option<TrackSample>,
    leash_m: Vec2,
    heading: Vec2,
    /// End of the leash of the heading, metres.
    drawn_m: Vec2,
    /// Path length aside or back without a turn, metres.
    aside_m: f64,
    turned_since_step_rad: f64,
}

/// The path walked in a tick.
struct TickPath {
    from: TrackSample,
    to: TrackSample,
    facing_before: Vec2,
    direction: Vec2,
    walked_m: f64,
    turned_rad: f64,
}

impl GaitState {
    /// The gait of a person; `shifts_per_s` is the rate of weight shifts while standing.
    pub fn new(seed: u64, person: &Person, shifts_per_s: f64) -> GaitState {
        let mut rng = person_stream(seed, person.id, Purpose::Gait);
        let phase = rng.random::<f64>();
        let left_next = rng.random::<bool>();
        let feet = Feet::new(&mut rng, person);
        let rest = Rest::new(&mut rng);
        GaitState {
            rng,
            shifts_per_s,
            phase,
            left_next,
            feet,
            rest,
            previous: None,
            leash_m: Vec2::ZERO,
            heading: vec2(1.0, 0.0),
            drawn_m: Vec2::ZERO,
            aside_m: 0.0,
            turned_since_step_rad: 0.0,
        }
    }

    /// Clears the position after a gap in the path, but not the next foot.
    pub fn interrupt(&mut self) {
        self.previous = None;
        self.feet.lift();
        self.rest.forget();
    }

    /// Advances to the next sample; calls `each` with the footfalls in between.
    pub fn walk(&mut self, person: &Person, sample: TrackSample, mut each: impl FnMut(FootPlacement)) -> GaitProgress {
        let Some(from) = self.previous.replace(sample) else {
            self.begin(&sample);
            return GaitProgress::default();
        };
        let facing_before = self.heading;
        let (walked_m, direction) = self.pull(sample.position_m);
        let turned_rad = match sample.facing {
            Some(facing) => self.face(facing, walked_m),
            None => self.follow(direction, walked_m, &sample),
        };
        let way = TickPath { from, to: sample, facing_before, direction, walked_m, turned_rad };
        self.take_steps(person, &way, &mut each);
        let tick = rest::RestTick {
            body_m: sample.position_m,
            facing: self.heading,
            walked_m,
            turned_rad,
            ahead_m: sample.ahead_m.length(),
            shifts_per_s: self.shifts_per_s,
        };
        let left_next = &mut self.left_next;
        let stood = self.rest.pass(&mut self.feet, &mut self.rng, &tick, &mut |step: FootPlacement| {
            *left_next = !step.left;
            each(step);
        });
        if stood.came_to_rest {
            self.phase = SETTING_OUT;
            self.turned_since_step_rad = 0.0;
        }
        GaitProgress { walked_m, turned_rad, stops: stood.stops, stood_s: stood.stood_s }
    }

    /// Unit vector: where the body faces.
    pub fn heading(&self) -> Vec2 {
        self.heading
    }

    fn begin(&mut self, sample: &TrackSample) {
        let walks = sample.velocity_m_s.length() > 0.2;
        let way = if walks { sample.velocity_m_s } else { sample.ahead_m };
        self.heading = sample.facing.or(way.normalized()).unwrap_or(self.heading);
        self.leash_m = sample.position_m - self.heading * LEASH_M;
        self.drawn_m = self.leash_m;
    }

    /// Takes the steps of a tick.
    fn take_steps(&mut self, person: &Person, way: &TickPath, each: &mut impl FnMut(FootPlacement)) {
        let speeds = [way.from, way.to].map(|sample| sample.velocity_m_s.length());
        let speed_m_s = (speeds[0] + speeds[1]) / 2.0;
        let ahead = self.heading.dot(way.direction);
        let step_m = self.step_m(person, way, speed_m_s) * shortened(ahead);
        let steps = (way.walked_m / step_m).max(self.steps_around(way));
        // The last step before a stop ends where the body will stand.
        let stops = way.to.comes_to_rest && way.to.ahead_m.length() < 0.5 * step_m;
        let to_go_m = if stops { way.to.ahead_m } else { Vec2::ZERO };
        let end = self.phase + steps;
        let mut next = self.phase.floor() + 1.0;
        while next <= end {
            let share = ((next - self.phase) / steps).clamp(0.0, 1.0);
            let facing = way.facing_before.lerp(self.heading, share).normalized().unwrap_or(self.heading);
            let turn_rad = self.turned_since_step_rad + way.turned_rad * share;
            let aside_m = step_m * facing.cross(way.direction).abs();
            let landing = Landing {
                body_m: way.from.position_m.lerp(way.to.position_m, share) + to_go_m,
                facing,
                half_width_m: self.feet.half_width_m(speed_m_s, turn_rad) + beyond_line_m(aside_m, ahead),
                askew_rad: 0.0,
                speed_m_s,
                braking_m_s2: (speeds[0] - speeds[1]) / TICK_S,
                turn_rad,
            };
            each(self.feet.set_down(&mut self.rng, self.left_next, &landing));
            self.left_next = !self.left_next;
            self.turned_since_step_rad = -way.turned_rad * share;
            next += 1.0;
        }
        self.turned_since_step_rad += way.turned_rad;
        self.phase = end - end.floor();
    }

    /// Number of steps for a turn.
    ///
    /// With a known facing the steps follow its angle. A facing derived from the path swings with body sway, so only a
    /// turn beyond the angle of one step takes a step of its own.
    fn steps_around(&self, way: &TickPath) -> f64 {
        if way.to.facing.is_some() {
            return way.turned_rad.abs() / TURN_PER_STEP;
        }
        let since_step_rad = self.turned_since_step_rad + way.turned_rad;
        if since_step_rad.abs() >= TURN_PER_STEP { 1.0 - self.phase } else { 0.0 }
    }

    /// Length of a step ahead, metres: by speed; in a shuffle between two stands by its path length.
    fn step_m(&self, person: &Person, way: &TickPath, speed_m_s: f64) -> f64 {
        let by_speed_m = person.step_length_m(speed_m_s);
        let way_m = self.rest.moved_m() + way.to.ahead_m.length();
        if !way.to.comes_to_rest || way_m > SHUFFLE_M {
            return by_speed_m;
        }
        by_speed_m.max(way_m / (way_m / SHUFFLE_STEP_M).ceil().max(1.0))
    }

    /// Pulls the leash to a position. Returns distance and direction, both zero if the leash is slack.
    fn pull(&mut self, place_m: Vec2) -> (f64, Vec2) {
        let taut = place_m - self.leash_m;
        let distance = taut.length();
        if distance <= LEASH_M {
            return (0.0, Vec2::ZERO);
        }
        let direction = taut / distance;
        self.leash_m = place_m - direction * LEASH_M;
        (distance - LEASH_M, direction)
    }

    /// Turns the body to a known facing; returns the turn, radians.
    fn face(&mut self, facing: Vec2, walked_m: f64) -> f64 {
        let angle = self.angle_to(facing);
        let slack = if walked_m > 0.0 { 0.0 } else { TURN_SLACK };
        self.turn(angle - angle.clamp(-slack, slack), angle, facing)
    }

    /// Turns the body along its path, except in steps aside or back; returns the turn, radians.
    fn follow(&mut self, direction: Vec2, walked_m: f64, sample: &TrackSample) -> f64 {
        let taut = sample.position_m - self.drawn_m;
        let distance = taut.length();
        let leash_m = heading_leash_m(sample.velocity_m_s.length());
        if walked_m == 0.0 || distance <= leash_m {
            return 0.0;
        }
        let drawn = taut / distance;
        self.drawn_m = sample.position_m - drawn * leash_m;
        if self.heading.dot(direction) < ASIDE {
            self.aside_m += walked_m;
            if self.aside_m < STEP_ASIDE_M && sample.ahead_m.dot(direction) < STEP_ASIDE_M {
                return 0.0;
            }
        } else {
            self.aside_m = 0.0;
        }
        let angle = self.angle_to(drawn);
        let most = (FASTEST_TURN * TICK_S).min(walked_m / TURNING_WAY_M);
        self.turn(angle.clamp(-most, most), angle, drawn)
    }

    fn angle_to(&self, direction: Vec2) -> f64 {
        atan2(self.heading.cross(direction), self.heading.dot(direction))
    }

    /// Turns by `turned_rad`; a turn by all of `angle` sets the heading to `direction` exactly.
    fn turn(&mut self, turned_rad: f64, angle: f64, direction: Vec2) -> f64 {
        if turned_rad == angle {
            self.heading = direction;
        } else if turned_rad != 0.0 {
            self.heading = turned_by(self.heading, turned_rad);
        }
        turned_rad
    }
}

/// Length of the heading's leash at a speed, metres.
fn heading_leash_m(speed_m_s: f64) -> f64 {
    let ([short_m, long_m], [fast, slow]) = (HEADING_LEASH_M, HEADING_SPEEDS_M_S);
    short_m + (long_m - short_m) * ((fast - speed_m_s) / (fast - slow)).clamp(0.0, 1.0)
}

/// Factor on the step length for a cosine between path and heading.
fn shortened(ahead: f64) -> f64 {
    1.0 - ASIDE_SHORTER * ((AHEAD - ahead) / AHEAD).clamp(0.0, 1.0)
}

/// Offset of a foot beyond its line in a sideways step, metres: half the step if all of it is sideways, so that the
/// other foot closes up.
fn beyond_line_m(aside_m: f64, ahead: f64) -> f64 {
    0.5 * aside_m * (1.0 - ahead.abs() / AHEAD).max(0.0)
}
