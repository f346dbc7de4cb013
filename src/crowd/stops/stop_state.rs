use super::queue::Queue;
use super::standing::{self, StandingArea};
use super::visit::StopTally;
use crate::crowd::environment::Environment;
use crate::math::Vec2;
use crate::routes::{Field, Stop, StopKind, StopWay};

/// Distance to the side, and back, over which people leave a counter, metres.
const ASIDE_M: f64 = 0.95;
const BACK_M: f64 = 0.3;
/// Distances beyond a ticket gate, and before a bench, at which people go on along their route, metres.
const BEYOND_GATE_M: [f64; 3] = [2.2, 1.4, 0.7];
const FROM_BENCH_M: f64 = 0.8;
/// Radius within which others crowd a way out, and the detour that each of them is worth, metres.
const IN_THE_WAY_M: f64 = 0.7;
const DETOUR_M: f64 = 2.0;

/// Walking distance to the middle of a room, beyond half its size, from which people go to their spot, metres.
const ROOM_MARGIN_M: f64 = 0.5;

/// A stop with the people at it.
#[derive(Debug)]
pub(super) struct StopState {
    pub(super) stop: Stop,
    pub(super) way: StopWay,
    pub(super) kind: Service,
    pub(super) tally: StopTally,
}

/// How people spend their time at a stop.
#[derive(Debug)]
pub(super) enum Service {
    /// Everybody finds a spot to stand or sit.
    Standing(StandingArea),
    /// People wait in queues and are served in turn.
    Queues(Vec<Queue>),
}

impl StopState {
    /// A stop that people come to on this way.
    pub(super) fn new(environment: &Environment<'_>, stop: &Stop, way: StopWay, keep_m: f64) -> StopState {
        let place = |&p: &Vec2| {
            let place_m = standing::off_walls(environment, p, keep_m);
            (place_m, stop.facing_from(place_m))
        };
        let kind = match stop.kind {
            StopKind::Place | StopKind::Bench => Service::Standing(StandingArea::new(environment, stop, keep_m)),
            StopKind::Queue | StopKind::Machine => {
                Service::Queues(vec![Queue::new(stop.places_m.iter().map(place), stop.spacing_m)])
            }
            StopKind::Gate => {
                let lane = |p: &Vec2| Queue::new([place(p)].into_iter(), stop.spacing_m);
                Service::Queues(stop.places_m.iter().map(lane).collect())
            }
        };
        StopState {
            stop: stop.clone(),
            way,
            kind,
            tally: StopTally { name: stop.name.clone(), in_line: stop.kind.has_line(), ..StopTally::default() },
        }
    }

    /// Largest distance from the stop itself of people who are at it, metres.
    pub(super) fn reach_m(&self) -> f64 {
        match &self.kind {
            Service::Standing(standing) => standing.reach_m(),
            Service::Queues(queues) => queues.iter().map(Queue::reach_m).fold(0.0, f64::max),
        }
    }

    /// Whether a person at `p` has come into the room that the stop is.
    pub(super) fn is_entered(&self, environment: &Environment<'_>, p: Vec2) -> bool {
        let is_room = !self.stop.spots.is_empty();
        is_room && self.way.field.at(environment.ground(), p) < self.reach_m() + ROOM_MARGIN_M
    }

    /// Removes a person who has left the crowd.
    pub(super) fn forget(&mut self, id: u32) {
        match &mut self.kind {
            Service::Standing(standing) => standing.leave(id),
            Service::Queues(queues) => queues.iter_mut().for_each(|queue| queue.forget(id)),
        }
    }

    /// First place of a person at `p` who leaves the stop and then follows the field `onward`: beside the queue, beyond the
    /// gate, before the bench. `None` if the route goes on at once.
    pub(super) fn way_out(
        &self,
        environment: &Environment<'_>,
        p: Vec2,
        onward: &Field,
        others: &[Vec2],
    ) -> Option<Vec2> {
        let facing = self.stop.facing_from(p);
        let free = |to: &Vec2| environment.is_free(p, *to, 0.17);
        match self.stop.kind {
            StopKind::Place => None,
            StopKind::Bench => Some(p + facing * FROM_BENCH_M).filter(free),
            StopKind::Gate => BEYOND_GATE_M.map(|beyond_m| p + facing * beyond_m).into_iter().find(free),
            StopKind::Queue | StopKind::Machine => {
                let cost = |to: &Vec2| {
                    let crowded = others.iter().filter(|other| other.distance(*to) < IN_THE_WAY_M).count();
                    let way_m = onward.at(environment.ground(), *to);
                    if way_m.is_finite() { way_m + DETOUR_M * crowded as f64 } else { 1e9 }
                };
                let sides = [-1.0, 1.0].map(|side| p + facing.left() * (side * ASIDE_M) - facing * BACK_M);
                sides.into_iter().filter(free).min_by(|a, b| cost(a).total_cmp(&cost(b)))
            }
        }
    }
}

/// Lays the queues of all stops, each clear of all counters and of the queues before it.
pub(super) fn lay_queues(environment: &Environment<'_>, states: &mut [StopState]) {
    for index in 0..states.len() {
        let Service::Queues(queues) = &states[index].kind else { continue };
        for number in 0..queues.len() {
            let taken: Vec<Vec2> = states
                .iter()
                .enumerate()
                .flat_map(|(other, state)| match &state.kind {
                    Service::Queues(queues) => queues.iter().enumerate().map(|queue| (other, queue)).collect(),
                    Service::Standing(_) => Vec::new(),
                })
                .filter(|&(other, (queue, _))| (other, queue) != (index, number))
                .flat_map(|(_, (_, queue))| queue.footprint())
                .collect();
            let StopState { stop, kind, .. } = &mut states[index];
            if let Service::Queues(queues) = kind {
                queues[number].lay(environment, stop, &taken);
            }
        }
    }
}
