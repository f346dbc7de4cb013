//! Narrow cross-sections of ways: where everybody who goes from one place of a route to the next has to pass.

use std::collections::BinaryHeap;

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::field::Field;
use super::flow::Flow;
use super::ground::{CLEARANCE_LIMIT_M, Ground};
use super::legs::Leg;
use super::navigation::Navigation;
use super::{Gate, Route};
use crate::math::{Vec2, vec2};

/// Distance between cross-sections that are looked at, metres.
const STEP_M: f64 = 0.3;
/// Clearance from which on a cross-section is not narrow, metres.
const OPEN_M: f64 = CLEARANCE_LIMIT_M - 0.1;
/// Distance between two narrow places of a leg, metres, and their largest number.
const APART_M: f64 = 3.0;
const MOST_OF_LEG: usize = 8;
/// Distance of their middles within which two gaps are the same, metres.
const SAME_M: f64 = 1.0;
/// Share of the largest clearance along a line from which on its cells lie in the gap.
const CORE_SHARE: f64 = 0.8;
/// Width from which on a gate of a way without a flow is not narrow, metres; gates keep off walls by about 0.15 m.
const NARROW_GATE_M: f64 = 2.5;
const OFF_WALLS_M: f64 = 0.3;

/// A cross-section of all ways from one place of a route to the next: one gap, or several side by side.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Narrow {
    /// Middles of the gaps, metres.
    pub(crate) gaps_m: Vec<Vec2>,
    /// Width of all gaps together, from wall to wall, metres.
    pub(crate) width_m: f64,
}

impl Narrow {
    /// Whether both are the same place.
    fn is(&self, other: &Narrow) -> bool {
        let near = |gap: &Vec2| other.gaps_m.iter().any(|p| p.distance(*gap) < SAME_M);
        self.gaps_m.len() == other.gaps_m.len() && self.gaps_m.iter().all(near)
    }
}

/// A narrow place on a leg of a route: the index of the place, and the distance left to the end of the leg, metres.
pub(crate) type OnLeg = (usize, f64);

/// Narrow places of all routes, each once, and those of each leg of each route in the order of passing.
pub(crate) struct NarrowPlaces {
    pub(crate) places: Vec<Narrow>,
    pub(crate) of_routes: Vec<Vec<Vec<OnLeg>>>,
}

/// Where people of a leg pass: in a flow with a field, or through the gates of a route.
#[derive(Clone, Copy, PartialEq)]
enum LegOfRoute {
    Flow(usize, usize),
    /// Route, and whether it is its first leg.
    Gates(usize, bool),
}

impl Navigation {
    /// The narrow places of these routes, which this was made for.
    pub(crate) fn narrow_places(&self, routes: &[Route]) -> NarrowPlaces {
        // Each leg once; of ways without a flow all gates of the route count on the first one.
        let mut legs: Vec<(LegOfRoute, Vec<usize>)> = Vec::new();
        let mut leg_of = vec![Vec::new(); routes.len()];
        for (route, way) in self.ways.iter().enumerate() {
            let mut from: Option<&Leg> = None;
            for (number, leg) in way.legs.iter().enumerate() {
                let own = match leg.flow {
                    Some(flow) => LegOfRoute::Flow(flow, leg.field),
                    None => LegOfRoute::Gates(route, number == 0),
                };
                let known = legs.iter().position(|leg| leg.0 == own).unwrap_or(legs.len());
                if known == legs.len() {
                    let is_end = |field: &Field, cell: &usize| field.of_cell(*cell) <= 0.0;
                    let ends = |leg: &Leg| {
                        let field = &self.fields[leg.field];
                        (0..self.ground.lattice.len()).filter(|cell| is_end(field, cell)).collect()
                    };
                    legs.push((own, from.map_or_else(|| way.start_cells.clone(), ends)));
                }
                leg_of[route].push(known);
                from = Some(leg);
            }
        }
        let sections = |(leg, starts): &(LegOfRoute, Vec<usize>)| match *leg {
            LegOfRoute::Flow(flow, field) => {
                cross_sections(&self.ground, &self.fields[field], &self.flows[flow], starts)
            }
            LegOfRoute::Gates(route, true) => of_gates(&routes[route].gates),
            LegOfRoute::Gates(..) => Vec::new(),
        };
        let sections: Vec<Vec<(Narrow, f64)>> = legs.par_iter().map(sections).collect();
        let mut places: Vec<Narrow> = Vec::new();
        for (narrow, _) in sections.iter().flat_map(|sections| narrowest(sections)) {
            match places.iter_mut().find(|place| place.is(narrow)) {
                Some(place) => place.width_m = place.width_m.min(narrow.width_m),
                None => places.push(narrow.clone()),
            }
        }
        let on_leg = |sections: &Vec<(Narrow, f64)>| {
            let passed = |(index, place): (usize, &Narrow)| {
                sections.iter().find(|(narrow, _)| narrow.is(place)).map(|&(_, left_m)| (index, left_m))
            };
            let mut on_leg: Vec<OnLeg> = places.iter().enumerate().filter_map(passed).collect();
            on_leg.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
            on_leg
        };
        let of_legs: Vec<Vec<OnLeg>> = sections.par_iter().map(on_leg).collect();
        let of_route = |legs: &Vec<usize>| legs.iter().map(|&leg| of_legs[leg].clone()).collect();
        NarrowPlaces { of_routes: leg_of.iter().map(of_route).collect(), places }
    }
}

/// The narrowest of these cross-sections that lie apart.
fn narrowest(sections: &[(Narrow, f64)]) -> Vec<&(Narrow, f64)> {
    let mut by_width: Vec<&(Narrow, f64)> = sections.iter().collect();
    by_width.sort_by(|a, b| a.0.width_m.total_cmp(&b.0.width_m).then(b.1.total_cmp(&a.1)));
    let mut chosen: Vec<&(Narrow, f64)> = Vec::new();
    for section in by_width {
        if chosen.len() < MOST_OF_LEG && chosen.iter().all(|other| (other.1 - section.1).abs() >= APART_M) {
            chosen.push(section);
        }
    }
    chosen
}

/// Cross-sections of a flow at equal distances from its end where no gap is wide, with those distances, metres.
///
/// Whoever starts farther away passes each of them: a line of equal distance parts the start from the end.
fn cross_sections(ground: &Ground, field: &Field, flow: &Flow, starts: &[usize]) -> Vec<(Narrow, f64)> {
    let lattice = &ground.lattice;
    let first_m = starts.iter().map(|&cell| field.of_cell(cell)).fold(f64::INFINITY, f64::min);
    let reached_m = reached(ground, field, flow, starts);
    let mut fronts: Vec<Vec<usize>> = Vec::new();
    let mut widest_m: Vec<f64> = Vec::new();
    for cell in 0..lattice.len() {
        let Some(&own_m) = reached_m.get(&cell).filter(|own_m| **own_m < first_m) else { continue };
        let least_m = lattice.beside(cell).map(|beside| field.of_cell(beside)).fold(own_m, f64::min);
        // Lines of equal distance between this cell and the nearest one beside it.
        for line in (least_m / STEP_M).ceil() as usize..(own_m / STEP_M).ceil() as usize {
            if line >= fronts.len() {
                fronts.resize(line + 1, Vec::new());
                widest_m.resize(line + 1, 0.0);
            }
            widest_m[line] = widest_m[line].max(ground.cell_clearance_m(cell));
            if widest_m[line] < OPEN_M {
                fronts[line].push(cell);
            }
        }
    }
    // The first lines go round the end, wherever its people vanish.
    let lines =
        fronts.iter().enumerate().filter(|&(line, front)| line > 0 && widest_m[line] < OPEN_M && !front.is_empty());
    lines.map(|(line, front)| (section(ground, front), line as f64 * STEP_M)).collect()
}

/// For each cell of a flow the largest distance left, metres, that people from the start need not fall below before they
/// get there.
///
/// It is less than the cell's own distance in pockets beside the far side of a gap: nobody passes there on the way to it.
fn reached(ground: &Ground, field: &Field, flow: &Flow, starts: &[usize]) -> FxHashMap<usize, f64> {
    // Distances are not negative, so that their bits compare as they do.
    let bits = |cell: usize| field.of_cell(cell).to_bits();
    let is_passed = |cell: usize| flow.holds(cell) && field.of_cell(cell).is_finite();
    let mut reached_m = FxHashMap::default();
    let mut open: BinaryHeap<(u64, usize)> =
        starts.iter().filter(|&&cell| is_passed(cell)).map(|&cell| (bits(cell), cell)).collect();
    while let Some((left, cell)) = open.pop() {
        if reached_m.contains_key(&cell) {
            continue;
        }
        reached_m.insert(cell, f64::from_bits(left));
        open.extend(
            ground.lattice.beside(cell).filter(|&cell| is_passed(cell)).map(|cell| (left.min(bits(cell)), cell)),
        );
    }
    reached_m
}

/// The gaps that the cells along a line of equal distance lie in.
///
/// Lines run on along the walls beside a gap, where nobody walks: only what has about as much room as the widest counts.
fn section(ground: &Ground, front: &[usize]) -> Narrow {
    let (mut gaps_m, mut width_m) = (Vec::new(), 0.0);
    for line in connected(ground, front) {
        let clearance_m = |cell: &usize| ground.cell_clearance_m(*cell);
        let widest_m = line.iter().map(clearance_m).fold(0.0, f64::max);
        let core_m = CORE_SHARE * widest_m;
        let core: Vec<usize> = line.into_iter().filter(|cell| clearance_m(cell) >= core_m).collect();
        for gap in connected(ground, &core) {
            let centres = gap.iter().map(|&cell| ground.lattice.centre(cell));
            let [low, high] = centres
                .fold([Vec2 { x: f64::MAX, y: f64::MAX }, Vec2 { x: f64::MIN, y: f64::MIN }], |[low, high], p| {
                    [vec2(low.x.min(p.x), low.y.min(p.y)), vec2(high.x.max(p.x), high.y.max(p.y))]
                });
            // From the outermost cells it is as far to the walls as they are clear of them.
            width_m += low.distance(high) + 2.0 * gap.iter().map(clearance_m).fold(f64::INFINITY, f64::min);
            gaps_m.push(low.lerp(high, 0.5));
        }
    }
    Narrow { gaps_m, width_m }
}

/// Divides cells into those that are connected, also across corners.
fn connected(ground: &Ground, cells: &[usize]) -> Vec<Vec<usize>> {
    let place = |cell: usize| ground.lattice.column_row(cell);
    let mut left: FxHashMap<[usize; 2], usize> = cells.iter().map(|&cell| (place(cell), cell)).collect();
    let mut parts = Vec::new();
    for &first in cells {
        if left.remove(&place(first)).is_none() {
            continue;
        }
        let (mut part, mut next) = (vec![first], 0);
        while let Some(&cell) = part.get(next) {
            next += 1;
            let [x, y] = place(cell);
            for column in x.saturating_sub(1)..=x + 1 {
                part.extend((y.saturating_sub(1)..=y + 1).filter_map(|row| left.remove(&[column, row])));
            }
        }
        parts.push(part);
    }
    parts
}

/// Narrow gates of a route as cross-sections: its people follow a field through them.
fn of_gates(gates: &[Gate]) -> Vec<(Narrow, f64)> {
    let count = gates.len();
    let narrow = gates.iter().enumerate().map(|(number, gate)| {
        let narrow = Narrow { gaps_m: vec![gate.at(0.5)], width_m: gate.width_m() + OFF_WALLS_M };
        (narrow, (count - number) as f64 * APART_M)
    });
    narrow.filter(|(narrow, _)| narrow.width_m < NARROW_GATE_M).collect()
}
