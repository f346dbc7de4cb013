//! Rasterises marks as rotated, scaled, blurred and noisy prints and stains.
//!
//! A footfall adds to three quantities: `passes` and `soil` hold the sole itself; `presence` holds a soft kernel along
//! the heading with the same integral as the sole, so that local means of `passes` and `presence` agree. A heel mark
//! adds to `scuff`. A footfall that turns or stops adds to `grind`, a while of standing to `dwell`, both as `presence`. A
//! wheel adds a thin line to `wheels`.
//!
//! Each pattern is filtered once for the texel density, with four samples per texel (`bank`). A stamp reads one sample
//! per texel at any angle, size and sub-texel position. A second, vectorised loop applies per-print variation to each
//! row (`variation`).
//!
//! A stamp is a pure function of the mark, its pattern and the grid. Texels are counted from the mark's own texel, so a
//! stamp cut by a block's border gives the same integers on both sides as an uncut one.
//!
//! Contacts become stains on unrolled wall faces ([`WallGrid`]). A stain stretches, blurs and bends its pattern; drags
//! fade along their path; the wall's grain, fixed in place, breaks the stain up ([`WallStamper`]).

mod bank;
mod error;
mod fixed_point;
#[cfg(test)]
pub(crate) mod fixtures;
mod float_image;
mod heel;
mod lanes;
mod linear;
mod noise;
mod options;
mod pose;
mod presence;
mod print;
mod print_coverage;
mod reference;
mod shadow;
mod soil_coat;
mod sole;
mod stamper;
#[cfg(test)]
mod tests;
mod texel_grid;
mod variation;
mod wall_grid;
mod wall_plate;
mod wall_stamper;
mod wall_variation;
mod wheel;
mod window;

pub use error::StampsError;
pub(crate) use fixed_point::{DENSITY_ONE, DWELL_ONE, PASSES_ONE, PRESENCE_ONE, WHEELS_ONE};
pub(crate) use lanes::SumCell;
pub use options::StampOptions;
pub(crate) use print_coverage::PrintCoverage;
pub use reference::{ReferenceImage, stamp_reference};
pub use stamper::Stamper;
pub(crate) use stamper::{MarkBounds, PlacedMark};
pub use texel_grid::TexelGrid;
pub use wall_grid::{FaceSpan, WallGrid};
pub(crate) use wall_stamper::PlacedStain;
pub use wall_stamper::WallStamper;
pub(crate) use window::{TexelBounds, TexelWindow, WINDOW};
