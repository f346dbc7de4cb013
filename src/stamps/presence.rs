//! Presence kernel of a footfall: the expected print over many passes of one person.
//!
//! The kernel is `3 / (pi a b) (1 - r^2)^2` on the ellipse `r < 1` along the heading. Its half axes a and b are `sqrt
//! 8` times the standard deviations. It resembles a Gaussian with bounded support. Kernels are precomputed for 64
//! headings over 180 degrees (a kernel is symmetric) and 4 x 4 positions within a cell.

use super::StampOptions;
use super::lanes::{LANES, Lanes, Scaling, SumCell, add_lanes, upper};
use super::shadow::{Shadow, StampExtent};
use super::window::{TexelBounds, TexelWindow, WINDOW, floor};
use crate::math::{Vec2, atan2, sin_cos, vec2};

const HEADINGS: usize = 64;
const PHASES: usize = 4;

/// The precomputed kernels for one cell size.
#[derive(Debug)]
pub(super) struct Kernels {
    cell_m: f64,
    cells_per_m: f64,
    /// Half axes, metres.
    half_along_m: f64,
    half_across_m: f64,
    kernels: Vec<Kernel>,
    rows: Vec<KernelRow>,
    /// Shares of the integral, in units of `1 / unit`.
    values: Vec<Lanes<u16>>,
    unit: f32,
}

/// One kernel: rows from `j0` on, relative to the foot's cell.
#[derive(Clone, Copy, Debug)]
struct Kernel {
    j0: i16,
    first_row: u32,
    rows: u16,
    /// Range of columns of its rows.
    i0: i16,
    i1: i16,
}

#[derive(Clone, Copy, Debug)]
struct KernelRow {
    i0: i16,
    length: u16,
    /// Index of its first lane in `values`.
    first_lanes: u32,
}

/// A placed kernel: its index, cell and amount.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedKernel {
    cell: [i32; 2],
    number: u16,
    /// Amount that a kernel value of 65536 adds to a cell, in the scaling.
    factor: u16,
    scaling: Scaling,
}

impl Kernels {
    pub(super) fn new(cells_per_metre: f64, options: &StampOptions) -> Kernels {
        let cell_m = 1.0 / cells_per_metre;
        let half_axis = |deviation_m: f64| deviation_m * 8.0f64.sqrt();
        let mut bank = Kernels {
            cell_m,
            cells_per_m: cells_per_metre,
            half_along_m: half_axis(options.presence_along_m),
            half_across_m: half_axis(options.presence_across_m),
            kernels: Vec::with_capacity(HEADINGS * PHASES * PHASES),
            rows: Vec::new(),
            values: Vec::new(),
            unit: 1.0,
        };
        let shares: Vec<Shares> = (0..HEADINGS * PHASES * PHASES).map(|number| bank.shares(number)).collect();
        let peak = shares.iter().flat_map(|s| &s.values).fold(0.0, |a: f64, &b| a.max(b));
        // The largest share takes up all 16 bits.
        let unit = 65_535.0 / peak.max(1e-9);
        bank.unit = unit as f32;
        shares.iter().for_each(|s| bank.push(s, unit));
        bank
    }

    /// Extent of a kernel: slightly more than its ellipse, for the rounding of the heading.
    pub(super) fn extent(&self, middle_m: Vec2, heading: Vec2) -> StampExtent {
        let turned_aside_m = self.half_along_m * (0.5 * std::f64::consts::PI / HEADINGS as f64);
        StampExtent {
            middle_m,
            heading,
            half_along_m: self.half_along_m + self.cell_m,
            half_across_m: self.half_across_m + self.cell_m + turned_aside_m,
        }
    }

    /// Computes the shares of cells around a position. `number` encodes heading and position in the cell.
    fn shares(&self, number: usize) -> Shares {
        let (sin, cos) = sin_cos(std::f64::consts::PI * (number / (PHASES * PHASES)) as f64 / HEADINGS as f64);
        let phase = |k: usize| (k as f64 + 0.5) / PHASES as f64;
        let middle = vec2(phase(number % PHASES), phase(number / PHASES % PHASES)) * self.cell_m;
        let reach = (self.half_along_m.max(self.half_across_m) / self.cell_m).ceil() as i32 + 1;
        let size = (2 * reach + 1) as usize;
        // Coarse cells hold means over several points.
        let parts = (self.cell_m / (0.3 * self.half_across_m)).ceil().clamp(1.0, 24.0) as usize;
        let mut values = vec![0.0; size * size];
        for (k, value) in values.iter_mut().enumerate() {
            let corner = vec2(f64::from((k % size) as i32 - reach), f64::from((k / size) as i32 - reach)) * self.cell_m;
            for part in 0..parts * parts {
                let offset =
                    vec2((part % parts) as f64 + 0.5, (part / parts) as f64 + 0.5) * (self.cell_m / parts as f64);
                let d = corner + offset - middle;
                let along = (d.x * cos + d.y * sin) / self.half_along_m;
                let across = (d.y * cos - d.x * sin) / self.half_across_m;
                let inside = (1.0 - along * along - across * across).max(0.0);
                *value += inside * inside;
            }
        }
        let total: f64 = values.iter().sum();
        if total > 0.0 {
            values.iter_mut().for_each(|v| *v /= total);
        } else {
            values[size * size / 2] = 1.0;
        }
        Shares { reach, size, values }
    }

    fn push(&mut self, shares: &Shares, unit: f64) {
        // The rounding remainder is carried on, so that the shares sum to 1.
        let mut remainder = 0.0;
        let whole: Vec<u16> = shares
            .values
            .iter()
            .map(|share| {
                let wanted = share * unit + if *share > 0.0 { remainder } else { 0.0 };
                let rounded = wanted.round().clamp(0.0, 65_535.0);
                if *share > 0.0 {
                    remainder = wanted - rounded;
                }
                rounded as u16
            })
            .collect();
        let rows: Vec<&[u16]> = whole.chunks_exact(shares.size).collect();
        let filled = |row: &&&[u16]| row.iter().any(|&v| v > 0);
        let first = rows.iter().position(|row| filled(&row)).unwrap_or(0);
        let last = rows.iter().rposition(|row| filled(&row)).unwrap_or(first);
        let first_row = self.rows.len();
        for row in &rows[first..=last] {
            let start = row.iter().position(|&v| v > 0).unwrap_or(0);
            let end = row.iter().rposition(|&v| v > 0).map_or(start, |k| k + 1);
            self.rows.push(KernelRow {
                i0: (start as i32 - shares.reach) as i16,
                length: (end - start) as u16,
                first_lanes: self.values.len() as u32,
            });
            let padded = |lane: &[u16]| std::array::from_fn(|k| lane.get(k).copied().unwrap_or(0));
            self.values.extend(row[start..end].chunks(LANES).map(padded));
        }
        let rows = &self.rows[first_row..];
        self.kernels.push(Kernel {
            j0: (first as i32 - shares.reach) as i16,
            first_row: first_row as u32,
            rows: rows.len() as u16,
            i0: rows.iter().map(|r| r.i0).min().unwrap_or(0),
            i1: rows.iter().map(|r| r.i0 + r.length as i16).max().unwrap_or(0),
        });
    }

    /// Finds the kernel for a position and a heading.
    pub(super) fn find(&self, place_m: Vec2, heading: Vec2) -> FoundKernel {
        let turn = atan2(heading.y, heading.x) / std::f64::consts::PI;
        let angle = floor(turn * HEADINGS as f64 + 0.5);
        let number = angle.rem_euclid(HEADINGS as i64) as usize;
        let [x, y] = [place_m.x, place_m.y].map(|m| m * self.cells_per_m);
        let cell = [floor(x), floor(y)];
        let phase = |v: f64, cell: i64| (((v - cell as f64) * PHASES as f64) as usize).min(PHASES - 1);
        let number = (number * PHASES + phase(y, cell[1])) * PHASES + phase(x, cell[0]);
        FoundKernel { number: number as u16, cell: cell.map(|k| k as i32) }
    }

    /// Places a kernel with the integral `amount` over all cells.
    pub(super) fn place(&self, found: FoundKernel, amount: f32) -> PlacedKernel {
        let peak = amount / self.unit * 65_536.0;
        let scaling = Scaling::for_most(peak);
        let factor = (peak * scaling.factor() + 0.5) as u16;
        PlacedKernel { number: found.number, cell: found.cell, factor, scaling }
    }

    /// Cells that a kernel touches.
    pub(super) fn bounds(&self, found: FoundKernel) -> TexelBounds {
        let kernel = self.kernels[usize::from(found.number)];
        let [i, j] = found.cell.map(i64::from);
        let j0 = j + i64::from(kernel.j0);
        let rows = i64::from(kernel.rows);
        TexelBounds { i0: i + i64::from(kernel.i0), i1: i + i64::from(kernel.i1), j0, j1: j0 + rows }
    }

    fn rows_of(&self, kernel: Kernel) -> &[KernelRow] {
        &self.rows[kernel.first_row as usize..][..usize::from(kernel.rows)]
    }

    fn values_of(&self, row: KernelRow) -> &[Lanes<u16>] {
        &self.values[row.first_lanes as usize..][..usize::from(row.length).div_ceil(LANES)]
    }

    /// Share of a kernel behind walls.
    pub(super) fn share_hidden(&self, found: FoundKernel, shadow: &Shadow) -> f32 {
        let kernel = self.kernels[usize::from(found.number)];
        let mut sum = 0.0;
        for (k, &row) in self.rows_of(kernel).iter().enumerate() {
            let j = i64::from(found.cell[1]) + i64::from(kernel.j0) + k as i64;
            let mut i = i64::from(found.cell[0]) + i64::from(row.i0);
            for values in self.values_of(row) {
                let mut reached = [0.0; LANES];
                shadow.reached([i, j], &mut reached);
                sum += values.iter().zip(&reached).map(|(&v, r)| f32::from(v) * (1.0 - r)).sum::<f32>();
                i += LANES as i64;
            }
        }
        sum / self.unit
    }

    /// Upper bound on a placed kernel's value in a cell.
    pub(super) fn peak(&self, placed: &PlacedKernel) -> u32 {
        (u32::from(placed.factor) >> placed.scaling.shift) + 1
    }

    /// Adds a kernel to the cells of a window, except those behind walls.
    pub(super) fn add<C: SumCell>(
        &self,
        placed: &PlacedKernel,
        shadow: Option<&Shadow>,
        window: TexelWindow,
        cells: &mut [C],
    ) {
        let kernel = self.kernels[usize::from(placed.number)];
        let from_window = i64::from(placed.cell[0]) - window.i0;
        let first_row = i64::from(placed.cell[1]) + i64::from(kernel.j0) - window.j0;
        for (k, &row) in self.rows_of(kernel).iter().enumerate() {
            let j = first_row + k as i64;
            let start = i64::from(row.i0) + from_window;
            if j < 0 || j >= WINDOW as i64 {
                continue;
            }
            let cells = &mut cells[j as usize * WINDOW..][..WINDOW];
            for (values, column) in self.values_of(row).iter().zip((start..).step_by(LANES)) {
                let amounts = placed.amounts(values);
                let within = usize::try_from(column).ok().and_then(|c| cells.get_mut(c..)?.first_chunk_mut::<LANES>());
                match (shadow, within) {
                    (None, Some(cells)) => add_lanes(cells, &amounts),
                    _ => {
                        let mut reached = [1.0; LANES];
                        if let Some(shadow) = shadow {
                            shadow.reached([column + window.i0, j + window.j0], &mut reached);
                        }
                        for ((column, amount), reached) in (column..).zip(amounts).zip(reached) {
                            // A cell cut by a wall gets the full amount.
                            if reached > 0.0 && column >= 0 && column < WINDOW as i64 {
                                cells[column as usize].add(amount);
                            }
                        }
                    }
                }
            }
        }
    }
}

impl PlacedKernel {
    /// Amounts for a row of kernel values.
    #[inline]
    fn amounts(self, values: &Lanes<u16>) -> Lanes<u16> {
        let (factor, half, shift) = (self.factor, self.scaling.half(), self.scaling.shift);
        values.map(|value| upper(value, factor).saturating_add(half) >> shift)
    }
}

/// Index of a kernel and the cell of its origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct FoundKernel {
    number: u16,
    cell: [i32; 2],
}

/// An unrounded kernel: a square of cells around the position.
struct Shares {
    reach: i32,
    size: usize,
    values: Vec<f64>,
}
