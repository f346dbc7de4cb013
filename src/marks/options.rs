//! Options of the marks.

use serde::{Deserialize, Serialize};

use crate::math::Distribution;
use crate::options::{Options, names, options};

use super::{ContactOptions, MarksError};

options! {
    /// Options of the marks: footprints, soil, heel marks and wall contacts.
    pub struct MarksOptions {
        /// How many of the last people leave readable prints: those since the floor was mopped.
        fresh_people: u32 = 300;
        /// The one sole that everybody wears; left out: by share.
        shoe: Option<String> = None, eg "\"leather_shoe\"";
        /// How often somebody who stands sets a foot anew.
        shifts_per_minute: f64 = 2.5, in 0.0..=60.0;
        /// Soil on shoes.
        soil: SoilOptions = SoilOptions::default();
        /// Heel marks.
        heel: HeelOptions = HeelOptions::default();
        /// Wall contacts.
        contact: ContactOptions = ContactOptions::default();
    }
}

/// Weather outside, which decides how a soil trail fades.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Weather {
    /// Dust: the n-th step of a shoe leaves `2.68 / (n + 2.68)` of the first (half at 3, a tenth at 24).
    ///
    /// Source: NIJ, *Rates of loss and replacement of very small particles on the contact surfaces of footwear*.
    #[default]
    Dry,
    /// Water and mud: `exp(-b n)` with b from 0.7 to 1.4, gone in four to six prints of a shoe; three times the load.
    ///
    /// Source: Fei Li, study of sole-to-PVC transfer by fluorescence.
    Wet,
}

names!(Weather);

options! {
    /// Options of soil on shoes.
    ///
    /// With the defaults 300 fresh people through an entrance of 5 m leave 2 to 3 readable prints (D of 0.04 and more)
    /// per m2 on the first 5 m, and 0.4 on the 20 m behind; 0.15 % of all footfalls of 1000 people.
    pub struct SoilOptions {
        /// Outside: "dry" or "wet".
        weather: Weather = Weather::Dry;
        /// Optical density of a first print.
        median_density: f64 = 0.01, in 0.0..=3.0;
        /// How widely people's loads differ: deviation of the logarithm.
        sigma: f64 = 1.4, in 0.0..=3.0;
        /// The same between the two shoes of a person.
        shoe_sigma: f64 = 0.3, in 0.0..=3.0;
        /// Length of the mat inside an entrance.
        ///
        /// L metres of mat take `1 - exp(-L / 2 m)` of the load.
        mat_length_m: f64 = 1.25, in 0.0..=100.0, unit "m";
        /// Steps of a shoe since the soil, for who comes in.
        steps_before_entering: Distribution = Distribution::Uniform([0.5, 3.5]), in 0.0..=1e6;
        /// The same for who starts inside.
        steps_before_indoors: Distribution = Distribution::Uniform([20.0, 80.0]), in 0.0..=1e6;
    }
}

options! {
    /// Options of heel marks: the rubber of dragged heels and toes.
    ///
    /// Rates are for [`HeelOptions::people`] and scaled so that another number of simulated people leaves as many marks in
    /// all. In a corridor 4 to 5 m wide 1000 people walk 200 to 250 m on each m2, where `per_metre` gives 0.4 to 0.5 marks.
    /// The other rates make turns, doors and stops about five times as marked.
    pub struct HeelOptions {
        /// Heel marks per metre walked.
        per_metre: f64 = 0.0022, in 0.0..=1.0;
        /// Per radian turned at a walk.
        ///
        /// Turns on the spot count 0.15 of it.
        per_radian: f64 = 0.012, in 0.0..=1.0;
        /// Per stop, and per start.
        per_stop: f64 = 0.003, in 0.0..=10.0;
        /// Per second stood.
        per_second_stood: f64 = 0.000_05, in 0.0..=1.0;
        /// Per passage of a door or another narrow place.
        per_passage: f64 = 0.006, in 0.0..=10.0;
        /// Drags of the chair each time that somebody sits down or gets up.
        per_sitting: f64 = 0.12, in 0.0..=10.0;
        /// What counts as narrow.
        narrow_m: f64 = 1.6, in 0.0..=5.0, unit "m";
        /// Optical density of a mark.
        median_density: f64 = 0.25, in 0.0..=3.0;
        /// Deviation of its logarithm.
        sigma: f64 = 0.8, in 0.0..=3.0;
        /// The number of people for which the rates hold; fewer leave more each.
        ///
        /// Smaller crowds get up to ten times the rates.
        people: f64 = 1000.0, in 1.0..=1e9;
    }
}

impl HeelOptions {
    /// Options with all rates zero.
    pub fn none() -> HeelOptions {
        HeelOptions {
            per_metre: 0.0,
            per_radian: 0.0,
            per_stop: 0.0,
            per_second_stood: 0.0,
            per_passage: 0.0,
            per_sitting: 0.0,
            ..HeelOptions::default()
        }
    }
}

impl MarksOptions {
    /// Checks every value.
    ///
    /// # Errors
    /// The first value out of its range, by its key in a scenario.
    pub fn check(&self) -> Result<(), MarksError> {
        self.check_ranges().map_err(|error| MarksError::Option(error.within("marks")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::parse;

    #[test]
    fn the_defaults_are_in_range_and_survive_toml() {
        let options = MarksOptions::default();
        options.check().unwrap();
        let text = toml::to_string(&options.table()).unwrap();
        assert_eq!(parse::<MarksOptions>(&text).ok(), Some(options));
    }

    #[test]
    fn what_is_out_of_range_is_named() {
        let with = |change: fn(&mut MarksOptions)| {
            let mut options = MarksOptions::default();
            change(&mut options);
            options.check().unwrap_err().to_string()
        };
        assert_eq!(with(|o| o.heel.per_metre = -1.0), "marks.heel.per_metre is -1, allowed is 0 to 1");
        assert_eq!(with(|o| o.soil.sigma = f64::NAN), "marks.soil.sigma is NaN, allowed is 0 to 3");
        let reversed = with(|o| o.soil.steps_before_indoors = Distribution::Uniform([5.0, 1.0]));
        assert!(reversed.starts_with("marks.soil.steps_before_indoors: the range runs from 5 down to 1"), "{reversed}");
        assert!(parse::<MarksOptions>("fresh = 3").is_err());
    }
}
