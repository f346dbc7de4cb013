//! Arrival list: time and route of each person, drawn before the walk begins.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rand::RngExt;

use super::CrowdOptions;
use crate::math::{Purpose, SplitMix64, person_stream};
use crate::plan::FloorPlan;
use crate::routes::{Place, Route, Stop};

/// Arrival of one person: time and route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// Number of the person, counted from 0 in the order of arrival.
    pub id: u32,
    /// Time of entering, seconds from the start; later where the entrance has no room.
    pub time_s: f64,
    /// Index of the person's route.
    pub route: usize,
    /// Whether the person comes in through an opening rather than starting in a room.
    pub from_outside: bool,
}

/// Flow through narrow places, people per second and metre: less than openings let in.
const NARROW_RATE: f64 = 0.45;
/// How many times as long the people of default life take to come as these flows would allow: they go both ways through
/// doors of rooms, and most of them at some hours of the day. Twice as long still locks buildings; longer costs nothing.
const LIFE_TAKES: f64 = 3.0;
/// Most people of a burst by share, per second and metre of the opening, over the burst's spread, seconds: half of what an
/// opening of that width carries.
const BURST_RATE: f64 = 0.75;
const LEAST_SPREAD_S: f64 = 30.0;
/// Largest flow through all openings together, people per second.
const MOST_RATE: f64 = 5.0;
/// Width from which on a place limits no flow, metres.
const NARROW_M: f64 = 2.5;
/// Distance of their middles within which two gates are the same place, metres.
const SAME_PLACE_M: f64 = 1.0;

/// Draws the arrival list. Person `id` enters in the `id`-th of as many equal parts of the entry time, so that the
/// stream is even over time and each person a function of (seed, id) alone.
pub(super) fn list(plan: &FloorPlan, routes: &[Route], seed: u64, options: &CrowdOptions) -> Vec<Arrival> {
    let mut arrivals = drawn(plan, routes, seed, options);
    if routes.iter().any(|route| route.life.is_some()) {
        take_turns(&mut arrivals, routes);
        // Who writes when people come knows the day.
        if options.arrivals.is_default() && options.entry_seconds.is_none() {
            by_day(&mut arrivals, routes);
        }
    }
    arrivals
}

fn drawn(plan: &FloorPlan, routes: &[Route], seed: u64, options: &CrowdOptions) -> Vec<Arrival> {
    if !options.arrivals.is_default() || routes.iter().any(|route| route.arrivals.is_some()) {
        return by_timetables(plan, routes, seed, options);
    }
    let period_s = options.entry_seconds.unwrap_or_else(|| entry_seconds(plan, routes, options));
    let part_s = period_s / f64::from(options.people);
    (0..options.people)
        .map(|id| {
            let rng = &mut person_stream(seed, id, Purpose::Arrival);
            let time_s = (f64::from(id) + rng.random::<f64>()) * part_s;
            let route = pick(routes, rng.random());
            Arrival { id, time_s, route, from_outside: routes[route].is_from_outside() }
        })
        .collect()
}

/// Draws the arrival list by timetables. Lists of routes take as many people as they name, in the order of routes;
/// everybody else takes a route by share, and comes when its timetable or the crowd's says. Ids follow the times.
fn by_timetables(plan: &FloorPlan, routes: &[Route], seed: u64, options: &CrowdOptions) -> Vec<Arrival> {
    let people = options.people as usize;
    let listed = listed(routes, people);
    let free: Vec<usize> = (0..routes.len()).filter(|&route| listed[route].is_none()).collect();
    let free_share: f64 = free.iter().map(|&route| routes[route].share).sum();
    let mut of_lists = listed.iter().enumerate().flat_map(|(route, &count)| vec![route; count.unwrap_or(0)]);
    let draws: Vec<[f64; 2]> = (0..options.people)
        .map(|index| {
            let rng = &mut person_stream(seed, index, Purpose::Arrival);
            [rng.random(), rng.random()]
        })
        .collect();
    // People by timetable: the crowd's comes behind those of the routes.
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); routes.len() + 1];
    let mut route_of = Vec::with_capacity(people);
    for (index, draw) in draws.iter().enumerate() {
        let route = of_lists.next().unwrap_or_else(|| {
            let mut sum = 0.0;
            let by_share = free.iter().find(|&&route| {
                sum += routes[route].share;
                draw[1] * free_share < sum
            });
            by_share.or(free.last()).copied().unwrap_or(0)
        });
        route_of.push(route);
        members[if routes[route].arrivals.is_some() { route } else { routes.len() }].push(index);
    }
    let period_s = options.entry_seconds.unwrap_or_else(|| entry_seconds(plan, routes, options));
    let mut times: Vec<(f64, usize)> = Vec::with_capacity(people);
    for (route, members) in members.iter().enumerate() {
        let timetable = routes.get(route).and_then(|route| route.arrivals.as_ref()).unwrap_or(&options.arrivals);
        let width_m = routes.get(route).map_or(f64::INFINITY, |route| width_m(plan, route));
        let spread_s = timetable.spread_s.unwrap_or(0.0).max(LEAST_SPREAD_S);
        let most_in_burst = (BURST_RATE * width_m * spread_s) as usize;
        let of_members = timetable.times_s(members.len(), period_s, most_in_burst, |k| draws[members[k]][0]);
        times.extend(of_members.into_iter().zip(members.iter().copied()));
    }
    times.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let arrival = |(id, (time_s, index)): (usize, (f64, usize))| {
        let route = route_of[index];
        Arrival { id: id as u32, time_s, route, from_outside: routes[route].is_from_outside() }
    };
    times.into_iter().enumerate().map(arrival).collect()
}

/// Lets people of default life take its routes in turn, by share: as few people as there are routes take all.
fn take_turns(arrivals: &mut [Arrival], routes: &[Route]) {
    // The route that is farthest behind its share comes next; times are whole numbers, which compare exactly.
    // Equals come in another order each time: everybody to the n-th must not be a sample of a few routes.
    let turn = |route: usize, taken: u64| {
        let due = ((taken as f64 + 0.5) / routes[route].share * 1e6) as u64;
        Reverse((due, SplitMix64::new(taken << 20 | route as u64).next_u64(), route, taken))
    };
    let lived = (0..routes.len()).filter(|&route| routes[route].life.is_some() && routes[route].share > 0.0);
    let mut turns: BinaryHeap<_> = lived.map(|route| turn(route, 0)).collect();
    for arrival in arrivals.iter_mut().filter(|arrival| routes[arrival.route].life.is_some()) {
        let Some(mut next) = turns.peek_mut() else { return };
        let Reverse((.., route, taken)) = *next;
        *next = turn(route, taken + 1);
        (arrival.route, arrival.from_outside) = (route, routes[route].is_from_outside());
    }
}

/// Crowds the arrivals of default life where the day of the building's use does.
fn by_day(arrivals: &mut [Arrival], routes: &[Route]) {
    let period_s = arrivals.last().map_or(0.0, |last| last.time_s);
    for arrival in arrivals.iter_mut().filter(|_| period_s > 0.0) {
        let Some(life) = routes[arrival.route].life else { continue };
        let day = life.r#use.habits().day;
        let total: f64 = day.iter().sum();
        let mut left = arrival.time_s / period_s * total;
        let part = day.iter().position(|&people| {
            let within = left <= people;
            left -= if within { 0.0 } else { people };
            within
        });
        let part = part.unwrap_or(day.len() - 1);
        arrival.time_s = period_s * (part as f64 + (left / day[part]).min(1.0)) / day.len() as f64;
    }
    arrivals.sort_by(|a, b| a.time_s.total_cmp(&b.time_s).then(a.id.cmp(&b.id)));
    (0..).zip(arrivals).for_each(|(id, arrival)| arrival.id = id);
}

/// Number of people that each route's list takes; `None` for routes without a list.
///
/// A list takes as many people as it names, or its proportion of them if there are not as many, or if all routes with a
/// share have lists.
fn listed(routes: &[Route], people: usize) -> Vec<Option<usize>> {
    let named: Vec<Option<u64>> = routes.iter().map(|route| route.arrivals.as_ref()?.listed()).collect();
    let total: u64 = named.iter().flatten().sum();
    let others = routes.iter().zip(&named).any(|(route, named)| named.is_none() && route.share > 0.0);
    if total == 0 || others && total <= people as u64 {
        return named.into_iter().map(|count| count.map(|count| count as usize)).collect();
    }
    let (mut before, mut given) = (0u64, 0usize);
    let part = |count: Option<u64>| {
        before += count?;
        let upto = (u128::from(before) * people as u128 / u128::from(total)) as usize;
        let own = upto - given;
        given = upto;
        Some(own)
    };
    named.into_iter().map(part).collect()
}

/// The route that a draw in `[0, 1)` falls on.
fn pick(routes: &[Route], draw: f64) -> usize {
    let mut sum = 0.0;
    for (index, route) in routes.iter().enumerate() {
        sum += route.share;
        if draw < sum {
            return index;
        }
    }
    // Shares that sum up to a hair less than 1: the last route with a share.
    routes.iter().rposition(|r| r.share > 0.0).unwrap_or(0)
}

/// Most of the spots of a room that are taken at a time, on average.
const MOST_TAKEN: f64 = 0.4;

/// Time in which the rooms of default life take everybody, seconds.
fn stay_seconds(routes: &[Route], people: f64) -> f64 {
    let stay_s = |stop: &Stop| {
        let visits = routes.iter().flat_map(|route| route.stops.iter().map(move |on_route| (route.share, on_route)));
        let own = visits.filter(|(_, on_route)| on_route.stop.name == stop.name);
        own.map(|(share, on_route)| share * on_route.share * people * stop.dwell_s.mean()).sum::<f64>()
    };
    let rooms = Route::each_stop(routes).into_iter().filter(|stop| !stop.spots.is_empty());
    rooms.map(|stop| stay_s(stop) / (MOST_TAKEN * stop.spots.len() as f64)).fold(0.0, f64::max)
}

/// Width through which the people of a route come in, metres.
fn width_m(plan: &FloorPlan, route: &Route) -> f64 {
    match route.start {
        Place::Opening(index) => plan.openings.get(index).map_or(1.0, |o| o.width_m()),
        Place::Area([min, max]) => ((max.x - min.x) * (max.y - min.y)).max(0.25).sqrt(),
    }
}

/// Entry time of the whole crowd, seconds: no opening lets in more than the entry rate, and no narrow place on the way
/// carries more than [`NARROW_RATE`].
fn entry_seconds(plan: &FloorPlan, routes: &[Route], options: &CrowdOptions) -> f64 {
    let people = f64::from(options.people);
    let load = |route: &Route| route.share * if route.life.is_some() { LIFE_TAKES } else { 1.0 };
    let mut seconds: f64 = stay_seconds(routes, people).max(people / MOST_RATE);
    for route in routes {
        let share: f64 = routes.iter().filter(|r| r.start == route.start).map(load).sum();
        seconds = seconds.max(people * share / (options.entry_rate * width_m(plan, route)));
    }
    let narrow = |route: &Route| {
        // Gates keep off the walls by about 0.15 m on either side.
        let gates = route.gates.iter().map(|g| (g.at(0.5), g.width_m() + 0.3));
        gates.filter(|g| g.1 < NARROW_M).collect::<Vec<_>>()
    };
    let narrow: Vec<_> = routes.iter().map(narrow).collect();
    for gates in &narrow {
        for &(place, width_m) in gates {
            let passing = |(index, others): (usize, &Vec<_>)| {
                let here = others.iter().any(|&(p, _): &(crate::math::Vec2, f64)| p.distance(place) < SAME_PLACE_M);
                if here { load(&routes[index]) } else { 0.0 }
            };
            let share: f64 = narrow.iter().enumerate().map(passing).sum();
            seconds = seconds.max(people * share / (NARROW_RATE * width_m));
        }
    }
    seconds
}
