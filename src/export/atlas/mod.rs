//! The wall atlas: where each stretch of wall face lies in the sheets. Geometry only, no pixels.

use crate::stamps::WallGrid;
use crate::walls::Corner;

use super::{ExportError, Target};

mod pack;
mod sheet;

#[cfg(test)]
mod tests;

pub use sheet::{Sheet, Strip};

/// All walls of a plan, unrolled into strips of wall height and laid into sheets.
///
/// Strips are as tall as the walls and lie in rows. Where rows leave more than a tenth of a sheet free, the space above
/// them holds strips turned by a quarter. Padding surrounds every strip. Each column of a face lies in exactly one
/// strip. The same walls give the same atlas.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Atlas {
    /// Texel density, texels per metre.
    pub texels_per_metre: f64,
    /// Height of the walls, metres.
    pub height_m: f64,
    /// Padding around each strip, texels.
    pub padding_px: u32,
    /// All sheets. All but the last have full size.
    pub sheets: Vec<Sheet>,
}

impl Atlas {
    /// Packs all faces into sheets of at most `sheet_px` x `sheet_px` texels.
    ///
    /// Each strip has `padding_px` texels of padding on every side. Long faces go first, ties by their start, each into
    /// the row that it fills best. A face that fits in a row stays in one piece. A longer face is cut at its last
    /// corner near the row's end, or at the row's end. A sheet filled by less than 85 % is packed again with more faces
    /// cut at corners, then with cuts anywhere. The last sheet is cut down to the smallest powers of two that hold its
    /// strips.
    ///
    /// # Errors
    /// A sheet too small for one strip; a size out of range.
    pub fn pack(grid: &WallGrid, corners: &[Corner], sheet_px: u32, padding_px: u32) -> Result<Atlas, ExportError> {
        let sheets = pack::sheets(grid, corners, sheet_px, padding_px)?;
        Ok(Atlas { texels_per_metre: grid.texels_per_metre, height_m: grid.height_m, padding_px, sheets })
    }

    /// Checks that the target accepts textures as large as the sheets.
    ///
    /// # Errors
    /// A sheet that is too large.
    pub fn check(&self, target: Target) -> Result<(), ExportError> {
        target.check_size(self.sheets.iter().map(|sheet| sheet.width.max(sheet.height)).max().unwrap_or(1))
    }

    /// Iterates over all strips, each with the index of its sheet.
    pub fn strips(&self) -> impl Iterator<Item = (usize, &Strip)> {
        self.sheets.iter().enumerate().flat_map(|(sheet, s)| s.strips.iter().map(move |strip| (sheet, strip)))
    }

    /// Returns the texture coordinates of a point on a strip.
    ///
    /// The sheet's upper left is (0, 0), v grows downward. `along_m` is the arc length along the face, `height_m` the
    /// height above the floor, metres.
    pub fn uv(&self, sheet: usize, strip: &Strip, along_m: f64, height_m: f64) -> [f64; 2] {
        let (column, row) = (along_m * self.texels_per_metre - f64::from(strip.i0), height_m * self.texels_per_metre);
        let (x, y) = match strip.turned {
            false => (f64::from(strip.x) + column, f64::from(strip.y) + row),
            true => (f64::from(strip.x + strip.height) - row, f64::from(strip.y) + column),
        };
        let [width, height] = self.sheets.get(sheet).map_or([1.0; 2], |s| [s.width, s.height].map(f64::from));
        [x / width, 1.0 - y / height]
    }
}
