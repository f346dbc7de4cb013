//! Smooth fields from values on a square lattice, by quadratic B-splines evaluated row by row.
//!
//! A quadratic B-spline has a continuous slope, reproduces linear ramps exactly, and uses three values per axis: no
//! blocks, creases or overshoot.

use crate::math::{Rect, vec2};

/// A rectangle of texels of the floor. Texel (i, j) covers `[i, i+1)/t x [j, j+1)/t` metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TexelWindow {
    pub texels_per_metre: f64,
    pub i0: i64,
    pub j0: i64,
    pub width: usize,
    pub height: usize,
}

impl TexelWindow {
    pub fn texels(&self) -> usize {
        self.width * self.height
    }

    /// Area of floor covered, metres.
    pub fn area_m(&self) -> Rect {
        let corner = |i: i64, j: i64| vec2(i as f64, j as f64) / self.texels_per_metre;
        let (i1, j1) = (self.i0 + self.width as i64, self.j0 + self.height as i64);
        Rect { min: corner(self.i0, self.j0), max: corner(i1, j1) }
    }

    /// Whether any texel of `part` is set in a mask of this window.
    pub fn any_in(&self, part: &TexelWindow, mask: &[bool]) -> bool {
        let clip = |first: i64, count: usize, size: usize| {
            let low = first.clamp(0, size as i64);
            low as usize..(first + count as i64).clamp(low, size as i64) as usize
        };
        let columns = clip(part.i0 - self.i0, part.width, self.width);
        let mut rows = clip(part.j0 - self.j0, part.height, self.height);
        rows.any(|row| mask[row * self.width..][columns.clone()].contains(&true))
    }

    /// Returns the window with a texel more to the left and below: slopes are differences to those.
    pub fn with_neighbours(&self) -> TexelWindow {
        TexelWindow { i0: self.i0 - 1, j0: self.j0 - 1, width: self.width + 1, height: self.height + 1, ..*self }
    }

    /// Returns the window enlarged by `by` texels on every side.
    pub fn grown(&self, by: usize) -> TexelWindow {
        TexelWindow {
            i0: self.i0 - by as i64,
            j0: self.j0 - by as i64,
            width: self.width + 2 * by,
            height: self.height + 2 * by,
            ..*self
        }
    }
}

/// Spline weights of a row of texels along one axis of a lattice.
///
/// A texel's weights depend only on its number on the whole floor, so every rectangle that contains the texel gets the
/// same value.
#[derive(Clone, Debug)]
pub(super) struct SplineAxis {
    /// Index of the first lattice value needed.
    pub first: i64,
    /// Number of lattice values needed.
    pub len: usize,
    /// Runs of texels that use the same three values.
    runs: Vec<SplineRun>,
    /// Weights of the three values, per texel.
    weights: [Vec<f32>; 3],
}

/// Weights of the values before, at and after the nearest one, `f` from it, -0.5 to 0.5.
pub(super) fn spline_weights(f: f32) -> [f32; 3] {
    [0.5 * (0.5 - f) * (0.5 - f), 0.75 - f * f, 0.5 * (0.5 + f) * (0.5 + f)]
}

/// Texels `start..end` use the lattice values `base..base + 3`.
#[derive(Clone, Copy, Debug)]
struct SplineRun {
    base: u32,
    start: u32,
    end: u32,
}

impl SplineAxis {
    /// Weights for `count` texels from `texel0`. Lattice value k is at `spacing * (k + offset)` texels.
    pub fn new(texel0: i64, count: usize, spacing: f64, offset: f64) -> SplineAxis {
        let place = |k: usize| ((texel0 + k as i64) as f64 + 0.5) / spacing - offset;
        let first = (place(0) + 0.5).floor() as i64 - 1;
        let mut runs: Vec<SplineRun> = Vec::new();
        let mut weights: [Vec<f32>; 3] = std::array::from_fn(|_| Vec::with_capacity(count));
        for k in 0..count {
            let u = place(k);
            let middle = (u + 0.5).floor();
            let base = (middle as i64 - 1 - first) as u32;
            match runs.last_mut().filter(|run| run.base == base) {
                Some(run) => run.end += 1,
                None => runs.push(SplineRun { base, start: k as u32, end: k as u32 + 1 }),
            }
            let of_values = spline_weights((u - middle) as f32);
            weights.iter_mut().zip(of_values).for_each(|(weights, weight)| weights.push(weight));
        }
        let len = runs.last().map_or(0, |run| run.base as usize + 3);
        SplineAxis { first, len, runs, weights }
    }

    /// Index of the first of a texel's three values, and their weights.
    fn at(&self, texel: usize) -> (usize, [f32; 3]) {
        let run = self.runs.partition_point(|run| run.end as usize <= texel);
        (self.runs[run].base as usize, self.weights.each_ref().map(|weights| weights[texel]))
    }
}

/// Values on a lattice, for evaluation at texels.
#[derive(Clone, Debug)]
pub(super) struct SplineLattice {
    pub x: SplineAxis,
    pub y: SplineAxis,
    /// Row-major, `x.len` by `y.len`.
    values: Vec<f32>,
    row: Vec<f32>,
}

impl SplineLattice {
    /// Creates a lattice with row-major values, `x.len` by `y.len`.
    pub fn new(x: SplineAxis, y: SplineAxis, values: Vec<f32>) -> SplineLattice {
        debug_assert_eq!(values.len(), x.len * y.len);
        let row = vec![0.0; x.len];
        SplineLattice { x, y, values, row }
    }

    /// Moves to a row of texels; evaluates the spline along y.
    pub fn begin_row(&mut self, row: usize) {
        let (base, [below, middle, above]) = self.y.at(row);
        let n = self.x.len;
        let (first, rest) = self.values[base * n..(base + 3) * n].split_at(n);
        let (second, third) = rest.split_at(n);
        for (((out, a), b), c) in self.row.iter_mut().zip(first).zip(second).zip(third) {
            *out = below * a + middle * b + above * c;
        }
    }

    /// Adds the field to the texels `start..start + out.len()` of the current row.
    pub fn add_to(&self, start: usize, out: &mut [f32]) {
        let end = start + out.len();
        let first = self.x.runs.partition_point(|run| run.end as usize <= start);
        let [left, middle, right] = &self.x.weights;
        for run in self.x.runs[first..].iter().take_while(|run| (run.start as usize) < end) {
            let (from, to) = ((run.start as usize).max(start), (run.end as usize).min(end));
            let values = &self.row[run.base as usize..run.base as usize + 3];
            let (a, b, c) = (values[0], values[1], values[2]);
            let out = &mut out[from - start..to - start];
            let (left, middle, right) = (&left[from..to], &middle[from..to], &right[from..to]);
            // Runs of fine noise are a texel or two long: iterators over four slices would cost more than the sum.
            for k in 0..to - from {
                out[k] += left[k] * a + middle[k] * b + right[k] * c;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lattice(x: SplineAxis, y: SplineAxis, value: impl Fn(i64, i64) -> f32) -> SplineLattice {
        let place = |n: usize| (x.first + (n % x.len) as i64, y.first + (n / x.len) as i64);
        let values = (0..x.len * y.len).map(place).map(|(i, j)| value(i, j)).collect();
        SplineLattice::new(x, y, values)
    }

    fn read(lattice: &mut SplineLattice, width: usize, row: usize) -> Vec<f32> {
        let mut out = vec![0.0; width];
        lattice.begin_row(row);
        lattice.add_to(0, &mut out);
        out
    }

    #[test]
    fn a_ramp_stays_a_ramp() {
        // Values at the centres of cells of 4 texels.
        let axis = |from: i64, n| SplineAxis::new(from, n, 4.0, 0.5);
        let mut lattice = lattice(axis(-7, 30), axis(9, 5), |i, j| (3 * i - j) as f32);
        for row in 0..5 {
            for (k, value) in read(&mut lattice, 30, row).into_iter().enumerate() {
                let x = (k as f64 - 7.0 + 0.5) / 4.0 - 0.5;
                let y = (row as f64 + 9.0 + 0.5) / 4.0 - 0.5;
                assert!((f64::from(value) - (3.0 * x - y)).abs() < 1e-4, "{k} {row}: {value}");
            }
        }
    }

    #[test]
    fn a_texel_has_the_same_value_in_every_window() {
        let value = |i: i64, j: i64| ((i * 31 + j * 17) % 23) as f32;
        let mut whole = lattice(SplineAxis::new(-50, 100, 3.7, 0.2), SplineAxis::new(0, 10, 3.7, 0.2), value);
        let mut part = lattice(SplineAxis::new(-3, 20, 3.7, 0.2), SplineAxis::new(6, 2, 3.7, 0.2), value);
        assert_eq!(read(&mut whole, 100, 7)[47..67], read(&mut part, 20, 1)[..]);
    }
}
