//! Touches of the simulated people, and their local mean.

use super::strip::FaceStrip;
use crate::look::lattice::{SplineAxis, SplineLattice, TexelWindow};
use crate::look::passes::{blurred, half_gaussian};
use crate::patterns::Cause;
use crate::stamps::DENSITY_ONE;
use crate::sums::WallSums;

/// Touches of one cause over a window of a strip.
pub(super) struct TouchFields {
    /// Sums per texel.
    pub single: Vec<u32>,
    /// Local mean of the sums; `None` if not requested.
    mean: Option<SplineLattice>,
}

/// Texels of a strip, grouped into cells along one axis.
#[derive(Clone, Copy)]
struct TexelCells {
    texels: u32,
    count: i64,
    closed: bool,
}

impl TexelCells {
    fn new(texels: u32, wanted: f64, closed: bool) -> TexelCells {
        let count = (f64::from(texels) / wanted).round().max(1.0) as i64;
        TexelCells { texels, count, closed }
    }

    /// Mean number of texels per cell; cells differ by less than one.
    fn spacing(&self) -> f64 {
        f64::from(self.texels) / self.count as f64
    }

    /// First texel of a cell.
    fn start(&self, cell: i64) -> u32 {
        (cell * i64::from(self.texels) / self.count) as u32
    }

    /// Index on the strip of a cell that may be beyond its ends.
    fn on_strip(&self, cell: i64) -> Option<i64> {
        let inside = (0..self.count).contains(&cell);
        if inside { Some(cell) } else { self.closed.then(|| cell.rem_euclid(self.count)) }
    }

    /// Runs of consecutive cells of the strip in `first..first + len`: position in that range, first cell, number of
    /// cells.
    fn runs(&self, first: i64, len: usize) -> Vec<(usize, i64, usize)> {
        let mut runs: Vec<(usize, i64, usize)> = Vec::new();
        for at in 0..len {
            let Some(cell) = self.on_strip(first + at as i64) else { continue };
            match runs.last_mut().filter(|(start, from, len)| (start + *len, from + *len as i64) == (at, cell)) {
                Some((_, _, len)) => *len += 1,
                None => runs.push((at, cell, 1)),
            }
        }
        runs
    }
}

impl TouchFields {
    /// Reads touches. `None` if there are none in the window, nor near it when smoothed over `spread_m`.
    pub fn over(
        window: &TexelWindow,
        strip: &FaceStrip,
        sums: &WallSums,
        cause: Cause,
        spread_m: Option<f64>,
    ) -> Option<TouchFields> {
        let Some(spread_m) = spread_m else { return TouchFields::alone(window, strip, sums, cause) };
        let spread = spread_m * strip.texels_per_metre;
        let cell = (spread / 3.0).floor().max(1.0);
        let across = TexelCells::new(strip.width, cell, strip.closed);
        let up = TexelCells::new(strip.height, cell, false);
        let x = SplineAxis::new(window.i0, window.width, across.spacing(), 0.5);
        let y = SplineAxis::new(window.j0, window.height, up.spacing(), 0.5);
        let kernel = half_gaussian(spread / cell);
        let cells = TexelWindow { texels_per_metre: 1.0, i0: x.first, j0: y.first, width: x.len, height: y.len };
        let around = cells.grown(kernel.len() - 1);

        let mut values = vec![0.0; around.texels()];
        let mut share = vec![0.0; around.texels()];
        let mut any = false;
        for (row, j, rows) in up.runs(around.j0, around.height) {
            for (column, i, columns) in across.runs(around.i0, around.width) {
                let place = CellBlock { cause, strip, across, up, cells: [i, j], count: [columns, rows] };
                any |= place.read(sums, &mut values, row * around.width + column, around.width);
                for line in share[row * around.width + column..].chunks_mut(around.width).take(rows) {
                    line[..columns].fill(1.0);
                }
            }
        }
        if !any {
            return None;
        }
        // Touches beyond the strip are unknown, so only wall counts in the mean.
        let (mut mean, share) = (blurred(&values, &around, &kernel), blurred(&share, &around, &kernel));
        for (mean, share) in mean.iter_mut().zip(share) {
            *mean /= share.max(1e-3);
        }
        let single = singles(window, strip, sums, cause);
        Some(TouchFields { single, mean: Some(SplineLattice::new(x, y, mean)) })
    }

    /// Reads touches without a local mean.
    fn alone(window: &TexelWindow, strip: &FaceStrip, sums: &WallSums, cause: Cause) -> Option<TouchFields> {
        let touched = sums.touched(cause, strip.face, window.i0 as u32, window.j0 as u32, window.width, window.height);
        touched.then(|| TouchFields { single: singles(window, strip, sums, cause), mean: None })
    }

    pub fn begin_row(&mut self, row: usize) {
        if let Some(mean) = &mut self.mean {
            mean.begin_row(row);
        }
    }

    /// Local mean density of the current row; 0 if not requested.
    pub fn expected(&self, out: &mut [f32]) {
        out.fill(0.0);
        if let Some(mean) = &self.mean {
            mean.add_to(0, out);
        }
    }
}

/// Sums of a window, per texel.
fn singles(window: &TexelWindow, strip: &FaceStrip, sums: &WallSums, cause: Cause) -> Vec<u32> {
    let mut single = vec![0; window.texels()];
    let TexelWindow { i0, j0, width, height, .. } = *window;
    sums.read(cause, strip.face, i0 as u32, j0 as u32, width, height, &mut single);
    single
}

/// A rectangle of cells on a strip.
struct CellBlock<'a> {
    cause: Cause,
    strip: &'a FaceStrip,
    across: TexelCells,
    up: TexelCells,
    cells: [i64; 2],
    count: [usize; 2],
}

impl CellBlock<'_> {
    /// Writes cells' mean densities from `out[at]`, in rows of `stride`; `false` if all are zero.
    fn read(&self, sums: &WallSums, out: &mut [f32], at: usize, stride: usize) -> bool {
        let CellBlock { cause, strip, across, up, cells: [i, j], count: [columns, rows] } = self;
        let (i0, i1) = (across.start(*i), across.start(i + *columns as i64));
        let (j0, j1) = (up.start(*j), up.start(j + *rows as i64));
        let (width, height) = ((i1 - i0) as usize, (j1 - j0) as usize);
        if !sums.touched(*cause, strip.face, i0, j0, width, height) {
            return false;
        }
        let mut texels = vec![0; width * height];
        sums.read(*cause, strip.face, i0, j0, width, height, &mut texels);
        for (row, out) in out[at..].chunks_mut(stride).take(*rows).enumerate() {
            let (from, to) = (up.start(j + row as i64) - j0, up.start(j + row as i64 + 1) - j0);
            for (column, out) in out[..*columns].iter_mut().enumerate() {
                let (left, right) = (across.start(i + column as i64) - i0, across.start(i + column as i64 + 1) - i0);
                let cell = (from..to).flat_map(|row| {
                    let line = &texels[row as usize * width..];
                    &line[left as usize..right as usize]
                });
                let sum: f64 = cell.map(|&sum| f64::from(sum)).sum();
                let area = f64::from((to - from) * (right - left)).max(1.0);
                *out = (sum / area / f64::from(DENSITY_ONE)) as f32;
            }
        }
        true
    }
}
