use std::collections::BTreeMap;

use super::queue::{self, Queue};
use super::stop_state::{self, Service, StopState};
use super::target::VisitTarget;
use super::update::StopsUpdate;
use super::visit::{StopTally, Visit};
use super::visitor::{StopOnRoute, VisitState, Visitor};
use crate::crowd::agents::Agents;
use crate::crowd::environment::Environment;
use crate::routes::{Field, Stop, StopKind};

/// Interval at which stops are updated, seconds.
const UPDATE_S: f64 = 0.2;
/// Walking distance at which people look for a free spot or a queue, metres.
const NEAR_M: f64 = 6.0;
/// Distance from the tail of a queue at which people join it, metres.
const JOIN_M: f64 = 1.0;
/// Time without getting nearer to the tail after which people join from where they are, seconds.
const JOIN_AFTER_S: f64 = 5.0;
/// Distance from a spot at which it counts as reached, metres.
const THERE_M: f64 = 0.2;
/// Distance from the counter at which the time of the service begins, metres.
const STEP_UP_M: f64 = 1.8;
/// Time after the call at which it begins in any case, seconds.
const STEP_UP_S: f64 = 8.0;
/// Time after which a stay begins even if the crowd keeps the person off the spot, seconds.
const SETTLE_S: f64 = 20.0;
/// Time by which a service is extended for people who have not reached the counter, seconds.
const GRACE_S: f64 = 4.0;
/// Time after which people who leave go on along their route in any case, seconds.
const LEAVE_S: f64 = 8.0;
/// Time beyond the longest service after which a queue counts as stalled, seconds.
const STALLED_S: f64 = 30.0;

/// All stops, and the people who visit them.
#[derive(Debug, Default)]
pub(in crate::crowd) struct Stops {
    states: Vec<StopState>,
    /// Stops of each route.
    of_route: Vec<Vec<StopOnRoute>>,
    visitors: BTreeMap<u32, Visitor>,
    /// Slots in the order of ids; sorted for every update.
    by_id: Vec<u32>,
    log: Option<Vec<Visit>>,
}

impl Stops {
    /// A stop by its index.
    pub(super) fn get(&self, stop: usize) -> Option<&StopState> {
        self.states.get(stop)
    }

    /// The stops of the routes; stops of one name are one. People stand at least `keep_m` off walls where there is room.
    pub(in crate::crowd) fn new(environment: &Environment<'_>, keep_m: f64) -> Stops {
        let mut stops = Stops::default();
        for route in environment.routes {
            let mut of_route = Vec::new();
            for on_route in &route.stops {
                let known = stops.states.iter().position(|state| state.stop.name == on_route.stop.name);
                let stop = known.unwrap_or(stops.states.len());
                if known.is_none() {
                    let way = environment.navigation.stop_ways[stop].clone();
                    stops.states.push(StopState::new(environment, &on_route.stop, way, keep_m));
                }
                of_route.push(StopOnRoute {
                    stop,
                    share: on_route.share,
                    after_via: on_route.after_via,
                    dwell_s: on_route.stop.dwell_s,
                });
            }
            stops.of_route.push(of_route);
        }
        stop_state::lay_queues(environment, &mut stops.states);
        stops
    }

    /// Draws the stops of a person who enters, the same for all of a group, and returns the first target if there is one.
    ///
    /// `id` is the person's, `first` that of the first of the group.
    pub(in crate::crowd) fn enter(&mut self, seed: u64, [id, first]: [u32; 2], route: usize) -> Option<VisitTarget> {
        let stops = self.of_route.get(route).filter(|stops| !stops.is_empty())?;
        let visitor = Visitor::new(seed, [id, first], route, stops)?;
        let first = visitor.plan.last().map(|next| stops[next.stop]);
        self.visitors.insert(id, visitor);
        first.filter(|stop| stop.after_via == 0).map(|stop| VisitTarget::come(stop.stop))
    }

    /// All stops, each once.
    pub(in crate::crowd) fn all(&self) -> impl Iterator<Item = &Stop> {
        self.states.iter().map(|state| &state.stop)
    }

    /// How long a person stays at a stop of the route, seconds; `None` for those who do not stop there.
    pub(in crate::crowd) fn dwell_s(&self, seed: u64, ids: [u32; 2], route: usize, stop: usize) -> Option<f64> {
        let visitor = Visitor::new(seed, ids, route, self.of_route.get(route)?)?;
        visitor.plan.iter().find(|visit| visit.stop == stop).map(|visit| visit.dwell_s)
    }

    /// Counts of visits, stop by stop.
    pub(in crate::crowd) fn tally(&self) -> Vec<StopTally> {
        self.states.iter().map(|state| state.tally.clone()).collect()
    }

    /// Keeps every visit that ends from now on.
    pub(in crate::crowd) fn keep_visits(&mut self) {
        self.log.get_or_insert_with(Vec::new);
    }

    /// Visits that ended since [`Stops::keep_visits`], in the order of their ends.
    pub(in crate::crowd) fn visits(&self) -> &[Visit] {
        self.log.as_deref().unwrap_or(&[])
    }

    /// The name of a target's stop, for messages.
    pub(in crate::crowd) fn name_of(&self, target: &VisitTarget) -> Option<String> {
        self.get(target.stop()).map(|state| state.stop.name.clone())
    }

    /// Whether a target's stop is a ticket gate.
    pub(in crate::crowd) fn is_gate(&self, target: &VisitTarget) -> bool {
        self.get(target.stop()).is_some_and(|state| state.stop.kind == StopKind::Gate)
    }

    /// Moves queues on and ends stays, if an update is due at this step.
    pub(in crate::crowd) fn update(
        &mut self,
        (step, time_step_s): (u64, f64),
        environment: &Environment<'_>,
        agents: &mut Agents,
    ) {
        let every = (UPDATE_S / time_step_s).round().max(1.0) as u64;
        if self.visitors.is_empty() || !step.is_multiple_of(every) {
            return;
        }
        let time_s = step as f64 * time_step_s;
        let mut by_id = std::mem::take(&mut self.by_id);
        agents.slots_by_id(&mut by_id);
        let update = &mut StopsUpdate { time_s, environment, agents, by_id: &by_id };
        self.forget_those_who_left(update);
        let mut visitors = std::mem::take(&mut self.visitors);
        let mut joining: Vec<Joining> = Vec::new();
        for (&id, visitor) in &mut visitors {
            if let Some(slot) = update.slot(id) {
                self.go_on(visitor, slot, update, &mut joining);
            }
        }
        self.join(joining, &mut visitors, time_s);
        self.call(&mut visitors, update);
        self.line_up(&mut visitors, update);
        visitors.retain(|_, visitor| !visitor.plan.is_empty());
        self.visitors = visitors;
        self.by_id = by_id;
    }

    /// Takes out visitors who have left the crowd.
    fn forget_those_who_left(&mut self, update: &StopsUpdate<'_>) {
        let states = &mut self.states;
        self.visitors.retain(|id, _| {
            let present = update.slot(*id).is_some();
            if !present {
                states.iter_mut().for_each(|state| state.forget(*id));
            }
            present
        });
    }

    /// Updates the state of one visitor.
    fn go_on(&mut self, visitor: &mut Visitor, slot: usize, update: &mut StopsUpdate<'_>, joining: &mut Vec<Joining>) {
        let Some(planned) = visitor.plan.last().copied() else { return };
        let on_route = self.of_route[visitor.route][planned.stop];
        let state = &mut self.states[on_route.stop];
        let p = update.position(slot);
        let time_s = update.time_s;
        match visitor.state {
            VisitState::Underway => {
                let leg = update.walk(slot).leg as usize;
                let is_next = leg + 1 == on_route.after_via;
                let enters = is_next && state.is_entered(update.environment, p);
                if enters {
                    update.walk(slot).leg += 1;
                }
                if enters || leg >= on_route.after_via {
                    visitor.state = VisitState::Coming { queue: None };
                    update.set(slot, VisitTarget::come(on_route.stop));
                }
            }
            VisitState::Coming { queue } => {
                let far_m = state.way.field.at(update.environment.ground(), p);
                if far_m > NEAR_M + state.reach_m() {
                    return;
                }
                match &mut state.kind {
                    Service::Standing(standing) => {
                        let (spot_m, facing) =
                            standing.take(update.environment, &state.stop, visitor.id, planned.draw, p);
                        // Rooms take whom they take.
                        if state.stop.spots.is_empty() {
                            state.tally.crowd(standing.taken(), standing.room(state.stop.spacing_m));
                        }
                        visitor.came_s = time_s;
                        visitor.state = VisitState::Settling { since_s: time_s };
                        update.set(slot, VisitTarget::stand(on_route.stop, spot_m, facing, true));
                    }
                    Service::Queues(queues) => {
                        let queue = queue::choose(queues, queue, p, state.stop.dwell_s.mean(), planned.draw);
                        visitor.state = VisitState::Coming { queue: Some(queue) };
                        let tail_m = queues[queue].tail_m(planned.draw);
                        let idle_s = time_s - update.walk(slot).improved_s;
                        let distance_m = p.distance(tail_m);
                        if distance_m < JOIN_M || idle_s > JOIN_AFTER_S {
                            joining.push(Joining { stop: on_route.stop, queue, distance_m, id: visitor.id });
                        }
                        let seen = queues[queue].seen_from(update.environment, p, tail_m);
                        let target = match seen {
                            Some(to_m) => VisitTarget::towards(on_route.stop, to_m),
                            None => VisitTarget::come(on_route.stop),
                        };
                        update.walk(slot).visit = Some(target);
                    }
                }
            }
            VisitState::Settling { since_s } => {
                let there = update.distance_to_spot(slot) < THERE_M;
                if there || time_s - since_s > SETTLE_S {
                    visitor.begun_s = time_s;
                    visitor.state = VisitState::Staying { until_s: time_s + planned.dwell_s };
                }
            }
            VisitState::Staying { until_s } => {
                update.walk(slot).improved_s = time_s;
                if time_s >= until_s {
                    if let Service::Standing(standing) = &mut state.kind {
                        standing.leave(visitor.id);
                    }
                    self.leave(visitor, slot, on_route, until_s, update);
                }
            }
            VisitState::Waiting { queue } => {
                if let Service::Queues(queues) = &state.kind
                    && time_s - queues[queue].moved_s < state.stop.dwell_s.bounds()[1] + STALLED_S
                {
                    update.walk(slot).improved_s = time_s;
                }
            }
            VisitState::Called { queue, place, called_s, begun_s, ready_s } => {
                let distance_m = update.distance_to_spot(slot);
                let begun_s = begun_s.or_else(|| {
                    // People who stood in the queue step up at once.
                    (distance_m < STEP_UP_M).then_some(if time_s - ready_s < 3.0 * UPDATE_S { ready_s } else { time_s })
                });
                let begun_s = begun_s.or((time_s - called_s > STEP_UP_S).then_some(time_s));
                visitor.state = VisitState::Called { queue, place, called_s, begun_s, ready_s };
                let Some(begun_s) = begun_s else { return };
                update.walk(slot).improved_s = time_s;
                let end_s = begun_s + planned.dwell_s;
                // At a gate, an arm's length is near enough.
                let there = distance_m < if state.stop.kind == StopKind::Gate { 3.0 } else { 2.0 } * THERE_M;
                if time_s < end_s || !there && time_s < end_s + GRACE_S {
                    return;
                }
                visitor.begun_s = begun_s;
                // The time until the next update counts for no service.
                let free_s = if time_s - end_s < 1.5 * UPDATE_S { end_s } else { time_s };
                if let Service::Queues(queues) = &mut state.kind {
                    queues[queue].free(place, free_s);
                }
                self.leave(visitor, slot, on_route, free_s, update);
            }
            VisitState::Leaving { until_s } => {
                let passed = update.distance_to_spot(slot) < 0.5;
                if passed || time_s >= until_s {
                    self.done(visitor, slot, update);
                }
            }
        }
    }

    /// Ends a visit at the time `left_s`.
    fn leave(
        &mut self,
        visitor: &mut Visitor,
        slot: usize,
        on_route: StopOnRoute,
        left_s: f64,
        update: &mut StopsUpdate<'_>,
    ) {
        let visit = visitor.visit(on_route.stop, left_s);
        let onward = self.onward(visitor, update);
        let p = update.position(slot);
        let others = update.near(p, visitor.id, NEAR_M);
        let way_out = self.states[on_route.stop].way_out(update.environment, p, onward, &others);
        let state = &mut self.states[on_route.stop];
        state.tally.add(&visit);
        if let Some(log) = &mut self.log {
            log.push(visit);
        }
        match way_out {
            Some(to_m) => {
                visitor.state = VisitState::Leaving { until_s: update.time_s + LEAVE_S };
                update.set(slot, VisitTarget::pass(on_route.stop, to_m));
            }
            None => self.done(visitor, slot, update),
        }
    }

    /// The distance field that leads a visitor on from a stop.
    fn onward<'f>(&'f self, visitor: &Visitor, update: &'f StopsUpdate<'_>) -> &'f Field {
        let stops = &self.of_route[visitor.route];
        let now = visitor.plan.last().map_or(0, |planned| stops[planned.stop].after_via);
        let next = visitor.plan.iter().rev().nth(1).map(|planned| stops[planned.stop]);
        if let Some(next) = next.filter(|next| next.after_via == now) {
            return &self.states[next.stop].way.field;
        }
        let legs = &update.environment.navigation.ways[visitor.route].legs;
        &update.environment.navigation.fields[legs[now.min(legs.len() - 1)].field]
    }

    /// Sends a visitor to the next stop, or along the rest of the route.
    fn done(&mut self, visitor: &mut Visitor, slot: usize, update: &mut StopsUpdate<'_>) {
        visitor.plan.pop();
        visitor.state = VisitState::Underway;
        let time_s = update.time_s;
        let walk = update.walk(slot);
        walk.visit = None;
        walk.looks = 1; // looks for the way at once
        walk.least_left_m = f32::INFINITY;
        walk.improved_s = time_s;
        walk.blocked_s = 0.0;
    }

    /// Adds those who reached the tail of a queue to it, the nearest first.
    fn join(&mut self, mut joining: Vec<Joining>, visitors: &mut BTreeMap<u32, Visitor>, time_s: f64) {
        joining.sort_by(|a, b| a.distance_m.total_cmp(&b.distance_m).then(a.id.cmp(&b.id)));
        for Joining { stop, queue, id, .. } in joining {
            let (Service::Queues(queues), Some(visitor)) = (&mut self.states[stop].kind, visitors.get_mut(&id)) else {
                continue;
            };
            queues[queue].order.push_back(id);
            visitor.came_s = time_s;
            visitor.state = VisitState::Waiting { queue };
        }
    }

    /// Calls the first of each queue to the places that are free.
    fn call(&mut self, visitors: &mut BTreeMap<u32, Visitor>, update: &mut StopsUpdate<'_>) {
        for (index, state) in self.states.iter_mut().enumerate() {
            let stop = &state.stop;
            let Service::Queues(queues) = &mut state.kind else { continue };
            if stop.kind == StopKind::Gate {
                let_nearest_go(queues, update);
            }
            for (number, queue) in queues.iter_mut().enumerate() {
                while let Some(&id) = queue.order.front() {
                    let found = update.slot(id).and_then(|slot| {
                        Some((slot, visitors.get_mut(&id)?, queue.free_place(update.position(slot))?))
                    });
                    let Some((slot, visitor, place)) = found else { break };
                    queue.order.pop_front();
                    let ready_s = queue.take(place, id, update.time_s);
                    visitor.state =
                        VisitState::Called { queue: number, place, called_s: update.time_s, begun_s: None, ready_s };
                    let draw = visitor.plan.last().map_or(0, |planned| planned.draw);
                    let (spot_m, facing) = queue.spot_at(place, stop, draw, update.environment);
                    update.set(slot, VisitTarget::stand(index, spot_m, facing, true));
                }
            }
        }
    }

    /// Gives everybody who waits in a queue a place there.
    fn line_up(&mut self, visitors: &mut BTreeMap<u32, Visitor>, update: &mut StopsUpdate<'_>) {
        for (index, state) in self.states.iter_mut().enumerate() {
            let Service::Queues(queues) = &mut state.kind else { continue };
            for queue in queues {
                let spots = queue.line_up(update, visitors);
                state.tally.crowd(queue.order.len(), queue.room());
                for (slot, spot_m, facing) in spots {
                    update.set_waiting(slot, VisitTarget::stand(index, spot_m, facing, false));
                }
            }
        }
    }
}

/// Puts those who wait before ticket gates at the head of the lane that is free next to them: before gates people stand
/// in a bulk, and who is nearest takes the free lane.
fn let_nearest_go(queues: &mut [Queue], update: &StopsUpdate<'_>) {
    for lane in 0..queues.len() {
        let Some(place_m) = queues[lane].vacant_m() else { continue };
        let waiting = queues.iter().enumerate().flat_map(|(from, queue)| {
            // Who is first at a free lane of its own stays there.
            let stay = usize::from(from != lane && queue.vacant_m().is_some());
            queue.order.iter().skip(stay).map(move |&id| (from, id))
        });
        let distances = waiting.filter_map(|(from, id)| Some((update.place_of(id)?.1.distance(place_m), id, from)));
        let nearest = distances.filter(|nearest| nearest.0 < NEAR_M);
        let nearest = nearest.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        if let Some((_, id, from)) = nearest {
            queues[from].forget(id);
            queues[lane].order.push_front(id);
        }
    }
}

/// A visitor who has reached the tail of a queue.
#[derive(Clone, Copy, Debug)]
struct Joining {
    stop: usize,
    queue: usize,
    distance_m: f64,
    id: u32,
}
