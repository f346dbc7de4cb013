//! Measures a photograph of a real floor, and finds the look that reproduces what was measured.
//!
//! 1. `photo` straightens the floor to a known texel density and takes out the slope of the light;
//! 2. `measure` finds the lane and the quiet margin, and measures colours, unevenness, marks and the line at a wall;
//! 3. `ours` resolves the same floor, with as many people over each spot as the photograph shows, with a look;
//! 4. here the look is changed until the same measures of our floor are those of the photograph.

mod measure;
mod options;
mod ours;
mod photo;
mod report;
mod search;

use std::path::Path;

use super::error::LookError;
use super::settings::Look;
use crate::math::srgb::{self, luminance};
use crate::math::{exp, ln};
use crate::patterns::PixelRaster;
use measure::{Measured, Parts, marks_per_m2};
pub use options::FitOptions;
use ours::OurFloor;
use photo::Straightened;
pub use report::{FitMeasure, FittedLook};
use search::Search;

/// Least difference between lane and margin, of 255.
const LEAST_CONTRAST: f64 = 2.0;

impl FittedLook {
    /// Measures a photograph and fits a look.
    ///
    /// # Errors
    /// [`LookError::Photo`] and [`LookError::Fit`]: the photograph cannot be read, is too small or black; the corners are
    /// not those of a rectangle; there is no lane. Settings of the look out of range.
    pub fn of_photo(path: &Path, options: &FitOptions) -> Result<FittedLook, LookError> {
        let refused = |message: String, hint: &'static str| LookError::Fit { path: path.to_path_buf(), message, hint };
        let Straightened { mut floor, clean, pixels_per_texel } = photo::read(path, options)?;
        let mut look = options.start.clone();
        look.floor.material = options.material;
        look.floor.image = None;
        let soil = luminance(srgb::light_of(look.film.colour).map(f64::from));
        let all = vec![true; floor.rgb[0].values.len()];
        let brightness = luminance(measure::colour(&floor, clean.as_ref().unwrap_or(&all)));
        let is_darker = brightness > soil;
        floor.without_slope(photo::slope_of_light(&floor, is_darker, clean.as_deref()));
        let parts = Parts::find(&floor, soil, is_darker, options.walls, clean.as_deref());
        let is_none = |mask: &[bool]| mask.iter().filter(|&&is| is).count() < 100;
        if parts.contrast < LEAST_CONTRAST || is_none(&parts.lane) || is_none(&parts.margin) {
            let message =
                format!("there is no lane: trodden floor differs from quiet floor by {:.1} of 255", parts.contrast);
            return Err(refused(message, "choose a rectangle that reaches from the lane to floor where few walk"));
        }
        let target = (Measured::of(&floor, &parts), marks_per_m2(&floor, &parts));
        let clean = clean.map(|mask| measure::colour(&floor, &mask));
        let passes = passes(&parts.share, &look, options.passes);
        let ours = OurFloor::new(&passes, floor.texels_per_metre, options.walls, pixels_per_texel);
        let mut search = Search::new(look, target, clean, &ours, &parts);
        search.run()?;
        report::report(search, options, &floor)
    }
}

/// People over each texel, so that the film has the density that the photograph shows where `passes` have walked.
fn passes(share: &PixelRaster, look: &Look, passes: f64) -> PixelRaster {
    let per_pass = f64::from(look.film.per_pass).max(1e-4);
    let whole = ln(1.0 + per_pass * passes);
    share.map(|share| ((exp(f64::from(share) * whole) - 1.0) / per_pass) as f32)
}
