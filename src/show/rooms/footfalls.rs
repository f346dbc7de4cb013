//! Footfalls on a coarse raster.

use crate::math::Vec2;
use crate::sums::{BLOCK, FloorSums, Quantity};

/// Side of a cell, metres.
pub(crate) const CELL_M: f64 = 0.25;

/// Wear of each cell by footfalls, 0 to 1.
pub(crate) struct FootfallGrid {
    columns: usize,
    rows: usize,
    trodden: Vec<f32>,
}

impl FootfallGrid {
    pub fn of(sums: &FloorSums) -> FootfallGrid {
        let grid = sums.presence_grid();
        let per_metre = grid.texels_per_metre;
        let cells = |texels: u32| (f64::from(texels) / per_metre / CELL_M) as usize + 1;
        let (columns, rows) = (cells(grid.width), cells(grid.height));
        let mut counts = vec![0u64; columns * rows];
        let mut values = vec![0; BLOCK * BLOCK];
        let cell = |texel: usize| ((texel as f64 + 0.5) / per_metre / CELL_M) as usize;
        for [i0, j0] in sums.blocks(Quantity::Presence) {
            sums.read(Quantity::Presence, i0, j0, BLOCK, BLOCK, &mut values);
            for (n, &value) in values.iter().enumerate().filter(|(_, value)| **value > 0) {
                let [x, y] = [cell(i0 as usize + n % BLOCK), cell(j0 as usize + n / BLOCK)];
                if x < columns && y < rows {
                    counts[y * columns + x] += u64::from(value);
                }
            }
        }
        let walked = counts.iter().filter(|&&count| count > 0).count().max(1) as f64;
        let usual = counts.iter().map(|&count| count as f64).sum::<f64>() / walked;
        let share = |count: u64| (count as f64 / (count as f64 + usual.max(1.0))) as f32;
        FootfallGrid { columns, rows, trodden: counts.into_iter().map(share).collect() }
    }

    /// Wear of a place by footfalls, 0 to 1.
    pub fn at(&self, p: Vec2) -> f32 {
        let (x, y) = (p.x / CELL_M, p.y / CELL_M);
        let inside = x >= 0.0 && y >= 0.0 && x < self.columns as f64 && y < self.rows as f64;
        if inside { self.trodden[y as usize * self.columns + x as usize] } else { 0.0 }
    }

    /// Size in cells.
    pub fn size(&self) -> [usize; 2] {
        [self.columns, self.rows]
    }
}
