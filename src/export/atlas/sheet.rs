/// One texture of walls.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheet {
    /// Width, texels.
    pub width: u32,
    /// Height, texels.
    pub height: u32,
    /// What it holds: row by row from below, in rows from the left.
    pub strips: Vec<Strip>,
}

/// A stretch of one wall face in a sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip {
    /// Index into [`crate::walls::Walls::faces`].
    pub face: usize,
    /// Arc length at which it begins, metres. At a corner of the face it is the corner's to the last digit, up to half
    /// a texel from column `i0`'s left side.
    pub from_m: f64,
    /// Arc length at which it ends, metres.
    pub to_m: f64,
    /// First column of the face in it.
    pub i0: u32,
    /// Columns of the face in it.
    pub width: u32,
    /// Rows: those of [`WallGrid::height`](crate::stamps::WallGrid::height).
    pub height: u32,
    /// Column of the sheet at the rectangle's left.
    pub x: u32,
    /// Row of the sheet, counted upward from its lowest, at the rectangle's lower side.
    pub y: u32,
    /// Whether it is turned by a quarter counter-clockwise: arc length grows upward, height to the left.
    pub turned: bool,
}

impl Sheet {
    /// The share of it that strips with their padding take, 0 to 1.
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

    /// Column and row (upward) of the sheet that show the strip's column `i`, counted from its first, in row `j`.
    pub fn texel(&self, i: u32, j: u32) -> [u32; 2] {
        if self.turned { [self.x + self.height - 1 - j, self.y + i] } else { [self.x + i, self.y + j] }
    }
}
