//! Resolves places of routes: from names in a scenario to cells of the ground.

use super::ground::{Ground, apron};
use super::{FloorPoint, Place, PlaceRequest, RoutesError};
use crate::math::{Rect, Vec2, vec2};
use crate::plan::{FloorPlan, LARGEST_COORDINATE};
use crate::walls::APRON_M;

/// Half side of the square around a point, metres.
const POINT_REACH_M: f64 = 1.0;
/// Distance beyond an opening's edge at which its goal cells begin, metres.
const OPENING_DEPTH_M: f64 = APRON_M - 0.4;

/// The use of a place by a route, for messages: route name and role.
#[derive(Clone, Copy)]
pub(super) struct PlaceUsage<'a> {
    pub(super) route: &'a str,
    pub(super) role: &'static str,
}

/// Finds the place of a request.
pub(super) fn place(
    plan: &FloorPlan,
    ground: &Ground,
    request: &PlaceRequest,
    usage: PlaceUsage<'_>,
) -> Result<Place, RoutesError> {
    match request {
        PlaceRequest::Opening(name) => opening(plan, name, usage),
        PlaceRequest::Point(point) => {
            let p = finite(point.to_m(plan), request, usage)?;
            let cell = ground.walkable_near(p, 0.2).ok_or_else(|| not_on_floor(plan, ground, p, request, usage))?;
            let centre = ground.lattice.centre(cell);
            // A point in the narrow band along a wall moves to the nearest walkable cell.
            let p = if ground.lattice.cell_at(p) == Some(cell) { p } else { centre };
            let reach = vec2(POINT_REACH_M, POINT_REACH_M);
            Ok(Place::Area([p - reach, p + reach]))
        }
        PlaceRequest::Area([a, b]) => {
            let (a, b) = (finite(Vec2::from(*a), request, usage)?, finite(Vec2::from(*b), request, usage)?);
            let area = Rect::around(a, b);
            if area_cells(ground, area).is_empty() {
                return Err(not_on_floor(plan, ground, area.centre(), request, usage));
            }
            Ok(Place::Area([area.min, area.max]))
        }
    }
}

fn opening(plan: &FloorPlan, name: &str, usage: PlaceUsage<'_>) -> Result<Place, RoutesError> {
    let wanted = name.trim();
    if let Some(index) = plan.openings.iter().position(|o| o.name.eq_ignore_ascii_case(wanted)) {
        return Ok(Place::Opening(index));
    }
    let mut painted = plan.painted.entrances.iter();
    if let Some(entrance) = painted.find(|entrance| entrance.name.eq_ignore_ascii_case(wanted)) {
        return Ok(Place::Area(entrance.area_m));
    }
    let names = plan.openings.iter().map(|o| &o.name);
    let openings: Vec<String> = names.chain(plan.painted.entrances.iter().map(|e| &e.name)).cloned().collect();
    let nearest = openings
        .iter()
        .map(|o| (strsim::damerau_levenshtein(&o.to_lowercase(), &wanted.to_lowercase()), o))
        .min_by_key(|(distance, _)| *distance)
        .filter(|(distance, _)| *distance <= 3)
        .map(|(_, o)| o.clone());
    Err(RoutesError::UnknownOpening { route: usage.route.into(), name: name.into(), nearest, openings })
}

fn finite(p: Vec2, request: &PlaceRequest, usage: PlaceUsage<'_>) -> Result<Vec2, RoutesError> {
    // Coordinates beyond any plan would overflow the grid's indices; NaN must be out of range.
    match [p.x, p.y].into_iter().find(|c| c.is_nan() || c.abs() > LARGEST_COORDINATE) {
        None => Ok(p),
        Some(value) => {
            let (route, place) = (usage.route.into(), request.describe());
            Err(RoutesError::TooFar { route, role: usage.role, place, value })
        }
    }
}

fn not_on_floor(
    plan: &FloorPlan,
    ground: &Ground,
    p: Vec2,
    request: &PlaceRequest,
    usage: PlaceUsage<'_>,
) -> RoutesError {
    let nearest = (0..ground.lattice.len()).filter(|&c| ground.is_walkable(c)).min_by(|&a, &b| {
        let distance = |c| ground.lattice.centre(c).distance(p);
        distance(a).total_cmp(&distance(b))
    });
    let nearest = nearest.map(|cell| Box::new(spot(plan, ground, cell, "")));
    let at_px = plan.m_to_px(p);
    RoutesError::NotOnFloor { route: usage.route.into(), role: usage.role, place: request.describe(), at_px, nearest }
}

/// Description of a cell, for messages.
pub(super) fn spot(plan: &FloorPlan, ground: &Ground, cell: usize, name: &str) -> FloorPoint {
    let at_m = ground.lattice.centre(cell);
    let part_m2 = ground.part_area_m2(ground.part(cell));
    FloorPoint { name: name.into(), at_m, at_px: plan.m_to_px(at_m), part_m2 }
}

/// Cells that count as the place.
pub(super) fn cells(plan: &FloorPlan, ground: &Ground, place: Place) -> Vec<usize> {
    match place {
        Place::Opening(index) => plan.openings.get(index).map_or(Vec::new(), |opening| {
            let out = opening.side.outward() * OPENING_DEPTH_M;
            let far = Rect::around(opening.from_m + out, opening.to_m + opening.side.outward() * APRON_M);
            within(ground, far)
        }),
        Place::Area([min, max]) => area_cells(ground, Rect { min, max }),
    }
}

/// Cells that count as a via place: the whole area, so that people pass over its full width, or an opening's apron.
pub(super) fn via_cells(plan: &FloorPlan, ground: &Ground, place: Place) -> Vec<usize> {
    match place {
        Place::Opening(index) => plan.openings.get(index).map_or(Vec::new(), |o| within(ground, apron(o))),
        Place::Area(_) => cells(plan, ground, place),
    }
}

/// The cell nearest to the centroid of some cells, shifted towards more room.
pub(super) fn middle(ground: &Ground, cells: &[usize]) -> Option<Vec2> {
    if cells.is_empty() {
        return None;
    }
    let sum = cells.iter().fold(Vec2::ZERO, |sum, &c| sum + ground.lattice.centre(c));
    let mean = sum / cells.len() as f64;
    let score = |c: usize| ground.lattice.centre(c).distance(mean) - 0.5 * ground.cell_clearance_m(c).min(1.0);
    cells
        .iter()
        .copied()
        .min_by(|&a, &b| score(a).total_cmp(&score(b)).then(a.cmp(&b)))
        .map(|c| ground.lattice.centre(c))
}

/// Walkable cells in a rectangle.
fn within(ground: &Ground, area: Rect) -> Vec<usize> {
    let mut cells = ground.lattice.cells_within(area);
    cells.retain(|&c| ground.is_walkable(c));
    cells
}

/// Walkable cells of a rectangle that are connected within it: those around its centre, or the largest group if the
/// centre is wall. Cells behind a wall do not count.
fn area_cells(ground: &Ground, area: Rect) -> Vec<usize> {
    let all = within(ground, area);
    let mut left = vec![false; ground.lattice.len()];
    all.iter().for_each(|&cell| left[cell] = true);
    let centre = ground.lattice.cell_at(area.centre());
    let mut best: Vec<usize> = Vec::new();
    for first in all {
        if !std::mem::take(&mut left[first]) {
            continue;
        }
        let joined = ground.lattice.joined(first, |cell| std::mem::take(&mut left[cell]));
        let holds_centre = centre.is_some_and(|c| joined.contains(&c));
        if holds_centre || joined.len() > best.len() {
            best = joined;
        }
        if holds_centre {
            break;
        }
    }
    best.sort_unstable();
    best
}
