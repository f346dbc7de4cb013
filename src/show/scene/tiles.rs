//! Cuts triangles and walls at the borders of floor tiles.

use std::collections::HashMap;

use crate::math::{Rect, Vec2, vec2};

/// Borders closer than this are the same, metres.
const SAME_M: f64 = 1e-6;

/// The borders of a floor's tiles. What is cut at them gets the same new corners from whichever side it is cut, so
/// that neighbours leave no crack.
#[derive(Debug)]
pub(super) struct TileCuts {
    /// Borders across x and across y, metres, ascending.
    borders: [Vec<f64>; 2],
    /// The tile of a column and a row.
    tiles: HashMap<[usize; 2], usize>,
}

impl TileCuts {
    /// From the places of tiles on a common lattice. Tiles without an area are left out.
    pub fn new(tiles: &[Rect]) -> TileCuts {
        let sound = |t: &&Rect| t.min.is_finite() && t.max.is_finite() && t.width() > 0.0 && t.height() > 0.0;
        let borders = [0, 1].map(|axis| {
            let ends = tiles.iter().filter(sound).flat_map(|t| [along(t.min, axis), along(t.max, axis)]);
            let mut ends: Vec<f64> = ends.collect();
            ends.sort_by(f64::total_cmp);
            ends.dedup_by(|a, b| (*a - *b).abs() < SAME_M);
            ends
        });
        let mut cuts = TileCuts { borders, tiles: HashMap::new() };
        for (index, tile) in tiles.iter().enumerate().filter(|(_, tile)| sound(tile)) {
            let cell = cuts.cell(tile.centre());
            cuts.tiles.entry(cell).or_insert(index);
        }
        cuts
    }

    /// The tile at a place; of a place beyond all of them, the nearest.
    pub fn tile(&self, p: Vec2) -> Option<usize> {
        self.tiles.get(&self.cell(p)).copied()
    }

    fn cell(&self, p: Vec2) -> [usize; 2] {
        [0, 1].map(|axis| inner(&self.borders[axis]).partition_point(|&border| border <= along(p, axis)))
    }

    /// Cuts a convex polygon into one piece per tile that it touches.
    pub fn polygon(&self, corners: &[Vec2], mut piece: impl FnMut(&[Vec2])) {
        self.polygon_across(0, corners, &mut |column| self.polygon_across(1, column, &mut piece));
    }

    fn polygon_across(&self, axis: usize, corners: &[Vec2], piece: &mut impl FnMut(&[Vec2])) {
        let borders = self.between(axis, corners);
        if borders.is_empty() {
            return piece(corners);
        }
        let mut rest = corners.to_vec();
        for &border in borders {
            let [below, above] = split(&rest, axis, border);
            piece(&below);
            rest = above;
        }
        piece(&rest);
    }

    /// Cuts an edge; gives where, from `a` to `b`, both ends included.
    pub fn edge(&self, a: Vec2, b: Vec2) -> Vec<Vec2> {
        let points = self.edge_across(0, &[a, b]);
        self.edge_across(1, &points)
    }

    fn edge_across(&self, axis: usize, points: &[Vec2]) -> Vec<Vec2> {
        let mut out = Vec::with_capacity(points.len());
        for ends in points.windows(2) {
            let forward = along(ends[0], axis) <= along(ends[1], axis);
            let (low, high) = if forward { (ends[0], ends[1]) } else { (ends[1], ends[0]) };
            // From below, as polygons are.
            let mut piece = vec![low];
            for &border in self.between(axis, ends) {
                piece.push(crossing(piece[piece.len() - 1], high, axis, border));
            }
            piece.push(high);
            if !forward {
                piece.reverse();
            }
            piece.pop();
            out.extend(piece);
        }
        out.extend(points.last());
        out
    }

    /// The borders strictly between the least and the greatest coordinate of some points.
    fn between(&self, axis: usize, points: &[Vec2]) -> &[f64] {
        let values = || points.iter().map(|&p| along(p, axis));
        let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        let borders = inner(&self.borders[axis]);
        let from = borders.partition_point(|&border| border <= low);
        let to = borders.partition_point(|&border| border < high);
        &borders[from..to.max(from)]
    }
}

/// All borders but the outermost: an outline may lie a little beyond those.
fn inner(borders: &[f64]) -> &[f64] {
    borders.get(1..borders.len().saturating_sub(1)).unwrap_or_default()
}

fn along(p: Vec2, axis: usize) -> f64 {
    if axis == 0 { p.x } else { p.y }
}

/// Cuts a convex polygon at a coordinate: the piece below and the piece above.
fn split(corners: &[Vec2], axis: usize, border: f64) -> [Vec<Vec2>; 2] {
    let mut parts = [Vec::with_capacity(corners.len() + 1), Vec::with_capacity(corners.len() + 1)];
    for (k, &a) in corners.iter().enumerate() {
        let b = corners[(k + 1) % corners.len()];
        let (at_a, at_b) = (along(a, axis), along(b, axis));
        if at_a <= border {
            parts[0].push(a);
        }
        if at_a >= border {
            parts[1].push(a);
        }
        if (at_a < border && border < at_b) || (at_b < border && border < at_a) {
            let cut = crossing(a, b, axis, border);
            parts[0].push(cut);
            parts[1].push(cut);
        }
    }
    parts
}

/// Where an edge crosses a border: the same bits whichever end comes first.
fn crossing(a: Vec2, b: Vec2, axis: usize, border: f64) -> Vec2 {
    let (low, high) = if along(a, axis) <= along(b, axis) { (a, b) } else { (b, a) };
    let share = (border - along(low, axis)) / (along(high, axis) - along(low, axis));
    let other = along(low, 1 - axis) + (along(high, 1 - axis) - along(low, 1 - axis)) * share;
    if axis == 0 { vec2(border, other) } else { vec2(other, border) }
}
