//! Imports patterns from photographs: extracts a stain on a wall or a floor from its picture.
//!
//! The coverage of a pattern follows from the stain's optical density D = -ln(I / I0). I is the light from a place,
//! I0 the light that the clean wall would send from there. I0 is not in the picture, but the wall has one colour and
//! light falls off slowly over it. The steps of `from_photo`:
//!
//! 1. `photo` reads the picture as logarithms of light;
//! 2. `surface` fits a smooth surface to the logarithms around the stain;
//! 3. `stain` finds the stain: connected parts darker than the surface;
//! 4. `density` combines the colour channels along the direction in which the stain darkens;
//! 5. `cut` rotates, resamples to 10 px/cm, removes noise, softens the edge and crops.
//!
//! `save` writes the image and its entry in `patterns.toml`.

mod cut;
mod density;
mod error;
mod from_photo;
mod imported;
mod options;
mod photo;
mod preview;
mod raster;
mod save;
mod stain;
mod surface;

pub use error::ImportError;
pub use imported::ImportedPattern;
pub use options::{ImportOptions, PhotoScale};
pub(crate) use photo::decode as decode_photo;
pub use preview::import_picture;
pub(crate) use raster::{PixelRaster, quantile};
pub use save::{ImportEntry, SavedPattern, name_of_photo};
