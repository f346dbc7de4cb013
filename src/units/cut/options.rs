use serde::{Deserialize, Serialize};

use super::walks::FPS;
use crate::units::{Areas, LONGEST_S, UnitsError};

/// Options of [`cut`](super::cut).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CutOptions {
    /// The areas in which people are matched and units are played.
    pub areas: Areas,
    /// Least duration of a unit, seconds, 1 to 60.
    pub least_s: f64,
    /// Largest duration of a unit, seconds, 1 to 120.
    pub most_s: f64,
    /// Distance at which another person who comes near a member ends the unit, metres, 0 to 10.
    pub apart_m: f64,
    /// Largest number of units, those of most interest.
    pub most: usize,
    /// Samples per second of a unit, 1 to 10.
    pub fps: f64,
}

impl Default for CutOptions {
    fn default() -> CutOptions {
        CutOptions { areas: Areas::default(), least_s: 3.0, most_s: 12.0, apart_m: 0.7, most: 8, fps: 5.0 }
    }
}

impl CutOptions {
    /// Checks every value.
    ///
    /// # Errors
    /// The first value that is not a number or out of its range.
    pub fn check(&self) -> Result<(), UnitsError> {
        let numbers = [
            ("the shortest time", self.least_s, 1.0, 60.0),
            ("the longest time", self.most_s, self.least_s, LONGEST_S),
            ("the distance to others", self.apart_m, 0.0, 10.0),
            ("the number of units", self.most as f64, 1.0, 1000.0),
            ("samples per second", self.fps, 1.0, FPS),
        ];
        match numbers.into_iter().find(|&(_, value, low, high)| !(value >= low && value <= high)) {
            Some((name, value, low, high)) => Err(UnitsError::Number { name, value, low, high }),
            None => Ok(()),
        }
    }
}
