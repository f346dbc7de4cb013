//! Demand against capacity, before anybody walks: where more people come than can pass.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::fmt;

use serde::{Deserialize, Serialize};

use super::arrivals::Arrival;
use super::environment::Environment;
use super::stops::Stops;
use crate::math::Vec2;
use crate::plan::{FloorPlan, Opening};
use crate::routes::{Narrow, NarrowPlaces, Route, StopKind, USUAL_M_S};
use crate::walls::closest_on;

/// People per second and metre of width who pass a gap while the crowd keeps moving, measured in `docs/crowd.md`.
const FLOW_PER_M_S: f64 = 1.3;
/// Wait of the last in a row from which on a place is too narrow, seconds; lines at counters are usual.
const LONG_S: f64 = 30.0;
const LONG_AT_COUNTER_S: f64 = 300.0;
/// Distance of an opening's line within which a gap is that opening, metres.
const OPENING_M: f64 = 1.0;

/// A place to which more people come than can pass, as foreseen before the walk.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Overload {
    /// What it is: the stop's or the opening's name, or the gap's width.
    pub what: String,
    /// Where it is, metres.
    pub at_m: Vec2,
    /// Number of people who come in a row, from the first who waits to the one who waits longest.
    pub people: u64,
    /// Time within which they come, seconds.
    pub within_s: f64,
    /// Number of people who can pass in a second.
    pub pass_per_s: f64,
    /// Time for which the last of them waits, seconds.
    pub wait_s: f64,
}

impl fmt::Display for Overload {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Overload { what, at_m: Vec2 { x, y }, people, within_s, pass_per_s, wait_s } = self;
        let needed_s = *people as f64 / pass_per_s;
        write!(
            f,
            "{what} at [{x:.1}, {y:.1}]: {people} people come in {within_s:.0} s, {pass_per_s:.2} a second pass: the \
             last wait {wait_s:.0} s; let them come over {needed_s:.0} s, or widen it"
        )
    }
}

/// What limits how many pass.
struct Server {
    what: String,
    at_m: Vec2,
    pass_per_s: f64,
    long_s: f64,
    /// When the next one can pass, seconds.
    free_s: f64,
    /// When the first of those came who have waited in a row, seconds, and their number.
    since_s: f64,
    in_row: u64,
    worst: Option<Overload>,
}

impl Server {
    fn new(what: String, at_m: Vec2, pass_per_s: f64, long_s: f64) -> Server {
        Server { what, at_m, pass_per_s, long_s, free_s: 0.0, since_s: 0.0, in_row: 0, worst: None }
    }

    /// Takes a person who comes at a time; returns when the person has passed.
    fn pass(&mut self, time_s: f64) -> f64 {
        if time_s >= self.free_s {
            (self.since_s, self.in_row) = (time_s, 0);
        }
        self.in_row += 1;
        let wait_s = (self.free_s - time_s).max(0.0);
        if wait_s > self.worst.as_ref().map_or(self.long_s, |worst| worst.wait_s) {
            self.worst = Some(Overload {
                what: self.what.clone(),
                at_m: self.at_m,
                people: self.in_row,
                within_s: time_s - self.since_s,
                pass_per_s: self.pass_per_s,
                wait_s,
            });
        }
        self.free_s = time_s + wait_s + 1.0 / self.pass_per_s;
        self.free_s
    }
}

/// What a route leads past, in order.
#[derive(Clone, Copy)]
struct Passage {
    /// Way from the passage before, metres.
    after_m: f64,
    /// Index of the server; `None` where people stay as they like.
    server: Option<usize>,
    /// Index among the route's stops, for those who stop there.
    stop: Option<usize>,
}

/// Lets everybody pass the narrow places, gates and counters of their routes one after the other, and returns those where
/// the last wait long, the longest first. Who waits at one place comes later to the next.
pub(super) fn overloads(
    environment: &Environment<'_>,
    arrivals: &[Arrival],
    stops: &Stops,
    seed: u64,
    first_of_group: impl Fn(u32) -> u32,
) -> Vec<Overload> {
    let narrow = environment.navigation.narrow_places(environment.routes);
    let name = |narrow: &Narrow| {
        Server::new(describe(environment.plan, narrow), middle(narrow), FLOW_PER_M_S * narrow.width_m, LONG_S)
    };
    let mut servers: Vec<Server> = narrow.places.iter().map(name).collect();
    let passages = passages(environment, &narrow, stops, &mut servers);
    // The next passage of everybody, by time; times are not negative, so that their bits compare as they do.
    let mut next: BinaryHeap<Reverse<(u64, u32, u32)>> = BinaryHeap::new();
    let step = |time_s: f64, id: u32, number: usize, route: usize| {
        let passage = passages[route].get(number)?;
        Some(Reverse(((time_s + passage.after_m / USUAL_M_S).to_bits(), id, number as u32)))
    };
    next.extend(arrivals.iter().filter_map(|arrival| step(arrival.time_s.max(0.0), arrival.id, 0, arrival.route)));
    while let Some(Reverse((bits, id, number))) = next.pop() {
        let (route, number) = (arrivals[id as usize].route, number as usize);
        let mut time_s = f64::from_bits(bits);
        let Passage { server, stop, .. } = passages[route][number];
        let stays_s = match stop {
            None => Some(0.0),
            Some(stop) => stops.dwell_s(seed, [id, first_of_group(id)], route, stop),
        };
        if let Some(stays_s) = stays_s {
            time_s = server.map_or(time_s, |server| servers[server].pass(time_s)) + stays_s;
        }
        next.extend(step(time_s, id, number + 1, route));
    }
    let mut worst: Vec<Overload> = servers.into_iter().filter_map(|server| server.worst).collect();
    worst.sort_by(|a, b| b.wait_s.total_cmp(&a.wait_s));
    worst
}

/// What each route leads past; adds the counters and gates to the servers.
fn passages(
    environment: &Environment<'_>,
    narrow: &NarrowPlaces,
    stops: &Stops,
    servers: &mut Vec<Server>,
) -> Vec<Vec<Passage>> {
    let first_stop = servers.len();
    servers.extend(stops.all().map(|stop| {
        let pass_per_s = stop.places_m.len() as f64 / stop.dwell_s.mean().max(0.1);
        let long_s = if stop.kind == StopKind::Gate { LONG_S } else { LONG_AT_COUNTER_S };
        Server::new(format!("\"{}\"", stop.name), stop.at_m[0].lerp(stop.at_m[1], 0.5), pass_per_s, long_s)
    }));
    let ground = environment.ground();
    let of_route = |(number, route): (usize, &Route)| {
        let way = &environment.navigation.ways[number];
        let mut passages = Vec::new();
        let mut from_m: Option<f64> = None;
        for (leg_number, leg) in way.legs.iter().enumerate() {
            let field = &environment.navigation.fields[leg.field];
            let mut ahead: Vec<(f64, Option<usize>, Option<usize>)> = narrow.of_routes[number][leg_number]
                .iter()
                .map(|&(place, left_m)| (left_m, Some(place), None))
                .collect();
            for (index, on_route) in route.stops.iter().enumerate().filter(|(_, stop)| stop.after_via == leg_number) {
                let cells = on_route.stop.cells(ground);
                let left_m = cells.iter().map(|&cell| field.of_cell(cell)).fold(f64::INFINITY, f64::min);
                let served = on_route.stop.kind.has_line();
                let server = stops.all().position(|stop| stop.name == on_route.stop.name).filter(|_| served);
                let left_m = if left_m.is_finite() { left_m } else { 0.0 };
                ahead.push((left_m, server.map(|stop| first_stop + stop), Some(index)));
            }
            // Stops keep their order.
            ahead.sort_by(|a, b| match (a.2, b.2) {
                (Some(a), Some(b)) => a.cmp(&b),
                _ => b.0.total_cmp(&a.0),
            });
            let start_m = way.start_cells.first().map_or(0.0, |&cell| field.of_cell(cell));
            let mut at_m = from_m.unwrap_or(start_m);
            for (left_m, server, stop) in ahead {
                passages.push(Passage { after_m: (at_m - left_m).max(0.0), server, stop });
                at_m = left_m;
            }
            from_m = way.legs.get(leg_number + 1).map(|next| {
                let next = &environment.navigation.fields[next.field];
                let end = route.via.get(leg_number).map(|via| route.gates[via.gate].at(0.5));
                end.map_or(0.0, |end| next.at(ground, end)).min(1e4)
            });
        }
        passages
    };
    environment.routes.iter().enumerate().map(of_route).collect()
}

/// The middle of the first gap, metres.
fn middle(narrow: &Narrow) -> Vec2 {
    narrow.gaps_m.first().copied().unwrap_or_default()
}

fn describe(plan: &FloorPlan, narrow: &Narrow) -> String {
    let at_m = middle(narrow);
    let is_here = |opening: &&Opening| closest_on(opening.from_m, opening.to_m, at_m).distance(at_m) < OPENING_M;
    let opening = plan.openings.iter().find(is_here);
    let width_m = narrow.width_m;
    match (opening, narrow.gaps_m.len()) {
        (Some(opening), 1) => format!("the opening \"{}\", {width_m:.1} m wide,", opening.name),
        (_, 1) => format!("the gap of {width_m:.1} m"),
        (_, gaps) => format!("{gaps} gaps of {width_m:.1} m together"),
    }
}
