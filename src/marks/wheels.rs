//! Wheels: the lines of cases that are pulled behind and of trolleys, prams and wheelchairs that are pushed ahead.
//!
//! Both are an axle with two wheels. The axle of a case follows the hand by the tractrix: it always rolls towards the
//! hand, at the length of its bar, and so cuts corners. The axle of a trolley rolls where the person faces. A wheel's
//! line is cut into pieces that bend a little each; together they are as long as the line, whatever the frame rate.

use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::math::{Purpose, SplitMix64, Vec2, atan2, exp, person_stream};
use crate::motion::{BagKind, CarrySide, Person};
use crate::patterns::Cause;
use crate::walls::Walls;

use super::Mark;
use super::feet::{normal, turned_by};
use super::gait::GaitProgress;
use super::track::TrackSample;

/// Ranges of the distance between the two lines, of cases and of trolleys, metres.
const GAUGE_M: [[f64; 2]; 2] = [[0.30, 0.40], [0.40, 0.55]];
/// Ranges of the breadth of a line, metres.
const BREADTH_M: [[f64; 2]; 2] = [[0.010, 0.016], [0.014, 0.024]];
/// Ranges of the distance of the axle behind the hand, and ahead of the body, metres.
const REACH_M: [[f64; 2]; 2] = [[0.65, 0.85], [0.55, 0.70]];
/// Place of the hand that pulls: behind the body's middle, and beside it, metres.
const HAND_BEHIND_M: f64 = 0.15;
const HAND_BESIDE_M: f64 = 0.18;
/// Share of its reach within which a case is pushed back rather than pulled, and reaches from which it is lifted.
const TOO_NEAR: f64 = 0.4;
const TORN_AWAY: f64 = 1.6;
/// Range of the points about which cases turn on the spot: of the way from the middle of the axle to the inner wheel.
const PIVOT: [f64; 2] = [0.5, 1.0];
/// Ways on which a trolley turns to where the person faces, and comes in front of the person again, metres.
const STEERING_M: f64 = 0.35;
const IN_FRONT_M: f64 = 0.4;
/// Way that a turn on the spot counts for, metres per radian.
const TURN_AS_M: f64 = 0.3;
/// Longest step of an axle, metres, and most steps in a tick.
const STEP_M: f64 = 0.04;
const MOST_STEPS: f64 = 40.0;
/// Clearance of a wheel from walls, metres.
const CLEAR_M: f64 = 0.03;

/// Standard deviation of the logarithm of the dirt on the wheels of people, which is 1 in the mean, and its limit.
const LOAD_SIGMA: f64 = 1.0;
const MOST_LOAD: f64 = 5.0;
/// A tread takes dirt up and loses it again: the standard deviation of the logarithm of what it leaves along its way, which
/// is 1 in the mean, and the way between two values, which goes straight between them, metres.
const TREAD_SIGMA: f64 = 0.9;
const TREAD_M: f64 = 0.9;
/// How far the treads of an axle's wheels are from each other, so that they differ: no way is as long, metres.
const APART_M: f64 = 1e6;
/// What a bend of one radian per metre adds to a line, relative to a straight one, the bend from which it adds no more, and
/// the largest bend that counts at all.
const SCRUB: f64 = 1.5;
const MOST_SCRUBBED: f64 = 2.5;
const MOST_BEND: f64 = 6.0;
/// Way over which bends are evened out, metres.
const BEND_WAY_M: f64 = 0.08;
/// Bend from which rubber stays on the floor, radians per metre, and the bend at which all of it does.
const TIGHT: [f64; 2] = [2.0, 4.0];
/// Share of tight turns that leave rubber, the median of its optical density, the deviation of the logarithm, and its limit.
const RUBS: f64 = 0.4;
const RUBBER_DENSITY: f64 = 0.16;
const RUBBER_SIGMA: f64 = 0.7;
const MOST_RUBBER: f64 = 0.5;
/// Least optical density of rubber, and its breadth relative to the line's.
const LEAST_RUBBER: f64 = 0.01;
const RUBBER_BREADTH: f64 = 0.6;

/// Shortest step of a wheel, metres: less is a tremble.
const LEAST_STEP_M: f64 = 0.004;
/// Longest piece of a line, metres, and its largest turn, radians.
const PIECE_M: f64 = 0.6;
const PIECE_RAD: f64 = 0.16;
/// Cosine of a turn from which a wheel rolls back.
const BACK: f64 = 0.5;

/// What a person pulls or pushes on two wheels.
pub(super) struct Wheels {
    pushed: bool,
    /// Distance of the axle behind the hand, or ahead of the body, metres.
    reach_m: f64,
    /// How far the hand lies to the left of the body, metres.
    beside_m: f64,
    half_gauge_m: f64,
    /// The point about which it turns on the spot: from its middle, 0, to the inner wheel, 1.
    pivot: f64,
    ink: Ink,
    rng: ChaCha8Rng,
    body: Option<Body>,
    axle: Option<Axle>,
    lines: [Line; 2],
}

/// What the wheels of a person leave.
struct Ink {
    breadth_m: f64,
    /// Dirt on the wheels, 1 in the mean.
    load: f64,
    variation: u64,
}

impl Ink {
    /// Dirt on the tread of a wheel that has rolled so far, relative to the person's wheels.
    fn on_tread(&self, rolled_m: f64) -> f64 {
        let at = rolled_m / TREAD_M;
        let value = |k: u64| {
            // The sum of four even numbers is close to normal.
            let word = SplitMix64::new(self.variation.wrapping_add(k)).next_u64();
            let sum = (0..4).map(|n| (word >> (16 * n) & 0xffff) as f64 / 65_535.0 - 0.5).sum::<f64>();
            sum * 3f64.sqrt()
        };
        let k = at as u64;
        let (from, to) = (value(k), value(k + 1));
        let bell = from + (to - from) * (at - at.floor());
        // Between two values it varies less: 2/3 in the mean.
        exp(TREAD_SIGMA * bell - TREAD_SIGMA * TREAD_SIGMA / 3.0)
    }
}

#[derive(Clone, Copy)]
struct Body {
    place_m: Vec2,
    velocity_m_s: Vec2,
    facing: Vec2,
}

#[derive(Clone, Copy)]
struct Axle {
    middle_m: Vec2,
    /// Unit vector: where it rolls.
    way: Vec2,
}

/// The line of one wheel.
#[derive(Default)]
struct Line {
    /// The piece that is not finished.
    piece: Option<Piece>,
    /// Way that the wheel has rolled since the person came, metres; the two wheels of an axle start apart.
    rolled_m: f64,
    /// Bend, radians per metre, evened out.
    bend_per_m: f64,
    /// Turn of the axle that no step of the wheel has taken up yet, radians.
    turned_rad: f64,
    /// Whether the wheel is in a tight turn, and the optical density of the rubber that it leaves.
    tight: bool,
    rubber: f64,
}

/// A piece of a line, from its start to the last place of the wheel.
#[derive(Clone, Copy)]
struct Piece {
    start_m: Vec2,
    start_way: Vec2,
    from: Laid,
    last_m: Vec2,
    last_way: Vec2,
    to: Laid,
    length_m: f64,
    turned_rad: f64,
}

/// What a wheel leaves at a place: passes, and optical density of rubber.
#[derive(Clone, Copy, Default)]
struct Laid {
    passes: f64,
    rubber: f64,
}

impl Wheels {
    /// The wheels of a person; `None` for who has none.
    pub fn of(seed: u64, person: &Person) -> Option<Box<Wheels>> {
        let bag = person.bag?;
        let pushed = match bag.kind {
            BagKind::Trolley => false,
            BagKind::Pushed => true,
            BagKind::Bag | BagKind::Case | BagKind::Rucksack => return None,
        };
        let mut rng = person_stream(seed, person.id, Purpose::Wheels);
        let mut within = |ranges: [[f64; 2]; 2]| {
            let [low, high] = ranges[usize::from(pushed)];
            low + (high - low) * rng.random::<f64>()
        };
        let (gauge_m, breadth_m, reach_m) = (within(GAUGE_M), within(BREADTH_M), within(REACH_M));
        let load = exp(LOAD_SIGMA * normal(&mut rng) - 0.5 * LOAD_SIGMA * LOAD_SIGMA).min(MOST_LOAD);
        Some(Box::new(Wheels {
            pushed,
            reach_m,
            beside_m: if bag.side == CarrySide::Left { HAND_BESIDE_M } else { -HAND_BESIDE_M },
            half_gauge_m: 0.5 * gauge_m,
            pivot: PIVOT[0] + (PIVOT[1] - PIVOT[0]) * rng.random::<f64>(),
            ink: Ink { breadth_m, load, variation: rng.random() },
            rng,
            body: None,
            axle: None,
            lines: [0.0, APART_M].map(Line::after),
        }))
    }

    /// Lifts the wheels off the floor: the next step sets them down behind or before the person.
    pub fn lift(&mut self, out: &mut Vec<Mark>) {
        self.body = None;
        self.set_aside(out);
    }

    /// Advances to the next sample of the person's path; appends the finished pieces of lines.
    pub fn roll(
        &mut self,
        sample: &TrackSample,
        facing: Vec2,
        progress: &GaitProgress,
        walls: &Walls,
        out: &mut Vec<Mark>,
    ) {
        let next = Body { place_m: sample.position_m, velocity_m_s: sample.velocity_m_s, facing };
        let moved = progress.walked_m > 0.0 || progress.turned_rad != 0.0;
        let Some(last) = self.body.filter(|_| moved) else {
            self.body.get_or_insert(next);
            return;
        };
        self.body = Some(next);
        let chord = next.place_m - last.place_m;
        let length_m = chord.length();
        let turn = angle(last.facing, facing).abs();
        let steps = ((length_m + self.reach_m * turn) / STEP_M).ceil().clamp(1.0, MOST_STEPS);
        // A cubic between the two places, along the velocities at both.
        let slope = |body: &Body| {
            let along = body.velocity_m_s.normalized().filter(|way| way.dot(chord) > 0.5 * length_m);
            along.map_or(chord, |way| way * length_m)
        };
        let (slope_then, slope_now) = (slope(&last), slope(&next));
        for step in 1..=steps as u32 {
            let t = f64::from(step) / steps;
            let (t2, u) = (t * t, 1.0 - t);
            let place_m =
                last.place_m + chord * (t2 * (3.0 - 2.0 * t)) + slope_then * (t * u * u) + slope_now * (t2 * -u);
            let facing = last.facing.lerp(facing, t).normalized().unwrap_or(facing);
            self.follow(place_m, facing, length_m / steps, walls, out);
        }
    }

    /// Moves the axle after a body that came this far.
    fn follow(&mut self, body_m: Vec2, facing: Vec2, step_m: f64, walls: &Walls, out: &mut Vec<Mark>) {
        let hand_m = body_m - facing * HAND_BEHIND_M + facing.left() * self.beside_m;
        let hold_m = if self.pushed { body_m } else { hand_m };
        let near = |axle: &Axle| axle.middle_m.distance(hold_m) < TORN_AWAY * self.reach_m;
        let Some(axle) = self.axle.filter(near) else {
            self.set_aside(out);
            let middle_m = hold_m + facing * if self.pushed { self.reach_m } else { -self.reach_m };
            self.axle = Some(Axle { middle_m, way: facing });
            return;
        };
        let Axle { mut middle_m, way } =
            if self.pushed { self.pushed_by(axle, body_m, facing, step_m) } else { self.pulled_by(axle, hand_m) };
        // Who pulls or pushes steers clear of walls.
        let clear_m = self.half_gauge_m + CLEAR_M;
        if let Some(wall) = walls.nearest(middle_m, clear_m)
            && let Some(off) = (middle_m - wall.point_m).normalized()
        {
            middle_m += off * (0.5 * (clear_m - wall.distance_m));
        }
        if !walls.is_inside(middle_m) || !walls.sight(axle.middle_m, middle_m) {
            self.set_aside(out);
            return;
        }
        self.axle = Some(Axle { middle_m, way });
        let turned_rad = angle(axle.way, way).abs();
        for (line, side) in self.lines.iter_mut().zip([self.half_gauge_m, -self.half_gauge_m]) {
            line.roll_to(middle_m + way.left() * side, turned_rad, &mut self.rng, &self.ink, out);
        }
    }

    /// The axle of a case after a step of the hand: it rolls towards the hand.
    fn pulled_by(&self, axle: Axle, hand_m: Vec2) -> Axle {
        let bar = hand_m - axle.middle_m;
        let length_m = bar.length();
        let way = if length_m > 1e-6 { bar / length_m } else { axle.way };
        let kept_m = length_m.clamp(TOO_NEAR * self.reach_m, self.reach_m);
        let inner_m = self.pivot * self.half_gauge_m * axle.way.cross(way).signum();
        let on_the_spot = if kept_m == length_m { (axle.way.left() - way.left()) * inner_m } else { Vec2::ZERO };
        Axle { middle_m: hand_m - way * kept_m + on_the_spot, way }
    }

    /// The axle of a trolley after a step of the body: it rolls ahead and turns to where the person faces.
    fn pushed_by(&self, axle: Axle, body_m: Vec2, facing: Vec2, step_m: f64) -> Axle {
        let turn = angle(axle.way, facing);
        let way_m = step_m + TURN_AS_M * turn.abs().min(step_m + 0.05);
        let way = turned_by(axle.way, turn * (1.0 - exp(-way_m / STEERING_M)));
        let missing = body_m + way * self.reach_m - axle.middle_m;
        let along = way * missing.dot(way);
        Axle { middle_m: axle.middle_m + along + (missing - along) * (1.0 - exp(-step_m / IN_FRONT_M)), way }
    }

    fn set_aside(&mut self, out: &mut Vec<Mark>) {
        self.axle = None;
        for line in &mut self.lines {
            let rolled_m = line.rolled_m;
            if let Some(piece) = std::mem::replace(line, Line::after(rolled_m)).piece {
                piece.finish(piece.last_way, &self.ink, out);
            }
        }
    }
}

impl Line {
    /// The line of a wheel that has rolled so far and stands nowhere.
    fn after(rolled_m: f64) -> Line {
        Line { rolled_m, ..Line::default() }
    }

    /// Rolls the wheel to a place while its axle turns.
    fn roll_to(&mut self, to: Vec2, turned_rad: f64, rng: &mut ChaCha8Rng, ink: &Ink, out: &mut Vec<Mark>) {
        let Some(piece) = &mut self.piece else {
            let passes = ink.load * ink.on_tread(self.rolled_m);
            self.piece = Some(Piece::begin(to, None, Laid { passes, rubber: 0.0 }));
            return;
        };
        let step = to - piece.last_m;
        let length_m = step.length();
        self.turned_rad += turned_rad;
        if length_m < LEAST_STEP_M {
            return;
        }
        let bend_per_m = (std::mem::take(&mut self.turned_rad) / length_m).min(MOST_BEND);
        self.bend_per_m += (bend_per_m - self.bend_per_m) * length_m / (length_m + BEND_WAY_M);
        if self.bend_per_m > TIGHT[0] && !self.tight {
            let leaves = rng.random::<f64>() < RUBS;
            let density = (RUBBER_DENSITY * exp(RUBBER_SIGMA * normal(rng))).min(MOST_RUBBER);
            self.rubber = if leaves { density } else { 0.0 };
        }
        self.tight = self.bend_per_m > TIGHT[0] * if self.tight { 0.7 } else { 1.0 };
        let tight = ((self.bend_per_m - TIGHT[0]) / (TIGHT[1] - TIGHT[0])).clamp(0.0, 1.0);
        self.rolled_m += length_m;
        let load = ink.load * ink.on_tread(self.rolled_m);
        let laid =
            Laid { passes: load * (1.0 + SCRUB * self.bend_per_m.min(MOST_SCRUBBED)), rubber: self.rubber * tight };

        let way = step / length_m;
        let (ahead, aside) = (piece.last_way.dot(way), piece.last_way.cross(way).abs());
        if piece.length_m > 0.0 && ahead < BACK {
            piece.finish(piece.last_way, ink, out);
            *piece = Piece::begin(piece.last_m, Some(way), piece.to);
        } else if piece.length_m + length_m > PIECE_M || piece.turned_rad + aside > PIECE_RAD {
            let between = (piece.last_way + way).normalized().unwrap_or(way);
            piece.finish(between, ink, out);
            *piece = Piece::begin(piece.last_m, Some(between), piece.to);
        }
        piece.roll(to, way, length_m, laid);
    }
}

impl Piece {
    fn begin(start_m: Vec2, way: Option<Vec2>, from: Laid) -> Piece {
        let start_way = way.unwrap_or(Vec2::ZERO);
        let (last_m, last_way) = (start_m, start_way);
        Piece { start_m, start_way, from, last_m, last_way, to: from, length_m: 0.0, turned_rad: 0.0 }
    }

    fn roll(&mut self, to_m: Vec2, way: Vec2, length_m: f64, laid: Laid) {
        if self.start_way == Vec2::ZERO {
            (self.start_way, self.last_way) = (way, way);
        }
        self.turned_rad += self.last_way.cross(way).abs();
        self.length_m += length_m;
        (self.last_m, self.last_way, self.to) = (to_m, way, laid);
    }

    /// Appends the marks of the piece, which ends in a direction.
    fn finish(&self, end_way: Vec2, ink: &Ink, out: &mut Vec<Mark>) {
        let chord = self.last_m - self.start_m;
        let Some(heading) = chord.normalized() else { return };
        let mark = |cause: Cause, breadth_m: f64, [from, to]: [f64; 2]| Mark {
            cause,
            place_m: self.start_m.lerp(self.last_m, 0.5),
            heading,
            mirrored: false,
            pattern: 0,
            length_m: chord.length() as f32,
            smear_m: 0.0,
            twist_rad: angle(self.start_way, end_way) as f32,
            forefoot: 0.0,
            effort: (to - from) as f32,
            stood_s: 0.0,
            wheel_m: breadth_m as f32,
            strength: (0.5 * (from + to)) as f32,
            soil: 0.0,
            wet: 0.0,
            wear: 0,
            variation: ink.variation,
        };
        out.push(mark(Cause::Sole, ink.breadth_m, [self.from.passes, self.to.passes]));
        if self.from.rubber.max(self.to.rubber) > LEAST_RUBBER {
            out.push(mark(Cause::Heel, RUBBER_BREADTH * ink.breadth_m, [self.from.rubber, self.to.rubber]));
        }
    }
}

/// The angle from one unit vector to another, radians counter-clockwise.
fn angle(from: Vec2, to: Vec2) -> f64 {
    atan2(from.cross(to), from.dot(to))
}
