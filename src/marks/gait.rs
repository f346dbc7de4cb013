//! Steps: when and where a foot is set down.

use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::math::{Purpose, Vec2, atan2, person_stream, vec2};
use crate::motion::Person;

use super::feet::{Feet, Landing, Step, turned_by};
use super::rest::{self, Rest};
use super::track::{Sample, TICK_S};

/// The walked way is measured by a point that is pulled along on a leash of this length, so that somebody who stands
/// and sways walks no way.
const LEASH_M: f64 = 0.05;
/// A body of which only the way is known turns at most this fast, radians per second: half a turn takes 1.3 s.
const FASTEST_TURN: f64 = 2.4;
/// Such a body turns around within this much way per radian, metres: who shifts a little while standing does not turn.
const TURNING_WAY_M: f64 = 0.08;
/// Where such a body faces is drawn along on a longer leash by those who hardly move: so long at a walk, so long for
/// who shuffles, metres, at these speeds, metres per second. Jostling within that turns nobody.
const HEADING_LEASH_M: [f64; 2] = [0.05, 0.25];
const HEADING_SPEEDS_M_S: [f64; 2] = [0.6, 0.2];
/// A way whose direction has less than this cosine with the heading is a step aside or back, ...
const ASIDE: f64 = 0.3;
/// ... unless it leads farther than this, metres: then such a body turns to walk it.
const STEP_ASIDE_M: f64 = 0.45;
/// A body that stands does not turn for less than this, radians.
const TURN_SLACK: f64 = 0.12;
/// Who turns on the spot takes a step per this angle, radians.
const TURN_PER_STEP: f64 = 0.8;
/// Steps are shorter by up to this share where the way's direction has less than this cosine with the heading.
const ASIDE_SHORTER: f64 = 0.35;
const AHEAD: f64 = 0.8;
/// How much of the next step is over when somebody who stood sets out: from feet side by side it is a short one.
const SETTING_OUT: f64 = 0.35;
/// Whoever moves on by no more than this before standing again does so in steps of at most so much, metres.
const SHUFFLE_M: f64 = 1.0;
const SHUFFLE_STEP_M: f64 = 0.5;

/// What happened on the smoothed path between two ticks.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Progress {
    /// Way walked, metres.
    pub walked_m: f64,
    /// Turn of the body, radians counter-clockwise.
    pub turned_rad: f64,
    /// Stops and starts: 1 each, less for those of a short shuffle.
    pub stops: f64,
    /// Time stood, seconds.
    pub stood_s: f64,
}

/// One person's legs.
pub(super) struct Gait {
    rng: ChaCha8Rng,
    shifts_per_s: f64,
    /// Steps taken, with the fraction of the one under way.
    phase: f64,
    left_next: bool,
    feet: Feet,
    rest: Rest,
    previous: Option<Sample>,
    leash_m: Vec2,
    heading: Vec2,
    /// The end of the leash that draws the heading along.
    drawn_m: Vec2,
    /// Way gone aside or back without turning to it, metres.
    aside_m: f64,
    turned_since_step_rad: f64,
}

/// A piece of way, walked in a tick.
struct Way {
    from: Sample,
    to: Sample,
    facing_before: Vec2,
    direction: Vec2,
    walked_m: f64,
    turned_rad: f64,
}

impl Gait {
    /// The legs of a person who shifts weight so many times a second when standing.
    pub fn new(seed: u64, person: &Person, shifts_per_s: f64) -> Gait {
        let mut rng = person_stream(seed, person.id, Purpose::Gait);
        let phase = rng.random::<f64>();
        let left_next = rng.random::<bool>();
        let feet = Feet::new(&mut rng, person);
        let rest = Rest::new(&mut rng);
        Gait {
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

    /// Forgets where the person was, but not which foot comes next.
    pub fn interrupt(&mut self) {
        self.previous = None;
        self.feet.lift();
        self.rest.forget();
    }

    /// Walks on to the next sample; gives the feet that are set down on the way to `each`.
    pub fn walk(&mut self, person: &Person, sample: Sample, mut each: impl FnMut(Step)) -> Progress {
        let Some(from) = self.previous.replace(sample) else {
            self.begin(&sample);
            return Progress::default();
        };
        let facing_before = self.heading;
        let (walked_m, direction) = self.pull(sample.position_m);
        let turned_rad = match sample.facing {
            Some(facing) => self.face(facing, walked_m),
            None => self.follow(direction, walked_m, &sample),
        };
        let way = Way { from, to: sample, facing_before, direction, walked_m, turned_rad };
        self.take_steps(person, &way, &mut each);
        let tick = rest::Tick {
            body_m: sample.position_m,
            facing: self.heading,
            walked_m,
            turned_rad,
            ahead_m: sample.ahead_m.length(),
            shifts_per_s: self.shifts_per_s,
        };
        let left_next = &mut self.left_next;
        let stood = self.rest.pass(&mut self.feet, &mut self.rng, &tick, &mut |step: Step| {
            *left_next = !step.left;
            each(step);
        });
        if stood.came_to_rest {
            self.phase = SETTING_OUT;
            self.turned_since_step_rad = 0.0;
        }
        Progress { walked_m, turned_rad, stops: stood.stops, stood_s: stood.stood_s }
    }

    /// Where the body faces: a unit vector.
    pub fn heading(&self) -> Vec2 {
        self.heading
    }

    fn begin(&mut self, sample: &Sample) {
        let walks = sample.velocity_m_s.length() > 0.2;
        let way = if walks { sample.velocity_m_s } else { sample.ahead_m };
        self.heading = sample.facing.or(way.normalized()).unwrap_or(self.heading);
        self.leash_m = sample.position_m - self.heading * LEASH_M;
        self.drawn_m = self.leash_m;
    }

    /// Takes the steps of a piece of way.
    fn take_steps(&mut self, person: &Person, way: &Way, each: &mut impl FnMut(Step)) {
        let speeds = [way.from, way.to].map(|sample| sample.velocity_m_s.length());
        let speed_m_s = (speeds[0] + speeds[1]) / 2.0;
        let ahead = self.heading.dot(way.direction);
        let step_m = self.step_m(person, way, speed_m_s) * shortened(ahead);
        let steps = (way.walked_m / step_m).max(self.steps_around(way));
        // Who stops within the step sets the foot down where the body will stand.
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

    /// Steps that a turn takes. Where the source says where the body faces, the legs follow the turn at its own pace. Where
    /// that is drawn from the way alone, it swings with the sway of whoever is slow or squeezed through; whoever walks
    /// takes such turns along within the steps, and only one that goes on farther than a step reaches needs a step of its
    /// own.
    fn steps_around(&self, way: &Way) -> f64 {
        if way.to.facing.is_some() {
            return way.turned_rad.abs() / TURN_PER_STEP;
        }
        let since_step_rad = self.turned_since_step_rad + way.turned_rad;
        if since_step_rad.abs() >= TURN_PER_STEP { 1.0 - self.phase } else { 0.0 }
    }

    /// Length of a step ahead: by the speed, but for a few steps between one stand and the next by their way.
    fn step_m(&self, person: &Person, way: &Way, speed_m_s: f64) -> f64 {
        let by_speed_m = person.step_length_m(speed_m_s);
        let way_m = self.rest.moved_m() + way.to.ahead_m.length();
        if !way.to.comes_to_rest || way_m > SHUFFLE_M {
            return by_speed_m;
        }
        by_speed_m.max(way_m / (way_m / SHUFFLE_STEP_M).ceil().max(1.0))
    }

    /// Pulls the leash to a place. Returns the way and its direction, both null if the leash is slack.
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

    /// Turns the body where the source says that it faces. Returns the turn.
    fn face(&mut self, facing: Vec2, walked_m: f64) -> f64 {
        let angle = self.angle_to(facing);
        let slack = if walked_m > 0.0 { 0.0 } else { TURN_SLACK };
        self.turn(angle - angle.clamp(-slack, slack), angle, facing)
    }

    /// Turns the body the way it goes, unless that is a step aside or back. Returns the turn.
    fn follow(&mut self, direction: Vec2, walked_m: f64, sample: &Sample) -> f64 {
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

    /// Turns by an angle; `angle` is the one to `direction`, which is taken up exactly if it is all of it.
    fn turn(&mut self, turned_rad: f64, angle: f64, direction: Vec2) -> f64 {
        if turned_rad == angle {
            self.heading = direction;
        } else if turned_rad != 0.0 {
            self.heading = turned_by(self.heading, turned_rad);
        }
        turned_rad
    }
}

/// Length of the leash that draws the heading along at a speed.
fn heading_leash_m(speed_m_s: f64) -> f64 {
    let ([short_m, long_m], [fast, slow]) = (HEADING_LEASH_M, HEADING_SPEEDS_M_S);
    short_m + (long_m - short_m) * ((fast - speed_m_s) / (fast - slow)).clamp(0.0, 1.0)
}

/// Factor on the length of steps along a way whose direction has this cosine with the heading.
fn shortened(ahead: f64) -> f64 {
    1.0 - ASIDE_SHORTER * ((AHEAD - ahead) / AHEAD).clamp(0.0, 1.0)
}

/// How far beyond its line a foot lands in a step of which so much goes to a side: half of it where all does, so that
/// the foot on that side takes it and the other one closes up.
fn beyond_line_m(aside_m: f64, ahead: f64) -> f64 {
    0.5 * aside_m * (1.0 - ahead.abs() / AHEAD).max(0.0)
}
