//! Neighbour search: bodies sorted into a uniform grid, rebuilt every step.

use std::ops::Range;

use super::state::BodyState;
use crate::math::Rect;

/// Lanes of a vector register: others are weighed so many at a time.
pub(super) const LANES: usize = 8;
/// Place of unused lanes, metres: farther away than anything that matters.
pub(super) const NOWHERE_M: f32 = 1e3;

/// Bodies by grid cell. Cells run row by row, bodies in a cell by slot, so that the order is the same however the
/// work is split; the cells of a row lie side by side, so that a neighbourhood is one stretch for each row.
#[derive(Debug, Default)]
pub(super) struct NeighbourGrid {
    origin: [f32; 2],
    cells_per_m: f32,
    columns: usize,
    rows: usize,
    /// Period in x, metres, if the columns go round.
    period_x_m: Option<f32>,
    /// First index of each cell, and the end behind the last.
    starts: Vec<u32>,
    cell_of_slot: Vec<u32>,
    /// Bodies in the order of cells.
    pub(super) bodies: Vec<BodyState>,
    /// Slot of each of them.
    pub(super) slots: Vec<u32>,
    /// Index among them of each slot's body.
    pub(super) index_of_slot: Vec<u32>,
}

impl NeighbourGrid {
    /// A grid over `area` whose cells are at least `cell_m` wide; with a period in x, from x = 0 to the period.
    pub(super) fn new(area: Rect, cell_m: f32, period_x_m: Option<f32>) -> NeighbourGrid {
        let rows = (area.height() as f32 / cell_m).ceil().max(1.0) as usize;
        let (left, columns, cell_m) = match period_x_m {
            // A whole number of columns, three at least so that a body is never on both sides of another.
            Some(period) => {
                let columns = (period / cell_m).floor().max(3.0);
                (0.0, columns as usize, period / columns)
            }
            None => (area.min.x as f32, (area.width() as f32 / cell_m).ceil().max(1.0) as usize, cell_m),
        };
        NeighbourGrid {
            origin: [left, area.min.y as f32],
            cells_per_m: 1.0 / cell_m,
            columns,
            rows,
            period_x_m,
            starts: vec![0; columns * rows + 1],
            ..NeighbourGrid::default()
        }
    }

    fn column_row(&self, x: f32, y: f32) -> [usize; 2] {
        let column = ((x - self.origin[0]) * self.cells_per_m).max(0.0) as usize;
        let row = ((y - self.origin[1]) * self.cells_per_m).max(0.0) as usize;
        [column.min(self.columns - 1), row.min(self.rows - 1)]
    }

    /// Sorts the bodies again.
    pub(super) fn rebuild(&mut self, bodies: &[BodyState]) {
        let mut cells = std::mem::take(&mut self.cell_of_slot);
        cells.clear();
        cells.extend(bodies.iter().map(|body| {
            let [column, row] = self.column_row(body.x, body.y);
            (row * self.columns + column) as u32
        }));
        // Counting sort: how many there are in each cell, where each cell ends, then each body to its place.
        self.starts.fill(0);
        for &cell in &cells {
            self.starts[cell as usize] += 1;
        }
        let mut sum = 0;
        for start in &mut self.starts {
            sum += *start;
            *start = sum;
        }
        self.bodies.resize(bodies.len(), BodyState::default());
        self.slots.resize(bodies.len(), 0);
        self.index_of_slot.resize(bodies.len(), 0);
        // Backwards, so that each cell's end walks back to its beginning and slots stay in order.
        for (slot, &cell) in cells.iter().enumerate().rev() {
            let start = &mut self.starts[cell as usize];
            *start -= 1;
            let place = *start as usize;
            self.bodies[place] = bodies[slot];
            self.slots[place] = slot as u32;
            self.index_of_slot[slot] = place as u32;
        }
        self.cell_of_slot = cells;
    }

    /// Calls `visit` with the ranges of [`NeighbourGrid::bodies`] in the nine cells around a place.
    ///
    /// The second argument is to be added to their x: a period, for those seen across its end.
    #[inline]
    pub(super) fn around(&self, x: f32, y: f32, mut visit: impl FnMut(Range<usize>, f32)) {
        let mut base_shift = 0.0;
        let mut x = x;
        if let Some(period) = self.period_x_m {
            // A place ahead may lie beyond the end.
            base_shift = if x >= period {
                period
            } else if x < 0.0 {
                -period
            } else {
                0.0
            };
            x -= base_shift;
        }
        let [column, row] = self.column_row(x, y);
        let last = self.columns - 1;
        for row in row.saturating_sub(1)..=(row + 1).min(self.rows - 1) {
            let base = row * self.columns;
            let mut stretch = |from: usize, to: usize, shift: f32| {
                let range = self.starts[base + from] as usize..self.starts[base + to + 1] as usize;
                visit(range, base_shift + shift);
            };
            match self.period_x_m {
                // Round the period: the column on the other side is a stretch of its own.
                Some(period) if column == 0 => {
                    stretch(last, last, -period);
                    stretch(0, 1, 0.0);
                }
                Some(period) if column == last => {
                    stretch(last - 1, last, 0.0);
                    stretch(0, 0, period);
                }
                _ => stretch(column.saturating_sub(1), (column + 1).min(last), 0.0),
            }
        }
    }

    /// Calls `visit` with the ranges in all cells that come nearer than `reach_m`, as [`NeighbourGrid::around`] does.
    ///
    /// Round a period some bodies are found on either side: of these, one at most lies within half a period.
    #[inline]
    pub(super) fn within(&self, x: f32, y: f32, reach_m: f32, mut visit: impl FnMut(Range<usize>, f32)) {
        let across = (reach_m * self.cells_per_m).ceil().max(1.0) as usize;
        let [column, row] = self.column_row(x, y);
        for row in row.saturating_sub(across)..=(row + across).min(self.rows - 1) {
            let base = row * self.columns;
            let mut stretch = |from: usize, to: usize, shift: f32| {
                let range = self.starts[base + from] as usize..self.starts[base + to] as usize;
                if !range.is_empty() {
                    visit(range, shift);
                }
            };
            let (from, to) = (column.saturating_sub(across), (column + across + 1).min(self.columns));
            stretch(from, to, 0.0);
            if let Some(period) = self.period_x_m {
                let before = across.saturating_sub(column).min(self.columns);
                stretch(self.columns - before, self.columns, -period);
                let behind = (column + across + 1).saturating_sub(self.columns).min(self.columns);
                stretch(0, behind, period);
            }
        }
    }

    /// Shortest difference in x from `a` to `b`, round the period if there is one, metres.
    #[inline]
    pub(super) fn dx(&self, a: f32, b: f32) -> f32 {
        let dx = b - a;
        match self.period_x_m {
            Some(period) if dx > 0.5 * period => dx - period,
            Some(period) if dx < -0.5 * period => dx + period,
            _ => dx,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Vec2, vec2};

    fn body(x: f32, y: f32) -> BodyState {
        BodyState { x, y, ..BodyState::default() }
    }

    #[test]
    fn everybody_near_is_found_once_and_the_sorting_keeps_them_all() {
        let area = Rect { min: Vec2::ZERO, max: vec2(20.0, 10.0) };
        for period in [None, Some(20.0f32)] {
            let mut grid = NeighbourGrid::new(area, 2.0, period);
            for count in [0usize, 1, 700] {
                let bodies: Vec<BodyState> =
                    (0..count).map(|k| body((k as f32 * 7.31) % 20.0, (k as f32 * 3.77) % 10.0)).collect();
                grid.rebuild(&bodies);
                for (slot, me) in bodies.iter().enumerate() {
                    assert_eq!(grid.slots[grid.index_of_slot[slot] as usize] as usize, slot);
                    assert_eq!(grid.bodies[grid.index_of_slot[slot] as usize], *me);
                    let mut seen = vec![0; count];
                    grid.around(me.x, me.y, |range, shift| {
                        for index in range {
                            seen[grid.slots[index] as usize] += 1;
                            let dx = grid.bodies[index].x + shift - me.x;
                            assert!((dx - grid.dx(me.x, grid.bodies[index].x)).abs() < 1e-4 || dx.abs() > 2.0);
                        }
                    });
                    for (other, &times) in bodies.iter().zip(&seen) {
                        let (dx, dy) = (grid.dx(me.x, other.x), other.y - me.y);
                        let near = dx * dx + dy * dy < 4.0;
                        assert!(times <= 1 && (!near || times == 1), "seen {times} times at {dx}, {dy}");
                    }
                }
            }
        }
    }
}
