use crate::math::{Vec2, vec2};
use crate::plan::{FloorPlan, PlanClass};

/// Least side of a cell, metres, and wanted number of cells.
const FINEST_M: f64 = 0.1;
const CELLS_WANTED: f64 = 4e6;

/// What a cell holds: a bit each.
pub(super) const BLOCKED: u8 = 1;
pub(super) const OUTSIDE: u8 = 2;
pub(super) const WALL: u8 = 4;
pub(super) const DOOR: u8 = 8;
pub(super) const STAIRS: u8 = 16;
/// Seats, tables and counters.
pub(super) const FURNITURE: u8 = 32;
pub(super) const FIXTURE: u8 = 64;
/// Seats and fixtures: what one person uses at a time.
pub(super) const SEAT: u8 = 128;

/// A plan in square cells, row by row from the top left.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    pub(super) cell_m: f64,
    pub(super) columns: usize,
    pub(super) rows: usize,
    height_m: f64,
    /// What each cell holds.
    pub(super) holds: Vec<u8>,
}

impl Grid {
    /// A cell is blocked if the middle of any of its pixels is no floor, so that the thinnest wall divides.
    pub(super) fn of(plan: &FloorPlan) -> Grid {
        let (width_m, height_m) = (plan.width_m(), plan.height_m());
        let cell_m = (width_m * height_m / CELLS_WANTED).sqrt().max(FINEST_M).max(plan.metres_per_pixel);
        let per_px = plan.metres_per_pixel / cell_m;
        let place = |px: usize| ((px as f64 + 0.5) * per_px) as usize;
        // The middle of the last pixel lies in the last cell: one without any would pass for floor.
        let width_px = plan.width_px as usize;
        let [columns, rows] = [width_px, plan.height_px as usize].map(|count| place(count.max(1) - 1) + 1);
        let mut holds = vec![0u8; columns * rows];
        let columns_of: Vec<usize> = (0..width_px).map(place).collect();
        for (y, (floor, classes)) in plan.floor.chunks(width_px).zip(plan.classes.chunks(width_px)).enumerate() {
            let row = place(y) * columns;
            for ((&floor, &class), &column) in floor.iter().zip(classes).zip(&columns_of) {
                if floor == 0 || class != PlanClass::Floor {
                    holds[row + column] |= of_class(class) | u8::from(floor == 0);
                }
            }
        }
        // Cells smaller than a pixel do not exist.
        Grid { cell_m, columns, rows, height_m, holds }
    }

    pub(super) fn len(&self) -> usize {
        self.holds.len()
    }

    pub(super) fn has(&self, cell: usize, what: u8) -> bool {
        self.holds[cell] & what != 0
    }

    pub(super) fn cell_at(&self, p: Vec2) -> Option<usize> {
        let (x, y) = (p.x / self.cell_m, (self.height_m - p.y) / self.cell_m);
        // Comparisons are written so that NaN lands outside.
        let inside = x >= 0.0 && y >= 0.0 && x < self.columns as f64 + 1.0 && y < self.rows as f64 + 1.0;
        // The plan's rim may lie beyond the last cell.
        inside.then(|| (y as usize).min(self.rows - 1) * self.columns + (x as usize).min(self.columns - 1))
    }

    pub(super) fn centre(&self, cell: usize) -> Vec2 {
        let [column, row] = self.column_row(cell);
        vec2((column as f64 + 0.5) * self.cell_m, self.height_m - (row as f64 + 0.5) * self.cell_m)
    }

    pub(super) fn column_row(&self, cell: usize) -> [usize; 2] {
        [cell % self.columns, cell / self.columns]
    }

    /// Cells beside a cell: west, east, north, south.
    pub(super) fn beside(&self, cell: usize) -> impl Iterator<Item = usize> {
        let [column, row] = self.column_row(cell);
        let columns = self.columns;
        [
            (column > 0, cell.wrapping_sub(1)),
            (column + 1 < columns, cell + 1),
            (row > 0, cell.wrapping_sub(columns)),
            (row + 1 < self.rows, cell + columns),
        ]
        .into_iter()
        .filter_map(|(is, cell)| is.then_some(cell))
    }

    /// Cells within `reach` columns and rows of a cell, row by row.
    pub(super) fn around(&self, cell: usize, reach: usize) -> impl Iterator<Item = usize> {
        let [column, row] = self.column_row(cell);
        let columns = column.saturating_sub(reach)..(column + reach + 1).min(self.columns);
        let rows = row.saturating_sub(reach)..(row + reach + 1).min(self.rows);
        let across = self.columns;
        rows.flat_map(move |row| columns.clone().map(move |column| row * across + column))
    }

    /// Groups of the cells that are members and that `near` joins: first cells row by row.
    pub(super) fn groups<I: Iterator<Item = usize>>(
        &self,
        is_member: impl Fn(usize) -> bool,
        near: impl Fn(usize) -> I,
    ) -> Vec<Vec<usize>> {
        let mut seen = vec![false; self.len()];
        let mut groups = Vec::new();
        for first in 0..self.len() {
            if seen[first] || !is_member(first) {
                continue;
            }
            seen[first] = true;
            let (mut members, mut next) = (vec![first], 0);
            while let Some(&cell) = members.get(next) {
                next += 1;
                members.extend(near(cell).filter(|&b| is_member(b) && !std::mem::replace(&mut seen[b], true)));
            }
            groups.push(members);
        }
        groups
    }

    /// Cells on the straight line between two points.
    pub(super) fn line(&self, a: Vec2, b: Vec2) -> impl Iterator<Item = usize> {
        let steps = (a.distance(b) / (0.25 * self.cell_m)).ceil().max(1.0) as usize;
        (0..=steps).filter_map(move |k| self.cell_at(a.lerp(b, k as f64 / steps as f64)))
    }

    /// Distance of each cell from the nearest blocked one, in cells (a step along a side 1, along a diagonal 1.4).
    pub(super) fn clearances(&self) -> Vec<f32> {
        const DIAGONAL: f32 = 1.4;
        let (columns, rows) = (self.columns as i64, self.rows as i64);
        let mut distance: Vec<f32> =
            self.holds.iter().map(|&holds| if holds & BLOCKED == 0 { f32::INFINITY } else { 0.0 }).collect();
        let relax = |distance: &mut [f32], cell: usize, steps: [(i64, i64, f32); 4]| {
            let (column, row) = ((cell as i64) % columns, (cell as i64) / columns);
            for (dx, dy, step) in steps {
                let (x, y) = (column + dx, row + dy);
                if (0..columns).contains(&x) && (0..rows).contains(&y) {
                    let other = distance[(y * columns + x) as usize];
                    distance[cell] = distance[cell].min(other + step);
                }
            }
        };
        for cell in 0..self.len() {
            relax(&mut distance, cell, [(-1, 0, 1.0), (0, -1, 1.0), (-1, -1, DIAGONAL), (1, -1, DIAGONAL)]);
        }
        for cell in (0..self.len()).rev() {
            relax(&mut distance, cell, [(1, 0, 1.0), (0, 1, 1.0), (1, 1, DIAGONAL), (-1, 1, DIAGONAL)]);
        }
        // A plan without any wall.
        let longest = (columns + rows) as f32;
        distance.iter_mut().for_each(|d| *d = d.min(longest));
        distance
    }
}

fn of_class(class: PlanClass) -> u8 {
    match class {
        PlanClass::Outside => OUTSIDE,
        PlanClass::Wall | PlanClass::Window | PlanClass::Shelf => WALL,
        PlanClass::Door => DOOR,
        PlanClass::Stairs => STAIRS,
        PlanClass::Seat => FURNITURE | SEAT,
        PlanClass::Table | PlanClass::Counter => FURNITURE,
        PlanClass::Fixture => FIXTURE | SEAT,
        PlanClass::Floor | PlanClass::Lettering | PlanClass::Dimension | PlanClass::Frame => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_at_the_rim_hold_pixels_too() {
        for (width, height, metres_per_pixel) in [(1620, 1020, 0.0192), (829, 786, 0.0245), (40, 30, 0.1), (7, 5, 0.3)]
        {
            let wall = vec![0; (width * height) as usize];
            let plan = FloorPlan::from_mask(width, height, metres_per_pixel, wall);
            let grid = Grid::of(&plan);
            assert!((0..grid.len()).all(|cell| grid.has(cell, BLOCKED)), "{width} x {height} at {metres_per_pixel}");
            let corner = vec2(plan.width_m(), 0.0);
            assert_eq!(grid.cell_at(corner), Some(grid.len() - 1));
        }
    }
}
