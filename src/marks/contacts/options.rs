use serde::{Deserialize, Serialize};

use crate::marks::MarksError;

/// What decides where people touch walls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ContactRule {
    /// What people do there: pass a door, turn round a corner, squeeze through, carry a bag along, stand and lean.
    #[default]
    Causes,
    /// Nothing but the distance from the wall, as in Takenaka, Tanaka, Sagawa, *Expression of indoor grime by human walk*:
    /// very close, arm, shoulder, shoe and belongings touch, a little farther hand and belongings only.
    Distance,
}

/// How often people touch walls, and how strongly.
///
/// Every rate is for one person: per metre walked, per passage, per turn, per second stood. Distances are those from the
/// side of the body to the wall. The defaults are judgement, so that 1000 people leave a plain wall almost clean and door
/// jambs, corners and fixtures at least ten times as touched.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ContactOptions {
    /// What decides where people touch walls.
    pub rule: ContactRule,
    /// For how many people touches are drawn, 1 to 1e9: touches are rare, so that those of a few hundred would not show
    /// where many more have touched. Whoever walks in a smaller crowd touches as often as up to 64 who go the same way;
    /// the look knows for how many the sums stand. 1: as many as walk.
    pub people: f64,
    /// How far hands and belongings reach, metres.
    pub reach_m: f64,
    /// How far away a wall may be that shoulder, arm and hip touch, metres.
    pub close_m: f64,
    /// Clear width below which those who walk brush walls with their shoulders, metres.
    pub narrow_m: f64,
    /// Hands on a plain wall, per metre walked within reach, more often the nearer it is: 0.01 per 10 m at the distances that
    /// people keep.
    pub hand_per_metre: f64,
    /// Elbow, upper arm and hip, per metre walked very close.
    pub arm_per_metre: f64,
    /// Shoulders, per metre walked very close where it is narrow.
    pub shoulder_per_metre: f64,
    /// Belongings, per metre walked within reach of those who carry some on the wall's side: by the shares of people, 0.005
    /// per 10 m of everybody.
    pub bag_per_metre: f64,
    /// Shoes, per metre walked within reach, mostly of those who walk very close: 0.002 per 10 m at the distances that people
    /// keep.
    pub shoe_per_metre: f64,
    /// Hands on a jamb, per passage of a doorway within reach of it.
    pub jamb_hand_per_passage: f64,
    /// Shoulders and arms on a jamb, per passage of a doorway narrower than `narrow_m`.
    pub jamb_shoulder_per_passage: f64,
    /// Belongings against a jamb, per passage of those who carry some on that side.
    pub jamb_bag_per_passage: f64,
    /// Shoes against a jamb, per passage.
    pub jamb_shoe_per_passage: f64,
    /// Hands on the corner that one turns round, per turn within reach of it.
    pub corner_per_turn: f64,
    /// Belongings against it, per turn of those who carry some on that side.
    pub corner_bag_per_turn: f64,
    /// Shoes against its foot, per turn.
    pub corner_shoe_per_turn: f64,
    /// Shoulder, back, hand, sole or belongings of somebody who stands very close, per second.
    pub lean_per_second: f64,
    /// What a fixture takes of somebody who passes within reach; factor on the kind's own shares.
    pub fixture_per_passage: f64,
    /// What it takes of somebody who stands within reach, per second; factor likewise.
    pub fixture_per_second: f64,
    /// Rule `distance`: touches per metre walked at no distance; falls to nothing at `close_m`.
    pub distance_close_per_metre: f64,
    /// Rule `distance`: the same of hand and belongings, to nothing at `reach_m`.
    pub distance_far_per_metre: f64,
    /// Median optical density of a hand's touch where its pattern covers fully.
    pub hand_density: f64,
    /// Of an arm's.
    pub arm_density: f64,
    /// Of a shoulder's.
    pub shoulder_density: f64,
    /// Of a bag's.
    pub bag_density: f64,
    /// Of a shoe's.
    pub shoe_density: f64,
    /// Spread of all: standard deviation of the natural logarithm.
    pub sigma: f64,
}

/// Nobody stands for more than so many people: their few ways would show.
const MOST_STAND_INS: f64 = 64.0;

impl Default for ContactOptions {
    fn default() -> ContactOptions {
        ContactOptions {
            rule: ContactRule::Causes,
            people: 20_000.0,
            reach_m: 0.7,
            close_m: 0.25,
            narrow_m: 1.2,
            hand_per_metre: 0.001_4,
            arm_per_metre: 0.002,
            shoulder_per_metre: 0.02,
            bag_per_metre: 0.003,
            shoe_per_metre: 0.000_6,
            jamb_hand_per_passage: 0.075,
            jamb_shoulder_per_passage: 0.015,
            jamb_bag_per_passage: 0.03,
            jamb_shoe_per_passage: 0.01,
            corner_per_turn: 0.045,
            corner_bag_per_turn: 0.02,
            corner_shoe_per_turn: 0.01,
            lean_per_second: 0.004,
            fixture_per_passage: 0.03,
            fixture_per_second: 0.006,
            distance_close_per_metre: 0.03,
            distance_far_per_metre: 0.004,
            hand_density: 0.05,
            arm_density: 0.035,
            shoulder_density: 0.035,
            bag_density: 0.06,
            shoe_density: 0.2,
            sigma: 0.9,
        }
    }
}

impl ContactOptions {
    /// Nobody ever touches a wall.
    pub fn none() -> ContactOptions {
        ContactOptions {
            hand_per_metre: 0.0,
            arm_per_metre: 0.0,
            shoulder_per_metre: 0.0,
            bag_per_metre: 0.0,
            shoe_per_metre: 0.0,
            jamb_hand_per_passage: 0.0,
            jamb_shoulder_per_passage: 0.0,
            jamb_bag_per_passage: 0.0,
            jamb_shoe_per_passage: 0.0,
            corner_per_turn: 0.0,
            corner_bag_per_turn: 0.0,
            corner_shoe_per_turn: 0.0,
            lean_per_second: 0.0,
            fixture_per_passage: 0.0,
            fixture_per_second: 0.0,
            distance_close_per_metre: 0.0,
            distance_far_per_metre: 0.0,
            people: 1.0,
            ..ContactOptions::default()
        }
    }

    /// The paper's rule: by distance alone.
    pub fn paper() -> ContactOptions {
        ContactOptions { rule: ContactRule::Distance, people: 1.0, ..ContactOptions::default() }
    }

    /// For how many people each of a crowd touches: 1 to [`MOST_STAND_INS`].
    pub(crate) fn stand_ins(&self, crowd: usize) -> f64 {
        (self.people / crowd.max(1) as f64).clamp(1.0, MOST_STAND_INS)
    }

    /// Whether nobody can touch anything.
    pub(crate) fn is_none(&self) -> bool {
        let Self { rule, .. } = self;
        let none = ContactOptions { rule: *rule, ..ContactOptions::none() };
        self.rates() == none.rates()
    }

    /// The rates that count under the rule.
    fn rates(&self) -> Vec<f64> {
        match self.rule {
            ContactRule::Distance => vec![self.distance_close_per_metre, self.distance_far_per_metre],
            ContactRule::Causes => vec![
                self.hand_per_metre,
                self.arm_per_metre,
                self.shoulder_per_metre,
                self.bag_per_metre,
                self.shoe_per_metre,
                self.jamb_hand_per_passage,
                self.jamb_shoulder_per_passage,
                self.jamb_bag_per_passage,
                self.jamb_shoe_per_passage,
                self.corner_per_turn,
                self.corner_bag_per_turn,
                self.corner_shoe_per_turn,
                self.lean_per_second,
                self.fixture_per_passage,
                self.fixture_per_second,
            ],
        }
    }

    /// Checks every value.
    ///
    /// # Errors
    /// The first value that is not finite or lies beyond its range, by its name in a scenario.
    pub fn check(&self) -> Result<(), MarksError> {
        for (key, value, low, high) in [
            ("contact.people", self.people, 1.0, 1e9),
            ("contact.reach_m", self.reach_m, 0.1, 1.0),
            ("contact.close_m", self.close_m, 0.0, 1.0),
            ("contact.narrow_m", self.narrow_m, 0.0, 3.0),
            ("contact.hand_per_metre", self.hand_per_metre, 0.0, 10.0),
            ("contact.arm_per_metre", self.arm_per_metre, 0.0, 10.0),
            ("contact.shoulder_per_metre", self.shoulder_per_metre, 0.0, 10.0),
            ("contact.bag_per_metre", self.bag_per_metre, 0.0, 10.0),
            ("contact.shoe_per_metre", self.shoe_per_metre, 0.0, 10.0),
            ("contact.jamb_hand_per_passage", self.jamb_hand_per_passage, 0.0, 10.0),
            ("contact.jamb_shoulder_per_passage", self.jamb_shoulder_per_passage, 0.0, 10.0),
            ("contact.jamb_bag_per_passage", self.jamb_bag_per_passage, 0.0, 10.0),
            ("contact.jamb_shoe_per_passage", self.jamb_shoe_per_passage, 0.0, 10.0),
            ("contact.corner_per_turn", self.corner_per_turn, 0.0, 10.0),
            ("contact.corner_bag_per_turn", self.corner_bag_per_turn, 0.0, 10.0),
            ("contact.corner_shoe_per_turn", self.corner_shoe_per_turn, 0.0, 10.0),
            ("contact.lean_per_second", self.lean_per_second, 0.0, 1.0),
            ("contact.fixture_per_passage", self.fixture_per_passage, 0.0, 10.0),
            ("contact.fixture_per_second", self.fixture_per_second, 0.0, 1.0),
            ("contact.distance_close_per_metre", self.distance_close_per_metre, 0.0, 10.0),
            ("contact.distance_far_per_metre", self.distance_far_per_metre, 0.0, 10.0),
            ("contact.hand_density", self.hand_density, 0.0, 3.0),
            ("contact.arm_density", self.arm_density, 0.0, 3.0),
            ("contact.shoulder_density", self.shoulder_density, 0.0, 3.0),
            ("contact.bag_density", self.bag_density, 0.0, 3.0),
            ("contact.shoe_density", self.shoe_density, 0.0, 3.0),
            ("contact.sigma", self.sigma, 0.0, 3.0),
        ] {
            if !(low..=high).contains(&value) {
                return Err(MarksError::OutOfRange { key, value, low, high });
            }
        }
        Ok(())
    }
}
