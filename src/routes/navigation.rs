use std::cell::LazyCell;
use std::sync::Arc;

use rayon::prelude::*;

use super::draft::RouteDraft;
use super::field::Field;
use super::flow::Flow;
use super::ground::{Fineness, Ground};
use super::legs::{FieldStore, Leg, LegEnd, RouteLegs, leg_ends};
use super::ribbon::RibbonEnd;
use super::stop::{RouteStop, Stop};
use super::stop_ways::{self, StopWay};
use super::targets::{self, PlaceUsage};
use super::{
    FloorPoint, Gap, Place, PlaceRequest, Route, RouteRequest, RoutesError, RoutesOptions, Via, ViaRequest, defaults,
    gates, lanes, life, ribbon,
};
use crate::math::Vec2;
use crate::plan::FloorPlan;
use crate::rooms::{Entrance, Life, Rooms};
use crate::walls::Walls;
use crate::{Progress, Silent};

/// Share of people who use the rooms of a building whose drawing has lanes.
const BESIDE_LANES: f64 = 0.5;
/// Largest number of routes.
const MOST_ROUTES: usize = 1000;
/// Radius within which people pass a via place in the open, metres.
const VIA_REACH_M: f64 = 2.5;

/// Navigation data of a plan and its routes: ground, distance fields, flows. Routes to the same place share a field. Copies
/// share all of it.
#[derive(Clone, Debug)]
pub struct Navigation {
    pub(crate) ground: Arc<Ground>,
    pub(crate) fields: Vec<Arc<Field>>,
    pub(crate) flows: Vec<Arc<Flow>>,
    /// One per route, in order.
    pub(crate) ways: Vec<RouteLegs>,
    /// One per stop, in the order of [`Route::each_stop`].
    pub(crate) stop_ways: Vec<StopWay>,
    life: Option<Arc<Life>>,
}

/// Finds the requested routes, or the default ones.
///
/// # Errors
/// Places that the plan does not have, that are inside walls, or that no way joins; see [`RoutesError`].
///
/// # Example
/// ```
/// use trodden::{plan::FloorPlan, routes, walls::Walls};
///
/// // A corridor of 12 x 3 m: by default, people walk it from end to end.
/// let floor = (0..120 * 40).map(|k: u32| u8::from((5..35).contains(&(k / 120)))).collect();
/// let plan = FloorPlan::from_mask(120, 40, 0.1, floor);
/// let walls = Walls::trace(&plan, &Default::default());
/// assert!(!routes::find(&plan, &walls, &Default::default())?.is_empty());
/// # Ok::<(), trodden::Error>(())
/// ```
pub fn find(plan: &FloorPlan, walls: &Walls, options: &RoutesOptions) -> Result<Vec<Route>, RoutesError> {
    Navigation::find(plan, walls, options).map(|found| found.0)
}

impl Navigation {
    /// Finds the routes and their navigation data: [`find`] and [`Navigation::new`] in one pass.
    ///
    /// # Errors
    /// As [`find`].
    pub fn find(
        plan: &FloorPlan,
        walls: &Walls,
        options: &RoutesOptions,
    ) -> Result<(Vec<Route>, Navigation), RoutesError> {
        Navigation::find_watched(plan, walls, options, &Silent)
    }

    /// Like [`Navigation::find`], but stops soon after `progress` is interrupted.
    ///
    /// # Errors
    /// As [`find`]; [`RoutesError::Interrupted`].
    pub fn find_watched(
        plan: &FloorPlan,
        walls: &Walls,
        options: &RoutesOptions,
        progress: &dyn Progress,
    ) -> Result<(Vec<Route>, Navigation), RoutesError> {
        let life = match options.routes.is_empty() || options.life.share > 0.0 {
            true => Some(Arc::new(life::of(plan, walls, options)?)),
            false => None,
        };
        first_that_works(plan, |fineness| {
            let ground = Ground::new(plan, walls, fineness);
            let (routes, fields) = Navigation::find_on(plan, walls, &ground, options, life.as_deref(), progress)?;
            let navigation = Navigation::of(plan, ground, &routes, fields)?;
            let life = life.clone().filter(|_| routes.iter().any(|route| route.life.is_some()));
            Ok((routes, Navigation { life, ..navigation }))
        })
    }

    /// Computes distance fields and flows of these routes.
    ///
    /// # Errors
    /// A route does not belong to this plan.
    pub fn new(plan: &FloorPlan, walls: &Walls, routes: &[Route]) -> Result<Navigation, RoutesError> {
        first_that_works(plan, |fineness| {
            Navigation::of(plan, Ground::new(plan, walls, fineness), routes, FieldStore::new(&Silent))
        })
    }

    /// The rooms of the building, and what it is for, where people live in it.
    pub fn life(&self) -> Option<&Arc<Life>> {
        self.life.as_ref()
    }

    fn find_on<'p>(
        plan: &FloorPlan,
        walls: &Walls,
        ground: &Ground,
        options: &RoutesOptions,
        life: Option<&Life>,
        progress: &'p dyn Progress,
    ) -> Result<(Vec<Route>, FieldStore<'p>), RoutesError> {
        let asked = &options.routes;
        if asked.len() > MOST_ROUTES {
            return Err(RoutesError::TooMany { routes: asked.len(), most: MOST_ROUTES });
        }
        let mut fields = FieldStore::new(progress);
        let entrances = life.map_or(&[][..], |life| &life.rooms.entrances);
        let lanes = if asked.is_empty() { lanes::drafts(plan, ground) } else { Vec::new() };
        let has_lanes = !lanes.is_empty();
        let mut drafts: Vec<RouteDraft> = match (asked.is_empty(), life) {
            (true, _) if has_lanes => lanes,
            (true, Some(life)) if life.has_rooms() => Vec::new(),
            (true, _) => defaults::drafts(plan, ground, &mut fields, entrances)?,
            (false, _) => {
                let stops = stops(plan, walls, ground, options)?;
                let doors = LazyCell::new(|| Rooms::find(plan, walls).entrances);
                let of = |request| draft(plan, ground, request, options, &stops, &doors);
                asked.iter().map(of).collect::<Result<_, _>>()?
            }
        };
        let mut lived = life.map_or(Vec::new(), |life| life::drafts(plan, ground, life, &options.life));
        if asked.is_empty() && lived.is_empty() && drafts.is_empty() {
            drafts = defaults::drafts(plan, ground, &mut fields, entrances)?;
        }
        if asked.is_empty() && !has_lanes && !drafts.is_empty() {
            fields.fill(plan, ground, drafts.iter().flat_map(RouteDraft::legs))?;
            match life.is_some_and(|life| life::is_crossed(plan, ground, life, &fields, &drafts)) {
                true => lived.clear(),
                false if !lived.is_empty() => drafts.clear(),
                false => {}
            }
        }
        let mut total: f64 = drafts.iter().map(|p| p.share).sum();
        if total <= 0.0 && !drafts.is_empty() {
            return Err(RoutesError::NoShares { routes: drafts.len() });
        }
        if !lived.is_empty() {
            let share = match () {
                () if drafts.is_empty() => 1.0,
                () if has_lanes => BESIDE_LANES,
                () => options.life.share,
            };
            let own: f64 = lived.iter().map(|draft| draft.share).sum();
            drafts.iter_mut().for_each(|draft| draft.share *= (1.0 - share) / total);
            drafts.extend(lived.into_iter().map(|draft| RouteDraft { share: draft.share * share / own, ..draft }));
            total = 1.0;
        }
        fields.fill(plan, ground, drafts.iter().flat_map(RouteDraft::legs))?;
        turn_gates(ground, &fields, &mut drafts);
        let routes: Result<Vec<Route>, RoutesError> =
            drafts.par_iter().map(|draft| lay_out(plan, ground, &fields, draft, draft.share / total)).collect();
        Ok((routes?, fields))
    }

    fn of(
        plan: &FloorPlan,
        ground: Ground,
        routes: &[Route],
        mut fields: FieldStore<'_>,
    ) -> Result<Navigation, RoutesError> {
        fields.fill(plan, &ground, routes.iter().flat_map(route_legs))?;
        let mut pairs: Vec<LegEnds> = Vec::new();
        let ways = routes
            .iter()
            .map(|route| way(plan, &ground, &fields, route, &mut pairs))
            .collect::<Result<Vec<RouteLegs>, _>>()?;
        let flow = |pair: &LegEnds| {
            fields.keep_on()?;
            let starts = pair.from.cells(plan, &ground);
            Ok(Arc::new(Flow::new(&ground, &starts, fields.get(pair.to))))
        };
        let (flows, stop_ways) = rayon::join(
            || pairs.par_iter().map(flow).collect::<Result<_, RoutesError>>(),
            || stop_ways::find(&ground, routes, &ways, &fields),
        );
        let (flows, stop_ways) = (flows?, stop_ways?);
        Ok(Navigation { ground: Arc::new(ground), fields: fields.into_fields(), flows, ways, stop_ways, life: None })
    }
}

/// Tries finer and finer grounds while places cannot be reached: coarse cells may close narrow passages.
fn first_that_works<T>(
    plan: &FloorPlan,
    attempt: impl Fn(Fineness) -> Result<T, RoutesError>,
) -> Result<T, RoutesError> {
    let mut first_error = None;
    for fineness in Fineness::attempts(plan) {
        match attempt(fineness) {
            Ok(found) => return Ok(found),
            Err(
                error @ (RoutesError::Unreachable { .. }
                | RoutesError::NotOnFloor { .. }
                | RoutesError::NoRoom { .. }
                | RoutesError::StopNotOnFloor { .. }
                | RoutesError::StopUnreachable { .. }),
            ) => {
                first_error.get_or_insert(error);
            }
            Err(error) => return Err(error),
        }
    }
    Err(first_error.unwrap_or(RoutesError::NoRoom { largest_m2: 0.0 }))
}

/// Both ends of a leg.
#[derive(Clone, Copy, Debug, PartialEq)]
struct LegEnds {
    from: LegEnd,
    to: LegEnd,
}

fn route_legs(route: &Route) -> impl Iterator<Item = LegEnd> {
    leg_ends(route.via.iter().map(|v| v.place), route.goal)
}

/// The door to the outside that an unknown opening's name means.
fn or_door(plan: &FloorPlan, ground: &Ground, error: RoutesError, doors: &[Entrance]) -> Result<Place, RoutesError> {
    let RoutesError::UnknownOpening { route, name, nearest, openings } = error else { return Err(error) };
    let doors: Vec<&Entrance> = doors.iter().filter(|door| door.opening.is_none()).collect();
    let meant = doors.iter().find(|door| door.name.eq_ignore_ascii_case(name.trim()));
    if let Some(end) = meant.and_then(|door| life::end(plan, ground, door)) {
        return Ok(end.place);
    }
    let others = doors.iter().map(|door| door.name.clone()).filter(|door| !openings.contains(door)).collect::<Vec<_>>();
    Err(RoutesError::UnknownOpening { route, name, nearest, openings: [openings, others].concat() })
}

/// Finds the places of a request.
fn draft(
    plan: &FloorPlan,
    ground: &Ground,
    request: &RouteRequest,
    options: &RoutesOptions,
    stops: &[Stop],
    doors: &LazyCell<Vec<Entrance>, impl FnOnce() -> Vec<Entrance>>,
) -> Result<RouteDraft, RoutesError> {
    let (passed, stopped) = split(request, options);
    let mut names: Vec<String> =
        [&request.from].into_iter().chain(passed.iter().copied()).chain([&request.to]).map(|p| p.describe()).collect();
    let name = request.name.clone().unwrap_or_else(|| format!("{} to {}", names[0], names[names.len() - 1]));
    if !(request.share >= 0.0 && request.share.is_finite()) {
        return Err(RoutesError::Share { route: name, share: request.share });
    }
    let place = |request, role| {
        let found = targets::place(plan, ground, request, PlaceUsage { route: &name, role });
        found.or_else(|error| or_door(plan, ground, error, doors))
    };
    let start = place(&request.from, "from")?;
    let via = passed.into_iter().map(|p| place(p, "via").map_err(|error| or_stop(error, stops)));
    let mut via = via.collect::<Result<Vec<_>, _>>()?;
    let part = targets::cells(plan, ground, start).first().map(|&cell| ground.part(cell));
    let stops = stopped.into_iter().map(|(stop, share, after_via)| {
        let stop = find_stop(stops, &name, stop)?.clone();
        if !(0.0..=1.0).contains(&share) {
            let problem = format!("the share {share} of route \"{name}\" is not within 0 to 1");
            return Err(RoutesError::StopValue { stop: stop.name, key: "share".to_string(), problem });
        }
        match stop.cells(ground).iter().find(|&&cell| Some(ground.part(cell)) != part) {
            Some(_) => {
                let place_m = stop.places_m[0];
                Err(RoutesError::StopUnreachable { route: name.clone(), stop: stop.name, place_m })
            }
            None => Ok(RouteStop { stop, share, after_via }),
        }
    });
    let stops = stops.collect::<Result<Vec<_>, _>>()?;
    let goal = place(&request.to, "to")?;
    if start == goal
        && via.is_empty()
        && let Some(first) = stops.first()
    {
        // People enter, go to the stop, and leave: the route passes the stop.
        via.push(first.stop.before(ground));
        names.insert(1, first.stop.name.clone());
    }
    if start == goal && via.is_empty() {
        return Err(RoutesError::NoLength { route: name, place: names[0].clone() });
    }
    if let Some(error) = request.arrivals.as_ref().and_then(|arrivals| arrivals.check().err()) {
        return Err(RoutesError::Timetable { route: name, error });
    }
    let arrivals = request.arrivals.clone();
    let life = None;
    Ok(RouteDraft { name, place_names: names, start, via, stops, arrivals, life, goal, share: request.share })
}

/// Finds the scenario's stops on the ground.
fn stops(plan: &FloorPlan, walls: &Walls, ground: &Ground, options: &RoutesOptions) -> Result<Vec<Stop>, RoutesError> {
    for (index, stop) in options.stops.iter().enumerate() {
        if options.stops[..index].iter().any(|other| other.name == stop.name) {
            return Err(RoutesError::SameStop { name: stop.name.clone() });
        }
    }
    options.stops.iter().map(|stop| stop.resolve(plan, ground, walls)).collect()
}

/// Splits a request into via places and stops: name, share, number of via places before.
fn split<'r>(
    request: &'r RouteRequest,
    options: &RoutesOptions,
) -> (Vec<&'r PlaceRequest>, Vec<(&'r str, f64, usize)>) {
    let (mut passed, mut stopped) = (Vec::new(), Vec::new());
    for via in &request.via {
        match (via.stop(&options.stops), via) {
            (Some((stop, share)), _) => stopped.push((stop, share, passed.len())),
            (None, ViaRequest::Place(place)) => passed.push(place),
            (None, ViaRequest::Stop(_)) => {}
        }
    }
    (passed, stopped)
}

fn find_stop<'s>(stops: &'s [Stop], route: &str, name: &str) -> Result<&'s Stop, RoutesError> {
    stops.iter().find(|stop| stop.name == name).ok_or_else(|| {
        let distance = |stop: &&Stop| strsim::damerau_levenshtein(&stop.name.to_lowercase(), &name.to_lowercase());
        let nearest = stops.iter().min_by_key(distance).filter(|stop| distance(stop) <= 3);
        let nearest = nearest.map(|stop| stop.name.clone());
        RoutesError::UnknownStop { route: route.into(), name: name.into(), nearest }
    })
}

/// Suggests a stop if the unknown opening resembles its name.
fn or_stop(error: RoutesError, stops: &[Stop]) -> RoutesError {
    if let RoutesError::UnknownOpening { route, name, nearest: None, .. } = &error
        && let Err(unknown @ RoutesError::UnknownStop { nearest: Some(_), .. }) = find_stop(stops, route, name)
    {
        return unknown;
    }
    error
}

/// Turns ticket gates the way the first route passes them; all routes share the heading.
fn turn_gates(ground: &Ground, fields: &FieldStore<'_>, drafts: &mut [RouteDraft]) {
    let mut turned: Vec<Stop> = Vec::new();
    for draft in drafts {
        let legs: Vec<LegEnd> = draft.legs().collect();
        for on_route in &mut draft.stops {
            if let Some(known) = turned.iter().find(|stop| stop.name == on_route.stop.name) {
                on_route.stop = known.clone();
                continue;
            }
            on_route.stop.turn_along(ground, fields.get(legs[on_route.after_via]));
            turned.push(on_route.stop.clone());
        }
    }
}

/// Traces a drafted route and lays gates across its path.
fn lay_out(
    plan: &FloorPlan,
    ground: &Ground,
    fields: &FieldStore<'_>,
    draft: &RouteDraft,
    share: f64,
) -> Result<Route, RoutesError> {
    let unreachable = |leg: usize, from: Vec2| {
        let to = draft.via.get(leg).copied().unwrap_or(draft.goal);
        let names = [draft.place_names[leg].as_str(), draft.place_names[leg + 1].as_str()];
        let cells = [ground.walkable_near(from, 1.0), targets::cells(plan, ground, to).first().copied()];
        no_way(plan, ground, &draft.name, names, cells)
    };
    let start_cells = targets::cells(plan, ground, draft.start);
    let mut at = targets::middle(ground, &start_cells).unwrap_or_default();
    let mut line: Vec<Vec2> = Vec::new();
    let mut turns = Vec::new();
    for (leg, end) in draft.legs().enumerate() {
        let path = ribbon::trace(ground, fields.get(end), at).ok_or_else(|| unreachable(leg, at))?;
        at = path[path.len() - 1];
        let piece = ribbon::resample(&path);
        line.extend(&piece[usize::from(!line.is_empty())..]);
        turns.push(line.len() - 1);
    }
    turns.pop();
    let ends = [draft.start, draft.goal].map(|place| match place {
        Place::Opening(index) => RibbonEnd::Opening(plan.openings.get(index).map_or(0.0, |o| o.width_m())),
        Place::Area([min, max]) => RibbonEnd::Area(min.distance(max)),
    });
    let pinches: Vec<(usize, f64)> = turns.iter().map(|&k| (k, VIA_REACH_M)).collect();
    let stations = ribbon::measure(ground, &line, ends, &pinches);
    let (gates, at) = gates::lay(&stations, &turns);
    let via = draft
        .via
        .iter()
        .zip(&turns)
        .map(|(&place, turn)| Via { place, gate: at.iter().position(|k| k == turn).unwrap_or(0) })
        .collect();
    let length_m = line.windows(2).map(|w| w[0].distance(w[1])).sum();
    Ok(Route {
        name: draft.name.clone(),
        start: draft.start,
        via,
        stops: draft.stops.clone(),
        arrivals: draft.arrivals.clone(),
        life: draft.life,
        goal: draft.goal,
        share,
        gates,
        length_m,
    })
}

/// Returns the error that names two unconnected places and the cause.
fn no_way(plan: &FloorPlan, ground: &Ground, route: &str, names: [&str; 2], cells: [Option<usize>; 2]) -> RoutesError {
    let spot = |end: usize| {
        Box::new(match cells[end] {
            Some(cell) => targets::spot(plan, ground, cell, names[end]),
            None => FloorPoint { name: names[end].into(), at_m: Vec2::ZERO, at_px: [0.0; 2], part_m2: 0.0 },
        })
    };
    let gap = match cells {
        [Some(from), Some(to)] => {
            ground.narrowest_between(from, to).map(|(at_m, width_m)| Gap { at_m, at_px: plan.m_to_px(at_m), width_m })
        }
        _ => None,
    };
    RoutesError::Unreachable { route: route.into(), from: spot(0), to: spot(1), gap }
}

/// Navigation data of one route; appends pairs of places without a flow.
fn way(
    plan: &FloorPlan,
    ground: &Ground,
    fields: &FieldStore<'_>,
    route: &Route,
    pairs: &mut Vec<LegEnds>,
) -> Result<RouteLegs, RoutesError> {
    // People come from all cells of the start.
    let mut from = LegEnd { place: route.start, last: true };
    let mut legs = Vec::with_capacity(route.via.len() + 1);
    for to in route_legs(route) {
        // Visits of rooms lead everywhere: a flow for each would take longer than the walk.
        let visits = route.life.is_some() && !route.via.is_empty();
        let flow = (!visits).then(|| {
            let pair = LegEnds { from, to };
            let flow = pairs.iter().position(|p| *p == pair).unwrap_or(pairs.len());
            if flow == pairs.len() {
                pairs.push(pair);
            }
            flow
        });
        legs.push(Leg { field: fields.index(to), flow });
        from = to;
    }
    let first_field = fields.of_index(legs[0].field);
    let start_cells: Vec<usize> =
        targets::cells(plan, ground, route.start).into_iter().filter(|&c| first_field.of_cell(c).is_finite()).collect();
    let goal_cells = targets::cells(plan, ground, route.goal);
    if start_cells.is_empty() || goal_cells.is_empty() {
        let start = targets::cells(plan, ground, route.start).first().copied();
        let names = ["its start", "its goal"];
        return Err(no_way(plan, ground, &route.name, names, [start, goal_cells.first().copied()]));
    }
    Ok(RouteLegs { start_cells, goal_cells, legs })
}
