//! Who is near whom: bodies sorted into a uniform grid, rebuilt every step.

use super::state::Body;
use crate::math::Rect;

/// Bodies by grid cell. Cells run row by row, bodies in a cell by slot, so that the order is the same however the
/// work is split.
#[derive(Debug, Default)]
pub(super) struct Neighbours {
    origin: [f32; 2],
    cells_per_m: f32,
    columns: usize,
    rows: usize,
    /// Whether the columns go round.
    period_x_m: Option<f32>,
    starts: Vec<u32>,
    counts: Vec<u32>,
    touched: Vec<u32>,
    cell_of_slot: Vec<u32>,
    /// Bodies in the order of cells.
    pub(super) bodies: Vec<Body>,
    /// The slot that each of them has.
    pub(super) slots: Vec<u32>,
}

impl Neighbours {
    /// A grid over `area` whose cells are at least `cell_m` wide; with a period in x, from x = 0 to the period.
    pub(super) fn new(area: Rect, cell_m: f32, period_x_m: Option<f32>) -> Neighbours {
        let rows = (area.height() as f32 / cell_m).ceil().max(1.0) as usize;
        let (left, columns, cell_m) = match period_x_m {
            // A whole number of columns, three at least so that a body is never on both sides of another.
            Some(period) => {
                let columns = (period / cell_m).floor().max(3.0);
                (0.0, columns as usize, period / columns)
            }
            None => (area.min.x as f32, (area.width() as f32 / cell_m).ceil().max(1.0) as usize, cell_m),
        };
        Neighbours {
            origin: [left, area.min.y as f32],
            cells_per_m: 1.0 / cell_m,
            columns,
            rows,
            period_x_m,
            starts: vec![0; columns * rows],
            counts: vec![0; columns * rows],
            ..Neighbours::default()
        }
    }

    fn column_row(&self, x: f32, y: f32) -> [usize; 2] {
        let column = ((x - self.origin[0]) * self.cells_per_m).max(0.0) as usize;
        let row = ((y - self.origin[1]) * self.cells_per_m).max(0.0) as usize;
        [column.min(self.columns - 1), row.min(self.rows - 1)]
    }

    /// Sorts the bodies anew.
    pub(super) fn rebuild(&mut self, bodies: &[Body]) {
        for &cell in &self.touched {
            self.counts[cell as usize] = 0;
        }
        self.touched.clear();
        self.cell_of_slot.clear();
        for body in bodies {
            let [column, row] = self.column_row(body.x, body.y);
            let cell = row * self.columns + column;
            self.cell_of_slot.push(cell as u32);
            if self.counts[cell] == 0 {
                self.touched.push(cell as u32);
            }
            self.counts[cell] += 1;
        }
        // The order of cells matters for speed and for the order of sums.
        self.touched.sort_unstable();
        let mut start = 0;
        for &cell in &self.touched {
            self.starts[cell as usize] = start;
            start += self.counts[cell as usize];
            self.counts[cell as usize] = 0;
        }
        self.bodies.resize(bodies.len(), Body::default());
        self.slots.resize(bodies.len(), 0);
        for (slot, &cell) in self.cell_of_slot.iter().enumerate() {
            let place = (self.starts[cell as usize] + self.counts[cell as usize]) as usize;
            self.counts[cell as usize] += 1;
            self.bodies[place] = bodies[slot];
            self.slots[place] = slot as u32;
        }
    }

    /// Calls `visit` with the ranges of [`Neighbours::bodies`] in the nine cells around a place.
    #[inline]
    pub(super) fn around(&self, x: f32, y: f32, mut visit: impl FnMut(std::ops::Range<usize>)) {
        let [column, row] = self.column_row(x, y);
        for row in row.saturating_sub(1)..=(row + 1).min(self.rows - 1) {
            let base = row * self.columns;
            let mut cell = |column: usize| {
                let cell = base + column;
                let count = self.counts[cell] as usize;
                if count > 0 {
                    let start = self.starts[cell] as usize;
                    visit(start..start + count);
                }
            };
            if self.period_x_m.is_some() {
                cell((column + self.columns - 1) % self.columns);
                cell(column);
                cell((column + 1) % self.columns);
            } else {
                if column > 0 {
                    cell(column - 1);
                }
                cell(column);
                if column + 1 < self.columns {
                    cell(column + 1);
                }
            }
        }
    }

    /// The shortest way in x from `a` to `b`, round the period if there is one.
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
