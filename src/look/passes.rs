//! Expected passes, standing time and effort of the simulated people per texel.

use super::lattice::{SplineAxis, SplineLattice, TexelWindow};
use crate::math;
use crate::stamps::TexelGrid;
use crate::sums::{BLOCK, FloorSums, Quantity};
use crate::walls::Walls;

/// A coarse quantity of the simulated people over one window.
pub(super) struct PassesField {
    /// The quantity times the share of floor in each cell, and that share. It is unknown off the floor, so only floor
    /// counts in the mean: lanes reach openings and door jambs undiminished.
    weighted: SplineLattice,
    /// `None` if all cells are floor.
    share: Option<SplineLattice>,
    /// Half the share of floor, that under furniture counted too; `None` away from furniture.
    beneath: Option<SplineLattice>,
}

impl PassesField {
    /// Evens the quantity out by a Gaussian of `blur_m`; `None` if the sums near the window are zero.
    pub fn over(
        window: &TexelWindow,
        (sums, quantity): (&FloorSums, Quantity),
        walls: &Walls,
        blur_m: f64,
    ) -> Option<PassesField> {
        let cells_per_metre = sums.presence_grid().texels_per_metre;
        let texels_per_cell = window.texels_per_metre / cells_per_metre;
        let axis = |texel0, count| SplineAxis::new(texel0, count, texels_per_cell, 0.5);
        let (x, y) = (axis(window.i0, window.width), axis(window.j0, window.height));

        let kernel = half_gaussian(blur_m * cells_per_metre);
        let reach = kernel.len() - 1;
        let cells =
            TexelWindow { texels_per_metre: cells_per_metre, i0: x.first, j0: y.first, width: x.len, height: y.len };
        let around = cells.grown(reach);
        let mut weighted = cells_of(sums, quantity, &around)?;
        let mut share = vec![0.0; around.texels()];
        walls.coverage(cells_per_metre, around.i0, around.j0, around.width, around.height, &mut share);
        for (value, share) in weighted.iter_mut().zip(&share) {
            *value *= share;
        }
        // Feet reach a little under furniture, and no farther.
        let beneath = walls.has_furniture().then(|| {
            let mut cleared = vec![0.0; around.texels()];
            walls.cleared_coverage(
                cells_per_metre,
                [around.i0, around.j0],
                [around.width, around.height],
                &mut cleared,
            );
            cleared
        });
        let beneath = beneath.filter(|cleared| *cleared != share).map(|cleared| {
            let half: Vec<f32> = cleared.into_iter().map(|share| 0.5 * share).collect();
            let half = if reach > 0 { blurred(&half, &around, &kernel) } else { half };
            SplineLattice::new(x.clone(), y.clone(), half)
        });
        if reach > 0 {
            weighted = blurred(&weighted, &around, &kernel);
            share = blurred(&share, &around, &kernel);
        }
        let all_floor = share.iter().all(|&share| share == 1.0);
        let share = (!all_floor).then(|| SplineLattice::new(x.clone(), y.clone(), share));
        Some(PassesField { weighted: SplineLattice::new(x, y, weighted), share, beneath })
    }

    pub fn begin_row(&mut self, row: usize) {
        self.weighted.begin_row(row);
        for lattice in self.share.iter_mut().chain(&mut self.beneath) {
            lattice.begin_row(row);
        }
    }

    /// The quantity at the texels `start..start + out.len()` of the current row.
    pub fn values(&self, start: usize, out: &mut [f32], scratch: &mut Vec<f32>) {
        out.fill(0.0);
        self.weighted.add_to(start, out);
        if let Some(share) = &self.share {
            scratch.clear();
            scratch.resize(2 * out.len(), 0.0);
            let (shares, least) = scratch.split_at_mut(out.len());
            share.add_to(start, shares);
            if let Some(beneath) = &self.beneath {
                beneath.add_to(start, least);
            }
            for ((value, share), least) in out.iter_mut().zip(shares).zip(least) {
                *value /= share.max(*least).max(1e-3);
            }
        }
    }
}

/// The quantity in whose place [`coarse`] has another one.
pub(super) const COARSE: Quantity = Quantity::Presence;

/// `gain` times the mean of a quantity in each cell of the coarse grid, as [`COARSE`]: the sums hold it in texels alone.
pub(super) fn coarse(sums: &FloorSums, quantity: Quantity, gain: f64) -> FloorSums {
    let mut coarse = FloorSums::new(sums.grid());
    let side = sums.grid().texels_per_presence_cell();
    let unit = gain * f64::from(COARSE.one()) / f64::from(quantity.one()) / (f64::from(side) * f64::from(side));
    let mut texels = vec![0; BLOCK * BLOCK];
    for [i0, j0] in sums.blocks(quantity) {
        sums.read(quantity, i0, j0, BLOCK, BLOCK, &mut texels);
        // Cells that the block shares with another one get a part from each.
        let cells_of = |k: u32| (k / side, ((k + BLOCK as u32 - 1) / side - k / side + 1) as usize);
        let ((left, columns), (low, rows)) = (cells_of(i0), cells_of(j0));
        let mut cells = vec![0u64; columns * rows];
        for (row, j) in texels.chunks_exact(BLOCK).zip(j0..) {
            let cells = &mut cells[(j / side - low) as usize * columns..][..columns];
            for (&sum, i) in row.iter().zip(i0..).filter(|(sum, _)| **sum > 0) {
                cells[(i / side - left) as usize] += u64::from(sum);
            }
        }
        let means: Vec<u32> =
            cells.into_iter().map(|sum| (sum as f64 * unit + 0.5).min(f64::from(u32::MAX)) as u32).collect();
        coarse.add_block(COARSE, left, low, columns, rows, &means);
    }
    coarse
}

/// A coarse quantity in the cells of a window; `None` if it is zero.
fn cells_of(sums: &FloorSums, quantity: Quantity, window: &TexelWindow) -> Option<Vec<f32>> {
    let unit = 1.0 / quantity.one() as f32;
    let mut values = Vec::new();
    let any = read(sums, quantity, window, &mut values);
    any.then(|| values.into_iter().map(|sum| sum as f32 * unit).collect())
}

/// A coarse quantity of the simulated people near a place, metres: the mean over a fifth of a metre.
pub(super) fn near(sums: &FloorSums, quantity: Quantity, place: [f64; 2]) -> f32 {
    let TexelGrid { texels_per_metre, width, height } = sums.presence_grid();
    let [i, j] = place.map(|metres| (metres * texels_per_metre).floor() as i64 - 2);
    let inside = |from: i64, size: u32| (0..i64::from(size) - 4).contains(&from);
    let mut cells = [0; 25];
    if !inside(i, width) || !inside(j, height) || !sums.touched(quantity, i as u32, j as u32, 5, 5) {
        return 0.0;
    }
    sums.read(quantity, i as u32, j as u32, 5, 5, &mut cells);
    cells.iter().map(|&sum| sum as f32).sum::<f32>() / (25.0 * quantity.one() as f32)
}

/// Reads sums over a window, 0 outside the grid; `false` if all are zero.
pub(super) fn read(sums: &FloorSums, quantity: Quantity, window: &TexelWindow, values: &mut Vec<u32>) -> bool {
    values.clear();
    let grid = sums.grid_of(quantity);
    let clip = |first: i64, count: usize, size: u32| {
        let low = first.clamp(0, i64::from(size));
        let high = (first + count as i64).clamp(low, i64::from(size));
        (low, (high - low) as usize)
    };
    let (i0, width) = clip(window.i0, window.width, grid.width);
    let (j0, height) = clip(window.j0, window.height, grid.height);
    if width == 0 || height == 0 || !sums.touched(quantity, i0 as u32, j0 as u32, width, height) {
        return false;
    }
    values.resize(window.texels(), 0);
    if (width, height) == (window.width, window.height) {
        sums.read(quantity, i0 as u32, j0 as u32, width, height, values);
        return true;
    }
    let mut inner = vec![0; width * height];
    sums.read(quantity, i0 as u32, j0 as u32, width, height, &mut inner);
    let (left, below) = ((i0 - window.i0) as usize, (j0 - window.j0) as usize);
    for (row, inner) in inner.chunks_exact(width).enumerate() {
        let start = (below + row) * window.width + left;
        values[start..start + width].copy_from_slice(inner);
    }
    true
}

/// Centre and one side of a normalised Gaussian of deviation `sd` cells; `[1.0]` for 0.
pub(super) fn half_gaussian(sd: f64) -> Vec<f32> {
    if sd <= 0.0 {
        return vec![1.0];
    }
    let reach = (3.0 * sd).ceil() as usize;
    let half: Vec<f64> = (0..=reach).map(|k| math::exp(-0.5 * (k as f64 / sd) * (k as f64 / sd))).collect();
    let whole = 2.0 * half.iter().sum::<f64>() - half[0];
    half.into_iter().map(|weight| (weight / whole) as f32).collect()
}

/// Blurs along both axes; the window shrinks by the kernel's reach on every side.
pub(super) fn blurred(values: &[f32], window: &TexelWindow, half_kernel: &[f32]) -> Vec<f32> {
    let reach = half_kernel.len() - 1;
    let (width, height) = (window.width - 2 * reach, window.height - 2 * reach);
    let mut across = vec![0.0; width * window.height];
    for (out, row) in across.chunks_exact_mut(width).zip(values.chunks_exact(window.width)) {
        for (out, value) in out.iter_mut().zip(&row[reach..]) {
            *out = value * half_kernel[0];
        }
        for (offset, weight) in half_kernel.iter().enumerate().skip(1) {
            for ((out, a), b) in out.iter_mut().zip(&row[reach - offset..]).zip(&row[reach + offset..]) {
                *out += weight * (a + b);
            }
        }
    }
    let mut both = vec![0.0; width * height];
    for (j, out) in both.chunks_exact_mut(width).enumerate() {
        let row = |j: usize| &across[j * width..(j + 1) * width];
        for (offset, &weight) in half_kernel.iter().enumerate() {
            let (below, above) = (row(j + reach - offset), row(j + reach + offset));
            let weight = if offset == 0 { 0.5 * weight } else { weight };
            for ((out, a), b) in out.iter_mut().zip(below).zip(above) {
                *out += weight * (a + b);
            }
        }
    }
    both
}
