//! Boundaries of the floor, split into fitted walls and straight openings.

use super::fit::{Corner, Fitted, SideLine};
use super::outline::Outline;
use super::runs::{Runs, Sample};
use super::subpixel;
use crate::math::{Vec2, vec2};
use crate::plan::cracks::CrackLoop;
use crate::plan::{FloorPlan, Side};

/// A closed boundary around floor (or around a hole in it), floor on the right.
#[derive(Debug)]
pub(super) struct Boundary {
    parts: Vec<Part>,
    /// Twice the signed area inside the pixel edges, square pixels.
    doubled_area: f64,
}

#[derive(Debug)]
#[allow(clippy::large_enum_variant)] // a boundary has few parts
enum Part {
    Wall(Fitted),
    Opening {
        side: Side,
        /// Start and end on the image's side, pixels.
        ends: [Vec2; 2],
        /// Whether the previous opening ends at its start, in the image's corner.
        from_corner: bool,
    },
}

/// A corner of a boundary.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex {
    /// Pixels from the top left, y down.
    pub(super) at: Vec2,
    /// Index of its part of the boundary, and the run within that part.
    part: usize,
    run: usize,
}

impl Boundary {
    /// Fits the walls of a boundary, with `tolerance_scale` times the usual tolerance.
    pub(super) fn fit(plan: &FloorPlan, cracks: &CrackLoop, tolerance_scale: f64) -> Boundary {
        let samples = subpixel::samples(plan, cracks, tolerance_scale);
        let sides: Vec<Option<Side>> = (0..cracks.len()).map(|k| side_of(plan, cracks, k)).collect();
        let stretches = stretches(&sides);
        let corner = |k: usize| cracks[k % cracks.len()].map(f64::from);
        let doubled_area = (0..cracks.len()).map(|k| cross(corner(k), corner(k + 1))).sum();
        if let [_] = stretches[..] {
            let wall = Fitted::new(Runs::new(true, cracks, &samples), None);
            return Boundary { parts: vec![Part::Wall(wall)], doubled_area };
        }
        let count = stretches.len();
        let parts = stretches.iter().enumerate().filter_map(|(k, stretch)| {
            let before = stretches[(k + count - 1) % count].side;
            let after = stretches[(k + 1) % count].side;
            match (stretch.side, before, after) {
                (None, Some(before), Some(after)) => {
                    let runs = stretch.runs(cracks, &samples);
                    Some(Part::Wall(Fitted::new(runs, Some([side_line(plan, before), side_line(plan, after)]))))
                }
                (Some(side), ..) => {
                    let ends = [corner(stretch.from), corner(stretch.from + stretch.count)].map(|[x, y]| vec2(x, y));
                    Some(Part::Opening { side, ends, from_corner: before.is_some() })
                }
                (None, ..) => None,
            }
        });
        Boundary { parts: parts.collect(), doubled_area }
    }

    /// Returns the corners in order.
    pub(super) fn vertices(&self) -> Vec<Vertex> {
        let mut vertices = Vec::new();
        for (part, content) in self.parts.iter().enumerate() {
            match content {
                Part::Wall(wall) => {
                    let vertex = |Corner { at: [x, y], run }| Vertex { at: vec2(x, y), part, run };
                    vertices.extend(wall.corners().into_iter().map(vertex));
                }
                &Part::Opening { ends, from_corner: true, .. } => vertices.push(Vertex { at: ends[0], part, run: 0 }),
                Part::Opening { .. } => {}
            }
        }
        vertices
    }

    /// Converts to an outline in metres.
    pub(super) fn outline(&self, plan: &FloorPlan) -> Outline {
        let vertices = self.vertices();
        let mut openings = Vec::new();
        for (part, content) in self.parts.iter().enumerate() {
            if let &Part::Opening { side, from_corner, .. } = content {
                // The opening starts at its own corner, or where the previous wall ends.
                let last = if from_corner { part } else { part - 1 };
                openings.push((vertices.partition_point(|vertex| vertex.part <= last) - 1, side));
            }
        }
        let points_m = vertices.iter().map(|v| plan.px_to_m([v.at.x, v.at.y])).collect();
        let outline = Outline { points_m, openings, furniture_m: None, windows_m: Vec::new() };
        let furniture_m = outline.height_of_furniture(plan);
        let windows_m = if furniture_m.is_some() { Vec::new() } else { outline.windows_of(plan) };
        Outline { furniture_m, windows_m, ..outline }
    }

    /// Whether the corners enclose an area of the same orientation as the pixel edges.
    pub(super) fn encloses(&self, vertices: &[Vertex]) -> bool {
        let count = vertices.len();
        let doubled_area: f64 = (0..count).map(|k| vertices[k].at.cross(vertices[(k + 1) % count].at)).sum();
        count >= 3 && doubled_area * self.doubled_area > 0.0
    }

    /// Whether the edge between two consecutive corners has a length; for openings, a forward one.
    pub(super) fn leads_on(&self, a: Vertex, b: Vertex) -> bool {
        match self.opening_between(a, b) {
            Some(along) => (b.at - a.at).dot(along) > 0.0,
            None => a.at != b.at,
        }
    }

    /// Direction of the opening between two consecutive corners, `None` for a wall.
    fn opening_between(&self, a: Vertex, b: Vertex) -> Option<Vec2> {
        let is_gap = self.parts.len() > 1 && (a.part != b.part || b.run < a.run);
        let from_wall = if is_gap { self.parts.get(a.part + 1) } else { None };
        match (&self.parts[a.part], from_wall) {
            (Part::Opening { ends, .. }, _) | (_, Some(Part::Opening { ends, .. })) => Some(ends[1] - ends[0]),
            _ => None,
        }
    }

    /// Resets the walls between two consecutive corners to the pixel edges near `place`. Returns whether any changed.
    pub(super) fn put_on_edges(&mut self, a: Vertex, b: Vertex, place: Vec2) -> bool {
        let place = [place.x, place.y];
        let is_opening = self.opening_between(a, b).is_some();
        let ends = if is_opening {
            vec![(a.part, a.run, a.run), (b.part, b.run, b.run)]
        } else {
            vec![(a.part, a.run, b.run)]
        };
        let mut changed = false;
        for (part, from, to) in ends {
            let Part::Wall(wall) = &mut self.parts[part] else { continue };
            let count = wall.runs.len();
            let to = if to < from { to + count } else { to };
            changed |= wall.put_on_edges(from, to, place) || {
                // The runs between are on pixel edges already: the adjacent ones cause the crossing.
                let from = if wall.runs.closed { from + count - 1 } else { from.saturating_sub(1) };
                let to = if wall.runs.closed { to + count + 1 } else { (to + 1).min(count) };
                wall.put_on_edges(from, to, place)
            };
        }
        changed
    }

    /// Resets all walls to the pixel edges. Returns whether any changed.
    pub(super) fn put_all_on_edges(&mut self) -> bool {
        let walls = self.parts.iter_mut().filter_map(|part| match part {
            Part::Wall(wall) => Some(wall),
            Part::Opening { .. } => None,
        });
        // `fold`, not `any`, which would stop at the first change.
        walls.map(|wall| wall.put_all_on_edges()).fold(false, |any, changed| any | changed)
    }
}

fn cross([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    ax * by - ay * bx
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

/// Splits a boundary into stretches in order, beginning with a wall if there is one.
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

/// Returns the image side on which crack `k` is part of an opening.
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
