//! Options of the stamps.

use serde::{Deserialize, Serialize};

use super::StampsError;

/// Options of stamping: variation of prints and stains, width of the presence kernel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct StampOptions {
    /// Share of soil prints that show only the heel, only the ball or fade to one side, 0 to 1.
    pub partial: f64,
    /// Standard deviation of the pressure slope over a sole or stain, share of the mean, 0 to 0.4.
    ///
    /// Soles have one slope from heel to toe and one from edge to edge.
    pub pressure: f64,
    /// Range of the standard deviation of a soil print's or wall stain's blur, metres, 0 to 0.02.
    ///
    /// Skin and cloth blur 2.5 times as much. The texel filter is added.
    pub blur_m: [f64; 2],
    /// Standard deviation of the noise in a soil print, as a share of its density, 0 to 0.6.
    ///
    /// Wall stains have blotches of 1.2 times and grain of 0.8 times this value.
    pub noise: f64,
    /// Standard deviation of the presence kernel across the heading, metres, 0.01 to 1.
    pub presence_across_m: f64,
    /// Standard deviation of the presence kernel along the heading, metres, 0.01 to 1.
    pub presence_along_m: f64,
}

impl Default for StampOptions {
    fn default() -> StampOptions {
        StampOptions {
            partial: 0.4,
            pressure: 0.2,
            blur_m: [0.0005, 0.0025],
            noise: 0.35,
            presence_across_m: 0.08,
            presence_along_m: 0.25,
        }
    }
}

impl StampOptions {
    /// Checks that every value is in its range.
    ///
    /// # Errors
    /// Names the first value out of its range.
    pub fn check(&self) -> Result<(), StampsError> {
        let ranges = [
            ("partial", self.partial, 0.0, 1.0),
            ("pressure", self.pressure, 0.0, 0.4),
            ("blur_m[0]", self.blur_m[0], 0.0, 0.02),
            ("blur_m[1]", self.blur_m[1], self.blur_m[0], 0.02),
            ("noise", self.noise, 0.0, 0.6),
            ("presence_across_m", self.presence_across_m, 0.01, 1.0),
            ("presence_along_m", self.presence_along_m, 0.01, 1.0),
        ];
        for (name, value, low, high) in ranges {
            // NaN must be out of range.
            if !(value >= low && value <= high) {
                return Err(StampsError::OutOfRange { name, value, low, high });
            }
        }
        Ok(())
    }
}
