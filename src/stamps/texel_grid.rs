//! Texel grid of a floor.

use serde::{Deserialize, Serialize};

use super::StampsError;
use crate::math::Vec2;

/// Approximate side of a cell of the presence grid, metres: fine enough for a kernel of 8 cm.
const PRESENCE_CELL_M: f64 = 0.04;

/// Largest number of texels along a side of a floor: 2 km at 1000 texels per metre.
pub const MOST_TEXELS: u32 = 1 << 21;

/// Texel grid of a floor.
///
/// Texel (i, j) covers `[i, i+1)/t x [j, j+1)/t` metres from the plan's origin; j grows upward.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TexelGrid {
    /// Texel density t, texels per metre, 1 to 1000.
    pub texels_per_metre: f64,
    /// Number of columns.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
}

impl TexelGrid {
    /// Creates the grid of a floor of `width_m` x `height_m` metres.
    ///
    /// # Errors
    /// The texel density is outside 1 to 1000 texels per metre; a side has more than `MOST_TEXELS` texels.
    pub fn covering(width_m: f64, height_m: f64, texels_per_metre: f64) -> Result<TexelGrid, StampsError> {
        if !(1.0..=1000.0).contains(&texels_per_metre) {
            return Err(StampsError::FloorTexelDensity { texels_per_metre });
        }
        let texels = |metres: f64| {
            // Rounding errors must not add a texel.
            let texels = (metres * texels_per_metre - 1e-6).ceil().max(1.0);
            let fits = texels <= f64::from(MOST_TEXELS);
            fits.then_some(texels as u32).ok_or(StampsError::TooManyTexels {
                metres,
                texels_per_metre,
                most: MOST_TEXELS,
            })
        };
        Ok(TexelGrid { texels_per_metre, width: texels(width_m)?, height: texels(height_m)? })
    }

    /// Centre of a texel, metres.
    pub fn centre_m(&self, i: u32, j: u32) -> Vec2 {
        Vec2 { x: (f64::from(i) + 0.5) / self.texels_per_metre, y: (f64::from(j) + 0.5) / self.texels_per_metre }
    }

    /// Side of a texel, metres.
    pub fn texel_m(&self) -> f64 {
        1.0 / self.texels_per_metre
    }

    /// Grid of `presence`, with cells of about 4 cm: a whole number of texels per side, at least one.
    pub fn presence_grid(&self) -> TexelGrid {
        let texels = self.texels_per_presence_cell();
        TexelGrid {
            texels_per_metre: self.texels_per_metre / f64::from(texels),
            width: self.width.div_ceil(texels),
            height: self.height.div_ceil(texels),
        }
    }

    /// Side of a presence cell, texels; see [`TexelGrid::presence_grid`].
    pub fn texels_per_presence_cell(&self) -> u32 {
        (self.texels_per_metre * PRESENCE_CELL_M).round().clamp(1.0, 4096.0) as u32
    }
}
