//! Closed outlines of the floor, and the faces, wall segments and walkable loops made from them.

use serde::{Deserialize, Serialize};

use super::face::{APRON_M, Face, Segment};
use super::fit::{self, SideLine};
use super::runs::{Runs, Sample};
use super::subpixel;
use crate::math::{Rect, Vec2, vec2};
use crate::plan::cracks::CrackLoop;
use crate::plan::{FloorPlan, Side};

/// A closed loop around floor (or around a hole in it), floor on the right.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outline {
    /// Corners, metres. Edge `k` runs from point `k` to the next; the last edge to point 0.
    #[serde(rename = "points")]
    pub points_m: Vec<Vec2>,
    /// Edges that are no wall but an opening in an image side, with that side, by ascending edge.
    pub openings: Vec<(usize, Side)>,
}

impl Outline {
    /// The two ends of edge `k`.
    pub fn edge(&self, k: usize) -> [Vec2; 2] {
        [self.points_m[k], self.points_m[(k + 1) % self.points_m.len()]]
    }

    /// The image side on which edge `k` is open, or `None` for a wall.
    pub fn opening(&self, k: usize) -> Option<Side> {
        self.openings.binary_search_by_key(&k, |&(edge, _)| edge).ok().map(|i| self.openings[i].1)
    }
}

/// The outline of one boundary: walls as fitted polylines, openings straight along the image's sides.
pub(super) fn of_boundary(plan: &FloorPlan, cracks: &CrackLoop, tolerance_scale: f64) -> Outline {
    let samples = subpixel::samples(plan, cracks, tolerance_scale);
    let sides: Vec<Option<Side>> = (0..cracks.len()).map(|k| side_of(plan, cracks, k)).collect();
    let stretches = stretches(&sides);
    let mut points: Vec<[f64; 2]> = Vec::new();
    let mut openings = Vec::new();
    if let [_] = stretches[..] {
        let runs = Runs::new(true, cracks, &samples);
        points = fit::polyline(&runs, None);
    } else {
        for (k, stretch) in stretches.iter().enumerate() {
            let before = stretches[(k + stretches.len() - 1) % stretches.len()].side;
            let after = stretches[(k + 1) % stretches.len()].side;
            match (stretch.side, before, after) {
                (None, Some(before), Some(after)) => {
                    let runs = stretch.runs(cracks, &samples);
                    points.extend(fit::polyline(&runs, Some([side_line(plan, before), side_line(plan, after)])));
                }
                (Some(side), Some(_), _) => {
                    // Two openings meet in the image's corner.
                    points.push(cracks[stretch.from].map(f64::from));
                    openings.push((points.len() - 1, side));
                }
                // The wall before ends where this opening starts.
                (Some(side), None, _) => openings.push((points.len() - 1, side)),
                (None, ..) => {}
            }
        }
    }
    Outline { points_m: points.into_iter().map(|p| plan.px_to_m(p)).collect(), openings }
}

/// Consecutive pixel edges that are all wall or all the same opening.
struct Stretch {
    side: Option<Side>,
    from: usize,
    count: usize,
}

impl Stretch {
    fn runs(&self, cracks: &CrackLoop, samples: &[Sample]) -> Runs {
        let n = cracks.len();
        let points: Vec<[i32; 2]> = (0..=self.count).map(|k| cracks[(self.from + k) % n]).collect();
        let samples: Vec<Sample> = (0..self.count).map(|k| samples[(self.from + k) % n]).collect();
        Runs::new(false, &points, &samples)
    }
}

/// All stretches of a boundary in order, from a wall on if there is one; a single one if it is wall all around.
fn stretches(sides: &[Option<Side>]) -> Vec<Stretch> {
    let n = sides.len();
    let starts = || (0..n).filter(|&k| sides[k] != sides[(k + n - 1) % n]);
    let first = starts().find(|&k| sides[k].is_none()).or(starts().next()).unwrap_or(0);
    let mut stretches: Vec<Stretch> = Vec::new();
    for step in 0..n {
        let k = (first + step) % n;
        match stretches.last_mut() {
            Some(last) if last.side == sides[k] => last.count += 1,
            _ => stretches.push(Stretch { side: sides[k], from: k, count: 1 }),
        }
    }
    stretches
}

fn side_line(plan: &FloorPlan, side: Side) -> SideLine {
    match side {
        Side::West => SideLine { axis: 0, at: 0.0 },
        Side::East => SideLine { axis: 0, at: f64::from(plan.width_px) },
        Side::North => SideLine { axis: 1, at: 0.0 },
        Side::South => SideLine { axis: 1, at: f64::from(plan.height_px) },
    }
}

/// The image side on which crack `k` is part of an opening.
fn side_of(plan: &FloorPlan, cracks: &CrackLoop, k: usize) -> Option<Side> {
    let [x0, y0] = cracks[k];
    let [x1, y1] = cracks[(k + 1) % cracks.len()];
    let (width, height) = (plan.width_px as i32, plan.height_px as i32);
    let side = if x0 == 0 && x1 == 0 {
        Side::West
    } else if x0 == width && x1 == width {
        Side::East
    } else if y0 == 0 && y1 == 0 {
        Side::North
    } else if y0 == height && y1 == height {
        Side::South
    } else {
        return None;
    };
    let middle = plan.px_to_m([f64::from(x0 + x1) * 0.5, f64::from(y0 + y1) * 0.5]);
    let within = |o: &crate::plan::Opening| {
        o.side == side
            && match side {
                Side::West | Side::East => middle.y > o.from_m.y && middle.y < o.to_m.y,
                Side::South | Side::North => middle.x > o.from_m.x && middle.x < o.to_m.x,
            }
    };
    plan.openings.iter().any(within).then_some(side)
}

/// Wall faces: closed loops as they are, others cut at their openings. Longest first, ties by start.
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

/// All walls as segments: first the faces', then the unseen ones of the aprons.
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

/// The outlines with an apron beyond each opening.
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

/// The rectangle around all outlines; empty at the origin without any.
pub(super) fn bounds(outlines: &[Outline]) -> Rect {
    let mut points = outlines.iter().flat_map(|o| o.points_m.iter().copied());
    let first = points.next().unwrap_or(Vec2::ZERO);
    points.fold(Rect { min: first, max: first }, |r, p| Rect {
        min: vec2(r.min.x.min(p.x), r.min.y.min(p.y)),
        max: vec2(r.max.x.max(p.x), r.max.y.max(p.y)),
    })
}
