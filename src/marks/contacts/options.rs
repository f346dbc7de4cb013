//! Options of wall contacts.

use serde::{Deserialize, Serialize};

use crate::marks::MarksError;

/// Rule that decides where people touch walls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ContactRule {
    /// Activities: passing a door, turning round a corner, squeezing through, carrying luggage, leaning.
    #[default]
    Causes,
    /// Distance from the wall alone: very close arm, shoulder, shoe and luggage touch; farther away hand and luggage.
    ///
    /// Source: Takenaka, Tanaka, Sagawa, *Expression of indoor grime by human walk*.
    Distance,
}

/// Options of wall contacts: rates, reaches and optical densities.
///
/// Rates are for one person: per metre walked, per passage, per turn, per second stood. Distances are from the side of
/// the body to the wall. The defaults are estimates: 1000 people leave a plain wall almost clean, and touch door jambs,
/// corners and fixtures at least ten times as often.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ContactOptions {
    /// Rule that decides where people touch walls.
    pub rule: ContactRule,
    /// Number of people whose contacts the walls show, 1 to 1e9; 1 means the simulated crowd.
    ///
    /// In a crowd of fewer than `people`, each person's contact rate is scaled up, at most 64 times. The look accounts
    /// for the number of people that the sums stand for.
    pub people: f64,
    /// Reach of hands and luggage, metres.
    pub reach_m: f64,
    /// Reach of shoulder, arm and hip, metres.
    pub close_m: f64,
    /// Clear width below which walking people brush walls with their shoulders, metres.
    pub narrow_m: f64,
    /// Hands on a plain wall, per metre walked within reach, more often the nearer: 0.01 per 10 m at usual distances.
    pub hand_per_metre: f64,
    /// Elbow, upper arm and hip, per metre walked very close.
    pub arm_per_metre: f64,
    /// Shoulders, per metre walked very close in narrow places.
    pub shoulder_per_metre: f64,
    /// Luggage on the wall's side, per metre walked within reach by its carriers: 0.005 per 10 m over all people.
    pub bag_per_metre: f64,
    /// Shoes, per metre walked within reach, mostly very close: 0.002 per 10 m at usual distances.
    pub shoe_per_metre: f64,
    /// Hands on a jamb, per passage of a doorway within reach of it.
    pub jamb_hand_per_passage: f64,
    /// Shoulders and arms on a jamb, per passage of a doorway narrower than `narrow_m`.
    pub jamb_shoulder_per_passage: f64,
    /// Luggage against a jamb, per passage of people who carry it on that side.
    pub jamb_bag_per_passage: f64,
    /// Shoes against a jamb, per passage.
    pub jamb_shoe_per_passage: f64,
    /// Hands on a convex corner, per turn round it within reach.
    pub corner_per_turn: f64,
    /// Luggage against the corner, per turn of people who carry it on that side.
    pub corner_bag_per_turn: f64,
    /// Shoes against the foot of the corner, per turn.
    pub corner_shoe_per_turn: f64,
    /// Shoulder, back, hand, sole or luggage of a person who stands very close, per second.
    pub lean_per_second: f64,
    /// Contacts with a fixture per passage within reach; factor on the rate of its kind.
    pub fixture_per_passage: f64,
    /// Contacts with a fixture per second stood within reach; factor on the rate of its kind.
    pub fixture_per_second: f64,
    /// Rule `distance`: contacts per metre walked at distance 0; falls to zero at `close_m`.
    pub distance_close_per_metre: f64,
    /// Rule `distance`: contacts of hand and luggage per metre walked at distance 0; falls to zero at `reach_m`.
    pub distance_far_per_metre: f64,
    /// Median optical density of a hand's contact at full coverage, 0 to 3.
    pub hand_density: f64,
    /// Median optical density of an arm's contact.
    pub arm_density: f64,
    /// Median optical density of a shoulder's contact.
    pub shoulder_density: f64,
    /// Median optical density of a bag's contact.
    pub bag_density: f64,
    /// Median optical density of a shoe's contact.
    pub shoe_density: f64,
    /// Standard deviation of the natural logarithm of these densities.
    pub sigma: f64,
}

/// Limit on the factor of contact rates: beyond it the few simulated paths would show.
const MOST_RATE_FACTOR: f64 = 64.0;

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
    /// Options with all rates zero.
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

    /// Options of the rule by distance alone.
    pub fn paper() -> ContactOptions {
        ContactOptions { rule: ContactRule::Distance, people: 1.0, ..ContactOptions::default() }
    }

    /// Factor on contact rates in a crowd of this size, 1 to [`MOST_RATE_FACTOR`].
    pub(crate) fn rate_factor(&self, crowd: usize) -> f64 {
        (self.people / crowd.max(1) as f64).clamp(1.0, MOST_RATE_FACTOR)
    }

    /// Whether all rates are zero.
    pub(crate) fn is_none(&self) -> bool {
        let Self { rule, .. } = self;
        let none = ContactOptions { rule: *rule, ..ContactOptions::none() };
        self.rates() == none.rates()
    }

    /// The rates that apply under the rule.
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
    /// The first value out of its range, by its key in a scenario.
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
