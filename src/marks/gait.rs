//! Steps: when and where a foot is set down.

use rand::RngExt;
use rand::rngs::ChaCha8Rng;
use rand_distr::StandardNormal;

use crate::math::{Purpose, Vec2, person_stream, round_to_grid, sin_cos, vec2};
use crate::motion::Person;

use super::track::{Sample, TICK_S};

/// The walked way is measured by a point that is pulled along on a leash of this length, so that somebody who stands
/// and sways walks no way.
const LEASH_M: f64 = 0.05;
/// A body turns at most this fast, radians per second: half a turn takes 1.3 s.
const FASTEST_TURN: f64 = 2.4;
/// A body turns around within this much way per radian, metres: who shifts a little while standing does not turn.
const TURNING_WAY_M: f64 = 0.08;
/// Who turns on the spot takes a step per this angle, radians.
const TURN_PER_STEP: f64 = 0.8;
/// Turns of less than this per step do not twist the foot, radians.
const LEAST_TWIST: f64 = 0.15;
/// How much of a turn the standing foot follows by twisting on its ball, and how far at most, radians.
const TWIST_SHARE: f64 = 0.35;
const MOST_TWIST: f64 = 0.35;
/// Spread of a step about its mean: across and along the way (metres), toe-out (radians), pressure.
const SPREAD_ACROSS_M: f64 = 0.012;
const SPREAD_ALONG_M: f64 = 0.015;
const SPREAD_TOE_OUT: f64 = 0.045;
const SPREAD_PRESSURE: f64 = 0.10;
/// Difference between the feet of a person in toe-out, radians, standard deviation.
const SPREAD_FEET: f64 = 0.025;
/// Slip of the heel at 1.34 m/s: 12.6 +- 10.7 mm, at most 30 mm (McGorry, DiDomenico, Chang 2008, Appl. Ergon. 39).
const SLIP_M: [f64; 2] = [0.0126, 0.0107];
const MOST_SLIP_M: f64 = 0.03;
const SLIP_SPEED_M_S: f64 = 1.34;

/// A foot on the floor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub left: bool,
    /// Middle of the sole.
    pub place_m: Vec2,
    /// Where the toes point.
    pub heading: Vec2,
    pub pressure: f64,
    pub smear_m: f64,
    pub twist_rad: f64,
}

/// What happened on the smoothed path between two ticks.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Progress {
    /// Way walked, metres.
    pub walked_m: f64,
    /// Turn of the body, radians counter-clockwise.
    pub turned_rad: f64,
    /// Speed, metres per second.
    pub speed_m_s: f64,
}

/// One person's legs.
pub(super) struct Gait {
    rng: ChaCha8Rng,
    /// Steps taken, with the fraction of the one under way.
    phase: f64,
    left_next: bool,
    /// Half the step width and toe-out of the right and the left foot.
    half_width_m: f64,
    toe_out_rad: [f64; 2],
    previous: Option<Sample>,
    leash_m: Vec2,
    heading: Vec2,
    turned_since_step_rad: f64,
}

impl Gait {
    pub fn new(seed: u64, person: &Person) -> Gait {
        let mut rng = person_stream(seed, person.id, Purpose::Gait);
        let phase = rng.random::<f64>();
        let left_next = rng.random::<bool>();
        let difference = SPREAD_FEET * normal(&mut rng);
        Gait {
            rng,
            phase,
            left_next,
            half_width_m: person.step_width_m / 2.0,
            toe_out_rad: [person.toe_out_rad - difference, person.toe_out_rad + difference],
            previous: None,
            leash_m: Vec2::ZERO,
            heading: vec2(1.0, 0.0),
            turned_since_step_rad: 0.0,
        }
    }

    /// Forgets where the person was, but not which foot comes next.
    pub fn interrupt(&mut self) {
        self.previous = None;
    }

    /// Walks on to the next sample; gives the steps taken on the way to `each`.
    pub fn walk(&mut self, person: &Person, sample: Sample, mut each: impl FnMut(Step)) -> Progress {
        let Some(previous) = self.previous.replace(sample) else {
            self.heading = sample.velocity_m_s.normalized().unwrap_or(self.heading);
            self.leash_m = sample.position_m - self.heading * LEASH_M;
            return Progress { speed_m_s: sample.velocity_m_s.length(), ..Progress::default() };
        };
        let before = self.heading;
        let (walked_m, turned_rad) = self.pull(sample.position_m);
        let speed_m_s = (previous.velocity_m_s.length() + sample.velocity_m_s.length()) / 2.0;
        // Whoever turns on the spot steps around; whoever walks a bend turns within the steps.
        let steps = (walked_m / person.step_length_m(speed_m_s)).max(turned_rad.abs() / TURN_PER_STEP);
        let end = self.phase + steps;
        let mut next = self.phase.floor() + 1.0;
        while next <= end {
            let share = ((next - self.phase) / steps).clamp(0.0, 1.0);
            let body_m = previous.position_m.lerp(sample.position_m, share);
            let facing = before.lerp(self.heading, share).normalized().unwrap_or(self.heading);
            let turn_rad = self.turned_since_step_rad + turned_rad * share;
            each(self.step(body_m, facing, turn_rad, speed_m_s));
            self.turned_since_step_rad = -turned_rad * share;
            next += 1.0;
        }
        self.turned_since_step_rad += turned_rad;
        self.phase = end - end.floor();
        Progress { walked_m, turned_rad, speed_m_s }
    }

    /// Pulls the leash to a place and turns the body the way it goes. Returns the way and the turn.
    fn pull(&mut self, place_m: Vec2) -> (f64, f64) {
        let taut = place_m - self.leash_m;
        let distance = taut.length();
        if distance <= LEASH_M {
            return (0.0, 0.0);
        }
        let direction = taut / distance;
        self.leash_m = place_m - direction * LEASH_M;
        let angle = crate::math::atan2(self.heading.cross(direction), self.heading.dot(direction));
        let most = (FASTEST_TURN * TICK_S).min((distance - LEASH_M) / TURNING_WAY_M);
        let turned = angle.clamp(-most, most);
        self.heading = if turned == angle { direction } else { turned_by(self.heading, turned) };
        (distance - LEASH_M, turned)
    }

    fn step(&mut self, body_m: Vec2, facing: Vec2, turn_rad: f64, speed_m_s: f64) -> Step {
        let left = self.left_next;
        self.left_next = !left;
        let side = if left { 1.0 } else { -1.0 };
        let rng = &mut self.rng;
        let [across, along, toe_out, pressure, slip] = std::array::from_fn(|_| normal(rng));
        let across_m = side * self.half_width_m + SPREAD_ACROSS_M * across;
        let outward_rad = side * (self.toe_out_rad[usize::from(left)] + SPREAD_TOE_OUT * toe_out);
        let slip_m = (SLIP_M[0] + SLIP_M[1] * slip).clamp(0.0, MOST_SLIP_M);
        let twists = turn_rad.abs() > LEAST_TWIST;
        Step {
            left,
            place_m: body_m + facing.left() * across_m + facing * (SPREAD_ALONG_M * along),
            heading: turned_by(facing, outward_rad),
            pressure: (1.0 + SPREAD_PRESSURE * pressure).clamp(0.6, 1.4),
            smear_m: (slip_m * speed_m_s / SLIP_SPEED_M_S).min(MOST_SLIP_M),
            twist_rad: if twists { (TWIST_SHARE * turn_rad).clamp(-MOST_TWIST, MOST_TWIST) } else { 0.0 },
        }
    }
}

fn turned_by(v: Vec2, angle_rad: f64) -> Vec2 {
    let (s, c) = sin_cos(angle_rad);
    v.rotated(vec2(c, s))
}

/// A standard normal value, rounded to 1e-4.
pub(super) fn normal(rng: &mut ChaCha8Rng) -> f64 {
    round_to_grid(rng.sample(StandardNormal))
}
