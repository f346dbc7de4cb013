//! Turns a touch into a contact: position, height, length and pattern of its stain.

use std::f64::consts::PI;

use crate::math::{SplitMix64, exp};
use crate::motion::{BagKind, CarrySide, Person};
use crate::patterns::{Cause, Form};
use crate::walls::Walls;

use super::ContactOptions;
use super::places::{ContactPlaces, direction_at};
use super::requests::FixtureKind;
use super::step::ContactStep;
use super::wall_patterns::{SizedPattern, WallPatterns};
use super::wall_side::WallSide;
use crate::marks::Contact;

/// Reference stature for the heights of hands, metres, and the share of a height that scales with stature.
const STATURE_M: f64 = 1.69;
const BY_STATURE: f64 = 0.6;
/// Heights over stature (ANSUR II): shoulder, middle of the upper arm, elbow, hip.
const SHOULDER: f64 = 0.82;
const UPPER_ARM: f64 = 0.73;
const ELBOW: f64 = 0.629;
const HIP: f64 = 0.515;
/// What of an adult's shoulder rubs along a wall: height at the reference stature, change of it per stature, its standard
/// deviation, the greatest breadth of the stain and the length of one that is not drawn along, metres; and the stature from which people are adults, metres.
const RUBS_M: f64 = 1.395;
const RUBS_BY_STATURE: f64 = 0.25;
const RUBS_SPREAD_M: f64 = 0.03;
const RUBS_BREADTH_M: f64 = 0.08;
const RUBS_LENGTH_M: f64 = 0.22;
const ADULT_M: f64 = 1.42;
/// Heights at which hands push and hold a corner, and their standard deviation, metres.
const PUSH_M: f64 = 1.25;
const AT_CORNER_M: f64 = 1.15;
const HAND_SPREAD_M: f64 = 0.08;
/// Range of heights of buttons and switches, metres.
const SWITCH_M: [f64; 2] = [1.05, 1.2];
/// How far the upper arm is lifted sideways where a trailing hand just reaches the wall, as a sine, and the standard deviation
/// of the hand's height, metres.
const LIFTED: f64 = 0.95;
const TRAILING_SPREAD_M: f64 = 0.03;
/// Depth of a contact from which a hand lies flat; farther off only its fingertips touch.
const FLAT_HAND: f64 = 0.35;
/// Time for which a part at the wall stays on it, seconds: most of a step. Least length of what is drawn along, metres.
const LASTS_S: f64 = 0.38;
const LEAST_DRAG_M: f64 = 0.2;
/// How strongly a part presses that comes as near as it can, over the median.
const PRESS: f64 = 1.7;
/// Range of the fall of a dragged hand, degrees.
const FALL_DEG: [f32; 2] = [5.0, 15.0];
/// Range of the factors on a pattern's length and breadth.
const STRETCH: [f32; 2] = [0.85, 1.2];
/// Standard deviation of touches along the wall at a corner or a jamb, metres.
const ROUND_A_CORNER_M: f64 = 0.05;
/// Height ranges of low touches, metres: toes, shoes at a corner, cases, both ends of trolleys, chair backs.
const TOE_M: [f64; 2] = [0.02, 0.15];
const CORNER_SHOE_M: [f64; 2] = [0.02, 0.28];
const CASE_M: [f64; 2] = [0.2, 0.6];
const TROLLEY_M: [[f64; 2]; 2] = [[0.15, 0.3], [0.8, 0.95]];
const CHAIR_BACK_M: [f64; 2] = [0.75, 0.95];
/// Height range of a sole set against the wall behind, metres.
const SOLE_M: [f64; 2] = [0.22, 0.5];
/// Factor on the density at the foot of corners and jambs.
const HARD: f64 = 1.5;
/// Limit on the optical density of a contact.
const MOST_DENSITY: f64 = 1.0;

/// The part of a body, or the luggage, that touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum BodyPart {
    /// A hand that pushes or holds.
    Hand,
    /// A hand drawn along a wall.
    Trailing,
    Arm,
    Shoulder,
    Bag,
    Shoe,
    /// Any part of a standing person who leans.
    Lean,
}

/// A touch: the part and the place that it touches.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Touch {
    /// The wall beside the body.
    Beside { side: WallSide, part: BodyPart },
    /// A jamb of a passed door; `onward` if passed along its `through`.
    ///
    /// `near` is 1 for a jamb at hand, down to 0 where it is out of reach.
    Jamb { door: u32, jamb: usize, onward: bool, part: BodyPart, near: f64 },
    /// A corner, as near as a jamb.
    Corner { corner: u32, part: BodyPart, near: f64 },
    /// A fixture.
    Fixture { fixture: u32 },
}

/// A stain whose pattern is not chosen yet.
struct StainSpec {
    cause: Cause,
    form: Option<Form>,
    face: usize,
    along_m: f64,
    height_m: f64,
    /// Direction of a drag along the face, 1 or -1; `None` for a plain touch.
    way: Option<f64>,
    /// Length of a drag, metres.
    drawn_m: f64,
    /// Factor on the median density.
    hard: f64,
}

/// Random numbers of one touch.
struct TouchRandom(SplitMix64);

impl TouchRandom {
    fn unit(&mut self) -> f64 {
        f64::from(self.0.unit())
    }

    fn within(&mut self, [low, high]: [f64; 2]) -> f64 {
        low + (high - low) * self.unit()
    }

    fn normal(&mut self, mean: f64, spread: f64) -> f64 {
        mean + spread * f64::from(self.0.normal())
    }
}

/// Relative contact rates of a kind of fixture per passage and per second stood.
///
/// They are factors on [`ContactOptions::fixture_per_passage`] and [`ContactOptions::fixture_per_second`].
pub(super) fn fixture_rates(kind: FixtureKind) -> (f64, f64) {
    match kind {
        FixtureKind::Switch => (1.0, 0.3),
        FixtureKind::Handle => (1.5, 0.5),
        FixtureKind::Counter => (0.3, 1.0),
        FixtureKind::Bench | FixtureKind::Chairs => (0.2, 1.0),
        FixtureKind::Radiator => (0.3, 1.0),
        FixtureKind::Bin => (1.0, 0.3),
        FixtureKind::Machine => (0.2, 1.5),
    }
}

/// The contact of a touch; `None` if its wall has no face or the library lacks the cause.
pub(super) fn contact(
    options: &ContactOptions,
    wall_patterns: &WallPatterns,
    places: &ContactPlaces,
    walls: &Walls,
    step: &ContactStep,
    touch: &Touch,
    word: u64,
) -> Option<Contact> {
    let draw = &mut TouchRandom(SplitMix64::new(word));
    let stain = match *touch {
        Touch::Beside { side, part } => beside(options, step, &side, part, draw)?,
        Touch::Jamb { door, jamb, onward, part, near } => {
            let door = &places.doors()[door as usize];
            let (face, along_m) = door.doorway.on_faces[jamb];
            // Most people hold the edge ahead, some the edge behind.
            let behind = draw.unit() < 0.3;
            let sign = if (onward != behind) == door.onward[jamb] { -1.0 } else { 1.0 };
            let edge_m = draw.normal(0.5 * door.doorway.depth_m, ROUND_A_CORNER_M);
            let (mut stain, handle) = (at_edge(step.person, part, PUSH_M, draw), draw.unit());
            let is_latch = door.latch.is_none_or(|latch| latch == jamb);
            let share = if door.latch.is_some() { 0.5 } else { 0.25 };
            if part == BodyPart::Hand && door.handle_m.is_some() && is_latch && handle < share {
                stain.height_m = draw.normal(door.handle_height_m(), HAND_SPREAD_M);
                stain.form = Some(if draw.unit() < 0.6 { Form::Fingertips } else { Form::Palm });
            }
            StainSpec { face, along_m: along_m + sign * edge_m, hard: near * stain.hard, ..stain }
        }
        Touch::Corner { corner, part, near } => {
            let corner = &places.corners()[corner as usize];
            let stain = at_edge(step.person, part, AT_CORNER_M, draw);
            let along_m = draw.normal(corner.along_m, ROUND_A_CORNER_M);
            StainSpec { face: corner.face, along_m, hard: near * stain.hard, ..stain }
        }
        Touch::Fixture { fixture } => {
            let fixture = &places.fixtures()[fixture as usize];
            let direction = direction_at(walls, fixture.face, fixture.along_m);
            let half_m = 0.5 * fixture.width_m;
            let before_m = (step.at_m - fixture.point_m).dot(direction).clamp(-half_m, half_m);
            let stain = at_fixture(step.person, fixture.kind, draw);
            let spread_m = 0.07 + 0.1 * fixture.width_m.min(1.0);
            StainSpec { face: fixture.face, along_m: fixture.along_m + draw.normal(before_m, spread_m), ..stain }
        }
    };
    let chosen = wall_patterns.choose(stain.cause, stain.form, draw.unit())?;
    let length_m = walls.faces.get(stain.face)?.length_m();
    fitted(options, &stain, chosen, (length_m, walls.faces[stain.face].closed), draw)
}

/// Height of a hand, which scales with stature in part, metres.
fn hand_m(person: &Person, mean_m: f64, draw: &mut TouchRandom) -> f64 {
    let stature = 1.0 - BY_STATURE + BY_STATURE * person.stature_m / STATURE_M;
    draw.normal(mean_m, HAND_SPREAD_M) * stature
}

fn stain(cause: Cause, form: Option<Form>, height_m: f64) -> StainSpec {
    StainSpec { cause, form, face: 0, along_m: 0.0, height_m, way: None, drawn_m: 0.0, hard: 1.0 }
}

/// The stain on a wall beside the body, from the contact itself.
///
/// With the depth `d`, 1 at the wall and 0 where the part just reaches it: a swinging part stays on the wall for
/// `LASTS_S sqrt(d)` and draws as long a stain as the body goes along the wall in that time; it presses as `PRESS sqrt(d)`. A hand
/// is as high as the elbow, which rises as the arm reaches out; of the arm, the elbow juts out farthest, the hip least.
///
/// Random are the height within a few centimetres, the place within 6 cm, and which phase of the step a shoe is in.
fn beside(
    options: &ContactOptions,
    step: &ContactStep,
    side: &WallSide,
    part: BodyPart,
    draw: &mut TouchRandom,
) -> Option<StainSpec> {
    let person = step.person;
    let reach_m = if matches!(part, BodyPart::Arm | BodyPart::Shoulder) { options.close_m } else { options.reach_m };
    let depth = (1.0 - side.gap_m.max(0.0) / reach_m.max(1e-3)).clamp(0.05, 1.0);
    let found = match part {
        BodyPart::Trailing | BodyPart::Hand => {
            let form = if depth > FLAT_HAND { Form::Drag } else { Form::Fingertips };
            let lifted = LIFTED * (1.0 - depth);
            let height = SHOULDER - (SHOULDER - ELBOW) * (1.0 - lifted * lifted).sqrt();
            stain(Cause::Hand, Some(form), draw.normal(height * person.stature_m, TRAILING_SPREAD_M))
        }
        BodyPart::Arm => arm(person, depth, draw),
        BodyPart::Shoulder => shoulder(person, draw),
        BodyPart::Bag => bag(person, draw),
        BodyPart::Shoe => {
            let form = if draw.unit() < 0.7 { Form::Toe } else { Form::HeelLine };
            stain(Cause::Shoe, Some(form), draw.within(TOE_M))
        }
        BodyPart::Lean => leaning(person, side, draw),
    };
    let onward_m_s = step.velocity_m_s.dot(side.direction());
    let is_drawn = step.walked_m > 0.0 && onward_m_s != 0.0 && part != BodyPart::Lean;
    Some(StainSpec {
        face: side.face?,
        along_m: draw.normal(side.along_m, 0.06),
        way: is_drawn.then(|| onward_m_s.signum()),
        drawn_m: (onward_m_s.abs() * LASTS_S * depth.sqrt()).max(LEAST_DRAG_M),
        hard: if part == BodyPart::Lean { 1.0 } else { PRESS * depth.sqrt() },
        ..found
    })
}

fn shoulder(person: &Person, draw: &mut TouchRandom) -> StainSpec {
    let height_m = if person.stature_m < ADULT_M {
        SHOULDER * person.stature_m
    } else {
        RUBS_M + RUBS_BY_STATURE * (person.stature_m - STATURE_M)
    };
    stain(Cause::Shoulder, None, draw.normal(height_m, RUBS_SPREAD_M))
}

/// The stain of an arm, `near` 0 where the elbow just touches, 1 where the hip does.
fn arm(person: &Person, near: f64, draw: &mut TouchRandom) -> StainSpec {
    let height = match near {
        u if u < 0.55 => ELBOW,
        u if u < 0.8 => UPPER_ARM,
        _ => HIP,
    };
    stain(Cause::Arm, None, draw.normal(height * person.stature_m, 0.03))
}

fn bag(person: &Person, draw: &mut TouchRandom) -> StainSpec {
    let kind = person.bag.map_or(BagKind::Bag, |bag| bag.kind);
    let height_m = match kind {
        BagKind::Bag | BagKind::Case => draw.within(CASE_M),
        BagKind::Trolley | BagKind::Pushed => {
            let end = usize::from(draw.unit() < 0.4);
            draw.within(TROLLEY_M[end])
        }
        BagKind::Rucksack => draw.normal(0.72 * person.stature_m, 0.07),
    };
    stain(Cause::Bag, None, height_m)
}

/// The stain of a standing person who leans, by the direction of the wall.
fn leaning(person: &Person, side: &WallSide, draw: &mut TouchRandom) -> StainSpec {
    let u = draw.unit();
    if side.is_at_side() {
        return match u {
            u if u < 0.5 => shoulder(person, draw),
            u if u < 0.7 => arm(person, draw.unit(), draw),
            u if u < 0.9 => stain(Cause::Hand, Some(Form::Palm), hand_m(person, PUSH_M, draw)),
            _ => stain(Cause::Shoe, Some(Form::Toe), draw.within(TOE_M)),
        };
    }
    if side.ahead > 0.0 {
        return match u {
            u if u < 0.7 => stain(Cause::Hand, Some(Form::Palm), hand_m(person, PUSH_M, draw)),
            _ => stain(Cause::Shoe, Some(Form::Toe), draw.within(TOE_M)),
        };
    }
    let rucksack = person.bag.is_some_and(|bag| bag.side == CarrySide::Back);
    match u {
        u if u < 0.5 && rucksack => bag(person, draw),
        u if u < 0.5 => shoulder(person, draw),
        u if u < 0.85 => stain(Cause::Shoe, Some(Form::Sole), draw.within(SOLE_M)),
        _ => stain(Cause::Hand, Some(Form::Palm), draw.normal(0.5 * person.stature_m, 0.07)),
    }
}

/// The stain on the edge of a jamb or a corner.
fn at_edge(person: &Person, part: BodyPart, hand_height_m: f64, draw: &mut TouchRandom) -> StainSpec {
    match part {
        BodyPart::Bag => bag(person, draw),
        BodyPart::Shoe => {
            let form = if draw.unit() < 0.65 { Form::Toe } else { Form::HeelLine };
            StainSpec { hard: HARD, ..stain(Cause::Shoe, Some(form), draw.within(CORNER_SHOE_M)) }
        }
        BodyPart::Shoulder => {
            if draw.unit() < 0.6 {
                shoulder(person, draw)
            } else {
                arm(person, draw.unit(), draw)
            }
        }
        BodyPart::Arm => arm(person, draw.unit(), draw),
        BodyPart::Hand | BodyPart::Trailing | BodyPart::Lean => {
            let form = if draw.unit() < 0.75 { Form::Palm } else { Form::Fingertips };
            stain(Cause::Hand, Some(form), hand_m(person, hand_height_m, draw))
        }
    }
}

/// The stain at a fixture.
fn at_fixture(person: &Person, kind: FixtureKind, draw: &mut TouchRandom) -> StainSpec {
    let u = draw.unit();
    let palm = |height_m: f64| stain(Cause::Hand, Some(Form::Palm), height_m);
    let tips = |height_m: f64| stain(Cause::Hand, Some(Form::Fingertips), height_m);
    let toe = |height_m: f64| stain(Cause::Shoe, Some(Form::Toe), height_m);
    match kind {
        FixtureKind::Switch => {
            let at_m = draw.within(SWITCH_M);
            let height_m = draw.normal(at_m, HAND_SPREAD_M);
            if u < 0.7 { tips(height_m) } else { palm(height_m) }
        }
        FixtureKind::Handle => palm(draw.normal(1.0, 0.1)),
        FixtureKind::Counter => match u {
            u if u < 0.45 => palm(draw.normal(1.0, 0.07)),
            u if u < 0.7 => stain(Cause::Bag, None, draw.within(CASE_M)),
            _ => toe(draw.within(TOE_M)),
        },
        FixtureKind::Bench => match u {
            // Backs of people who sit.
            u if u < 0.35 => stain(Cause::Arm, None, draw.normal(0.6 * person.stature_m, 0.06)),
            u if u < 0.6 => stain(Cause::Bag, None, draw.within(CHAIR_BACK_M)),
            u if u < 0.85 => toe(draw.within([0.04, 0.25])),
            _ => palm(draw.normal(0.65, 0.1)),
        },
        FixtureKind::Radiator => match u {
            u if u < 0.5 => palm(draw.normal(0.95, HAND_SPREAD_M)),
            u if u < 0.8 => stain(Cause::Arm, None, draw.normal(HIP * person.stature_m, 0.05)),
            _ => toe(draw.within(TOE_M)),
        },
        FixtureKind::Bin => match u {
            u if u < 0.3 => tips(draw.normal(0.9, 0.1)),
            u if u < 0.65 => stain(Cause::Bag, None, draw.normal(0.75, 0.12)),
            _ => toe(draw.within([0.03, 0.25])),
        },
        FixtureKind::Machine => match u {
            u if u < 0.5 => tips(draw.normal(1.25, 0.1)),
            u if u < 0.8 => palm(draw.normal(1.2, 0.12)),
            _ => toe(draw.within([0.03, 0.25])),
        },
        FixtureKind::Chairs => match u {
            u if u < 0.75 => stain(Cause::Bag, None, draw.within(CHAIR_BACK_M)),
            _ => toe(draw.within([0.04, 0.25])),
        },
    }
}

/// Fits a pattern to a stain on a face of this length, closed or not.
fn fitted(
    options: &ContactOptions,
    stain: &StainSpec,
    chosen: SizedPattern,
    (face_m, closed): (f64, bool),
    draw: &mut TouchRandom,
) -> Option<Contact> {
    let stretch = |draw: &mut TouchRandom| f64::from(draw.0.range(STRETCH[0], STRETCH[1]));
    let is_drag = stain.way.is_some() && stain.form != Some(Form::Fingertips) && stain.form != Some(Form::Toe);
    let breadth_m = chosen.breadth_m * stretch(draw);
    let breadth_m = if stain.cause == Cause::Shoulder { breadth_m.min(RUBS_BREADTH_M) } else { breadth_m };
    let length_m = match stain.cause {
        // Rubber lines and plain touches keep the pattern's length.
        Cause::Shoe => chosen.length_m * stretch(draw) * if is_drag { 1.3 } else { 1.0 },
        _ if is_drag => stain.drawn_m,
        // A shoulder that only leans or passes a jamb leaves no more than its own breadth.
        Cause::Shoulder => chosen.length_m.min(RUBS_LENGTH_M) * stretch(draw),
        _ => chosen.length_m * stretch(draw),
    };
    let falls = matches!(stain.cause, Cause::Hand) && stain.way.is_some();
    let fall_rad = f64::from(if falls {
        draw.0.range(FALL_DEG[0], FALL_DEG[1])
    } else if is_drag {
        if stain.cause == Cause::Shoulder { draw.0.range(-1.0, 1.5) } else { draw.0.range(-2.0, 5.0) }
    } else {
        (if stain.cause == Cause::Shoulder { 3.0 } else { 10.0 }) * draw.0.normal()
    })
    .to_radians();
    // A drag to the left is rotated by half a turn and mirrored, so that up stays up.
    let either = if draw.unit() < 0.5 { 1.0 } else { -1.0 };
    let sign = stain.way.unwrap_or(either);
    let (direction_rad, mirrored) = if sign > 0.0 { (-fall_rad, false) } else { (fall_rad - PI, true) };
    let (sin, cos) = crate::math::sin_cos(fall_rad);
    let (ahead_m, down_m) = if is_drag { (0.5 * length_m * cos, 0.5 * length_m * sin) } else { (0.0, 0.0) };
    let along_m = stain.along_m + sign * ahead_m;
    // A stain entirely beyond the ends of an open face is dropped; others show in part.
    if !closed && (along_m < -0.5 * length_m || along_m > face_m + 0.5 * length_m) {
        return None;
    }
    let along_m = if closed { along_m.rem_euclid(face_m.max(1e-9)) } else { along_m };
    let median = match stain.cause {
        Cause::Hand => options.hand_density,
        Cause::Arm => options.arm_density,
        Cause::Shoulder => options.shoulder_density,
        Cause::Bag => options.bag_density,
        _ => options.shoe_density,
    };
    let density = median * stain.hard * exp(options.sigma * f64::from(draw.0.normal()));
    Some(Contact {
        cause: stain.cause,
        face: u32::try_from(stain.face).ok()?,
        along_m,
        height_m: (stain.height_m - down_m).max(0.01),
        direction_rad: direction_rad as f32,
        pattern: chosen.pattern,
        mirrored,
        length_m: length_m as f32,
        breadth_m: breadth_m as f32,
        strength: density.min(MOST_DENSITY) as f32,
        variation: draw.0.next_u64(),
    })
}
