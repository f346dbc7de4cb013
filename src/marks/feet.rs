//! The feet of a person: placement of footfalls and stances.

use rand::RngExt;
use rand::rngs::ChaCha8Rng;
use rand_distr::StandardNormal;

use crate::math::{Vec2, round_to_grid, sin_cos, vec2};
use crate::motion::Person;

/// Turns of less than this per step do not twist the foot, radians.
const LEAST_TWIST: f64 = 0.15;
/// Share of a turn that the standing foot follows by twisting on its ball, and its limit, radians.
const TWIST_SHARE: f64 = 0.35;
const MOST_TWIST: f64 = 0.35;
/// Standard deviations of a step: across and along the path (metres), toe-out (radians), pressure.
const SPREAD_ACROSS_M: f64 = 0.012;
const SPREAD_ALONG_M: f64 = 0.015;
const SPREAD_TOE_OUT: f64 = 0.045;
const SPREAD_PRESSURE: f64 = 0.10;
/// Difference between the feet of a person in toe-out, radians, standard deviation.
const SPREAD_FEET: f64 = 0.025;
/// Slip of the heel at 1.34 m/s: 12.6 +- 10.7 mm, at most 30 mm (McGorry, DiDomenico, Chang 2008, Appl. Ergon. 39).
const SLIP_M: [f64; 2] = [0.0126, 0.0107];
const MOST_SLIP_M: f64 = 0.03;
const FREE_SPEED_M_S: f64 = 1.34;
/// Slip that braking adds, metres per m/s2.
const BRAKING_SLIP_M: f64 = 0.01;
/// Share by which steps widen from free walking to a standstill, as body sway grows from 3 to 5 to 7 cm ...
const WIDER_WHEN_SLOW: f64 = 0.5;
/// ... and widening per radian turned with its limit, metres.
const WIDER_PER_RADIAN_M: f64 = 0.06;
const WIDEST_TURN_M: f64 = 0.05;
/// Additional distance between the feet's middles while standing: 17 cm in all (McIlroy, Maki 1997,
/// Clin. Biomech. 12).
const STANDING_WIDER_M: f64 = 0.09;
/// Least distance of feet side by side, and the offset along the foot at which it falls to zero, metres.
const SHOE_BREADTH_M: f64 = 0.10;
const SHOE_LENGTH_M: f64 = 0.28;
/// Speed of the change to running, metres per second, and the load share of the ball at that speed and in running.
const RUNS_M_S: f64 = 2.1;
const BALL_AT_FAST_WALK: f64 = 0.35;
const BALL_AT_RUN: f64 = 0.6;

/// Wear per radian turned at a footfall and its limit, and that of a stop or a start, in passes of a step straight on.
const EFFORT_PER_RADIAN: f64 = 7.0;
const MOST_EFFORT_OF_TURN: f64 = 2.5;
pub(super) const EFFORT_OF_STOP: f64 = 2.0;
/// Turns per step that cost nothing, radians: bodies sway. Changes of speed that cost nothing, and that count as a stop.
const FREE_TURN: f64 = 0.05;
const FREE_PUSH_M_S2: f64 = 0.2;
const FULL_PUSH_M_S2: f64 = 0.8;

/// A footfall of one foot.
#[derive(Clone, Copy, Debug)]
pub(super) struct FootPlacement {
    pub left: bool,
    /// Middle of the sole.
    pub place_m: Vec2,
    /// Unit vector: direction of the toes.
    pub heading: Vec2,
    pub pressure: f64,
    pub smear_m: f64,
    pub twist_rad: f64,
    /// Share of the heel's load that the ball carries, 0 to 1.
    pub forefoot: f64,
    /// Wear beyond that of a step straight on, in passes.
    pub effort: f64,
}

/// The body at the moment of a footfall.
#[derive(Clone, Copy, Debug)]
pub(super) struct Landing {
    /// Position of the body over the foot, metres.
    pub body_m: Vec2,
    /// Unit vector: where the body faces.
    pub facing: Vec2,
    /// Distance of the foot from the body's line, metres.
    pub half_width_m: f64,
    /// Turn of the foot against the body beyond its toe-out, radians counter-clockwise.
    pub askew_rad: f64,
    pub speed_m_s: f64,
    pub braking_m_s2: f64,
    /// Turn of the body since the other foot came down, radians counter-clockwise.
    pub turn_rad: f64,
}

/// The stance of a foot on the floor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stance {
    pub place_m: Vec2,
    /// Unit vector: where the body faced at the footfall.
    pub facing: Vec2,
}

/// The feet of a person: `[right, left]`.
pub(super) struct Feet {
    half_width_m: f64,
    toe_out_rad: [f64; 2],
    runs_on_ball: bool,
    stances: [Option<Stance>; 2],
}

impl Feet {
    pub fn new(rng: &mut ChaCha8Rng, person: &Person) -> Feet {
        let difference = SPREAD_FEET * normal(rng);
        Feet {
            half_width_m: person.step_width_m / 2.0,
            toe_out_rad: [person.toe_out_rad - difference, person.toe_out_rad + difference],
            runs_on_ball: person.runs_on_ball,
            stances: [None; 2],
        }
    }

    /// The stance of a foot, once it was set down.
    pub fn stance(&self, left: bool) -> Option<Stance> {
        self.stances[usize::from(left)]
    }

    /// Clears the stances.
    pub fn lift(&mut self) {
        self.stances = [None; 2];
    }

    /// Half the step width at a speed and a turn per step, metres.
    pub fn half_width_m(&self, speed_m_s: f64, turn_rad: f64) -> f64 {
        let slow = (1.0 - speed_m_s / FREE_SPEED_M_S).clamp(0.0, 1.0);
        let turning_m = (WIDER_PER_RADIAN_M * turn_rad.abs()).min(WIDEST_TURN_M);
        self.half_width_m * (1.0 + WIDER_WHEN_SLOW * slow) + 0.5 * turning_m
    }

    /// Half the step width while standing, metres.
    pub fn standing_half_width_m(&self) -> f64 {
        self.half_width_m + 0.5 * STANDING_WIDER_M
    }

    /// Sets a foot down.
    pub fn set_down(&mut self, rng: &mut ChaCha8Rng, left: bool, landing: &Landing) -> FootPlacement {
        let side = if left { 1.0 } else { -1.0 };
        let [across, along, toe_out, pressure, slip] = std::array::from_fn(|_| normal(rng));
        let across_m = side * landing.half_width_m + SPREAD_ACROSS_M * across;
        let outward_rad = side * (self.toe_out_rad[usize::from(left)] + SPREAD_TOE_OUT * toe_out);
        let slip_m = (SLIP_M[0] + SLIP_M[1] * slip).clamp(0.0, MOST_SLIP_M) * landing.speed_m_s / FREE_SPEED_M_S
            + BRAKING_SLIP_M * landing.braking_m_s2.max(0.0);
        let twists = landing.turn_rad.abs() > LEAST_TWIST;
        let facing = landing.facing;
        let wanted_m = landing.body_m + facing.left() * across_m + facing * (SPREAD_ALONG_M * along);
        let place_m = self.beside_the_other(left, wanted_m, facing);
        self.stances[usize::from(left)] = Some(Stance { place_m, facing });
        FootPlacement {
            left,
            place_m,
            heading: turned_by(facing, outward_rad + landing.askew_rad),
            pressure: (1.0 + SPREAD_PRESSURE * pressure).clamp(0.6, 1.4),
            smear_m: slip_m.min(MOST_SLIP_M),
            twist_rad: if twists { (TWIST_SHARE * landing.turn_rad).clamp(-MOST_TWIST, MOST_TWIST) } else { 0.0 },
            forefoot: self.forefoot(landing.speed_m_s),
            effort: landing.effort(),
        }
    }

    /// Position of a foot, moved aside if it would overlap the other foot.
    fn beside_the_other(&self, left: bool, place_m: Vec2, facing: Vec2) -> Vec2 {
        let Some(other) = self.stance(!left) else { return place_m };
        let offset = place_m - other.place_m;
        let outward = if left { facing.left() } else { -facing.left() };
        let behind = facing.dot(offset) / SHOE_LENGTH_M;
        let too_close_m = SHOE_BREADTH_M * (1.0 - behind * behind) - outward.dot(offset);
        if behind.abs() >= 1.0 || too_close_m <= 0.0 { place_m } else { place_m + outward * too_close_m }
    }

    /// Share of the heel's load carried by the ball at a speed: 0 in slow walking, 1 for runners on the ball.
    fn forefoot(&self, speed_m_s: f64) -> f64 {
        if speed_m_s > RUNS_M_S {
            return if self.runs_on_ball { 1.0 } else { BALL_AT_RUN };
        }
        let fast = ((speed_m_s - FREE_SPEED_M_S) / (RUNS_M_S - FREE_SPEED_M_S)).max(0.0);
        BALL_AT_FAST_WALK * fast
    }
}

impl Landing {
    /// Wear beyond that of a step straight on, in passes: soles grind when the body turns, brakes or sets out.
    fn effort(&self) -> f64 {
        let turn = EFFORT_PER_RADIAN * (self.turn_rad.abs() - FREE_TURN);
        let push = (self.braking_m_s2.abs() - FREE_PUSH_M_S2) / (FULL_PUSH_M_S2 - FREE_PUSH_M_S2);
        turn.clamp(0.0, MOST_EFFORT_OF_TURN) + EFFORT_OF_STOP * push.clamp(0.0, 1.0)
    }
}

/// A vector turned counter-clockwise.
pub(super) fn turned_by(v: Vec2, angle_rad: f64) -> Vec2 {
    let (s, c) = sin_cos(angle_rad);
    v.rotated(vec2(c, s))
}

/// A standard normal value, rounded to 1e-4.
pub(super) fn normal(rng: &mut ChaCha8Rng) -> f64 {
    round_to_grid(rng.sample(StandardNormal))
}
