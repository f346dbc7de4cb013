//! The result of an import.

use image::{GrayImage, RgbImage};

use super::raster::PixelRaster;
use crate::patterns::{Cause, Form, PATTERN_PX_PER_CM};

/// A pattern extracted from a photograph of a stain.
#[derive(Clone, Debug)]
pub struct ImportedPattern {
    /// Cause of the stain.
    pub cause: Cause,
    /// Kind of stain, for causes with several.
    pub form: Option<Form>,
    /// Coverage at 10 px/cm: 255 where the density is [`ImportedPattern::peak_density`] or more.
    pub coverage: GrayImage,
    /// Size of the stain without the margin of the image, centimetres along and across.
    pub stain_cm: [f64; 2],
    /// Optical density that only one in 200 of the stain's pixels exceeds, mean over the three channels.
    pub peak_density: f64,
    /// Standard deviation of the density of the clean wall at 10 px/cm, from noise, texture and an imperfect fit. The
    /// smaller against the peak, the better the photograph.
    pub wall_noise: f64,
    /// Whether the stain is lighter than the wall, as dust on a dark one.
    pub lighter: bool,
    /// Pixels of the photograph per centimetre.
    pub px_per_cm: f64,
    /// Position of the image's middle in the photograph, pixels from the upper left.
    pub middle_px: [f64; 2],
    /// The cropped photograph, for the preview.
    pub(super) cropped: RgbImage,
    /// Density of the whole crop, 1 at the peak, for the preview.
    pub(super) densities: PixelRaster,
}

impl ImportedPattern {
    /// Real length of the image, centimetres, as `patterns.toml` lists it.
    pub fn length_cm(&self) -> f64 {
        f64::from(self.coverage.width()) / PATTERN_PX_PER_CM
    }
}
