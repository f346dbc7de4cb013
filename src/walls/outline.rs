//! Outlines of the floor, and the faces, wall segments and walkable loops made from them.

use serde::{Deserialize, Serialize};

use super::error::{FEWEST_POINTS, LARGEST_EXTENT_M, LONGEST_M, WallsError};
use super::face::{APRON_M, Face, Segment};
use crate::math::{Rect, Vec2, vec2};
use crate::plan::Side;

/// A closed loop around floor, or around a hole in it, with the floor on its right.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outline {
    /// Corners, metres. Edge `k` goes from point `k` to the next; the last edge to point 0.
    #[serde(rename = "points")]
    pub points_m: Vec<Vec2>,
    /// Edges on an image side that are openings rather than walls, ascending, with the side.
    pub openings: Vec<(usize, Side)>,
}

impl Outline {
    /// Both ends of edge `k`, metres.
    pub fn edge(&self, k: usize) -> [Vec2; 2] {
        [self.points_m[k], self.points_m[(k + 1) % self.points_m.len()]]
    }

    /// The image side of the opening at edge `k`; `None` for a wall.
    pub fn opening(&self, k: usize) -> Option<Side> {
        self.openings.binary_search_by_key(&k, |&(edge, _)| edge).ok().map(|i| self.openings[i].1)
    }
}

/// Checks outlines of a file.
pub(crate) fn check(outlines: &[Outline]) -> Result<(), WallsError> {
    for (index, outline) in outlines.iter().enumerate() {
        let points = outline.points_m.len();
        if points < FEWEST_POINTS {
            return Err(WallsError::TooFewPoints { outline: index, points });
        }
        let ascends = outline.openings.is_sorted_by(|a, b| a.0 < b.0);
        let beyond = outline.openings.iter().find(|(edge, _)| *edge >= points || !ascends);
        if let Some(&(edge, _)) = beyond {
            return Err(WallsError::Opening { outline: index, edge, points });
        }
    }
    let all = || outlines.iter().flat_map(|outline| outline.points_m.iter());
    // `min` and `max` ignore NaN.
    if let Some(nan) = all().map(|p| p.x + p.y).find(|sum| sum.is_nan()) {
        return Err(WallsError::TooFar { extent_m: nan });
    }
    let bounds = bounds(outlines);
    let extent_m = bounds.width().max(bounds.height());
    let farthest_m = all().map(|p| p.x.abs().max(p.y.abs())).fold(extent_m, f64::max);
    if extent_m > LARGEST_EXTENT_M || farthest_m > LARGEST_EXTENT_M {
        return Err(WallsError::TooFar { extent_m: farthest_m });
    }
    let edges = outlines.iter().flat_map(|outline| (0..outline.points_m.len()).map(|k| outline.edge(k)));
    let length_m: f64 = edges.map(|[a, b]| a.distance(b)).sum();
    if length_m > LONGEST_M { Err(WallsError::TooLong { length_m }) } else { Ok(()) }
}

/// Returns wall faces: closed loops, and loops cut at their openings. Longest first, then by start.
pub(super) fn faces(outlines: &[Outline]) -> Vec<Face> {
    let mut faces: Vec<Face> = outlines.iter().flat_map(faces_of).collect();
    let key = |f: &Face| (f.length_m(), f.points_m[0]);
    faces.sort_by(|a, b| {
        let ((la, pa), (lb, pb)) = (key(a), key(b));
        lb.total_cmp(&la).then(pa.y.total_cmp(&pb.y)).then(pa.x.total_cmp(&pb.x))
    });
    faces
}

fn faces_of(outline: &Outline) -> Vec<Face> {
    let n = outline.points_m.len();
    let Some(&(first_open, _)) = outline.openings.first() else {
        let least = (0..n).min_by(|&a, &b| {
            let (a, b) = (outline.points_m[a], outline.points_m[b]);
            a.y.total_cmp(&b.y).then(a.x.total_cmp(&b.x))
        });
        let start = least.unwrap_or(0);
        let points_m = (0..n).map(|k| outline.points_m[(start + k) % n]).collect();
        return vec![Face { closed: true, points_m }];
    };
    let mut faces = Vec::new();
    let mut points_m: Vec<Vec2> = Vec::new();
    for step in 1..=n {
        let k = (first_open + step) % n;
        points_m.push(outline.points_m[k]);
        if outline.opening(k).is_some() {
            if points_m.len() > 1 {
                faces.push(Face { closed: false, points_m: std::mem::take(&mut points_m) });
            }
            points_m.clear();
        }
    }
    faces
}

/// Returns all walls as segments: those of faces, then the invisible ones of aprons.
pub(super) fn wall_segments(faces: &[Face], outlines: &[Outline]) -> Vec<Segment> {
    let mut segments = Vec::new();
    for (index, face) in faces.iter().enumerate() {
        let mut along_m = 0.0;
        let n = face.points_m.len();
        for k in 0..if face.closed { n } else { n - 1 } {
            let (a, b) = (face.points_m[k], face.points_m[(k + 1) % n]);
            segments.push(Segment { a, b, face: Some(index), along_m });
            along_m += a.distance(b);
        }
    }
    for outline in outlines {
        for &(k, side) in &outline.openings {
            let [a, b] = outline.edge(k);
            let out = side.outward() * APRON_M;
            segments.push(Segment { a, b: a + out, face: None, along_m: 0.0 });
            segments.push(Segment { a: b + out, b, face: None, along_m: 0.0 });
        }
    }
    segments
}

/// Returns the outlines with an apron beyond each opening.
pub(super) fn walked_loops(outlines: &[Outline]) -> Vec<Vec<Vec2>> {
    let with_aprons = |outline: &Outline| {
        let mut points = Vec::with_capacity(outline.points_m.len() + 2 * outline.openings.len());
        for (k, &point) in outline.points_m.iter().enumerate() {
            points.push(point);
            if let Some(side) = outline.opening(k) {
                let out = side.outward() * APRON_M;
                let [a, b] = outline.edge(k);
                points.extend([a + out, b + out]);
            }
        }
        points
    };
    outlines.iter().map(with_aprons).collect()
}

/// Bounding box of all outlines; empty at the origin if there are none.
pub(super) fn bounds(outlines: &[Outline]) -> Rect {
    let mut points = outlines.iter().flat_map(|o| o.points_m.iter().copied());
    let first = points.next().unwrap_or(Vec2::ZERO);
    points.fold(Rect { min: first, max: first }, |r, p| Rect {
        min: vec2(r.min.x.min(p.x), r.min.y.min(p.y)),
        max: vec2(r.max.x.max(p.x), r.max.y.max(p.y)),
    })
}
