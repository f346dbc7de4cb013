//! Default routes, for scenarios without routes.

use super::draft::RouteDraft;
use super::ground::Ground;
use super::legs::{FieldStore, LegEnd};
use super::{Place, RoutesError, life, targets};
use crate::math::vec2;
use crate::plan::{FloorPlan, Opening};
use crate::rooms::Entrance;

/// Largest number of places joined by default routes: 12 routes, both directions included.
const MOST_PLACES: usize = 4;
/// Smallest area of a part of the floor with default routes, square metres.
const LEAST_PART_M2: f64 = 1.0;
/// Half side of the squares that replace missing openings, metres.
const STAND_IN_REACH_M: f64 = 1.5;
/// Least clearance of paths to these squares, metres: leads through doors, but not between chairs.
const ROOMY_M: f64 = 0.34;
/// Least share of the floor with that clearance; otherwise all of the floor is used.
const ROOMY_SHARE: f64 = 0.3;
/// Least walking distance between these squares, metres.
const LEAST_APART_M: f64 = 2.0;
/// Least distance between these squares, as a share of the longest walking distance.
const APART_SHARE: f64 = 0.3;
/// Least distance of a square from several openings, relative to that between openings.
const BEYOND_OPENINGS: f64 = 1.5;
/// Range to which widths are clamped for shares, metres.
const SHARE_WIDTHS_M: [f64; 2] = [0.6, 8.0];

#[derive(Clone)]
struct Endpoint {
    place: Place,
    name: String,
    width_m: f64,
    part: u16,
}

/// Joins the widest openings and doors to the outside, all pairs in both directions. If there are fewer than two, or if they lie close together
/// at the edge of a large floor, distant places are added. A route's share is the product of the widths at its ends.
pub(super) fn drafts(
    plan: &FloorPlan,
    ground: &Ground,
    fields: &mut FieldStore<'_>,
    entrances: &[Entrance],
) -> Result<Vec<RouteDraft>, RoutesError> {
    let all = entrance_endpoints(plan, ground, entrances);
    let endpoints = with_far_places(plan, ground, fields, &all)?;
    let mut drafts = Vec::new();
    for from in &endpoints {
        for to in endpoints.iter().filter(|to| to.part == from.part && to.place != from.place) {
            drafts.push(RouteDraft {
                name: format!("{} to {}", from.name, to.name),
                place_names: vec![from.name.clone(), to.name.clone()],
                start: from.place,
                via: Vec::new(),
                stops: Vec::new(),
                arrivals: None,
                life: None,
                goal: to.place,
                share: from.width_m * to.width_m,
            });
        }
    }
    Ok(drafts)
}

/// Returns all openings that are wide enough for a person, the entrances painted in the plan, and doors to the outside.
fn entrance_endpoints(plan: &FloorPlan, ground: &Ground, entrances: &[Entrance]) -> Vec<Endpoint> {
    let endpoint = |(index, opening): (usize, &Opening)| {
        let place = Place::Opening(index);
        let cell = *targets::cells(plan, ground, place).first()?;
        let width_m = opening.width_m().clamp(SHARE_WIDTHS_M[0], SHARE_WIDTHS_M[1]);
        Some(Endpoint { place, name: opening.name.clone(), width_m, part: ground.part(cell) })
    };
    let painted = plan.painted.entrances.iter().filter_map(|entrance| {
        let place = Place::Area(entrance.area_m);
        let cell = *targets::cells(plan, ground, place).first()?;
        let width_m = entrance.area_m[0].distance(entrance.area_m[1]).clamp(SHARE_WIDTHS_M[0], SHARE_WIDTHS_M[1]);
        Some(Endpoint { place, name: entrance.name.clone(), width_m, part: ground.part(cell) })
    });
    let is_painted = |entrance: &&Entrance| plan.painted.entrances.iter().any(|painted| painted.name == entrance.name);
    let doors = entrances.iter().filter(|entrance| entrance.opening.is_none() && !is_painted(entrance));
    let doors = doors.filter_map(|door| {
        let life::End { place, name, width_m, part, .. } = life::end(plan, ground, door)?;
        Some(Endpoint { place, name, width_m, part })
    });
    plan.openings.iter().enumerate().filter_map(endpoint).chain(painted).chain(doors).collect()
}

/// Returns the widest of them that have another one within walking distance.
fn widest(plan: &FloorPlan, mut endpoints: Vec<Endpoint>) -> Vec<Endpoint> {
    let width = |s: &Endpoint| match s.place {
        Place::Opening(index) => plan.openings[index].width_m(),
        Place::Area(_) => s.width_m,
    };
    endpoints.sort_by(|a, b| width(b).total_cmp(&width(a)));
    // Removing one may leave its partner alone, so repeat until stable.
    loop {
        let lonely = |endpoints: &[Endpoint], part: u16| endpoints.iter().filter(|s| s.part == part).count() < 2;
        let among = endpoints.len().min(MOST_PLACES);
        match (0..among).find(|&k| lonely(&endpoints[..among], endpoints[k].part)) {
            // Its partner is a narrower opening that is not among the widest.
            Some(k) => {
                endpoints.remove(k);
            }
            None => break,
        }
    }
    endpoints.truncate(MOST_PLACES);
    endpoints
}

/// The widest entrances, and places that are as far as possible from them, by walking distance.
fn with_far_places(
    plan: &FloorPlan,
    ground: &Ground,
    fields: &mut FieldStore<'_>,
    entrances: &[Endpoint],
) -> Result<Vec<Endpoint>, RoutesError> {
    let mut endpoints = widest(plan, entrances.to_vec());
    let part = match endpoints.first() {
        Some(endpoint) => endpoint.part,
        None => largest_part(ground)?,
    };
    if endpoints.iter().any(|s| s.part != part) {
        return Ok(endpoints); // several floors with openings of their own
    }
    let cells = roomy_cells(ground, part);
    if endpoints.is_empty() {
        endpoints.extend(entrances.iter().find(|endpoint| endpoint.part == part).cloned());
    }
    let openings = endpoints.len();
    if openings == 0 {
        // One end of a longest walk: the cell farthest from an arbitrary one.
        let anywhere = targets::cells(plan, ground, stand_in(ground, cells[0]));
        let field = fields.measure(ground, &anywhere)?;
        let far = farthest(&cells, |k| field.of_cell(cells[k]));
        endpoints.push(named(stand_in(ground, far.0), 1, part));
    }
    let mut nearest_m = vec![f64::INFINITY; cells.len()];
    let mut longest_m: f64 = 0.0;
    let mut measured = 0;
    while endpoints.len() < MOST_PLACES {
        for k in measured..endpoints.len() {
            let end = LegEnd { place: endpoints[k].place, last: true };
            fields.fill(plan, ground, [end].into_iter())?;
            let field = fields.get(end);
            for (nearest, &cell) in nearest_m.iter_mut().zip(&cells) {
                *nearest = nearest.min(field.of_cell(cell));
            }
            for other in &endpoints[..k] {
                let there = targets::cells(plan, ground, other.place);
                longest_m = there.first().map_or(longest_m, |&c| longest_m.max(field.of_cell(c)));
            }
        }
        measured = endpoints.len();
        let (cell, distance_m) = farthest(&cells, |k| nearest_m[k]);
        let apart_m = match endpoints.len() {
            1 => 0.0,
            count if count == openings => BEYOND_OPENINGS * longest_m,
            _ => LEAST_APART_M.max(APART_SHARE * longest_m),
        };
        let place = stand_in(ground, cell);
        if distance_m < apart_m || endpoints.iter().any(|s| s.place == place) {
            break;
        }
        endpoints.push(named(place, endpoints.len() + 1 - openings, part));
    }
    if endpoints.len() < 2 {
        return Err(RoutesError::NoRoom { largest_m2: ground.part_area_m2(part) });
    }
    Ok(endpoints)
}

/// Returns the largest region of a part with clearance [`ROOMY_M`]. If it is small, returns the whole part.
fn roomy_cells(ground: &Ground, part: u16) -> Vec<usize> {
    let all: Vec<usize> = (0..ground.lattice.len()).filter(|&c| ground.part(c) == part).collect();
    let is_roomy = |c: usize| ground.part(c) == part && ground.cell_clearance_m(c) >= ROOMY_M;
    let mut seen = vec![false; ground.lattice.len()];
    let mut largest = Vec::new();
    for &first in &all {
        if seen[first] || !is_roomy(first) {
            continue;
        }
        seen[first] = true;
        let joined = ground.lattice.joined(first, |cell| is_roomy(cell) && !std::mem::replace(&mut seen[cell], true));
        if joined.len() > largest.len() {
            largest = joined;
        }
    }
    if (largest.len() as f64) < ROOMY_SHARE * all.len() as f64 {
        return all;
    }
    largest.sort_unstable();
    largest
}

/// Returns the largest connected part of the floor, if it is large enough to walk on.
fn largest_part(ground: &Ground) -> Result<u16, RoutesError> {
    let mut cells = vec![0usize; usize::from(u16::MAX) + 1];
    for cell in (0..ground.lattice.len()).filter(|&c| ground.is_walkable(c)) {
        cells[usize::from(ground.part(cell))] += 1;
    }
    let part = (1..cells.len()).max_by_key(|&p| (cells[p], usize::MAX - p)).unwrap_or(1) as u16;
    let largest_m2 = ground.part_area_m2(part);
    if largest_m2 < LEAST_PART_M2 { Err(RoutesError::NoRoom { largest_m2 }) } else { Ok(part) }
}

fn named(place: Place, number: usize, part: u16) -> Endpoint {
    Endpoint { place, name: format!("place {number}"), width_m: 2.0 * STAND_IN_REACH_M, part }
}

/// Returns the cell with the largest finite value, the first of equals, and the value.
fn farthest(cells: &[usize], value: impl Fn(usize) -> f64) -> (usize, f64) {
    let mut best = (cells[0], 0.0);
    for (k, &cell) in cells.iter().enumerate() {
        if value(k).is_finite() && value(k) > best.1 {
            best = (cell, value(k));
        }
    }
    best
}

/// Returns a square around the place with the most room within a short walk.
fn stand_in(ground: &Ground, from: usize) -> Place {
    let start = ground.lattice.centre(from);
    let most_steps = (2.0 * STAND_IN_REACH_M / ground.lattice.cell_m()) as usize;
    let mut seen = std::collections::BTreeSet::from([from]);
    let mut border = vec![from];
    let score = |c: usize| {
        let away_m = ground.lattice.centre(c).distance(start);
        ground.cell_clearance_m(c).min(STAND_IN_REACH_M) - 0.3 * away_m
    };
    let mut best = from;
    for _ in 0..most_steps {
        let mut next = Vec::new();
        for cell in border {
            if score(cell) > score(best) {
                best = cell;
            }
            let beside = ground.lattice.beside(cell).filter(|&b| ground.is_walkable(b));
            next.extend(beside.filter(|&b| seen.insert(b)));
        }
        border = next;
    }
    let middle = ground.lattice.centre(best);
    let reach = vec2(STAND_IN_REACH_M, STAND_IN_REACH_M);
    Place::Area([middle - reach, middle + reach])
}
