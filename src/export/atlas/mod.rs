//! Where the walls lie in textures: geometry only, no pixels.

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
/// Strips lie in rows, or, where rows of wall height leave much of a sheet free, also turned by a quarter in the rest
/// above the rows. Every strip has room for padding around it. The strips of a face hold each of its columns exactly
/// once. The same walls give the same atlas.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Atlas {
    /// Texel density, texels per metre.
    pub texels_per_metre: f64,
    /// Height of the walls, metres.
    pub height_m: f64,
    /// Texels around each strip that belong to nothing else.
    pub padding_px: u32,
    /// All sheets. All but the last are of full size.
    pub sheets: Vec<Sheet>,
}

impl Atlas {
    /// Lays all faces into sheets of at most `sheet_px` x `sheet_px` texels with `padding_px` texels around each strip.
    ///
    /// Longest first, ties by start, each into the row that it fills best. A face stays in one piece if it fits in a
    /// row; a longer one ends at its last corner near the row's end, or else at the row's end. A sheet that is filled
    /// by less than 85 % that way is filled again with more faces broken at corners of theirs, and, if even that is
    /// not enough, anywhere. The last sheet is as small as powers of two let it be.
    ///
    /// # Errors
    /// A sheet too small for one strip; a size out of range.
    pub fn pack(grid: &WallGrid, corners: &[Corner], sheet_px: u32, padding_px: u32) -> Result<Atlas, ExportError> {
        let sheets = pack::sheets(grid, corners, sheet_px, padding_px)?;
        Ok(Atlas { texels_per_metre: grid.texels_per_metre, height_m: grid.height_m, padding_px, sheets })
    }

    /// Checks the size of the sheets against what a target takes.
    ///
    /// # Errors
    /// A sheet that is too large.
    pub fn check(&self, target: Target) -> Result<(), ExportError> {
        target.check_size(self.sheets.iter().map(|sheet| sheet.width.max(sheet.height)).max().unwrap_or(1))
    }

    /// All strips, each with the index of its sheet.
    pub fn strips(&self) -> impl Iterator<Item = (usize, &Strip)> {
        self.sheets.iter().enumerate().flat_map(|(sheet, s)| s.strips.iter().map(move |strip| (sheet, strip)))
    }

    /// Texture coordinates, from the upper left of the sheet and downward, of a place on a strip: its arc length along
    /// the face and its height above the floor, metres.
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
