//! Options of wall contacts.

use serde::{Deserialize, Serialize};

use crate::options::{names, options};

names!(ContactRule);

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

options! {
    /// Options of wall contacts: rates, reaches and optical densities.
    ///
    /// Rates are for one person: per metre walked, per passage, per turn, per second stood. Distances are from the side of
    /// the body to the wall. The defaults are estimates: 1000 people leave a plain wall almost clean, and touch door jambs,
    /// corners and fixtures at least ten times as often.
    pub struct ContactOptions {
        /// What decides where walls are touched: "causes", or "distance" alone as in the paper.
        rule: ContactRule = ContactRule::Causes;
        /// For how many people touches are drawn: who walks stands for up to 64; 1: for those who walk.
        ///
        /// In a crowd of fewer than `people`, each person's contact rate is scaled up, at most 64 times. The look
        /// accounts for the number of people that the sums stand for.
        people: f64 = 60_000.0, in 1.0..=1e9;
        /// How far hands and belongings reach from the body's side.
        reach_m: f64 = 0.7, in 0.1..=1.0, unit "m";
        /// How near shoulders, arms and hips come to touch.
        close_m: f64 = 0.25, in 0.0..=1.0, unit "m";
        /// Clear width below which shoulders brush walls.
        narrow_m: f64 = 1.2, in 0.0..=3.0, unit "m";
        /// Hands on a plain wall, per metre walked within reach.
        ///
        /// More often the nearer: 0.01 per 10 m at usual distances.
        hand_per_metre: f64 = 0.001_4, in 0.0..=10.0;
        /// Elbows, arms and hips, per metre walked very close.
        arm_per_metre: f64 = 0.002, in 0.0..=10.0;
        /// Shoulders, per metre walked very close where it is narrow.
        shoulder_per_metre: f64 = 0.02, in 0.0..=10.0;
        /// Belongings, per metre within reach with some on the wall's side.
        ///
        /// Over all people 0.005 per 10 m.
        bag_per_metre: f64 = 0.003, in 0.0..=10.0;
        /// Shoes, per metre walked within reach.
        ///
        /// Mostly very close: 0.002 per 10 m at usual distances.
        shoe_per_metre: f64 = 0.000_6, in 0.0..=10.0;
        /// Hands on a door's jamb, per passage.
        jamb_hand_per_passage: f64 = 0.075, in 0.0..=10.0;
        /// Shoulders and arms on it, where the door is narrow.
        jamb_shoulder_per_passage: f64 = 0.015, in 0.0..=10.0;
        /// Belongings against it, with some on that side.
        jamb_bag_per_passage: f64 = 0.03, in 0.0..=10.0;
        /// Shoes against it.
        jamb_shoe_per_passage: f64 = 0.015, in 0.0..=10.0;
        /// Hands on the corner that one turns round, per turn.
        corner_per_turn: f64 = 0.045, in 0.0..=10.0;
        /// Belongings against it, with some on that side.
        corner_bag_per_turn: f64 = 0.02, in 0.0..=10.0;
        /// Shoes against it.
        corner_shoe_per_turn: f64 = 0.01, in 0.0..=10.0;
        /// Whatever who stands very close leans on a wall, per second.
        lean_per_second: f64 = 0.004, in 0.0..=1.0;
        /// Touches of a fixture, per passage within reach.
        fixture_per_passage: f64 = 0.03, in 0.0..=10.0;
        /// Touches of it, per second stood within reach.
        fixture_per_second: f64 = 0.006, in 0.0..=1.0;
        /// Rule "distance": touches at the wall, per metre; none from close_m on.
        distance_close_per_metre: f64 = 0.03, in 0.0..=10.0;
        /// The same of hand and belongings; none from reach_m on.
        distance_far_per_metre: f64 = 0.004, in 0.0..=10.0;
        /// Median optical density of a hand's touch.
        hand_density: f64 = 0.05, in 0.0..=3.0;
        /// Of an arm's.
        arm_density: f64 = 0.035, in 0.0..=3.0;
        /// Of a shoulder's.
        shoulder_density: f64 = 0.035, in 0.0..=3.0;
        /// Of a bag's.
        bag_density: f64 = 0.06, in 0.0..=3.0;
        /// Of a shoe's.
        shoe_density: f64 = 0.2, in 0.0..=3.0;
        /// What stays random in them: deviation of the logarithm.
        ///
        /// The rest follows from the contact: beside a wall, a part leaves 1.7 times the median where it is as near as can be,
        /// the median two thirds of the way out, and almost nothing where it just reaches the wall.
        sigma: f64 = 0.6, in 0.0..=3.0;
    }
}

/// Limit on the factor of contact rates: beyond it the few simulated paths would show.
const MOST_RATE_FACTOR: f64 = 64.0;

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
}
