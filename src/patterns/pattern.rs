//! One pattern of the library.

use super::{Cause, Form};

/// Resolution of patterns, pixels per centimetre.
pub const PATTERN_PX_PER_CM: f64 = 10.0;

/// The coverage of one stain at 10 px/cm.
///
/// Toes, or the direction of a drag, point to the right (+x); a sole is a left foot.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// File name without extension.
    pub name: String,
    /// Description in words.
    pub description: String,
    /// Cause of the stain.
    pub cause: Cause,
    /// Kind of stain, for causes with several.
    pub form: Option<Form>,
    /// Real length along +x, centimetres, at which the image has 10 px/cm.
    pub length_cm: f64,
    /// Share among the patterns of its cause; the shares of a cause sum up to 1.
    pub share: f64,
    /// Range of sole lengths that wear it, centimetres; `None` for all.
    pub lengths_cm: Option<[f64; 2]>,
    /// Width in pixels.
    pub width_px: u32,
    /// Height in pixels.
    pub height_px: u32,
    /// Coverage, 0 (leaves nothing) to 255 (full), in image order: row 0 at the top, on the left of a person who
    /// walks right.
    pub coverage: Vec<u8>,
}

impl Pattern {
    /// Real extent across the length, centimetres.
    pub fn breadth_cm(&self) -> f64 {
        self.length_cm * f64::from(self.height_px) / f64::from(self.width_px)
    }
}
