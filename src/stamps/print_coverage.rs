//! Coverage of one print in one window, read from its plate.

use std::ops::Range;

use super::lanes::{LANES, Lanes};
use super::shadow::Shadow;
use super::window::{TexelBounds, TexelWindow, WINDOW};

/// Rows of a print's coverage in a window; each thread reuses one buffer.
#[derive(Debug)]
pub(crate) struct PrintCoverage {
    spans: Vec<[i32; 2]>,
    coverage: Vec<u8>,
    filled: Vec<FilledRow>,
}

/// A row of a window that a print touches.
#[derive(Clone, Debug)]
struct FilledRow {
    row: usize,
    /// Range of the row, in lanes.
    lanes: Range<usize>,
}

/// A row of coverage with its position.
pub(super) struct CoverageRow<'a> {
    /// Row of the floor grid.
    pub(super) j: i64,
    /// First texel and row, relative to the print's origin.
    pub(super) di: i32,
    pub(super) dj: i32,
    /// Index of the first lane on the floor.
    pub(super) first_lanes: u32,
    pub(super) coverage: &'a [Lanes<u8>],
    /// Cells under the row, in lanes of the window.
    pub(super) cells: Range<usize>,
}

impl PrintCoverage {
    pub(crate) fn new() -> PrintCoverage {
        PrintCoverage {
            spans: vec![[0; 2]; WINDOW],
            coverage: vec![0; WINDOW * WINDOW],
            filled: Vec::with_capacity(WINDOW),
        }
    }

    /// Reads the part of a print in a window; texels are counted from `origin`.
    ///
    /// `spans` finds the range of texels of each row from a given row on, within limits; `read` takes the first texel
    /// of a row, the row, and the output.
    #[inline]
    pub(super) fn fill(
        &mut self,
        origin: [i64; 2],
        bounds: TexelBounds,
        window: TexelWindow,
        spans: impl FnOnce(i32, [i32; 2], &mut [[i32; 2]]),
        read: impl Fn(i32, i32, &mut [u8]),
    ) {
        self.filled.clear();
        let first = bounds.j0.max(window.j0);
        let rows = (bounds.j1.min(window.j0 + WINDOW as i64) - first).max(0) as usize;
        let dj = (first - origin[1]) as i32;
        // The window's columns relative to the origin.
        let left = (window.i0 - origin[0]) as i32;
        spans(dj, [left, left + WINDOW as i32], &mut self.spans[..rows]);
        for (k, &[low, high]) in self.spans[..rows].iter().enumerate() {
            if low >= high {
                continue;
            }
            let row = (first - window.j0) as usize + k;
            let columns = (low - left) as usize..(high - left) as usize;
            let lanes = columns.start / LANES..columns.end.div_ceil(LANES);
            let coverage = &mut self.coverage[row * WINDOW..][..WINDOW];
            let (in_lanes, _) = coverage.as_chunks_mut::<LANES>();
            in_lanes[lanes.start] = [0; LANES];
            in_lanes[lanes.end - 1] = [0; LANES];
            read(low, dj + k as i32, &mut coverage[columns]);
            self.filled.push(FilledRow { row, lanes });
        }
    }

    /// Sets the coverage behind walls to 0.
    pub(super) fn hide(&mut self, shadow: &Shadow, window: TexelWindow) {
        for FilledRow { row, lanes } in &self.filled {
            let columns = lanes.start * LANES..lanes.end * LANES;
            let square = [window.i0 + columns.start as i64, window.j0 + *row as i64];
            shadow.hide(square, &mut self.coverage[row * WINDOW..][columns]);
        }
    }

    /// Iterates over the rows that were filled.
    #[inline]
    pub(super) fn rows(&self, origin: [i64; 2], window: TexelWindow) -> impl Iterator<Item = CoverageRow<'_>> {
        self.filled.iter().map(move |FilledRow { row, lanes }| {
            let i = window.i0 + (lanes.start * LANES) as i64;
            let j = window.j0 + *row as i64;
            let (coverage, _) = self.coverage.as_chunks::<LANES>();
            let cells = row * (WINDOW / LANES) + lanes.start..row * (WINDOW / LANES) + lanes.end;
            CoverageRow {
                j,
                di: (i - origin[0]) as i32,
                dj: (j - origin[1]) as i32,
                first_lanes: (i / LANES as i64) as u32,
                coverage: &coverage[cells.clone()],
                cells,
            }
        })
    }
}
