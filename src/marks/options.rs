//! Options of the marks.

use serde::{Deserialize, Serialize};

use crate::math::Distribution;

use super::{ContactOptions, MarksError};

/// Options of the marks: footprints, soil, heel marks and wall contacts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MarksOptions {
    /// Number of the last people whose shoes carry soil: those since the floor was mopped.
    pub fresh_people: u32,
    /// Name of the sole that all people wear; `None` draws soles by their share in the library.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shoe: Option<String>,
    /// Weight shifts of a standing person, each with a new footfall, per minute, 0 to 60.
    pub shifts_per_minute: f64,
    /// Soil on shoes.
    pub soil: SoilOptions,
    /// Heel marks.
    pub heel: HeelOptions,
    /// Wall contacts.
    pub contact: ContactOptions,
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

/// Options of soil on shoes.
///
/// With the defaults 300 fresh people through an entrance of 5 m leave 2 to 3 readable prints (D of 0.04 and more)
/// per m2 on the first 5 m, and 0.4 on the 20 m behind; 0.15 % of all footfalls of 1000 people.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SoilOptions {
    /// Weather, which decides how a trail fades.
    pub weather: Weather,
    /// Median optical density of a person's first print in dry weather, 0 to 3.
    pub median_density: f64,
    /// Standard deviation of the natural logarithm of people's first prints, 0 to 3.
    pub sigma: f64,
    /// Standard deviation of that logarithm between the two shoes of a person, 0 to 3.
    pub shoe_sigma: f64,
    /// Length of the mat inside an entrance, metres, 0 to 100. L metres of mat take `1 - exp(-L / 2 m)` of the load.
    pub mat_length_m: f64,
    /// Steps of a shoe since the soil, for people who come from outside.
    pub steps_before_entering: Distribution,
    /// Steps of a shoe since the soil, for people who start indoors.
    pub steps_before_indoors: Distribution,
}

/// Options of heel marks: the rubber of dragged heels and toes.
///
/// Rates are for [`HeelOptions::people`] and scaled so that another number of simulated people leaves as many marks in
/// all. In a corridor 4 to 5 m wide 1000 people walk 200 to 250 m on each m2, where `per_metre` gives 0.4 to 0.5 marks.
/// The other rates make turns, doors and stops about five times as marked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct HeelOptions {
    /// Marks per metre walked.
    pub per_metre: f64,
    /// Marks per radian turned while walking; turns on the spot count 0.15 of it.
    pub per_radian: f64,
    /// Marks per stop, and per start.
    pub per_stop: f64,
    /// Marks per second stood.
    pub per_second_stood: f64,
    /// Marks per passage of a door or another place narrower than `narrow_m`.
    pub per_passage: f64,
    /// Clear width below which a place counts as a passage, metres.
    pub narrow_m: f64,
    /// Median optical density of a mark.
    pub median_density: f64,
    /// Standard deviation of the natural logarithm of the density.
    pub sigma: f64,
    /// Number of people for which the rates hold; smaller crowds get up to ten times the rates.
    pub people: f64,
}

impl Default for MarksOptions {
    fn default() -> MarksOptions {
        MarksOptions {
            fresh_people: 300,
            shoe: None,
            shifts_per_minute: 2.5,
            soil: SoilOptions::default(),
            heel: HeelOptions::default(),
            contact: ContactOptions::default(),
        }
    }
}

impl Default for SoilOptions {
    fn default() -> SoilOptions {
        SoilOptions {
            weather: Weather::Dry,
            median_density: 0.01,
            sigma: 1.4,
            shoe_sigma: 0.3,
            mat_length_m: 1.25,
            steps_before_entering: Distribution::Uniform([0.5, 3.5]),
            steps_before_indoors: Distribution::Uniform([20.0, 80.0]),
        }
    }
}

impl Default for HeelOptions {
    fn default() -> HeelOptions {
        HeelOptions {
            per_metre: 0.0022,
            per_radian: 0.012,
            per_stop: 0.003,
            per_second_stood: 0.000_05,
            per_passage: 0.006,
            narrow_m: 1.6,
            median_density: 0.25,
            sigma: 0.8,
            people: 1000.0,
        }
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
        let (soil, heel) = (&self.soil, &self.heel);
        for (key, value, low, high) in [
            ("shifts_per_minute", self.shifts_per_minute, 0.0, 60.0),
            ("soil.median_density", soil.median_density, 0.0, 3.0),
            ("soil.sigma", soil.sigma, 0.0, 3.0),
            ("soil.shoe_sigma", soil.shoe_sigma, 0.0, 3.0),
            ("soil.mat_length_m", soil.mat_length_m, 0.0, 100.0),
            ("heel.per_metre", heel.per_metre, 0.0, 1.0),
            ("heel.per_radian", heel.per_radian, 0.0, 1.0),
            ("heel.per_stop", heel.per_stop, 0.0, 10.0),
            ("heel.per_second_stood", heel.per_second_stood, 0.0, 1.0),
            ("heel.per_passage", heel.per_passage, 0.0, 10.0),
            ("heel.narrow_m", heel.narrow_m, 0.0, 5.0),
            ("heel.median_density", heel.median_density, 0.0, 3.0),
            ("heel.sigma", heel.sigma, 0.0, 3.0),
            ("heel.people", heel.people, 1.0, 1e9),
        ] {
            if !(low..=high).contains(&value) {
                return Err(MarksError::OutOfRange { key, value, low, high });
            }
        }
        for (key, distribution) in [
            ("soil.steps_before_entering", &soil.steps_before_entering),
            ("soil.steps_before_indoors", &soil.steps_before_indoors),
        ] {
            distribution.check(0.0, 1e6).map_err(|problem| MarksError::Distribution { key, problem })?;
        }
        self.contact.check()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_are_in_range_and_survive_toml() {
        let options = MarksOptions::default();
        options.check().unwrap();
        let text = toml::to_string(&options).unwrap();
        assert_eq!(toml::from_str::<MarksOptions>(&text).unwrap(), options);
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
        assert!(toml::from_str::<MarksOptions>("fresh = 3").is_err());
    }
}
