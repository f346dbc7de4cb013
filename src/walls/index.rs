//! Spatial index of walls: nearest wall, inside test, line of sight.

use super::face::{Nearest, Segment};
use super::grid::Grid;
use crate::math::{Rect, Vec2, vec2};

/// Side of a cell, metres.
const CELL_M: f64 = 0.5;

/// Wall segments by cell, and edges of the walkable space by row of cells.
#[derive(Debug)]
pub(super) struct Index {
    segments: Vec<Segment>,
    grid: Grid,
    /// Segment numbers of cell `c` are `entries[starts[c]..starts[c + 1]]`.
    starts: Vec<u32>,
    entries: Vec<u32>,
    /// Edges of the walkable space that touch each row of cells.
    row_starts: Vec<u32>,
    row_edges: Vec<[Vec2; 2]>,
}

impl Index {
    pub(super) fn new(segments: Vec<Segment>, walked: &[Vec<Vec2>]) -> Index {
        let mut area = Rect { min: Vec2::ZERO, max: Vec2::ZERO };
        for (k, p) in walked.iter().flatten().enumerate() {
            let point = Rect { min: *p, max: *p };
            area = if k == 0 { point } else { union(area, point) };
        }
        let grid = Grid::new(area, CELL_M);
        let mut index = Index {
            segments,
            grid,
            starts: Vec::new(),
            entries: Vec::new(),
            row_starts: Vec::new(),
            row_edges: Vec::new(),
        };
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        for (number, s) in index.segments.iter().enumerate() {
            grid.cells_along(s.a, s.b, |cell| {
                pairs.push((cell as u32, number as u32));
                true
            });
        }
        pairs.sort_unstable();
        pairs.dedup();
        index.starts = counted_starts(grid.cells(), pairs.iter().map(|p| p.0));
        index.entries = pairs.into_iter().map(|p| p.1).collect();
        let mut by_row: Vec<(u32, [Vec2; 2])> = Vec::new();
        for points in walked {
            for (k, &a) in points.iter().enumerate() {
                let b = points[(k + 1) % points.len()];
                if a.y != b.y {
                    let [low, high] = [a.y.min(b.y), a.y.max(b.y)].map(|y| grid.row_of(y));
                    by_row.extend((low..=high).map(|row| (row as u32, [a, b])));
                }
            }
        }
        by_row.sort_by_key(|e| e.0);
        index.row_starts = counted_starts(grid.rows(), by_row.iter().map(|e| e.0));
        index.row_edges = by_row.into_iter().map(|e| e.1).collect();
        index
    }

    fn cell_segments(&self, cell: usize) -> &[u32] {
        &self.entries[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    pub(super) fn nearest(&self, p: Vec2, within_m: f64) -> Option<Nearest> {
        let reach = vec2(within_m, within_m);
        let (low, high) = (p - reach, p + reach);
        let mut best: Option<(f64, u32, Vec2)> = None;
        for row in self.grid.row_of(low.y)..=self.grid.row_of(high.y) {
            for column in self.grid.column_of(low.x)..=self.grid.column_of(high.x) {
                for &number in self.cell_segments(self.grid.cell(column, row)) {
                    let s = &self.segments[number as usize];
                    let q = closest_on(s.a, s.b, p);
                    let d = (p - q).length_squared();
                    if best.is_none_or(|(least, n, _)| d < least || (d == least && number < n)) {
                        best = Some((d, number, q));
                    }
                }
            }
        }
        let (squared, number, point_m) = best?;
        let distance_m = squared.sqrt();
        let s = &self.segments[number as usize];
        (distance_m <= within_m).then(|| Nearest {
            distance_m,
            point_m,
            face: s.face,
            along_m: s.along_m + s.a.distance(point_m),
        })
    }

    pub(super) fn is_inside(&self, p: Vec2) -> bool {
        let mut winding = 0;
        let row = self.grid.row_of(p.y);
        for &[a, b] in &self.row_edges[self.row_starts[row] as usize..self.row_starts[row + 1] as usize] {
            let upward = a.y <= p.y && b.y > p.y;
            let downward = b.y <= p.y && a.y > p.y;
            // Count crossings left of the point: the point is on the right of an upward edge.
            if upward && (b - a).cross(p - a) < 0.0 {
                winding += 1;
            } else if downward && (b - a).cross(p - a) > 0.0 {
                winding -= 1;
            }
        }
        winding > 0
    }

    pub(super) fn sight(&self, a: Vec2, b: Vec2) -> bool {
        let mut clear = true;
        self.grid.cells_along(a, b, |cell| {
            clear = !self.cell_segments(cell).iter().any(|&n| {
                let s = &self.segments[n as usize];
                crosses(a, b, s.a, s.b)
            });
            clear
        });
        clear
    }

    pub(super) fn segments_near(&self, area: Rect, out: &mut Vec<Segment>) {
        let mut numbers: Vec<u32> = Vec::new();
        for row in self.grid.row_of(area.min.y)..=self.grid.row_of(area.max.y) {
            for column in self.grid.column_of(area.min.x)..=self.grid.column_of(area.max.x) {
                numbers.extend_from_slice(self.cell_segments(self.grid.cell(column, row)));
            }
        }
        numbers.sort_unstable();
        numbers.dedup();
        out.extend(numbers.into_iter().map(|n| self.segments[n as usize]));
    }
}

/// Start offsets of `count` lists whose entries are sorted by list.
fn counted_starts(count: usize, lists: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut starts = vec![0u32; count + 1];
    for list in lists {
        starts[list as usize + 1] += 1;
    }
    for k in 0..count {
        starts[k + 1] += starts[k];
    }
    starts
}

/// Returns the point of segment `ab` nearest to `p`.
pub(crate) fn closest_on(a: Vec2, b: Vec2, p: Vec2) -> Vec2 {
    let along = b - a;
    let squared = along.length_squared();
    if squared <= 0.0 {
        return a;
    }
    a + along * ((p - a).dot(along) / squared).clamp(0.0, 1.0)
}

/// Whether the segments `ab` and `cd` cross; touching does not count.
fn crosses(a: Vec2, b: Vec2, c: Vec2, d: Vec2) -> bool {
    let (ab, cd) = (b - a, d - c);
    (ab.cross(c - a) > 0.0) != (ab.cross(d - a) > 0.0) && (cd.cross(a - c) > 0.0) != (cd.cross(b - c) > 0.0)
}

/// Bounding box of two rectangles.
pub(super) fn union(a: Rect, b: Rect) -> Rect {
    Rect {
        min: vec2(a.min.x.min(b.min.x), a.min.y.min(b.min.y)),
        max: vec2(a.max.x.max(b.max.x), a.max.y.max(b.max.y)),
    }
}
