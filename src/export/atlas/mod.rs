//! The wall atlas: where each stretch of wall face lies in the sheets. Geometry only, no pixels.

use crate::stamps::WallGrid;
use crate::walls::Corner;

use super::{ExportError, Target};

mod pack;

#[cfg(test)]
mod tests;

/// A texture atlas of all walls of a plan: faces unrolled into strips, packed into sheets.
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

/// One texture of the wall atlas.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheet {
    /// Width, texels.
    pub width: u32,
    /// Height, texels.
    pub height: u32,
    /// Its strips: row by row from below, each row from the left.
    pub strips: Vec<Strip>,
}

/// A stretch of one wall face in a sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip {
    /// Index into [`crate::walls::Walls::faces`].
    pub face: usize,
    /// Arc length at which it begins, metres.
    ///
    /// At a corner of the face it equals the corner's, up to half a texel from the left side of column `i0`.
    pub from_m: f64,
    /// Arc length at which it ends, metres.
    pub to_m: f64,
    /// Its first column of the face.
    pub i0: u32,
    /// Number of columns of the face.
    pub width: u32,
    /// Number of rows, equal to [`WallGrid::height`].
    pub height: u32,
    /// Column of the sheet at the rectangle's left.
    pub x: u32,
    /// Row of the sheet, counted upward from its lowest, at the rectangle's lower side.
    pub y: u32,
    /// Whether it is turned by a quarter counter-clockwise: arc length grows upward, height to the left.
    pub turned: bool,
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

impl Sheet {
    /// Returns the share of the sheet's area that strips and their padding cover, 0 to 1.
    pub fn filled(&self, padding_px: u32) -> f64 {
        let area = |[width, height]: [u32; 2]| f64::from(width + 2 * padding_px) * f64::from(height + 2 * padding_px);
        let taken: f64 = self.strips.iter().map(|strip| area(strip.size())).sum();
        taken / (f64::from(self.width) * f64::from(self.height))
    }
}

impl Strip {
    /// Width and height of its rectangle in the sheet, texels, without padding.
    pub fn size(&self) -> [u32; 2] {
        if self.turned { [self.height, self.width] } else { [self.width, self.height] }
    }

    /// Returns the sheet's column and row (upward) of the strip's texel in column `i`, row `j`.
    pub fn texel(&self, i: u32, j: u32) -> [u32; 2] {
        if self.turned { [self.x + self.height - 1 - j, self.y + i] } else { [self.x + i, self.y + j] }
    }
}
