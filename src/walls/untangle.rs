//! Removes crossings of outlines with each other and themselves.
//!
//! A fitted line deviates up to half a pixel from the pixel edges, a corner somewhat more. Where walls and gaps of one
//! pixel lie close together, as in maps made by robots, two lines may cross. Pixel edges never cross: outlines are
//! reset to them around each crossing, until there is none.

use rayon::prelude::*;

use super::boundary::{Boundary, Vertex};
use super::grid::Grid;
use super::index::{closest_on, union};
use crate::math::{Rect, Vec2};

/// Cell size of the grid for finding close edges, pixels.
const CELL_PX: f64 = 4.0;
/// Edges closer than this touch, pixels.
const TOUCH_PX: f64 = 1e-6;
/// Corners farther beyond the image than this could go round another boundary, which is a pixel wide at least.
const BEYOND_PX: f64 = 1.0;
/// Rounds of local mending, after which boundaries that still cross are put on the pixels' edges as a whole.
const LOCAL_ROUNDS: usize = 40;

/// Puts boundaries back on the pixels' edges wherever they would cross or touch, fold back, enclose nothing, or leave
/// the image, whose size is `size_px`.
pub(super) fn untangle(boundaries: &mut [Boundary], size_px: Vec2) {
    let mut outlines: Vec<Vec<Vertex>> = boundaries.par_iter().map(Boundary::vertices).collect();
    let mut is_new = vec![true; boundaries.len()];
    for round in 0.. {
        let mut changed = vec![false; boundaries.len()];
        for (number, boundary) in boundaries.iter_mut().enumerate().filter(|&(number, _)| is_new[number]) {
            if !boundary.encloses(&outlines[number]) {
                changed[number] = boundary.put_all_on_edges();
            }
        }
        for fault in faults(boundaries, &outlines, &is_new, size_px) {
            let vertices = &outlines[fault.outline];
            let [a, b] = [vertices[fault.edge], vertices[(fault.edge + 1) % vertices.len()]];
            let boundary = &mut boundaries[fault.outline];
            changed[fault.outline] |=
                if round < LOCAL_ROUNDS { boundary.put_on_edges(a, b, fault.at) } else { boundary.put_all_on_edges() };
        }
        if !changed.contains(&true) {
            return;
        }
        let anew = boundaries.par_iter().zip(&mut outlines).zip(&changed).filter(|(_, changed)| **changed);
        anew.for_each(|((boundary, vertices), _)| *vertices = boundary.vertices());
        is_new = changed;
    }
}

/// An edge that must be reset, and the position of its conflict.
struct Fault {
    outline: usize,
    edge: usize,
    at: Vec2,
}

/// Edges that cross or touch others, edges that lead nowhere, and edges that begin beyond the image, in a fixed order.
///
/// Beyond the image an edge goes round another boundary without crossing it: that one's wall would then be seen from
/// behind.
fn faults(boundaries: &[Boundary], outlines: &[Vec<Vertex>], is_new: &[bool], size_px: Vec2) -> Vec<Fault> {
    let is_beyond = |p: Vec2| (-p.x).max(-p.y).max(p.x - size_px.x).max(p.y - size_px.y) > BEYOND_PX;
    let mut found = Vec::new();
    for (outline, vertices) in outlines.iter().enumerate().filter(|&(outline, _)| is_new[outline]) {
        for edge in 0..vertices.len() {
            let [a, b] = [vertices[edge], vertices[(edge + 1) % vertices.len()]];
            if !boundaries[outline].leads_on(a, b) || is_beyond(a.at) {
                found.push(Fault { outline, edge, at: a.at });
            }
        }
    }
    let edges = Edges::new(outlines, is_new);
    for (pair, at) in edges.crossings() {
        found.extend(pair.map(|number| {
            let Edge { outline, edge, .. } = edges.edges[number as usize];
            Fault { outline: outline as usize, edge: edge as usize, at }
        }));
    }
    found
}

/// The edges of all outlines.
struct Edges<'a> {
    outlines: &'a [Vec<Vertex>],
    is_new: &'a [bool],
    edges: Vec<Edge>,
}

#[derive(Clone, Copy)]
struct Edge {
    outline: u32,
    edge: u32,
    a: Vec2,
    b: Vec2,
}

impl<'a> Edges<'a> {
    fn new(outlines: &'a [Vec<Vertex>], is_new: &'a [bool]) -> Edges<'a> {
        let of = |(outline, vertices): (usize, &'a Vec<Vertex>)| {
            (0..vertices.len()).map(move |edge| Edge {
                outline: outline as u32,
                edge: edge as u32,
                a: vertices[edge].at,
                b: vertices[(edge + 1) % vertices.len()].at,
            })
        };
        Edges { outlines, is_new, edges: outlines.iter().enumerate().flat_map(of).collect() }
    }

    /// Returns pairs of edges that cross, touch or fold back, with the position. Skips pairs without a new edge.
    fn crossings(&self) -> Vec<([u32; 2], Vec2)> {
        let Some(first) = self.edges.first() else { return Vec::new() };
        let area = self
            .edges
            .iter()
            .fold(Rect::around(first.a, first.b), |area, edge| union(area, Rect::around(edge.a, edge.b)));
        let grid = Grid::new(area, CELL_PX);
        let in_cells = |(number, edge): (usize, &Edge)| {
            let mut cells = Vec::new();
            grid.cells_along(edge.a, edge.b, |cell| {
                cells.push((cell, number as u32));
                true
            });
            cells
        };
        let mut entries: Vec<(usize, u32)> = self.edges.par_iter().enumerate().flat_map_iter(in_cells).collect();
        entries.par_sort_unstable();
        let in_cell = |cell: &[(usize, u32)]| {
            let mut found = Vec::new();
            for (k, &(_, i)) in cell.iter().enumerate() {
                found.extend(cell[k + 1..].iter().filter_map(|&(_, j)| Some(([i, j], self.meeting(i, j)?))));
            }
            found
        };
        let mut found: Vec<_> = entries.par_chunk_by(|a, b| a.0 == b.0).flat_map_iter(in_cell).collect();
        found.sort_by_key(|&(pair, _)| pair);
        found.dedup_by_key(|&mut (pair, _)| pair);
        found
    }

    /// Returns where two edges cross, touch or fold back on each other.
    fn meeting(&self, i: u32, j: u32) -> Option<Vec2> {
        let (s, t) = (self.edges[i as usize], self.edges[j as usize]);
        if i == j || !(self.is_new[s.outline as usize] || self.is_new[t.outline as usize]) || !are_near(&s, &t) {
            return None;
        }
        let count = self.outlines[s.outline as usize].len() as u32;
        if s.outline == t.outline {
            if (s.edge + 1) % count == t.edge {
                return folds_back(s.a, s.b, t.b).then_some(s.b);
            }
            if (t.edge + 1) % count == s.edge {
                return folds_back(t.a, t.b, s.b).then_some(t.b);
            }
        }
        let [ab, cd] = [s.b - s.a, t.b - t.a];
        let off_s = [t.a, t.b].map(|p| ab.cross(p - s.a));
        let off_t = [s.a, s.b].map(|p| cd.cross(p - t.a));
        let sides = |off: [f64; 2], length: f64| off.map(|off| Side::of(off, TOUCH_PX * length));
        let (of_t, of_s) = (sides(off_s, ab.length()), sides(off_t, cd.length()));
        if is_apart(of_t) || is_apart(of_s) {
            return None;
        }
        if !of_t.contains(&Side::On) && !of_s.contains(&Side::On) {
            return Some(s.a + ab * (off_t[0] / (off_t[0] - off_t[1])));
        }
        let ends = [(s.a, t), (s.b, t), (t.a, s), (t.b, s)];
        let touched = ends.into_iter().find(|(p, edge)| closest_on(edge.a, edge.b, *p).distance(*p) < TOUCH_PX)?.0;
        (!self.pass_by(&s, &t)).then_some(touched)
    }

    /// Whether two edges share a corner where their outlines only touch, as diagonal pixels do.
    fn pass_by(&self, s: &Edge, t: &Edge) -> bool {
        let corner = |edge: &Edge, end: u32| {
            let vertices = &self.outlines[edge.outline as usize];
            let count = vertices.len();
            let at = (edge.edge + end) as usize % count;
            [vertices[(at + count - 1) % count].at, vertices[at].at, vertices[(at + 1) % count].at]
        };
        let pairs = [[0, 0], [0, 1], [1, 0], [1, 1]].map(|[i, j]| (corner(s, i), corner(t, j)));
        let mut shared = pairs.into_iter().filter(|([_, p, _], [_, q, _])| p == q).peekable();
        shared.peek().is_some()
            && shared.all(|(s, [before, _, after])| {
                let sides = [before, after].map(|p| is_right_of(s, p));
                sides[0].is_some() && sides[0] == sides[1]
            })
    }
}

/// The side of a line on which a point lies.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Left,
    On,
    Right,
}

impl Side {
    fn of(off: f64, slack: f64) -> Side {
        if off > slack {
            Side::Left
        } else if off < -slack {
            Side::Right
        } else {
            Side::On
        }
    }
}

/// Whether both ends of an edge lie strictly on the same side.
fn is_apart([a, b]: [Side; 2]) -> bool {
    a == b && a != Side::On
}

/// Whether the bounding boxes of two edges touch.
fn are_near(s: &Edge, t: &Edge) -> bool {
    Rect::around(s.a, s.b).grown(TOUCH_PX).overlaps(Rect::around(t.a, t.b).grown(TOUCH_PX))
}

/// Whether the path from `a` over `b` to `c` reverses along itself.
fn folds_back(a: Vec2, b: Vec2, c: Vec2) -> bool {
    let (there, back) = (b - a, c - b);
    let shorter = there.length_squared().min(back.length_squared()).sqrt();
    // Distance of the shorter one's far end from the longer one.
    let apart = there.cross(back).abs() * shorter;
    there.dot(back) < 0.0 && apart <= TOUCH_PX * there.length() * back.length()
}

/// Side of the path `before`, `corner`, `after` on which `p` lies; `None` on the path.
fn is_right_of([before, corner, after]: [Vec2; 3], p: Vec2) -> Option<bool> {
    let (back, ahead, to) = (before - corner, after - corner, p - corner);
    let along = |way: Vec2| way.cross(to).abs() <= TOUCH_PX * to.length() && way.dot(to) > 0.0;
    if along(back) || along(ahead) {
        return None;
    }
    // Turning left from the path ahead to the path back.
    let is_between = |from: Vec2, till: Vec2| from.cross(to) > 0.0 && to.cross(till) > 0.0;
    Some(if ahead.cross(back) >= 0.0 { is_between(ahead, back) } else { !is_between(back, ahead) })
}
