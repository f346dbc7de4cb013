use rand::RngExt;
use serde::Serialize;

use crate::math::{Distribution, Purpose, person_stream};
use crate::options::options;

options! {
    /// Distribution of bodies and gaits in a crowd; lengths in metres.
    pub struct BodyOptions {
        /// Share of men among the grown-ups.
        men: f64 = 0.5, in 0.0..=1.0;
        /// Share of children among all.
        children: f64 = 0.03, in 0.0..=1.0;
        /// Body height.
        ///
        /// Stature of men (ANSUR II: 1.756 +- 0.069).
        stature_men: Distribution = Distribution::normal(1.756, 0.069, 1.5, 2.05), in 0.5..=2.5, unit "m";
        /// Body height.
        ///
        /// Stature of women (ANSUR II: 1.628 +- 0.064).
        stature_women: Distribution = Distribution::normal(1.628, 0.064, 1.4, 1.9), in 0.5..=2.5, unit "m";
        /// Body height.
        stature_children: Distribution = Distribution::Uniform([1.1, 1.45]), in 0.5..=2.5, unit "m";
        /// Share of people who carry a bag.
        bags: f64 = 0.6, in 0.0..=1.0;
        /// Share of those with a bag who pull it behind them, as a case on wheels.
        pull: f64 = 0.1, in 0.0..=1.0;
        /// Share of those with a bag who push a trolley, a pram or a wheelchair instead.
        push: f64 = 0.02, in 0.0..=1.0;
        /// A fixed step length; left out: it follows speed and stature.
        ///
        /// Individual step length, as in the paper: taken in full at the person's own free speed, and shorter as somebody
        /// is slowed.
        ///
        /// `None`: step length follows speed and stature.
        step_length: Option<Distribution> = None, in 0.15..=2.0, unit "m", eg "0.7";
        /// Between the lines of a man's feet, walking freely; women's: 0.88 of it.
        ///
        /// Distance between the lines of the left and the right foot's middles, of men who walk freely; women's is 0.88
        /// of it (Murray 1964, 1970: 0.081 and 0.071).
        step_width: Distribution = Distribution::normal(0.081, 0.025, 0.02, 0.16), in 0.0..=0.5, unit "m";
        /// How far a man's toes point outward; women's: 0.86 of it.
        ///
        /// Angle of the foot outward from the walking direction, degrees, of men; women's is 0.86 of it (Murray 1964,
        /// 1970: 7 and 6; Morton 1932: most feet 5 to 10).
        toe_out_deg: Distribution = Distribution::normal(7.0, 2.0, 0.0, 14.0), in -45.0..=45.0, unit "degrees";
    }
}

/// The side of the body on which a bag is carried.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
#[allow(missing_docs)]
pub enum CarrySide {
    Left,
    Right,
    Back,
}

/// A bag that a person carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Bag {
    /// The side on which it hangs or rolls.
    pub side: CarrySide,
    /// The kind of bag.
    pub kind: BagKind,
}

/// Kinds of bags, by the marks that they leave on walls.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum BagKind {
    /// Soft, in the hand or from the shoulder.
    Bag,
    /// Hard, in the hand.
    Case,
    /// On wheels, with a bar to pull it by.
    Trolley,
    /// A trolley, a pram or a wheelchair, pushed ahead.
    Pushed,
    /// On the back.
    Rucksack,
}

/// Share of cases among bags carried on a side.
const CASES: f64 = 0.25;

/// A person's body and gait: a pure function of (seed, id).
#[derive(Clone, Debug, PartialEq)]
pub struct Person {
    /// Number in the arrival list.
    pub id: u32,
    /// Body height, metres.
    pub stature_m: f64,
    /// Shoulder width, metres (ANSUR II: 0.291 of stature for men, 0.277 for women).
    pub shoulder_width_m: f64,
    /// Chest depth, metres (ANSUR II: 0.145 and 0.152 of stature).
    pub chest_depth_m: f64,
    /// Length of the shoe's sole, metres: bare foot (0.154 and 0.151 of stature) and 20 to 30 mm.
    pub sole_length_m: f64,
    /// Whether the person is a child.
    pub child: bool,
    /// The bag, if one is carried.
    pub bag: Option<Bag>,
    /// Individual step length, metres, if the scenario sets one.
    pub fixed_step_m: Option<f64>,
    /// Speed at which the person walks when nobody hinders, metres per second, if it is known.
    pub free_speed_m_s: Option<f64>,
    /// Personal factor on the step length, about 1: tall people take longer steps.
    pub step_factor: f64,
    /// Distance between the lines of the feet when walking freely, metres.
    pub step_width_m: f64,
    /// Mean angle of the foot outward from the walking direction, radians.
    pub toe_out_rad: f64,
    /// Whether the person runs on the ball of the foot rather than from the heel.
    pub runs_on_ball: bool,
    /// Uniform draw in `[0, 1)` that selects the shoe pattern by share.
    pub shoe_draw: f64,
}

/// Mean stature that the measured step lengths belong to, metres.
const REFERENCE_STATURE_M: f64 = 1.69;
/// Spread of step lengths among people of one stature.
const STEP_SPREAD: f64 = 0.05;
/// Women's step width and toe-out over men's (Murray 1964, 1970).
const WOMENS_WIDTH: f64 = 7.1 / 8.1;
const WOMENS_TOE_OUT: f64 = 6.0 / 7.0;
/// Share of runners who do not land on the heel (Hasegawa, Yamauchi, Kraemer 2007, J. Strength Cond. Res. 21(3)).
const RUN_ON_BALL: f64 = 0.25;

/// Below this speed people keep their step's duration and shorten the step, metres per second.
const SHUFFLING_M_S: f64 = 0.4;
/// Shortest step, metres.
const SHORTEST_STEP_M: f64 = 0.12;

/// Speed from which an individual step length is taken in full, metres per second.
///
/// It is the slowest free speed in the Grime paper.
pub const STRIDE_SPEED_M_S: f64 = 2.0;

impl Person {
    /// Step length at a speed, metres.
    ///
    /// From 0.4 m/s, `L = 0.247 + 0.344 v` times the personal factor, measured on congested and free flow in the Juelich
    /// recordings. Below, `L` is proportional to `v`, so that a step takes as long as at 0.4 m/s: in dense flow steps get
    /// shorter, not rarer (Jelic, Appert-Rolland, Lemercier, Pettre 2012, arXiv 1207.0832); at least 0.12 m. An individual
    /// step length is taken in full at the free speed and is proportional to the speed below: a person who is slowed keeps
    /// the cadence and takes more steps over the same distance, as the Grime paper says. Where the free speed is not known,
    /// it is taken in full from `STRIDE_SPEED_M_S`, and shrinks in proportion to the measured line.
    pub fn step_length_m(&self, speed_m_s: f64) -> f64 {
        let step_m = match self.fixed_step_m {
            Some(stride_m) => {
                let share = match self.free_speed_m_s {
                    Some(free_m_s) => speed_m_s / free_m_s,
                    None => measured_step_m(speed_m_s) / measured_step_m(STRIDE_SPEED_M_S),
                };
                stride_m * share.min(1.0)
            }
            None => measured_step_m(speed_m_s) * self.step_factor,
        };
        step_m.max(SHORTEST_STEP_M)
    }
}

/// Mean step length of a crowd at a speed, metres.
fn measured_step_m(speed_m_s: f64) -> f64 {
    let line_m = |speed_m_s: f64| 0.247 + 0.344 * speed_m_s.min(4.0);
    if speed_m_s >= SHUFFLING_M_S { line_m(speed_m_s) } else { line_m(SHUFFLING_M_S) * speed_m_s / SHUFFLING_M_S }
}

/// The people of a crowd, generated on demand from a seed.
#[derive(Clone, Debug)]
pub struct People {
    seed: u64,
    options: BodyOptions,
    speed: Option<Distribution>,
}

impl People {
    /// Makes people with these bodies from a seed.
    pub fn new(seed: u64, options: BodyOptions) -> People {
        People { seed, options, speed: None }
    }

    /// The same people, who are known to walk at these free speeds, metres per second: those that the crowd draws too.
    pub fn with_free_speed(self, speed: Distribution) -> People {
        People { speed: Some(speed), ..self }
    }

    /// The seed from which all personal traits are drawn.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// The person with an id; the same for every call.
    pub fn person(&self, id: u32) -> Person {
        self.person_of_stature(id, None)
    }

    /// The person with an id, whose body height is known, in metres; breadths, feet and steps follow it.
    pub fn person_of_stature(&self, id: u32, known_m: Option<f64>) -> Person {
        let rng = &mut person_stream(self.seed, id, Purpose::Traits);
        let options = &self.options;
        // Every trait is drawn for every person, used or not, so that one option never shifts the others.
        let child = rng.random::<f64>() < options.children;
        let man = rng.random::<f64>() < options.men;
        let statures = [&options.stature_men, &options.stature_women, &options.stature_children].map(|d| d.draw(rng));
        let bag = (rng.random::<f64>() < options.bags).then_some(());
        let side = match (rng.random::<f64>() * 10.0) as u32 {
            0..4 => CarrySide::Right,
            4..7 => CarrySide::Left,
            _ => CarrySide::Back,
        };
        let stature_m = known_m.unwrap_or(if child { statures[2] } else { statures[usize::from(!man)] });
        let (shoulder, depth, foot) = if man { (0.291, 0.145, 0.154) } else { (0.277, 0.152, 0.151) };
        let clearance_m = 0.02 + 0.01 * rng.random::<f64>();
        let spread = Distribution::normal(1.0, STEP_SPREAD, 0.85, 1.15).draw(rng);
        let fixed_step_m = options.step_length.as_ref().map(|d| d.draw(rng));
        let (width, toe_out) = if man { (1.0, 1.0) } else { (WOMENS_WIDTH, WOMENS_TOE_OUT) };
        let step_width_m = width * options.step_width.draw(rng);
        let toe_out_rad = toe_out * options.toe_out_deg.draw(rng).to_radians();
        let shoe_draw = rng.random();
        let runs_on_ball = rng.random::<f64>() < RUN_ON_BALL;
        let (carried, rolls) = (rng.random::<f64>(), rng.random::<f64>());
        let kind = match side {
            _ if !child && rolls < options.pull => BagKind::Trolley,
            _ if !child && rolls < options.pull + options.push => BagKind::Pushed,
            CarrySide::Back => BagKind::Rucksack,
            _ if carried < CASES => BagKind::Case,
            _ => BagKind::Bag,
        };
        // Nobody has wheels on the back.
        let on_wheels = matches!(kind, BagKind::Trolley | BagKind::Pushed);
        let side = if on_wheels && side == CarrySide::Back { CarrySide::Right } else { side };
        Person {
            id,
            stature_m,
            shoulder_width_m: shoulder * stature_m,
            chest_depth_m: depth * stature_m,
            sole_length_m: foot * stature_m + clearance_m,
            child,
            bag: bag.map(|()| Bag { side, kind }),
            fixed_step_m,
            // The first draw of the stream that the crowd draws a person's walk from.
            free_speed_m_s: self.speed.as_ref().map(|d| d.draw(&mut person_stream(self.seed, id, Purpose::Walk))),
            step_factor: stature_m / REFERENCE_STATURE_M * spread,
            step_width_m,
            toe_out_rad,
            runs_on_ball,
            shoe_draw,
        }
    }
}
