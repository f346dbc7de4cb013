use std::sync::{Mutex, PoisonError};

use image::{GrayImage, Luma, Rgb, RgbImage};

use super::reduction::{LightSum, rounded_mean};
use crate::look::ResolvedBlock;
use crate::stamps::TexelGrid;

/// Greatest width and height of the picture, pixels.
const LARGEST: u32 = 2048;

/// An overview of a floor from above. Each pixel is the mean light of the texels under it.
#[derive(Debug)]
pub struct Birdseye {
    grid: TexelGrid,
    /// Texels per pixel, along each axis.
    factor: usize,
    width: usize,
    height: usize,
    /// Row 0 is the southernmost.
    sums: Mutex<Vec<Seen>>,
}

/// Light and roughness of a pixel's texels.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    light: LightSum,
    /// Sum of roughness, 0 to 255 each.
    rough: u32,
}

impl Birdseye {
    /// Creates an empty overview of a floor.
    pub fn new(grid: TexelGrid) -> Birdseye {
        // At most as many texels per pixel as a `LightSum` holds.
        let factor = grid.width.max(grid.height).div_ceil(LARGEST).clamp(1, 256) as usize;
        let (width, height) = ((grid.width as usize).div_ceil(factor), (grid.height as usize).div_ceil(factor));
        Birdseye { grid, factor, width, height, sums: Mutex::new(vec![Seen::default(); width * height]) }
    }

    /// Adds a block whose lower-left texel is (i0, j0) of the whole floor.
    ///
    /// Skips empty blocks, and texels outside the floor's grid.
    pub fn add(&self, [i0, j0]: [i64; 2], [width, height]: [usize; 2], block: &ResolvedBlock) {
        let (Ok(i0), Ok(j0)) = (usize::try_from(i0), usize::try_from(j0)) else { return };
        let columns = width.min((self.grid.width as usize).saturating_sub(i0));
        let rows = height.min((self.grid.height as usize).saturating_sub(j0));
        if block.empty || columns == 0 || rows == 0 {
            return;
        }
        let (left, below) = (i0 / self.factor, j0 / self.factor);
        let cells_across = (i0 + columns - 1) / self.factor - left + 1;
        let cells_up = (j0 + rows - 1) / self.factor - below + 1;
        let mut cells = vec![Seen::default(); cells_across * cells_up];
        for (y, (row, orm)) in block.base_color.chunks(width).zip(block.orm.chunks(width)).enumerate().take(rows) {
            let cells = &mut cells[((j0 + y) / self.factor - below) * cells_across..][..cells_across];
            let mut x = 0;
            for (k, cell) in cells.iter_mut().enumerate() {
                let end = ((left + k + 1) * self.factor - i0).min(columns);
                row[x..end].iter().for_each(|&colour| cell.light.add(colour));
                cell.rough += orm[x..end].iter().map(|orm| u32::from(orm[1])).sum::<u32>();
                x = end;
            }
        }
        let mut sums = self.sums.lock().unwrap_or_else(PoisonError::into_inner);
        for (y, row) in cells.chunks(cells_across).enumerate() {
            let sums = &mut sums[(below + y) * self.width + left..][..cells_across];
            for (sum, cell) in sums.iter_mut().zip(row) {
                sum.light.merge(cell.light);
                sum.rough += cell.rough;
            }
        }
    }

    /// Pixels per metre of the picture.
    pub fn pixels_per_metre(&self) -> f64 {
        self.grid.texels_per_metre / self.factor as f64
    }

    /// Draws the picture, its upper row at the largest y. Pixels without floor get the colour `nothing`.
    pub fn picture(&self, nothing: [u8; 3]) -> RgbImage {
        let sums = self.sums.lock().unwrap_or_else(PoisonError::into_inner);
        RgbImage::from_fn(self.width as u32, self.height as u32, |x, y| {
            Rgb(sums[(self.height - 1 - y as usize) * self.width + x as usize].light.mean().unwrap_or(nothing))
        })
    }

    /// Roughness of the floor, as [`Birdseye::picture`] shows its colour. Pixels without floor get `nothing`.
    pub fn roughness(&self, nothing: u8) -> GrayImage {
        let sums = self.sums.lock().unwrap_or_else(PoisonError::into_inner);
        GrayImage::from_fn(self.width as u32, self.height as u32, |x, y| {
            let seen = sums[(self.height - 1 - y as usize) * self.width + x as usize];
            Luma([seen.light.count().map_or(nothing, |count| rounded_mean(seen.rough, count) as u8)])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(width: usize, height: usize, colour: impl Fn(usize, usize) -> u8) -> ResolvedBlock {
        let base_color = (0..width * height).map(|k| [colour(k % width, k / width); 3]).collect();
        ResolvedBlock { base_color, orm: vec![[255, 90, 0]; width * height], ..ResolvedBlock::default() }
    }

    #[test]
    fn light_is_averaged_not_numbers() {
        let birdseye = Birdseye::new(TexelGrid { texels_per_metre: 100.0, width: 4096, height: 2 });
        birdseye.add([0, 0], [4096, 2], &block(4096, 2, |x, y| if (x + y) % 2 == 0 { 255 } else { 0 }));
        let picture = birdseye.picture([1, 2, 3]);
        assert_eq!(picture.dimensions(), (2048, 1));
        assert!(picture.pixels().all(|p| p.0 == [188; 3]));
    }

    #[test]
    fn blocks_that_do_not_fit_the_pixels_add_up() {
        // Three texels to a pixel, blocks of 100.
        let grid = TexelGrid { texels_per_metre: 100.0, width: 6000, height: 7 };
        let colour = |x: usize, y: usize| (x / 24 + y) as u8;
        let (whole, parts) = (Birdseye::new(grid), Birdseye::new(grid));
        whole.add([0, 0], [6000, 7], &block(6000, 7, colour));
        for left in (0..6000).step_by(100) {
            // The last block reaches beyond the floor.
            parts.add([left as i64, 0], [100, 4], &block(100, 4, |x, y| colour(left + x, y)));
            parts.add([left as i64, 4], [100, 9], &block(100, 9, |x, y| colour(left + x, y.min(2) + 4)));
        }
        assert_eq!(whole.picture([0; 3]), parts.picture([0; 3]));
        assert_eq!(whole.picture([0; 3]).dimensions(), (2000, 3));
    }

    #[test]
    fn row_0_is_the_largest_y() {
        let birdseye = Birdseye::new(TexelGrid { texels_per_metre: 1.0, width: 1, height: 2 });
        birdseye.add([0, 0], [1, 2], &block(1, 2, |_, y| y as u8 * 100));
        assert_eq!(birdseye.picture([9; 3]).get_pixel(0, 0).0, [100; 3]);
    }

    #[test]
    fn nothing_seen_is_drawn_as_such() {
        let birdseye = Birdseye::new(TexelGrid { texels_per_metre: 1.0, width: 3, height: 2 });
        assert!(birdseye.picture([7, 8, 9]).pixels().all(|p| p.0 == [7, 8, 9]));
    }
}
