use rand::RngExt;

use super::visit::Visit;
use crate::math::{Distribution, Purpose, person_stream};

/// A stop of a route.
#[derive(Clone, Copy, Debug)]
pub(super) struct StopOnRoute {
    /// Index of the stop.
    pub(super) stop: usize,
    /// Share of the route's people who stop there, 0 to 1.
    pub(super) share: f64,
    /// Number of the route's places between start and goal that are passed before.
    pub(super) after_via: usize,
    /// How long people stay or are served, seconds.
    pub(super) dwell_s: Distribution,
}

/// A person with stops still to make.
#[derive(Clone, Debug)]
pub(super) struct Visitor {
    pub(super) id: u32,
    pub(super) route: usize,
    /// Stops still to come, the last one first.
    pub(super) plan: Vec<PlannedVisit>,
    pub(super) state: VisitState,
    pub(super) came_s: f64,
    pub(super) begun_s: f64,
}

/// A stop that a person will make.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlannedVisit {
    /// Index among the route's stops.
    pub(super) stop: usize,
    /// Dwell time, seconds.
    pub(super) dwell_s: f64,
    /// Random draw of the exact spot.
    pub(super) draw: u64,
}

/// Progress of a visitor with its next stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum VisitState {
    /// On the route before the stop.
    Underway,
    /// On the way to it, or to the tail of a queue.
    Coming { queue: Option<usize> },
    /// Waiting in a queue.
    Waiting { queue: usize },
    /// Called to a place at the counter that was ready at a time: steps up, is served.
    Called { queue: usize, place: usize, called_s: f64, begun_s: Option<f64>, ready_s: f64 },
    /// On the way to a spot.
    Settling { since_s: f64 },
    /// Stays at a spot.
    Staying { until_s: f64 },
    /// Gets away from the counter.
    Leaving { until_s: f64 },
}

impl Visitor {
    /// Draws a person's stops and dwell times from the seed and the first of the group; `None` without any stop.
    pub(super) fn new(seed: u64, [id, first]: [u32; 2], route: usize, stops: &[StopOnRoute]) -> Option<Visitor> {
        let rng = &mut person_stream(seed, first, Purpose::Stops);
        let mut plan = Vec::new();
        for (stop, on_route) in stops.iter().enumerate() {
            // Drawn for everybody, so that a share changes nothing but who stops.
            let takes = rng.random::<f64>() < on_route.share;
            let dwell_s = on_route.dwell_s.draw(rng);
            let draw = rng.random();
            if takes {
                plan.push(PlannedVisit { stop, dwell_s, draw });
            }
        }
        plan.reverse();
        let state = match plan.last().is_some_and(|first| stops[first.stop].after_via == 0) {
            true => VisitState::Coming { queue: None },
            false => VisitState::Underway,
        };
        (!plan.is_empty()).then_some(Visitor { id, route, plan, state, came_s: 0.0, begun_s: 0.0 })
    }

    pub(super) fn visit(&self, stop: usize, time_s: f64) -> Visit {
        let begun_s = self.begun_s;
        Visit { id: self.id, stop, came_s: self.came_s.min(begun_s), begun_s, left_s: time_s }
    }
}
