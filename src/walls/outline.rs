//! Outlines of the floor, and the faces, wall segments and walkable loops made from them.

use serde::{Deserialize, Serialize};

use super::error::{FEWEST_POINTS, HIGHEST_FURNITURE_M, LARGEST_EXTENT_M, LONGEST_M, WallsError};
use super::face::{APRON_M, Face, Segment};
use crate::math::{Rect, Vec2, vec2};
use crate::plan::{FloorPlan, PlanClass, Side};

/// A closed loop around floor, or around a hole in it, with the floor on its right.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outline {
    /// Corners, metres. Edge `k` goes from point `k` to the next; the last edge to point 0.
    #[serde(rename = "points")]
    pub points_m: Vec<Vec2>,
    /// Edges on an image side that are openings rather than walls, ascending, with the side.
    pub openings: Vec<(usize, Side)>,
    /// Height of the furniture that it goes around, metres; `None` for walls, up to the ceiling.
    #[serde(default, rename = "height_m", skip_serializing_if = "Option::is_none")]
    pub furniture_m: Option<f64>,
    /// Both ends of each window in it, metres, floor on the right.
    #[serde(default, rename = "windows", skip_serializing_if = "Vec::is_empty")]
    pub windows_m: Vec<[Vec2; 2]>,
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

/// Longest and broadest island that may be a cabinet or a counter, metres, and least ratio of the two: others are pillars.
const CABINET_M: [f64; 2] = [8.0, 1.6];
const LEAST_RATIO: f64 = 1.7;
/// How far from the line on which people stand its outline may be, metres.
const BESIDE_M: f64 = 0.75;

impl Outline {
    /// True around an island as small as a cabinet of a ticket gate or a counter.
    pub(super) fn is_small_island(&self) -> bool {
        let edges = || (0..self.points_m.len()).map(|k| self.edge(k));
        let area_m2 = 0.5 * edges().map(|[a, b]| a.cross(b)).sum::<f64>();
        let around_m: f64 = edges().map(|[a, b]| a.distance(b)).sum();
        // The rectangle of this area and circumference.
        let squared = 0.0625 * around_m * around_m - area_m2;
        let (middle_m, apart_m) = (0.25 * around_m, squared.max(0.0).sqrt());
        let (long_m, broad_m) = (middle_m + apart_m, middle_m - apart_m);
        let fits = long_m <= CABINET_M[0] && broad_m <= CABINET_M[1] && long_m >= LEAST_RATIO * broad_m;
        self.openings.is_empty() && area_m2 > 0.0 && fits
    }

    /// True if a corner or the middle of an edge is beside a line on which people stand.
    pub(super) fn stands_beside(&self, [a, b]: [Vec2; 2]) -> bool {
        let along = b - a;
        let squared = along.length_squared();
        let away = |p: Vec2| {
            let share = if squared > 0.0 { ((p - a).dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
            p.distance(a + along * share)
        };
        (0..self.points_m.len()).any(|k| {
            let [from, to] = self.edge(k);
            away(from) < BESIDE_M || away(from.lerp(to, 0.5)) < BESIDE_M
        })
    }
}

/// Least share of an island's outline that is furniture, so that the island is.
const LEAST_FURNITURE: f64 = 0.8;

impl Outline {
    /// Height of the island inside the outline, metres, if it is furniture that is lower than the walls.
    ///
    /// Each edge counts by its length, for the class of the pixel behind its middle; the commonest class decides.
    pub(super) fn height_of_furniture(&self, plan: &FloorPlan) -> Option<f64> {
        let edges = || (0..self.points_m.len()).map(|k| self.edge(k));
        // The floor is on the right: a counter-clockwise outline is around an island.
        let is_island = self.openings.is_empty() && edges().map(|[a, b]| a.cross(b)).sum::<f64>() > 0.0;
        if !is_island {
            return None;
        }
        let mut lengths_m = [0.0; PlanClass::ALL.len()];
        for [a, b] in edges() {
            let Some(along) = (b - a).normalized() else { continue };
            let behind = a.lerp(b, 0.5) + along.left() * (1.5 * plan.metres_per_pixel);
            lengths_m[plan.class_at(behind) as usize] += a.distance(b);
        }
        let share = |class: PlanClass| lengths_m[class as usize];
        let furniture = || PlanClass::ALL.into_iter().filter(|class| class.height_m().is_some());
        let is_furniture = furniture().map(share).sum::<f64>() >= LEAST_FURNITURE * lengths_m.iter().sum::<f64>();
        let commonest = furniture().max_by(|&a, &b| share(a).total_cmp(&share(b)));
        commonest.filter(|_| is_furniture).and_then(PlanClass::height_m)
    }
}

/// Shortest window, metres, and step at which walls are searched for them, pixels of the plan.
const SHORTEST_WINDOW_M: f64 = 0.35;
const WINDOW_STEP_PX: f64 = 0.5;

impl Outline {
    /// The parts of its walls behind which the plan shows a window.
    pub(super) fn windows_of(&self, plan: &FloorPlan) -> Vec<[Vec2; 2]> {
        let px = plan.metres_per_pixel;
        let mut windows = Vec::new();
        for k in (0..self.points_m.len()).filter(|&k| self.opening(k).is_none()) {
            let [a, b] = self.edge(k);
            let Some(along) = (b - a).normalized() else { continue };
            let length_m = a.distance(b);
            if length_m < SHORTEST_WINDOW_M {
                continue;
            }
            let is_window = |at_m: f64| {
                let on = a + along * at_m + along.left() * (1.5 * px);
                plan.class_at(on) == PlanClass::Window
            };
            let steps = (length_m / (WINDOW_STEP_PX * px)).ceil().max(1.0) as usize;
            let at_m = |step: usize| length_m * step as f64 / steps as f64;
            let mut from = None;
            for step in 0..=steps + 1 {
                match (step <= steps && is_window(at_m(step)), from) {
                    (true, None) => from = Some(step),
                    (false, Some(first)) => {
                        let ends_m = [at_m(first), at_m(step - 1)];
                        if ends_m[1] - ends_m[0] >= SHORTEST_WINDOW_M {
                            windows.push(ends_m.map(|at_m| a + along * at_m));
                        }
                        from = None;
                    }
                    _ => {}
                }
            }
        }
        windows
    }
}

/// Checks outlines of a file.
pub(crate) fn check(outlines: &[Outline]) -> Result<(), WallsError> {
    for (index, outline) in outlines.iter().enumerate() {
        let points = outline.points_m.len();
        if points < FEWEST_POINTS {
            return Err(WallsError::TooFewPoints { outline: index, points });
        }
        if let Some(height_m) =
            outline.furniture_m.filter(|height_m| !(*height_m > 0.0 && *height_m <= HIGHEST_FURNITURE_M))
        {
            return Err(WallsError::Furniture { outline: index, height_m });
        }
        let ascends = outline.openings.is_sorted_by(|a, b| a.0 < b.0);
        let beyond = outline.openings.iter().find(|(edge, _)| *edge >= points || !ascends);
        if let Some(&(edge, _)) = beyond {
            return Err(WallsError::Opening { outline: index, edge, points });
        }
    }
    let all = || outlines.iter().flat_map(|outline| outline.points_m.iter().chain(outline.windows_m.iter().flatten()));
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
        return vec![Face { closed: true, points_m, furniture_m: outline.furniture_m }];
    };
    let mut faces = Vec::new();
    let mut points_m: Vec<Vec2> = Vec::new();
    for step in 1..=n {
        let k = (first_open + step) % n;
        points_m.push(outline.points_m[k]);
        if outline.opening(k).is_some() {
            if points_m.len() > 1 {
                faces.push(Face { closed: false, points_m: std::mem::take(&mut points_m), furniture_m: None });
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
