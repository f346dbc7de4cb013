//! The pattern library: images of single stains, sorted by cause, with their real size and share.
//!
//! A library is a folder with `patterns.toml` and the images that it lists. In an image white leaves full soil and
//! black leaves none; the toes (or the direction of the drag) point to the right, and a sole is a **left** foot as
//! its print lies on the floor, so that the big toe is below. [`PatternLibrary::built_in`] is compiled in.

mod decode;
mod error;
pub(crate) mod font;
mod library;
mod listing;
mod sheet;

pub use error::{ListedAt, PatternsError};
pub use sheet::contact_sheet;

/// Resolution at which patterns are kept, pixels per centimetre.
pub const PATTERN_PX_PER_CM: f64 = 10.0;

/// What leaves a mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Cause {
    /// A shoe sole set down: the footprint.
    Sole,
    /// A heel or toe dragged over the floor: the thin black mark.
    Heel,
}

impl Cause {
    /// Every cause, in the order in which lists name them.
    pub const ALL: [Cause; 2] = [Cause::Sole, Cause::Heel];

    /// The cause as `patterns.toml` writes it.
    pub const fn name(self) -> &'static str {
        match self {
            Cause::Sole => "sole",
            Cause::Heel => "heel",
        }
    }
}

/// One pattern: coverage at 10 px/cm, toes (or the direction of the drag) to the right (+x), a left foot.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// File name without ending.
    pub name: String,
    /// What it is, in words.
    pub description: String,
    /// What leaves it.
    pub cause: Cause,
    /// Real length along +x, centimetres, at which the image has 10 px/cm.
    pub length_cm: f64,
    /// Share at which it occurs among the patterns of its cause; the library scales them to sum up to 1.
    pub share: f64,
    /// Lengths of sole that wear it, centimetres, if not all.
    pub lengths_cm: Option<[f64; 2]>,
    /// Width in pixels.
    pub width_px: u32,
    /// Height in pixels.
    pub height_px: u32,
    /// 0 (leaves nothing) to 255 (full), in image order (row 0 at the top: the left of someone walking right).
    pub coverage: Vec<u8>,
}

impl Pattern {
    /// Real extent across the length, centimetres.
    pub fn breadth_cm(&self) -> f64 {
        self.length_cm * f64::from(self.height_px) / f64::from(self.width_px)
    }
}

/// All patterns.
#[derive(Clone, Debug)]
pub struct PatternLibrary {
    /// In the order of `patterns.toml`; a mark names a pattern by its place here.
    pub patterns: Vec<Pattern>,
}
