use std::sync::Arc;

use rayon::prelude::*;

use super::field::Field;
use super::ground::{Fineness, Ground};
use super::ribbon::End;
use super::targets::{self, Asked};
use super::{Place, Route, RouteRequest, RoutesError, RoutesOptions, Via, defaults, gates, ribbon};
use crate::math::Vec2;
use crate::plan::FloorPlan;
use crate::walls::Walls;

/// More routes than this are a mistake.
const MOST_ROUTES: usize = 1000;
/// People keep within this of a place between start and goal that lies in the open, metres.
const VIA_REACH_M: f64 = 2.5;

/// What walking needs to know of a plan and its routes: the ground in cells, and the walking distance from
/// everywhere to each place that a route leads to. Routes that lead to the same place share it.
#[derive(Clone, Debug)]
pub struct Navigation {
    pub(crate) ground: Arc<Ground>,
    pub(crate) fields: Vec<Arc<Field>>,
    /// One for each route, in order.
    pub(crate) ways: Vec<Way>,
}

/// A route as the crowd walks it.
#[derive(Clone, Debug)]
pub(crate) struct Way {
    /// Cells on which people may appear.
    pub(crate) start_cells: Vec<usize>,
    /// Cells that count as the goal.
    pub(crate) goal_cells: Vec<usize>,
    /// For each leg (to the first place between, ..., to the goal) which field leads there.
    pub(crate) legs: Vec<usize>,
    /// For each gate the leg that it belongs to.
    pub(crate) gate_leg: Vec<u32>,
    /// For each gate the leg's distance from its left end, middle and right end, metres.
    pub(crate) gate_distance_m: Vec<[f32; 3]>,
}

/// Finds the routes that a scenario asks for, or the default ones.
///
/// # Errors
/// Places that the plan does not have, that are inside walls, or that no way joins; see [`RoutesError`].
pub fn find(plan: &FloorPlan, walls: &Walls, options: &RoutesOptions) -> Result<Vec<Route>, RoutesError> {
    Navigation::find(plan, walls, options).map(|found| found.0)
}

impl Navigation {
    /// Finds the routes, and keeps what walking them needs: what [`find`] and [`Navigation::new`] do, once.
    ///
    /// # Errors
    /// As [`find`].
    pub fn find(
        plan: &FloorPlan,
        walls: &Walls,
        options: &RoutesOptions,
    ) -> Result<(Vec<Route>, Navigation), RoutesError> {
        first_that_works(plan, |fineness| {
            let ground = Ground::new(plan, walls, fineness);
            let (routes, fields) = Navigation::find_on(plan, &ground, options)?;
            let navigation = Navigation::of(plan, ground, &routes, fields)?;
            Ok((routes, navigation))
        })
    }

    /// Measures what walking these routes needs.
    ///
    /// # Errors
    /// Routes that do not belong to this plan.
    pub fn new(plan: &FloorPlan, walls: &Walls, routes: &[Route]) -> Result<Navigation, RoutesError> {
        first_that_works(plan, |fineness| {
            Navigation::of(plan, Ground::new(plan, walls, fineness), routes, FieldStore::default())
        })
    }

    fn find_on(
        plan: &FloorPlan,
        ground: &Ground,
        options: &RoutesOptions,
    ) -> Result<(Vec<Route>, FieldStore), RoutesError> {
        let asked = &options.routes;
        if asked.len() > MOST_ROUTES {
            return Err(RoutesError::TooMany { routes: asked.len(), most: MOST_ROUTES });
        }
        let mut fields = FieldStore::default();
        let plots = if asked.is_empty() {
            defaults::plots(plan, ground, &mut fields)?
        } else {
            asked.iter().map(|request| plot(plan, ground, request)).collect::<Result<_, _>>()?
        };
        let total: f64 = plots.iter().map(|p| p.share).sum();
        if total <= 0.0 {
            return Err(RoutesError::NoShares { routes: plots.len() });
        }
        fields.fill(plan, ground, plots.iter().flat_map(Plot::legs));
        let routes: Result<Vec<Route>, RoutesError> =
            plots.par_iter().map(|plot| lay_out(plan, ground, &fields, plot, plot.share / total)).collect();
        Ok((routes?, fields))
    }

    fn of(
        plan: &FloorPlan,
        ground: Ground,
        routes: &[Route],
        mut fields: FieldStore,
    ) -> Result<Navigation, RoutesError> {
        fields.fill(plan, &ground, routes.iter().flat_map(route_legs));
        let ways = routes.par_iter().map(|route| way(plan, &ground, &fields, route)).collect::<Result<_, _>>()?;
        Ok(Navigation { ground: Arc::new(ground), fields: fields.fields.into_iter().map(|f| f.1).collect(), ways })
    }
}

/// Tries ever finer measures of the ground while places cannot be reached: coarse cells may close a narrow passage.
fn first_that_works<T>(
    plan: &FloorPlan,
    attempt: impl Fn(Fineness) -> Result<T, RoutesError>,
) -> Result<T, RoutesError> {
    let mut first_error = None;
    for fineness in Fineness::attempts(plan) {
        match attempt(fineness) {
            Ok(found) => return Ok(found),
            Err(
                error @ (RoutesError::Unreachable { .. } | RoutesError::NotOnFloor { .. } | RoutesError::NoRoom { .. }),
            ) => {
                first_error.get_or_insert(error);
            }
            Err(error) => return Err(error),
        }
    }
    Err(first_error.unwrap_or(RoutesError::NoRoom { largest_m2: 0.0 }))
}

/// A place that a leg leads to, and whether it is the route's last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LegEnd {
    pub(super) place: Place,
    pub(super) last: bool,
}

/// The fields made so far.
#[derive(Debug, Default)]
pub(super) struct FieldStore {
    fields: Vec<(LegEnd, Arc<Field>)>,
}

impl FieldStore {
    /// Makes the fields that are still missing, side by side.
    pub(super) fn fill(&mut self, plan: &FloorPlan, ground: &Ground, wanted: impl Iterator<Item = LegEnd>) {
        let mut missing: Vec<LegEnd> = Vec::new();
        for end in wanted {
            if !missing.contains(&end) && self.fields.iter().all(|f| f.0 != end) {
                missing.push(end);
            }
        }
        let made = missing.into_par_iter().map(|end| {
            let cells = match end.last {
                true => targets::cells(plan, ground, end.place),
                false => targets::middle_cells(plan, ground, end.place),
            };
            (end, Arc::new(Field::to(ground, &cells)))
        });
        let made: Vec<_> = made.collect();
        self.fields.extend(made);
    }

    fn index(&self, end: LegEnd) -> usize {
        self.fields.iter().position(|f| f.0 == end).expect("filled with every leg before")
    }

    pub(super) fn get(&self, end: LegEnd) -> &Field {
        &self.fields[self.index(end)].1
    }
}

/// A route before its way is known.
#[derive(Clone, Debug)]
pub(super) struct Plot {
    pub(super) name: String,
    /// How messages call start, places between, and goal.
    pub(super) place_names: Vec<String>,
    pub(super) start: Place,
    pub(super) via: Vec<Place>,
    pub(super) goal: Place,
    pub(super) share: f64,
}

impl Plot {
    fn legs(&self) -> impl Iterator<Item = LegEnd> {
        leg_ends(self.via.iter().copied(), self.goal)
    }
}

fn route_legs(route: &Route) -> impl Iterator<Item = LegEnd> {
    leg_ends(route.via.iter().map(|v| v.place), route.goal)
}

fn leg_ends(via: impl Iterator<Item = Place>, goal: Place) -> impl Iterator<Item = LegEnd> {
    via.map(|place| LegEnd { place, last: false }).chain([LegEnd { place: goal, last: true }])
}

/// Finds the places that a request names.
fn plot(plan: &FloorPlan, ground: &Ground, request: &RouteRequest) -> Result<Plot, RoutesError> {
    let names: Vec<String> =
        [&request.from].into_iter().chain(&request.via).chain([&request.to]).map(|p| p.describe()).collect();
    let name = request.name.clone().unwrap_or_else(|| format!("{} to {}", names[0], names[names.len() - 1]));
    if !(request.share >= 0.0 && request.share.is_finite()) {
        return Err(RoutesError::Share { route: name, share: request.share });
    }
    let place = |request, role| targets::place(plan, ground, request, Asked { route: &name, role });
    let start = place(&request.from, "from")?;
    let via = request.via.iter().map(|p| place(p, "via")).collect::<Result<Vec<_>, _>>()?;
    let goal = place(&request.to, "to")?;
    if start == goal && via.is_empty() {
        return Err(RoutesError::NoLength { route: name, place: names[0].clone() });
    }
    Ok(Plot { name, place_names: names, start, via, goal, share: request.share })
}

/// Follows a plotted route and lays gates across its way.
fn lay_out(
    plan: &FloorPlan,
    ground: &Ground,
    fields: &FieldStore,
    plot: &Plot,
    share: f64,
) -> Result<Route, RoutesError> {
    let unreachable = |leg: usize, from: Vec2| {
        let area = |cell: Option<usize>| cell.map_or(0.0, |c| part_area_m2(ground, ground.part(c)));
        let to = plot.via.get(leg).copied().unwrap_or(plot.goal);
        RoutesError::Unreachable {
            route: plot.name.clone(),
            from: plot.place_names[leg].clone(),
            from_area_m2: area(ground.walkable_near(from, 1.0)),
            to: plot.place_names[leg + 1].clone(),
            to_area_m2: area(targets::cells(plan, ground, to).first().copied()),
        }
    };
    let start_cells = targets::cells(plan, ground, plot.start);
    let mut at = targets::middle(ground, &start_cells).unwrap_or_default();
    let mut line: Vec<Vec2> = Vec::new();
    let mut turns = Vec::new();
    for (leg, end) in plot.legs().enumerate() {
        let path = ribbon::trace(ground, fields.get(end), at).ok_or_else(|| unreachable(leg, at))?;
        at = path[path.len() - 1];
        let piece = ribbon::resample(&path);
        line.extend(&piece[usize::from(!line.is_empty())..]);
        turns.push(line.len() - 1);
    }
    turns.pop();
    let ends = [plot.start, plot.goal].map(|place| match place {
        Place::Opening(index) => End::Opening(plan.openings.get(index).map_or(0.0, |o| o.width_m())),
        Place::Area([min, max]) => End::Area(min.distance(max)),
    });
    let pinches: Vec<(usize, f64)> = turns.iter().map(|&k| (k, VIA_REACH_M)).collect();
    let stations = ribbon::measure(ground, &line, ends, &pinches);
    let (gates, at) = gates::lay(&stations, &turns);
    let via = plot
        .via
        .iter()
        .zip(&turns)
        .map(|(&place, turn)| Via { place, gate: at.iter().position(|k| k == turn).unwrap_or(0) })
        .collect();
    let length_m = line.windows(2).map(|w| w[0].distance(w[1])).sum();
    Ok(Route { name: plot.name.clone(), start: plot.start, via, goal: plot.goal, share, gates, length_m })
}

/// Area of a connected part, square metres.
pub(super) fn part_area_m2(ground: &Ground, part: u16) -> f64 {
    let cells = (0..ground.lattice.len()).filter(|&c| part != 0 && ground.part(c) == part).count();
    cells as f64 * ground.lattice.cell_m() * ground.lattice.cell_m()
}

/// What the crowd needs of one route.
fn way(plan: &FloorPlan, ground: &Ground, fields: &FieldStore, route: &Route) -> Result<Way, RoutesError> {
    let legs: Vec<usize> = route_legs(route).map(|end| fields.index(end)).collect();
    let first_field = &fields.fields[legs[0]].1;
    let start_cells: Vec<usize> =
        targets::cells(plan, ground, route.start).into_iter().filter(|&c| first_field.of_cell(c).is_finite()).collect();
    let goal_cells = targets::cells(plan, ground, route.goal);
    if start_cells.is_empty() || goal_cells.is_empty() {
        return Err(RoutesError::Unreachable {
            route: route.name.clone(),
            from: "its start".into(),
            from_area_m2: 0.0,
            to: "its goal".into(),
            to_area_m2: goal_cells.first().map_or(0.0, |&c| part_area_m2(ground, ground.part(c))),
        });
    }
    let mut gate_leg = Vec::with_capacity(route.gates.len());
    let mut gate_distance_m = Vec::with_capacity(route.gates.len());
    for (number, gate) in route.gates.iter().enumerate() {
        // The gate at a place between still belongs to the leg that leads there.
        let leg = route.via.iter().filter(|v| v.gate < number).count().min(legs.len() - 1);
        let field = &fields.fields[legs[leg]].1;
        gate_leg.push(leg as u32);
        gate_distance_m.push([0.0, 0.5, 1.0].map(|share| field.at(ground, gate.at(share)) as f32));
    }
    Ok(Way { start_cells, goal_cells, legs, gate_leg, gate_distance_m })
}
