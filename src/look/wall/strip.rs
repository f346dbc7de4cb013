//! The strip of one unrolled face.

use std::ops::Range;

use crate::look::lattice::TexelWindow;
use crate::look::noise;
use crate::stamps::WallGrid;

/// Properties of a face's strip.
#[derive(Clone, Copy, Debug)]
pub(super) struct FaceStrip {
    pub face: usize,
    pub texels_per_metre: f64,
    /// Number of columns and rows.
    pub width: u32,
    pub height: u32,
    /// Whether the last column joins the first.
    pub closed: bool,
    /// Key of the face's patterns.
    pub salt: u32,
}

/// A range of columns of a strip, and their position in a block.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ColumnRun {
    pub columns: Range<u32>,
    /// First column in the block.
    pub at: usize,
}

impl FaceStrip {
    pub fn of(grid: &WallGrid, face: usize) -> Option<FaceStrip> {
        let span = grid.faces.get(face)?;
        Some(FaceStrip {
            face,
            texels_per_metre: grid.texels_per_metre,
            width: span.width.max(1),
            height: grid.height.max(1),
            closed: span.closed,
            salt: noise::mix(face as u32 + 1),
        })
    }

    pub fn window(&self, columns: &Range<u32>, rows: &Range<u32>) -> TexelWindow {
        TexelWindow {
            texels_per_metre: self.texels_per_metre,
            i0: i64::from(columns.start),
            j0: i64::from(rows.start),
            width: columns.len(),
            height: rows.len(),
        }
    }

    /// Returns the strip's columns in a block of columns `i0..i0 + width`. A closed face wraps around as often as
    /// needed; an open one gives its part of the block, at least its first or last column.
    pub fn columns(&self, i0: i64, width: usize) -> Vec<ColumnRun> {
        if !self.closed {
            return vec![ColumnRun { columns: clamped(i0, width, self.width), at: 0 }];
        }
        let (mut runs, mut at) = (Vec::new(), 0);
        while at < width {
            let first = (i0 + at as i64).rem_euclid(i64::from(self.width)) as u32;
            let len = (width - at).min((self.width - first) as usize);
            runs.push(ColumnRun { columns: first..first + len as u32, at });
            at += len;
        }
        runs
    }

    /// Returns the strip's rows in a block of rows `j0..j0 + height`.
    pub fn rows(&self, j0: i64, height: usize) -> Range<u32> {
        clamped(j0, height, self.height)
    }
}

/// The part of `first..first + count` in `0..size`, or the nearest end if there is none.
fn clamped(first: i64, count: usize, size: u32) -> Range<u32> {
    let last = i64::from(size) - 1;
    let from = first.clamp(0, last);
    let to = (first.saturating_add(count as i64) - 1).clamp(from, last);
    from as u32..to as u32 + 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strip(closed: bool) -> FaceStrip {
        FaceStrip { face: 0, texels_per_metre: 100.0, width: 50, height: 20, closed, salt: 1 }
    }

    #[test]
    fn an_open_strip_ends_in_its_edge() {
        let open = strip(false);
        assert_eq!(open.columns(-8, 20), [ColumnRun { columns: 0..12, at: 0 }]);
        assert_eq!(open.columns(-20, 10), [ColumnRun { columns: 0..1, at: 0 }]);
        assert_eq!(open.columns(60, 10), [ColumnRun { columns: 49..50, at: 0 }]);
        assert_eq!((open.rows(-3, 5), open.rows(18, 9), open.rows(40, 2)), (0..2, 18..20, 19..20));
    }

    #[test]
    fn a_closed_strip_goes_round() {
        let runs = strip(true).columns(-8, 120);
        let shown = |columns, at| ColumnRun { columns, at };
        assert_eq!(runs, [shown(42..50, 0), shown(0..50, 8), shown(0..50, 58), shown(0..12, 108)]);
    }
}
