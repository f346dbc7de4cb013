//! Patterns from photographs: a stain on a wall or a floor, taken out of its picture.
//!
//! What is needed is the stain's optical density D = -ln(I / I0), where I is the light that comes from a place and I0
//! what would come from the clean wall there. The clean wall is not in the picture; but its colour is one, and light
//! falls off slowly over it. So a smooth surface is fitted to the logarithm of the picture around the stain
//! (`surface`), the stain being what is darker than it and holds together (`stain`); what the channels say is joined
//! along the direction in colour in which the stain darkens (`density`), turned and brought to 10 px/cm, rid of noise,
//! given a soft edge and cut out (`cut`). `listing` writes the image and its entry in `patterns.toml`.

mod cut;
mod density;
mod error;
mod listing;
mod photo;
mod preview;
mod raster;
mod stain;
mod surface;

use image::GrayImage;

use super::{Cause, Form};
use raster::Raster;

pub use error::ImportError;
pub use listing::{ImportEntry, Listed, name_of_photo};
pub use preview::import_picture;

/// What is known of a photograph.
#[derive(Clone, Debug)]
pub struct ImportOptions {
    /// What left the stain.
    pub cause: Cause,
    /// What kind of stain it is, if its cause has several.
    pub form: Option<Form>,
    /// How large the stain is.
    pub size: PhotoScale,
    /// The part of the photograph to look at: left, top, width, height in pixels; `None` is all of it.
    pub crop: Option<[u32; 4]>,
    /// By how much to turn the photograph counter-clockwise, degrees, so that the drag (or the toes) point to the right.
    pub rotate_deg: f64,
}

/// How large a photographed stain is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PhotoScale {
    /// Pixels of the photograph per centimetre of the wall, 4 to 200.
    PxPerCm(f64),
    /// Length of the stain along the drag, centimetres, once it is turned.
    LengthCm(f64),
}

/// A stain taken from a photograph.
#[derive(Clone, Debug)]
pub struct Import {
    /// What left it.
    pub cause: Cause,
    /// What kind of stain it is.
    pub form: Option<Form>,
    /// Coverage at 10 px/cm: 255 where the density is [`Import::peak_density`] or more.
    pub coverage: GrayImage,
    /// Size of the stain itself, centimetres along and across; the image has a margin around it.
    pub stain_cm: [f64; 2],
    /// Optical density that only one in 200 of the stain's pixels exceeds, mean over the three channels.
    pub peak_density: f64,
    /// Standard deviation of the density of what is clean wall, at 10 px/cm: what noise, texture and an imperfect
    /// fit leave there. The smaller against the peak, the better the photograph.
    pub wall_noise: f64,
    /// Whether the stain is lighter than the wall, as dust on a dark one.
    pub lighter: bool,
    /// Pixels of the photograph per centimetre.
    pub px_per_cm: f64,
    /// Where the middle of the image lies in the photograph, pixels from its upper left.
    pub middle_px: [f64; 2],
    /// For the picture: the photograph as it was looked at, and the density of all of it, 1 at the peak.
    looked_at: image::RgbImage,
    densities: Raster,
}

impl Import {
    /// Takes the stain out of a photograph, given as the bytes of its file.
    ///
    /// # Errors
    /// A file that is no image or too large, a crop that reaches beyond it, a scale or an angle out of range, a
    /// photograph without a stain or without enough of the wall around it, a stain too small or too large to be a
    /// pattern of its cause.
    pub fn from_photo(bytes: &[u8], options: &ImportOptions) -> Result<Import, ImportError> {
        options.check()?;
        let photo = photo::read(bytes, options)?;
        let surface = surface::fit(&photo)?;
        let found = stain::find(&surface)?;
        let density = density::of(&photo, &surface, &found);
        cut::out(photo, &density, &found, &surface, options)
    }

    /// Real length of the image, centimetres, as `patterns.toml` lists it.
    pub fn length_cm(&self) -> f64 {
        f64::from(self.coverage.width()) / super::PATTERN_PX_PER_CM
    }
}

impl ImportOptions {
    fn check(&self) -> Result<(), ImportError> {
        let value = |key, value: f64, allowed: &'static str| Err(ImportError::Value { key, value, allowed });
        match self.size {
            PhotoScale::PxPerCm(scale) if !(4.0..=200.0).contains(&scale) => {
                return value("scale", scale, "4 to 200 px/cm");
            }
            PhotoScale::LengthCm(length) if !(0.5..=150.0).contains(&length) => {
                return value("length", length, "0.5 to 150 cm");
            }
            _ => {}
        }
        if !(-360.0..=360.0).contains(&self.rotate_deg) {
            return value("rotation", self.rotate_deg, "-360 to 360 degrees");
        }
        match self.form {
            Some(form) if form.cause() != self.cause => Err(ImportError::Form { cause: self.cause, form }),
            _ => Ok(()),
        }
    }
}
