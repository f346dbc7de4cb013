//! Finds the corners of faces, apart from turns within curves and steps of a pixel.

use crate::math::{Vec2, atan2};
use crate::walls::Face;

/// A corner of a face: a turn of more than 20 degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Index into [`crate::walls::Walls::faces`].
    pub face: usize,
    /// Arc length from the face's start, metres.
    pub along_m: f64,
    /// The vertex, metres.
    pub point_m: Vec2,
    /// Turn of the face, radians: positive at an inner corner (less than 180 degrees of floor), negative at an outer
    /// one.
    pub turn_rad: f64,
}

/// Least turn of a corner, radians: 20 degrees.
const LEAST_TURN_RAD: f64 = 20.0 * std::f64::consts::PI / 180.0;
/// Vertices closer than this form one corner, metres: ends of thin walls, rounded and bevelled edges.
const ONE_CORNER_M: f64 = 0.105;
/// A row of such vertices longer than this is a curve, metres.
const LONGEST_CORNER_M: f64 = 0.25;
/// Largest sagitta of a curve's pieces, metres: somewhat more than half a pixel of a coarse plan.
const MOST_SAGITTA_M: f64 = 0.06;
/// Fewest consecutive vertices of a curve that turn to one side.
const FEWEST_OF_CURVE: usize = 3;
/// Largest ratio of the turns at consecutive vertices of a curve.
const EVEN_TURN: f64 = 3.5;

/// A vertex of a face, or a cluster of them.
#[derive(Clone, Copy, Debug)]
struct Vertex {
    from_m: f64,
    to_m: f64,
    point_m: Vec2,
    turn_rad: f64,
}

impl Vertex {
    fn middle_m(&self) -> f64 {
        0.5 * (self.from_m + self.to_m)
    }
}

/// Appends all corners of a face, by ascending arc length.
pub(super) fn of_face(number: usize, face: &Face, out: &mut Vec<Corner>) {
    let length_m = face.length_m();
    let vertices = joined(vertices(face), face.closed.then_some(length_m));
    for (k, vertex) in vertices.iter().enumerate() {
        if vertex.turn_rad.abs() > LEAST_TURN_RAD && !is_of_curve(&vertices, k, face.closed.then_some(length_m)) {
            let along_m = vertex.middle_m();
            let along_m = if along_m >= length_m { along_m - length_m } else { along_m };
            out.push(Corner { face: number, along_m, point_m: vertex.point_m, turn_rad: vertex.turn_rad });
        }
    }
    let first = out.iter().rposition(|corner| corner.face != number).map_or(0, |last| last + 1);
    out[first..].sort_by(|a, b| a.along_m.total_cmp(&b.along_m));
}

/// Turn between two directions of a face, radians; positive at an inner corner.
pub(super) fn turn_rad(before: Vec2, after: Vec2) -> f64 {
    -atan2(before.cross(after), before.dot(after))
}

fn vertices(face: &Face) -> Vec<Vertex> {
    let n = face.points_m.len();
    let mut vertices = Vec::with_capacity(n);
    let mut along_m = 0.0;
    for k in 0..n {
        let at = face.points_m[k];
        if k > 0 {
            along_m += face.points_m[k - 1].distance(at);
        }
        if !face.closed && (k == 0 || k + 1 == n) {
            continue;
        }
        let turn_rad = turn_rad(at - face.points_m[(k + n - 1) % n], face.points_m[(k + 1) % n] - at);
        vertices.push(Vertex { from_m: along_m, to_m: along_m, point_m: at, turn_rad });
    }
    vertices
}

/// Merges vertices that form one corner. `closed_m` is a closed face's length; its seam is merged too.
fn joined(vertices: Vec<Vertex>, closed_m: Option<f64>) -> Vec<Vertex> {
    let n = vertices.len();
    // Start after a gap, so that the seam splits no cluster.
    let gap_before = |k: usize| match (k, closed_m) {
        (0, None) => f64::INFINITY,
        (0, Some(length_m)) => vertices[0].from_m + length_m - vertices[n - 1].from_m,
        (k, _) => vertices[k].from_m - vertices[k - 1].from_m,
    };
    let first = (0..n).find(|&k| gap_before(k) > ONE_CORNER_M).unwrap_or(0);
    let mut rows: Vec<Vec<Vertex>> = Vec::new();
    for step in 0..n {
        let k = (first + step) % n;
        let mut vertex = vertices[k];
        if k < first {
            let length_m = closed_m.unwrap_or(0.0);
            (vertex.from_m, vertex.to_m) = (vertex.from_m + length_m, vertex.to_m + length_m);
        }
        match rows.last_mut() {
            Some(row) if step > 0 && gap_before(k) <= ONE_CORNER_M => row.push(vertex),
            _ => rows.push(vec![vertex]),
        }
    }
    rows.into_iter().flat_map(one_of_row).collect()
}

/// Merges a row of close vertices into one corner; returns the row itself if it is a curve.
fn one_of_row(row: Vec<Vertex>) -> Vec<Vertex> {
    let (first, last) = (row[0], row[row.len() - 1]);
    if row.len() == 1 || last.to_m - first.from_m > LONGEST_CORNER_M {
        return row;
    }
    // The middle vertex gives the position; for an even number, the middle of the edge.
    let point_m = if row.len().is_multiple_of(2) {
        row[row.len() / 2 - 1].point_m.lerp(row[row.len() / 2].point_m, 0.5)
    } else {
        row[row.len() / 2].point_m
    };
    let turn_rad = row.iter().map(|vertex| vertex.turn_rad).sum();
    vec![Vertex { from_m: first.from_m, to_m: last.to_m, point_m, turn_rad }]
}

/// Whether a vertex is one of several between the short pieces of a curve.
fn is_of_curve(vertices: &[Vertex], k: usize, closed_m: Option<f64>) -> bool {
    let n = vertices.len();
    let turn_rad = vertices[k].turn_rad;
    let next = |from: usize, ahead: bool| -> Option<(usize, f64)> {
        let to = match (ahead, closed_m) {
            (true, None) => Some(from + 1).filter(|&to| to < n)?,
            (false, None) => from.checked_sub(1)?,
            (true, Some(_)) => (from + 1) % n,
            (false, Some(_)) => (from + n - 1) % n,
        };
        let apart_m = (vertices[to].middle_m() - vertices[from].middle_m()).abs();
        Some((to, closed_m.map_or(apart_m, |length_m| apart_m.min(length_m - apart_m))))
    };
    let run = |ahead: bool| {
        let (mut count, mut at) = (0, k);
        while count < FEWEST_OF_CURVE {
            let Some((to, apart_m)) = next(at, ahead) else { break };
            let (here, there) = (vertices[at].turn_rad, vertices[to].turn_rad);
            let even =
                here * there > 0.0 && there.abs() < EVEN_TURN * here.abs() && here.abs() < EVEN_TURN * there.abs();
            if to == k || !even || apart_m * here.abs().min(there.abs()) / 8.0 > MOST_SAGITTA_M {
                break;
            }
            (count, at) = (count + 1, to);
        }
        count
    };
    // A larger turn between two pieces does not look round.
    turn_rad.abs() < 1.1 && run(true) + run(false) + 1 >= FEWEST_OF_CURVE
}
