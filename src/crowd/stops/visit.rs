use rand::RngExt;
use serde::Serialize;

use super::OnRoute;
use super::post::Post;
use crate::math::{Purpose, person_stream};

/// What happened at a stop.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct StopTally {
    /// The stop's name.
    pub name: String,
    /// Whether people wait in line there.
    pub in_line: bool,
    /// How many visits have ended.
    pub visits: u64,
    /// How long all of them together waited in line, or walked up to their spots, seconds.
    pub waited_s: f64,
    /// How long all of them together stayed or were served, seconds.
    pub stayed_s: f64,
    /// The most people who were there or in line at once.
    pub most: usize,
    /// How many find room there; more stand around in a loose crowd.
    pub room: usize,
}

impl StopTally {
    /// Says that more people came than find room, if so.
    pub fn warning(&self) -> Option<String> {
        let StopTally { name, in_line, most, room, .. } = self;
        (most > room).then(|| match in_line {
            true => format!("the line at \"{name}\" reached {most} people, there is room for {room}"),
            false => format!("{most} people were at \"{name}\" at once, there is room for {room}"),
        })
    }

    pub(super) fn crowd(&mut self, people: usize, room: usize) {
        if people > self.most {
            (self.most, self.room) = (people, room);
        }
    }

    pub(super) fn add(&mut self, visit: &Visit) {
        self.visits += 1;
        self.waited_s += visit.begun_s - visit.came_s;
        self.stayed_s += visit.left_s - visit.begun_s;
    }
}

/// One person's visit of a stop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Visit {
    /// Who.
    pub id: u32,
    /// Index of the stop, in the order in which routes first name them.
    pub stop: usize,
    /// When the person joined the line or found a spot, seconds.
    pub came_s: f64,
    /// When the stay or the service began, seconds.
    pub begun_s: f64,
    /// When it ended, seconds.
    pub left_s: f64,
}

/// Somebody who will stop, or does.
#[derive(Clone, Debug)]
pub(super) struct Visitor {
    pub(super) id: u32,
    pub(super) route: usize,
    /// Stops still to come, the last one first.
    pub(super) plan: Vec<Planned>,
    pub(super) state: State,
    pub(super) came_s: f64,
    pub(super) begun_s: f64,
}

/// A stop that somebody will make.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Planned {
    /// Index among the route's stops.
    pub(super) stop: usize,
    /// Seconds to stay or to be served.
    pub(super) dwell_s: f64,
    /// Where exactly to stand.
    pub(super) draw: u64,
}

/// What somebody does about the next stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum State {
    /// Not there yet on the route.
    Underway,
    /// On the way to it, or to the tail of a line.
    Coming { line: Option<usize> },
    /// Waiting in a line.
    Waiting { line: usize },
    /// Called to a place at the counter that was ready at a time: steps up, is served.
    Called { line: usize, place: usize, called_s: f64, begun_s: Option<f64>, ready_s: f64 },
    /// On the way to a spot.
    Settling { since_s: f64 },
    /// Stays at a spot.
    Staying { until_s: f64 },
    /// Gets away from the counter.
    Leaving { until_s: f64 },
}

impl Visitor {
    /// Draws where somebody stops, and for how long: a function of the seed and of the first of their group. `None` for
    /// who stops nowhere.
    pub(super) fn new(
        seed: u64,
        [id, first]: [u32; 2],
        route: usize,
        stops: &[OnRoute],
        posts: &[Post],
    ) -> Option<Visitor> {
        let rng = &mut person_stream(seed, first, Purpose::Stops);
        let mut plan = Vec::new();
        for (stop, on_route) in stops.iter().enumerate() {
            // Drawn for everybody, so that a share changes nothing but who stops.
            let takes = rng.random::<f64>() < on_route.share;
            let dwell_s = posts[on_route.post].stop.dwell_s.draw(rng);
            let draw = rng.random();
            if takes {
                plan.push(Planned { stop, dwell_s, draw });
            }
        }
        plan.reverse();
        let state = match plan.last().is_some_and(|first| stops[first.stop].after_via == 0) {
            true => State::Coming { line: None },
            false => State::Underway,
        };
        (!plan.is_empty()).then_some(Visitor { id, route, plan, state, came_s: 0.0, begun_s: 0.0 })
    }

    pub(super) fn visit(&self, stop: usize, time_s: f64) -> Visit {
        let begun_s = self.begun_s;
        Visit { id: self.id, stop, came_s: self.came_s.min(begun_s), begun_s, left_s: time_s }
    }
}
