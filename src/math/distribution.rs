//! Distributions of quantities that differ from person to person.

use rand::RngExt;
use rand_distr::StandardNormal;
use serde::{Deserialize, Serialize};

use super::round_to_grid;
use crate::options::{Field, Kind, Leaf, Limits, OptionError, Table, Value};

/// Distribution of a quantity that differs from person to person.
///
/// In a scenario: a number (`0.3`), a range drawn from evenly (`[0.28, 0.36]`), or a normal distribution
/// (`{ mean = 1.34, sd = 0.26 }`), which `min` and `max` may cut off.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Distribution {
    /// The same for everybody.
    Constant(f64),
    /// Evenly between the two.
    Uniform([f64; 2]),
    /// Normal, clamped to `min` and `max`: without rejection every person uses the same number of draws.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation.
        sd: f64,
        /// Least value; three deviations below the mean if left out.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        min: Option<f64>,
        /// Largest value; three deviations above the mean if left out.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        max: Option<f64>,
    },
}

impl Distribution {
    const NORMAL: Table = Table {
        name: "Normal",
        parts: &[&[
            Field::plain("mean", f64::kind, true),
            Field::plain("sd", f64::kind, true),
            Field::plain("min", f64::kind, false),
            Field::plain("max", f64::kind, false),
        ]],
    };
}

impl Leaf for Distribution {
    fn takes() -> Kind {
        let words = "a number, a range [low, high], or { mean = .., sd = .. }";
        Kind::AnyOf(words, vec![Kind::Number, <[f64; 2]>::kind(), Kind::Table(Distribution::NORMAL)])
    }

    fn check_numbers(&self, limits: Limits) -> Result<(), OptionError> {
        self.check(limits.low, limits.high)
            .map_err(|problem| OptionError::Spread { key: String::new(), problem: problem.to_string() })
    }
}

/// Error in a distribution.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DistributionError {
    /// A mean, a deviation or an end that is NaN or infinite.
    #[error("it is {value}, allowed is {low} to {high}")]
    NotFinite {
        /// The number.
        value: f64,
        /// Least value allowed.
        low: f64,
        /// Largest value allowed.
        high: f64,
    },
    /// The ends of a range in the wrong order.
    #[error("the range runs from {start} down to {end}")]
    Reversed {
        /// Start of the range.
        start: f64,
        /// End of the range.
        end: f64,
    },
    /// The standard deviation is negative.
    #[error("the standard deviation {deviation} is negative")]
    NegativeDeviation {
        /// The standard deviation.
        deviation: f64,
    },
    /// The range of values exceeds what the quantity allows.
    #[error("it can be as {side} as {value}, allowed is {low} to {high}")]
    OutOfRange {
        /// "small" or "large".
        side: &'static str,
        /// The extreme that can be drawn.
        value: f64,
        /// Least value allowed.
        low: f64,
        /// Largest value allowed.
        high: f64,
    },
}

impl Distribution {
    /// A normal distribution, clamped to `min` and `max`.
    pub const fn normal(mean: f64, sd: f64, min: f64, max: f64) -> Distribution {
        Distribution::Normal { mean, sd, min: Some(min), max: Some(max) }
    }

    /// Draws a value, rounded to 1e-4 of its unit; always uses the same number of draws.
    pub fn draw(&self, rng: &mut impl rand::Rng) -> f64 {
        match *self {
            Distribution::Constant(value) => value,
            Distribution::Uniform([low, high]) => {
                round_to_grid(low + (high - low) * rng.random::<f64>()).clamp(low, high)
            }
            Distribution::Normal { mean, sd, .. } => {
                let z: f64 = rng.sample(StandardNormal);
                let [low, high] = self.bounds();
                round_to_grid(mean + sd * z).clamp(low, high)
            }
        }
    }

    /// Least and largest value that can be drawn.
    pub fn bounds(&self) -> [f64; 2] {
        match *self {
            Distribution::Constant(value) => [value, value],
            Distribution::Uniform(range) => range,
            Distribution::Normal { mean, sd, min, max } => {
                [min.unwrap_or(mean - 3.0 * sd), max.unwrap_or(mean + 3.0 * sd)]
            }
        }
    }

    /// Mean before clamping.
    pub fn mean(&self) -> f64 {
        match *self {
            Distribution::Constant(value) => value,
            Distribution::Uniform([low, high]) => (low + high) / 2.0,
            Distribution::Normal { mean, .. } => mean,
        }
    }

    /// Checks that every value lies in `low..=high`.
    ///
    /// # Errors
    /// A number is not finite; ends are in the wrong order; the deviation is negative; values are out of range.
    pub fn check(&self, low: f64, high: f64) -> Result<(), DistributionError> {
        if let Distribution::Normal { mean, sd, .. } = *self {
            if let Some(value) = [mean, sd].into_iter().find(|number| !number.is_finite()) {
                return Err(DistributionError::NotFinite { value, low, high });
            }
            if sd < 0.0 {
                return Err(DistributionError::NegativeDeviation { deviation: sd });
            }
        }
        let [least, most] = self.bounds();
        if let Some(value) = [least, most].into_iter().find(|number| number.is_nan()) {
            return Err(DistributionError::NotFinite { value, low, high });
        }
        if least > most {
            return Err(DistributionError::Reversed { start: least, end: most });
        }
        if least < low {
            return Err(DistributionError::OutOfRange { side: "small", value: least, low, high });
        }
        if most > high {
            return Err(DistributionError::OutOfRange { side: "large", value: most, low, high });
        }
        Ok(())
    }
}
