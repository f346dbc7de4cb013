//! Options of the stamps.

use super::StampsError;
use crate::options::{OptionError, Options, options};

options! {
    /// Variation of prints and stains, and the width of the presence kernel.
    pub struct StampOptions {
        /// Share of prints that show only the heel, only the ball, or fade to one side.
        partial: f64 = 0.4, in 0.0..=1.0;
        /// How unevenly a sole presses.
        ///
        /// Standard deviation of the pressure slope over a sole or a stain, as a share of the mean pressure.
        ///
        /// Soles have a slope from heel to toe and one from edge to edge.
        pressure: f64 = 0.2, in 0.0..=0.4;
        /// Least and largest blur of a print.
        ///
        /// Range of the blur of a soil print or a wall stain (standard deviation).
        ///
        /// Skin and cloth blur 2.5 times as much. The texel filter is added.
        blur_m: [f64; 2] = [0.0005, 0.0025], in 0.0..=0.02, unit "m";
        /// Blotches and grain in a print.
        ///
        /// Standard deviation of the noise in a soil print, as a share of its density.
        ///
        /// Wall stains have blotches of 1.2 times and grain of 0.8 times this.
        noise: f64 = 0.35, in 0.0..=0.6;
        /// Width of the soft trace that a footfall adds to the lane.
        presence_across_m: f64 = 0.08, in 0.01..=1.0, unit "m";
        /// Its length.
        presence_along_m: f64 = 0.25, in 0.01..=1.0, unit "m";
    }
}

impl StampOptions {
    /// Checks that every value is in its range.
    ///
    /// # Errors
    /// Names the first value out of its range.
    pub fn check(&self) -> Result<(), StampsError> {
        let check = || {
            self.check_ranges()?;
            match self.blur_m {
                [least, most] if least > most => {
                    Err(OptionError::unfit("blur_m", format!("`blur_m` runs from {least} down to {most}")))
                }
                _ => Ok(()),
            }
        };
        check().map_err(|error| StampsError::Option(error.within("stamps")))
    }
}
