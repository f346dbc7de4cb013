//! A queue of people, and the places where they are served.

use std::collections::{BTreeMap, VecDeque};

use super::queue_path::{QueuePath, stands};
use super::standing::{self, SearchArea};
use super::update::StopsUpdate;
use super::visitor::Visitor;
use crate::crowd::environment::Environment;
use crate::math::{SplitMix64, Vec2};
use crate::routes::{Stop, StopKind};

/// Share by which gaps in a queue differ from person to person.
const UNEVEN: f64 = 0.12;
/// Largest distance of people from the middle of the queue, metres.
const BESIDE_M: f64 = 0.09;
/// Largest distance of people from the middle of a place at a counter, metres: across, and back.
const OFF_PLACE_M: [f64; 2] = [0.07, 0.05];
/// Distance between people for whom the queue has no room, metres.
const LOOSE_M: f64 = 0.75;
/// Distance that they keep from the counter, metres.
const CLEAR_OF_PLACES_M: f64 = 1.4;
/// Distance from the own place beyond which the next one may go first, and by how much nearer that one is, metres.
const LET_GO_FIRST_M: [f64; 2] = [2.0, 1.0];
/// Walking speed by which queues are compared, metres per second.
const WALK_M_S: f64 = 1.2;
/// Advantage of the queue that is chosen already, seconds.
const HABIT_S: f64 = 2.0;
/// Longest wait that people put up with for a queue that they like better, seconds: otherwise all who come from one side
/// would take the nearest ticket gate.
const LIKING_S: f64 = 5.0;

/// Places that serve one queue, and the people in it.
#[derive(Clone, Debug)]
pub(super) struct Queue {
    places: Vec<ServicePlace>,
    path: QueuePath,
    spacing_m: f64,
    /// Everybody who waits, the first one first.
    pub(super) order: VecDeque<u32>,
    /// Spots of those for whom the queue has no room, metres.
    loose: BTreeMap<u32, Vec2>,
    /// Distance from the head to the place of the next one to come, metres.
    tail_along_m: f64,
    /// Time at which somebody was last called or served, seconds.
    pub(super) moved_s: f64,
}

/// Place where one person is served at a time.
#[derive(Clone, Copy, Debug)]
struct ServicePlace {
    place_m: Vec2,
    facing: Vec2,
    taken: Option<u32>,
    free_since_s: f64,
}

impl Queue {
    pub(super) fn new(places: impl Iterator<Item = (Vec2, Vec2)>, spacing_m: f64) -> Queue {
        let place = |(place_m, facing)| ServicePlace { place_m, facing, taken: None, free_since_s: 0.0 };
        Queue {
            places: places.map(place).collect(),
            path: QueuePath::default(),
            spacing_m,
            order: VecDeque::new(),
            loose: BTreeMap::new(),
            tail_along_m: 0.0,
            moved_s: 0.0,
        }
    }

    /// Middles of the places, and points of the queue, metres.
    pub(super) fn footprint(&self) -> impl Iterator<Item = Vec2> {
        self.places.iter().map(|place| place.place_m).chain(self.path.points().iter().copied())
    }

    /// Lays the queue behind the places: as the stop says, or as it finds room.
    pub(super) fn lay(&mut self, environment: &Environment<'_>, stop: &Stop, taken: &[Vec2]) {
        let count = self.places.len().max(1) as f64;
        let middle = self.places.iter().fold(Vec2::ZERO, |sum, place| sum + place.place_m) / count;
        let ahead = stop.facing_from(middle);
        if stop.queue_m.is_empty() {
            // SearchArea to step up and to get away between several places and the queue that serves them.
            let gap_m = if self.places.len() > 1 { self.spacing_m.max(1.3) } else { self.spacing_m };
            self.path = QueuePath::found(environment, middle - ahead * gap_m, ahead, self.spacing_m, taken);
        } else {
            let points = stop.queue_m.iter().map(|&point| standing::off_walls(environment, point, 0.25)).collect();
            self.path = QueuePath::new(points, ahead);
        }
        self.moved_s = 0.0;
    }

    /// Number of people for whom the queue has room.
    pub(super) fn room(&self) -> usize {
        if self.path.points().is_empty() { 0 } else { (self.path.length_m() / self.spacing_m + 1e-6) as usize + 1 }
    }

    /// Length of the queue now, metres.
    pub(super) fn reach_m(&self) -> f64 {
        self.tail_along_m.min(self.path.length_m())
    }

    /// Place of a person who joins now, metres.
    pub(super) fn tail_m(&self, draw: u64) -> Vec2 {
        let vacant = self.places.iter().filter(|place| place.taken.is_none()).count();
        if self.order.is_empty() && vacant > 0 {
            let wanted = (draw % vacant as u64) as usize;
            let place = self.places.iter().filter(|place| place.taken.is_none()).nth(wanted);
            return place.map_or(Vec2::ZERO, |place| place.place_m);
        }
        match self.path.points() {
            [] => self.places.first().map_or(Vec2::ZERO, |place| place.place_m - place.facing * self.spacing_m),
            _ => self.path.at(self.tail_along_m).0,
        }
    }

    /// The place to head for on the way to the tail: the tail if it is in sight, or else the last visible part of the
    /// queue. `None` if no part is in sight.
    pub(super) fn seen_from(&self, environment: &Environment<'_>, p: Vec2, tail_m: Vec2) -> Option<Vec2> {
        const MARGIN_M: f64 = 0.2;
        let free = |to: &Vec2| environment.is_free(p, *to, MARGIN_M);
        let step_m = 1.5;
        let steps = (self.reach_m() / step_m) as usize;
        let along = (0..=steps).rev().map(|k| self.path.at(k as f64 * step_m).0);
        [tail_m].into_iter().chain(along.filter(|_| !self.path.points().is_empty())).find(free)
    }

    /// A free place, metres.
    pub(super) fn vacant_m(&self) -> Option<Vec2> {
        self.places.iter().find(|place| place.taken.is_none()).map(|place| place.place_m)
    }

    /// The free place that is nearest to `p`.
    pub(super) fn free_place(&self, p: Vec2) -> Option<usize> {
        let free = self.places.iter().enumerate().filter(|(_, place)| place.taken.is_none());
        free.min_by(|a, b| a.1.place_m.distance(p).total_cmp(&b.1.place_m.distance(p))).map(|(index, _)| index)
    }

    /// Calls a person to a place; returns since when it has been free, seconds.
    pub(super) fn take(&mut self, place: usize, id: u32, time_s: f64) -> f64 {
        let place = &mut self.places[place];
        place.taken = Some(id);
        self.moved_s = time_s;
        place.free_since_s
    }

    /// Frees a place after a service.
    pub(super) fn free(&mut self, place: usize, time_s: f64) {
        let place = &mut self.places[place];
        (place.taken, place.free_since_s) = (None, time_s);
        self.moved_s = time_s;
    }

    /// Spot at a place, metres, and the unit vector that a person there faces.
    pub(super) fn spot_at(&self, place: usize, stop: &Stop, draw: u64, environment: &Environment<'_>) -> (Vec2, Vec2) {
        let ServicePlace { place_m, facing, .. } = self.places[place];
        let rng = &mut SplitMix64::new(draw);
        let across = if stop.kind == StopKind::Gate { 0.5 } else { 1.0 } * OFF_PLACE_M[0];
        let off = facing.left() * (across * f64::from(rng.range(-1.0, 1.0)))
            - facing * (OFF_PLACE_M[1] * f64::from(rng.unit()));
        let spot = if stands(environment, place_m + off, 0.2) { place_m + off } else { place_m };
        (spot, standing::about(facing, draw))
    }

    /// Spots of everybody in the queue now: slot of the agent, spot in metres, unit vector that the agent faces.
    pub(super) fn line_up(
        &mut self,
        update: &StopsUpdate<'_>,
        visitors: &BTreeMap<u32, Visitor>,
    ) -> Vec<(usize, Vec2, Vec2)> {
        let mut spots = Vec::with_capacity(self.order.len());
        let mut along_m = 0.0;
        let (has_path, length_m) = (!self.path.points().is_empty(), self.path.length_m());
        for (index, id) in self.order.iter().enumerate() {
            let Some((slot, p)) = update.place_of(*id) else { continue };
            let draw = visitors.get(id).and_then(|visitor| visitor.plan.last()).map_or(0, |planned| planned.draw);
            let rng = &mut SplitMix64::new(draw ^ 0x11);
            let gap_m = self.spacing_m * (1.0 + UNEVEN * f64::from(rng.range(-1.0, 1.0)));
            let beside_m = BESIDE_M * f64::from(rng.range(-1.0, 1.0));
            if index > 0 {
                along_m += gap_m;
            }
            if has_path && along_m <= length_m {
                self.loose.remove(id);
                let (middle, ahead) = self.path.at(along_m);
                let spot = middle + ahead.left() * beside_m;
                let spot = if stands(update.environment, spot, 0.2) { spot } else { middle };
                spots.push((slot, spot, standing::about(ahead, draw)));
                continue;
            }
            let (end, ahead) = match has_path {
                true => self.path.at(length_m),
                false => self.places.first().map_or((p, Vec2::ZERO), |place| (place.place_m, place.facing)),
            };
            if !self.loose.contains_key(id) {
                // A crowd as wide as it is many, behind the last one in the queue.
                let reach_m = 1.2 + 0.5 * (self.loose.len() as f64).sqrt();
                let free = |spot: Vec2, apart_m: f64| {
                    let queue = spots.iter().map(|(_, spot, _): &(usize, Vec2, Vec2)| spot);
                    self.loose.values().chain(queue).all(|other| other.distance(spot) >= apart_m)
                        && self.places.iter().all(|place| place.place_m.distance(spot) >= CLEAR_OF_PLACES_M)
                };
                let room = SearchArea::Around(end - ahead * (0.6 * reach_m), reach_m);
                let found = standing::free_spot(update.environment, room, LOOSE_M, draw, free).or_else(|| {
                    standing::free_spot(update.environment, SearchArea::Around(end, 1.5 * reach_m), LOOSE_M, draw, free)
                });
                self.loose.insert(*id, found.unwrap_or(p));
            }
            let spot = self.loose[id];
            spots.push((slot, spot, standing::about((end - spot).normalized().unwrap_or(ahead), draw)));
        }
        self.let_go_first(update, &spots);
        self.tail_along_m = if self.order.is_empty() { 0.0 } else { along_m + self.spacing_m };
        spots
    }

    /// Swaps neighbours in the queue where one is held up and the next one is nearer to the place.
    fn let_go_first(&mut self, update: &StopsUpdate<'_>, spots: &[(usize, Vec2, Vec2)]) {
        if spots.len() != self.order.len() {
            return;
        }
        let position = |index: usize| update.position(spots[index].0);
        let mut index = 0;
        while index + 1 < spots.len() {
            let spot = spots[index].1;
            let [own_m, next_m] = [index, index + 1].map(|k| position(k).distance(spot));
            if own_m > LET_GO_FIRST_M[0] && next_m < own_m - LET_GO_FIRST_M[1] {
                self.order.swap(index, index + 1);
                index += 1;
            }
            index += 1;
        }
    }

    /// Removes a person who has left the crowd.
    pub(super) fn forget(&mut self, id: u32) {
        self.order.retain(|other| *other != id);
        self.loose.remove(&id);
        self.places.iter_mut().filter(|place| place.taken == Some(id)).for_each(|place| place.taken = None);
    }

    /// Estimated time until a person at `p` would be served, seconds.
    fn wait_s(&self, p: Vec2, mean_s: f64) -> f64 {
        let ahead = self.order.len() + self.places.iter().filter(|place| place.taken.is_some()).count();
        ahead as f64 * mean_s / self.places.len().max(1) as f64 + self.tail_m(0).distance(p) / WALK_M_S
    }
}

/// Index of the quickest queue for a person at `p`; the one chosen already has a small advantage, and everybody likes
/// some queues better than others, by the person's `draw`.
pub(super) fn choose(queues: &[Queue], chosen: Option<usize>, p: Vec2, mean_s: f64, draw: u64) -> usize {
    let liked_less_s = |queue: usize| LIKING_S * f64::from(SplitMix64::new(draw ^ (queue as u64 + 1)).unit());
    let habit_s = |queue: usize| if chosen == Some(queue) { HABIT_S } else { 0.0 };
    let wait_s = |queue: usize| queues[queue].wait_s(p, mean_s) + liked_less_s(queue) - habit_s(queue);
    let mut best = 0;
    for queue in 1..queues.len() {
        if wait_s(queue) < wait_s(best) {
            best = queue;
        }
    }
    best
}
