//! A spatial index of doors, corners and fixtures.

use std::ops::RangeInclusive;

use crate::math::{Rect, Vec2, vec2};
use crate::walls::Walls;

use super::places::{ContactPlaces, direction_at};

/// Side of a cell, metres.
const CELL_M: f64 = 2.0;
/// Limit on the cells of one place along each axis; bounds the memory.
const MOST_CELLS: i32 = 64;

/// The spatial index of a plan's contact places.
pub(super) struct PlaceIndex {
    pub doors: PlaceCells,
    pub corners: PlaceCells,
    pub fixtures: PlaceCells,
    /// Both ends of each fixture on its wall, metres.
    pub ends_m: Vec<[Vec2; 2]>,
}

/// Places by grid cell: `(row, column, index of the place)`, ascending.
pub(super) struct PlaceCells {
    entries: Vec<(i32, i32, u32)>,
}

impl PlaceIndex {
    pub fn new(walls: &Walls, places: &ContactPlaces) -> PlaceIndex {
        let ends = |k: usize| {
            let fixture = &places.fixtures()[k];
            let half = direction_at(walls, fixture.face, fixture.along_m) * (0.5 * fixture.width_m);
            [fixture.point_m - half, fixture.point_m + half]
        };
        let ends_m: Vec<[Vec2; 2]> = (0..places.fixtures().len()).map(ends).collect();
        PlaceIndex {
            doors: PlaceCells::new(places.doors().iter().map(|door| door.doorway.jambs_m)),
            corners: PlaceCells::new(places.corners().iter().map(|corner| [corner.point_m; 2])),
            fixtures: PlaceCells::new(ends_m.iter().copied()),
            ends_m,
        }
    }
}

impl PlaceCells {
    fn new(spans: impl Iterator<Item = [Vec2; 2]>) -> PlaceCells {
        let mut entries = Vec::new();
        for ([a, b], number) in spans.zip(0u32..) {
            let (rows, columns) = cells_of(Rect::around(a, b));
            for row in rows.take(MOST_CELLS as usize) {
                entries.extend(columns.clone().take(MOST_CELLS as usize).map(|column| (row, column, number)));
            }
        }
        entries.sort_unstable();
        PlaceCells { entries }
    }

    /// Lists the indices of places that may lie within a distance of a point, each once, ascending.
    pub fn around(&self, at_m: Vec2, within_m: f64, out: &mut Vec<u32>) {
        out.clear();
        if self.entries.is_empty() {
            return;
        }
        let (rows, columns) = cells_of(Rect { min: at_m, max: at_m }.grown(within_m));
        for row in rows {
            let from = self.entries.partition_point(|entry| (entry.0, entry.1) < (row, *columns.start()));
            let found = self.entries[from..].iter().take_while(|entry| (entry.0, entry.1) <= (row, *columns.end()));
            out.extend(found.map(|entry| entry.2));
        }
        out.sort_unstable();
        out.dedup();
    }
}

fn cells_of(area: Rect) -> (RangeInclusive<i32>, RangeInclusive<i32>) {
    // Casting saturates, so that points far outside do not overflow.
    let cell = |metres: f64| (metres / CELL_M).floor() as i32;
    (cell(area.min.y)..=cell(area.max.y), cell(area.min.x)..=cell(area.max.x))
}

/// The point where a path from one point to another crosses a segment.
pub(super) fn crossing(from: Vec2, to: Vec2, [a, b]: [Vec2; 2]) -> Option<Vec2> {
    let (way, across) = (to - from, b - a);
    let turn = way.cross(across);
    if turn == 0.0 {
        return None;
    }
    let share = (a - from).cross(across) / turn;
    let along = (a - from).cross(way) / turn;
    // A path that ends on the segment crosses it here, not with the next step.
    let crosses = share > 0.0 && share <= 1.0 && (0.0..=1.0).contains(&along);
    crosses.then(|| from + vec2(way.x * share, way.y * share))
}
