//! Turns marks into small bitmaps of texels: rotated, scaled, blurred, noisy, no two alike.
//!
//! A footfall adds to three quantities. `passes` and `soil` show the sole itself; `presence` is a soft kernel
//! along the heading that holds as much as the sole does, so that the local means of `passes` and `presence`
//! agree. A heel mark adds to `scuff`.
//!
//! Nothing is drawn texel by texel from the pattern image. Each pattern is filtered once for the texel density
//! and kept at four samples a texel (`bank`); a stamp then reads one sample a texel, at whatever
//! angle, size and sub-texel place the mark asks for, so that none of these need be quantised. What
//! differs from print to print (`variation`) is laid over the row in a second, vectorised loop.
//!
//! Everything about a stamp is a pure function of the mark, its pattern and the grid. Texels are counted from
//! the mark's own texel, so that a stamp that is cut by a block's border gives the same integers on both sides
//! as one that is not.
//!
//! Contacts become stains on walls, which are unrolled face by face ([`WallGrid`]). A stain stretches its pattern along
//! and across, blurs, blots and bends it, and lets drags fade; the wall's own grain breaks it up, always in the
//! same places ([`WallStamper`]).

use crate::math::Vec2;

mod bank;
mod coat;
mod error;
#[cfg(test)]
pub(crate) mod fixtures;
mod heel;
mod lanes;
mod noise;
mod picture;
mod presence;
mod print;
mod reference;
mod shadow;
mod sheet;
mod sole;
mod stamper;
#[cfg(test)]
mod tests;
mod variation;
mod wall_grid;
mod wall_plate;
mod wall_stamper;
mod wall_variation;

pub use error::StampsError;
pub(crate) use lanes::Cell;
pub use reference::{ReferenceImage, stamp_reference};
pub(crate) use sheet::Sheet;
pub use stamper::Stamper;
pub(crate) use stamper::{Bounds, Placed, Touched, WINDOW, Window};
pub use wall_grid::{FaceSpan, WallGrid};
pub(crate) use wall_stamper::Stain;
pub use wall_stamper::WallStamper;

use serde::{Deserialize, Serialize};

/// What 1 is in sums of `passes`: a print of full coverage at mean pressure.
pub const PASSES_ONE: f32 = 256.0;

/// What 1 is in sums of `presence`, in the same unit as passes.
pub const PRESENCE_ONE: f32 = 1024.0;

/// What an optical density of 1 is in sums of `soil` and `scuff`, and in those of walls.
pub const DENSITY_ONE: f32 = 4096.0;

/// The most texels along a side of a floor: 2 km at 1000 texels per metre.
pub const MOST_TEXELS: u32 = 1 << 21;

/// The raster of a whole surface: texel (i, j) covers `[i, i+1)/t x [j, j+1)/t` metres from the plan's origin,
/// so j grows upward.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TexelGrid {
    /// Texel density t, texels per metre.
    pub texels_per_metre: f64,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl TexelGrid {
    /// The grid of a floor of `width_m` x `height_m` metres.
    ///
    /// # Errors
    /// A density out of 1 to 1000 texels per metre; more than [`MOST_TEXELS`] a side.
    pub fn covering(width_m: f64, height_m: f64, texels_per_metre: f64) -> Result<TexelGrid, StampsError> {
        if !(1.0..=1000.0).contains(&texels_per_metre) {
            return Err(StampsError::Density { texels_per_metre });
        }
        let texels = |metres: f64| {
            // A floor that is a whole number of texels but for rounding does not get one more.
            let texels = (metres * texels_per_metre - 1e-6).ceil().max(1.0);
            let fits = texels <= f64::from(MOST_TEXELS);
            fits.then_some(texels as u32).ok_or(StampsError::TooManyTexels { metres, texels_per_metre })
        };
        Ok(TexelGrid { texels_per_metre, width: texels(width_m)?, height: texels(height_m)? })
    }

    /// Middle of a texel, metres.
    pub fn centre_m(&self, i: u32, j: u32) -> Vec2 {
        Vec2 { x: (f64::from(i) + 0.5) / self.texels_per_metre, y: (f64::from(j) + 0.5) / self.texels_per_metre }
    }

    /// Side of a texel, metres.
    pub fn texel_m(&self) -> f64 {
        1.0 / self.texels_per_metre
    }

    /// The grid of `presence`: cells of about 4 cm that are a whole number of texels, one texel if texels are coarser.
    pub fn presence_grid(&self) -> TexelGrid {
        let texels = self.texels_per_presence_cell();
        TexelGrid {
            texels_per_metre: self.texels_per_metre / f64::from(texels),
            width: self.width.div_ceil(texels),
            height: self.height.div_ceil(texels),
        }
    }

    /// Side of a cell of [`TexelGrid::presence_grid`], texels.
    pub fn texels_per_presence_cell(&self) -> u32 {
        (self.texels_per_metre * PRESENCE_CELL_M).round().clamp(1.0, 4096.0) as u32
    }
}

/// About the side of a cell of the presence grid, metres: fine enough for a kernel of 8 cm.
const PRESENCE_CELL_M: f64 = 0.04;

/// How prints differ from each other, and how wide the presence kernel is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct StampOptions {
    /// Share of soil prints that show only the heel, only the ball or fade to one side, 0 to 1.
    pub partial: f64,
    /// Standard deviation of the pressure's slope over a sole, from heel to toe and from edge to edge, and over a stain
    /// on a wall, as a share of the mean pressure; 0 to 0.4.
    pub pressure: f64,
    /// Least and largest blur of a soil print or a stain on a wall (standard deviation), metres; 0 to 0.02. Skin and
    /// cloth blur by 2.5 times as much. The texel's own filter comes on top.
    pub blur_m: [f64; 2],
    /// Standard deviation of the blotches and grain in a soil print, as a share of its density; 0 to 0.6. Stains on
    /// walls have blotches of 1.2 times as much, and grain of 0.8 times.
    pub noise: f64,
    /// Standard deviation of the presence kernel across the heading, metres; 0.01 to 1.
    pub presence_across_m: f64,
    /// Standard deviation of the presence kernel along the heading, metres; 0.01 to 1.
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
    /// Checks every value against its range.
    ///
    /// # Errors
    /// The first value out of its range, by name.
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
            // Written so that NaN is out of range.
            if !(value >= low && value <= high) {
                return Err(StampsError::OutOfRange { name, value, low, high });
            }
        }
        Ok(())
    }
}
