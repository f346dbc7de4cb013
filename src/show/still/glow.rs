//! The glow around lamps and windows: light that a lens scatters.

use rayon::prelude::*;

use super::tone::MOST;
use crate::show::rooms::LinearRgb;

/// Pixels of the picture to a cell, along each axis.
const CELL: usize = 8;
/// Exposed light from which on it is scattered, and its share.
const FROM: f32 = 0.95;
const SHARE: f32 = 0.075;
/// Reach of a blur as a share of the picture's width; three of them follow each other.
const REACH: f32 = 0.016;

/// A picture's light before it is toned: square roots over those of [`MOST`].
pub(super) struct Exposed {
    pub width: usize,
    pub roots: Vec<[u16; 3]>,
}

impl Exposed {
    pub fn new([width, height]: [u32; 2]) -> Exposed {
        Exposed { width: width as usize, roots: vec![[0; 3]; width as usize * height as usize] }
    }

    /// Writes the light of row `y`.
    pub fn put(&mut self, y: usize, row: &[LinearRgb]) {
        let root = |light: f32| ((light.max(0.0) / MOST as f32).sqrt().min(1.0) * 65_535.0 + 0.5) as u16;
        let places = &mut self.roots[y * self.width..(y + 1) * self.width];
        places.iter_mut().zip(row).for_each(|(place, light)| *place = light.map(root));
    }

    /// Light of row `y`.
    pub fn row(&self, y: usize) -> impl Iterator<Item = LinearRgb> + '_ {
        self.roots[y * self.width..(y + 1) * self.width].iter().map(|root| root.map(light))
    }
}

fn light(root: u16) -> f32 {
    let root = f32::from(root) / 65_535.0;
    root * root * MOST as f32
}

/// Scattered light on a coarse raster.
pub(super) struct Glow {
    columns: usize,
    rows: usize,
    cells: Vec<LinearRgb>,
}

impl Glow {
    /// The glow of a picture that is exposed by a factor.
    pub fn of(picture: &Exposed, exposure: f32) -> Glow {
        let (width, height) = (picture.width, picture.roots.len() / picture.width);
        let (columns, rows) = (width.div_ceil(CELL), height.div_ceil(CELL));
        let cell = |k: usize| {
            let (x0, y0) = (k % columns * CELL, k / columns * CELL);
            let (x1, y1) = ((x0 + CELL).min(width), (y0 + CELL).min(height));
            let mut sum = [0.0; 3];
            for y in y0..y1 {
                for root in &picture.roots[y * width + x0..y * width + x1] {
                    let over = root.map(|root| (light(root) * exposure - FROM).max(0.0));
                    sum = std::array::from_fn(|c| sum[c] + over[c]);
                }
            }
            let count = ((x1 - x0) * (y1 - y0)) as f32;
            sum.map(|sum| sum / (count * exposure))
        };
        let mut cells: Vec<LinearRgb> = (0..columns * rows).into_par_iter().map(cell).collect();
        let reach = ((width as f32 * REACH / CELL as f32) as usize).max(1);
        for _ in 0..3 {
            cells = blurred(&cells, [columns, rows], [1, columns], reach);
            cells = blurred(&cells, [rows, columns], [columns, 1], reach);
        }
        Glow { columns, rows, cells }
    }

    /// Scattered light at a pixel.
    pub fn at(&self, x: usize, y: usize) -> LinearRgb {
        let place = |at: usize, count: usize| {
            let at = ((at as f32 + 0.5) / CELL as f32 - 0.5).clamp(0.0, (count - 1) as f32);
            let first = (at as usize).min(count.saturating_sub(2));
            (first, (first + 1).min(count - 1), at - first as f32)
        };
        let ((i, i1, u), (j, j1, v)) = (place(x, self.columns), place(y, self.rows));
        let cell = |i: usize, j: usize| self.cells[j * self.columns + i];
        let [a, b, c, d] = [cell(i, j), cell(i1, j), cell(i, j1), cell(i1, j1)];
        std::array::from_fn(|k| SHARE * ((a[k] * (1.0 - u) + b[k] * u) * (1.0 - v) + (c[k] * (1.0 - u) + d[k] * u) * v))
    }
}

/// Means over `2 reach + 1` cells along one axis; beyond the rim is nothing.
fn blurred(
    cells: &[LinearRgb],
    [along, across]: [usize; 2],
    [step, stride]: [usize; 2],
    reach: usize,
) -> Vec<LinearRgb> {
    let mut out = vec![[0.0; 3]; cells.len()];
    let share = 1.0 / (2 * reach + 1) as f32;
    for line in 0..across {
        for k in 0..along {
            let range = k.saturating_sub(reach)..(k + reach + 1).min(along);
            let mut sum = [0.0; 3];
            range.for_each(|n| {
                let cell = cells[line * stride + n * step];
                sum = std::array::from_fn(|c| sum[c] + cell[c]);
            });
            out[line * stride + k * step] = sum.map(|sum: f32| sum * share);
        }
    }
    out
}
