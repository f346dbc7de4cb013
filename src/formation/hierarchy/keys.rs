//! Positions of all people in a key formation.

use std::path::Path;

use super::super::assignment::assign_places;
use super::super::picture::{is_picture, read_picture, read_points};
use super::super::places::{
    Strokes, centred, centroid, disc, grid, grid_of, line, outline, polygon, ranks_of_triangle, rings, spread, star,
    strokes, turned, wedge,
};
use super::super::request::{Assign, FormationShape, KeyRequest, RequestError};
use crate::math::{Vec2, vec2};

/// Default side of a picture's pixel, metres.
const USUAL_M_PER_PX: f64 = 0.1;
/// Samples per person for spreading people over lines or areas.
const SAMPLES: usize = 60;

/// The positions of a key formation, independent of the number of people.
pub(super) enum FormationLayout {
    /// The example's own positions.
    Example,
    /// A position per person, and their description for errors.
    Places(Vec<Vec2>, String),
    /// Evenly within an area, given by samples.
    Area(Vec<Vec2>),
    /// Evenly along lines; with the height of letters, or `None` if the spacing sets it.
    Lines(Strokes, Option<f64>),
    /// A shape for any number of people.
    Shape(FormationShape),
}

impl FormationLayout {
    /// Reads the positions that a key formation names.
    pub fn of(request: &KeyRequest, folder: &Path) -> Result<FormationLayout, RequestError> {
        if let Some(points) = &request.points {
            return Ok(FormationLayout::Places(points.clone(), "points".to_string()));
        }
        if let Some(text) = &request.text {
            let lines = strokes(text, request.height_m.unwrap_or(1.0));
            return Ok(FormationLayout::Lines(lines, request.height_m));
        }
        let Some(file) = &request.file else {
            return Ok(FormationLayout::Shape(request.shape.unwrap_or(FormationShape::Grid)).resolved());
        };
        let path = folder.join(file);
        if !is_picture(&path) {
            let points = read_points(&path)?;
            return Ok(FormationLayout::Places(points, format!("points in {}", file.display())));
        }
        let drawn = read_picture(&path)?;
        let metres = request.metres_per_pixel.unwrap_or(USUAL_M_PER_PX);
        let scaled = |places: Vec<Vec2>| places.into_iter().map(|place| place * metres).collect();
        Ok(if request.filled.unwrap_or(false) {
            FormationLayout::Area(scaled(drawn.area_px))
        } else {
            FormationLayout::Places(scaled(drawn.dots_px), format!("dots in {}", file.display()))
        })
    }

    fn resolved(self) -> FormationLayout {
        if let FormationLayout::Shape(FormationShape::Example) = self { FormationLayout::Example } else { self }
    }

    /// Number of people, if the formation fixes it.
    pub fn people(&self) -> Option<usize> {
        if let FormationLayout::Places(places, _) = self { Some(places.len()) } else { None }
    }
}

/// Input of the assignment of people to positions.
pub(super) struct PlacementInput<'c> {
    /// Number of people.
    pub people: usize,
    /// The example's positions in that frame.
    pub example: &'c [Vec2],
    /// Positions in the formation before.
    pub before: &'c [Vec2],
    /// Angle by which the crowd has wheeled since, radians.
    pub wheel_rad: f64,
    /// Whether the centroid of the example's own positions is kept.
    pub free: bool,
    /// Default assignment of people to positions.
    pub assign: Assign,
}

/// The position of each person, in the order of people.
pub(super) fn places(
    request: &KeyRequest,
    layout: &FormationLayout,
    input: &PlacementInput<'_>,
    key: &str,
) -> Result<Vec<Vec2>, RequestError> {
    let own = matches!(layout, FormationLayout::Example);
    let drawn = drawn(request, layout, input, key)?;
    let scale = request.scale.unwrap_or(1.0);
    // A point that is drawn stays where it is drawn; everything else is around its middle.
    let middle = if own { centroid(&drawn) } else { Vec2::ZERO };
    let at = request.at.unwrap_or(if own && input.free { middle } else { Vec2::ZERO });
    let around: Vec<Vec2> = drawn.iter().map(|&place| (place - middle) * scale).collect();
    let placed: Vec<Vec2> =
        turned(&around, request.turn_deg.to_radians()).into_iter().map(|place| place + at).collect();
    if own || request.assign.unwrap_or(input.assign) == Assign::Order {
        return Ok(placed);
    }
    // Seen from the middle, and with the whole that wheels.
    let to = turned(&centred(&placed), -input.wheel_rad);
    Ok(assign_places(&centred(input.before), &to).into_iter().map(|place| placed[place]).collect())
}

/// Positions in the formation's own frame, up forward.
fn drawn(
    request: &KeyRequest,
    layout: &FormationLayout,
    input: &PlacementInput<'_>,
    key: &str,
) -> Result<Vec<Vec2>, RequestError> {
    let people = input.people;
    let spacing_m = request.spacing_m.unwrap_or(1.0);
    Ok(match layout {
        FormationLayout::Example => input.example.to_vec(),
        FormationLayout::Places(places, what) => {
            if places.len() != people {
                let (key, what) = (key.to_string(), what.clone());
                return Err(RequestError::Count { key, people, places: places.len(), what });
            }
            places.clone()
        }
        FormationLayout::Area(samples) => spread(samples, people),
        FormationLayout::Lines(lines, Some(_)) => spread(&samples_along(lines, people), people),
        FormationLayout::Lines(lines, None) => {
            let length_m: f64 =
                lines.iter().flat_map(|line| line.windows(2)).map(|side| side[0].distance(side[1])).sum();
            let scale = if length_m > 0.0 { spacing_m * people as f64 / length_m } else { 1.0 };
            let lines: Strokes = lines.iter().map(|line| line.iter().map(|&point| point * scale).collect()).collect();
            spread(&samples_along(&lines, people), people)
        }
        FormationLayout::Shape(shape) => centred(&shaped(*shape, request, people, spacing_m)),
    })
}

fn shaped(shape: FormationShape, request: &KeyRequest, people: usize, spacing_m: f64) -> Vec<Vec2> {
    let radius_m = request.radius_m;
    let closed = |corners: &dyn Fn(f64) -> Vec<Vec2>, filled: bool| {
        // Without a radius: neighbours so far apart along the outline, or an area of a square of that for each.
        if !filled {
            let spacing_m = radius_m.is_none().then_some(spacing_m);
            return outline(people, &corners(radius_m.unwrap_or(1.0)), spacing_m);
        }
        let unit = corners(1.0);
        let area: f64 = unit.windows(2).map(|side| side[0].cross(side[1])).sum::<f64>().abs() / 2.0;
        let radius_m = radius_m.unwrap_or_else(|| spacing_m * (people as f64 / area).sqrt());
        spread(&samples_within(&corners(radius_m), people), people)
    };
    match shape {
        FormationShape::Example => Vec::new(),
        FormationShape::Grid => {
            let columns = request.columns.map_or_else(|| grid_of(people)[0], |columns| columns as usize);
            grid(people, columns, spacing_m)
        }
        FormationShape::Line => line(people, spacing_m),
        FormationShape::Ring => rings(people, request.rings.unwrap_or(1) as usize, spacing_m, radius_m),
        FormationShape::Disc => disc(people, spacing_m, radius_m),
        FormationShape::Triangle if request.filled.unwrap_or(true) && radius_m.is_none() => {
            ranks_of_triangle(people, spacing_m)
        }
        FormationShape::Triangle => closed(&|radius_m| polygon(3, radius_m), request.filled.unwrap_or(true)),
        FormationShape::Polygon => {
            let corners = request.corners.unwrap_or(6) as usize;
            closed(&|radius_m| polygon(corners, radius_m), request.filled.unwrap_or(false))
        }
        FormationShape::Star => {
            let (points, inner) = (request.corners.unwrap_or(5) as usize, request.inner.unwrap_or(0.45));
            closed(&|radius_m| star(points, inner, radius_m), request.filled.unwrap_or(false))
        }
        FormationShape::Wedge => wedge(people, spacing_m, request.angle_deg.unwrap_or(80.0).to_radians()),
    }
}

/// Samples along lines, evenly spaced.
fn samples_along(lines: &Strokes, people: usize) -> Vec<Vec2> {
    let sides = || lines.iter().flat_map(|line| line.windows(2));
    let length_m: f64 = sides().map(|side| side[0].distance(side[1])).sum();
    let count = (people * SAMPLES).max(200) as f64;
    let mut samples = Vec::new();
    for side in sides() {
        let steps = (side[0].distance(side[1]) / length_m.max(1e-12) * count).ceil().max(1.0) as usize;
        samples.extend((0..steps).map(|step| side[0].lerp(side[1], (step as f64 + 0.5) / steps as f64)));
    }
    samples
}

/// Samples within a closed line, evenly spaced.
fn samples_within(corners: &[Vec2], people: usize) -> Vec<Vec2> {
    let reach_m = corners.iter().map(|corner| corner.length()).fold(0.0, f64::max);
    let side = (((people * SAMPLES).max(400) as f64).sqrt() * 1.6).ceil() as usize;
    let at = |k: usize| ((k as f64 + 0.5) / side as f64 * 2.0 - 1.0) * reach_m;
    let all = (0..side * side).map(|k| vec2(at(k % side), at(k / side)));
    all.filter(|&point| is_within(point, corners)).collect()
}

/// Whether a point lies within a closed line (even-odd rule).
fn is_within(point: Vec2, corners: &[Vec2]) -> bool {
    let crosses = |side: &&[Vec2]| {
        let (a, b) = (side[0], side[1]);
        (a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)
    };
    corners.windows(2).filter(crosses).count() % 2 == 1
}
