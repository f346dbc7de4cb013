//! A square grid of cells for spatial lookup.

use crate::math::{Rect, Vec2};

/// Grid of square cells over a rectangle, by column and row from its least x and y.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    origin: Vec2,
    cell: f64,
    columns: usize,
    rows: usize,
}

impl Grid {
    /// Covers `area` and half a cell around it with cells of side `cell`.
    pub(super) fn new(area: Rect, cell: f64) -> Grid {
        let area = area.grown(cell * 0.5);
        let count = |length: f64| (length / cell) as usize + 1;
        Grid { origin: area.min, cell, columns: count(area.width()), rows: count(area.height()) }
    }

    /// Number of rows.
    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    /// Number of cells.
    pub(super) fn cells(&self) -> usize {
        self.columns * self.rows
    }

    /// Index of a cell by column and row.
    pub(super) fn cell(&self, column: usize, row: usize) -> usize {
        row * self.columns + column
    }

    /// Column that holds `x`, clamped to the grid.
    pub(super) fn column_of(&self, x: f64) -> usize {
        (((x - self.origin.x) / self.cell).max(0.0) as usize).min(self.columns - 1)
    }

    /// Row that holds `y`, clamped to the grid.
    pub(super) fn row_of(&self, y: f64) -> usize {
        (((y - self.origin.y) / self.cell).max(0.0) as usize).min(self.rows - 1)
    }

    /// Calls `visit` with every cell that the segment passes until it returns false.
    pub(super) fn cells_along(&self, a: Vec2, b: Vec2, mut visit: impl FnMut(usize) -> bool) {
        let (low, high) = if a.y <= b.y { (a, b) } else { (b, a) };
        for row in self.row_of(low.y)..=self.row_of(high.y) {
            // The part of the segment in this row, slightly longer so that rounding never skips a cell.
            let bottom = self.origin.y + row as f64 * self.cell - 1e-9;
            let top = bottom + self.cell + 2e-9;
            let x_at = |y: f64| {
                if high.y - low.y < 1e-12 {
                    return None;
                }
                Some(low.x + (high.x - low.x) * ((y - low.y) / (high.y - low.y)).clamp(0.0, 1.0))
            };
            let (x0, x1) = match (x_at(bottom), x_at(top)) {
                (Some(x0), Some(x1)) => (x0, x1),
                _ => (low.x, high.x),
            };
            for column in self.column_of(x0.min(x1) - 1e-9)..=self.column_of(x0.max(x1) + 1e-9) {
                if !visit(self.cell(column, row)) {
                    return;
                }
            }
        }
    }
}
