//! Places where people stop: they go there, queue up or find a spot, stay, and walk on.
//!
//! Everything is decided at fixed times, one person after the other in the order of ids, so that neither threads
//! nor the time step matter: [`Stops::update`] gives everybody at a stop an [`Errand`] (where to stand, what to
//! face), and people walk it as [`walk`] says. Whoever has no errand walks the route.

mod errand;
mod line;
mod path;
mod post;
mod spots;
mod visit;
mod walk;

pub(super) use errand::Errand;
pub use visit::{StopTally, Visit};

use std::collections::BTreeMap;

use super::roll;
use super::state::{Body, Course};
use crate::math::{Rect, Vec2};
use crate::plan::FloorPlan;
use crate::routes::{Field, Ground, Navigation, Place, Route, StopKind};
use crate::walls::Walls;
use errand::Mode;
use post::{Kind, Post};
use visit::{State, Visitor};

/// How often stops are looked after, seconds.
const UPDATE_S: f64 = 0.2;
/// People look for a free spot or a line from this walking distance on, metres.
const NEAR_M: f64 = 6.0;
/// Whoever is this near to the tail of a line joins it, metres.
const JOIN_M: f64 = 1.0;
/// Whoever gets no nearer to a tail for so long joins from where they are, seconds.
const JOIN_AFTER_S: f64 = 5.0;
/// Whoever is this near to a spot is there, metres.
const THERE_M: f64 = 0.2;
/// Whoever is called steps up within this distance: the time of the service runs from there on, metres.
const STEP_UP_M: f64 = 1.8;
/// ... and from so long after the call in any case, seconds.
const STEP_UP_S: f64 = 8.0;
/// A stay begins so long after a spot was found, even if the crowd keeps the person from it, seconds.
const SETTLE_S: f64 = 20.0;
/// Nobody who is served leaves before they are there, unless so much time is over, seconds.
const GRACE_S: f64 = 4.0;
/// Somebody who leaves gets to where the route goes on within this, or goes on from where they are, seconds.
const LEAVE_S: f64 = 8.0;
/// A line that serves nobody for so much longer than anybody takes does not move, seconds.
const STALLED_S: f64 = 30.0;

/// What stands around: the plan as people see it.
#[derive(Clone, Copy)]
pub(super) struct Surface<'a> {
    pub(super) plan: &'a FloorPlan,
    pub(super) walls: &'a Walls,
    pub(super) ground: &'a Ground,
}

/// All stops and who is at them.
#[derive(Debug, Default)]
pub(super) struct Stops {
    posts: Vec<Post>,
    /// For each route its stops: index of the post, share, places passed before.
    of_route: Vec<Vec<OnRoute>>,
    visitors: BTreeMap<u32, Visitor>,
    /// Slots in the order of ids, made anew for every look.
    by_id: Vec<u32>,
    log: Option<Vec<Visit>>,
}

/// A stop of a route.
#[derive(Clone, Copy, Debug)]
struct OnRoute {
    post: usize,
    share: f64,
    after_via: usize,
}

impl Stops {
    /// The stops of these routes; those of one name are one. Nobody stands nearer to a wall than `keep_m` if there
    /// is room.
    pub(super) fn new(surface: Surface<'_>, routes: &[Route], navigation: &Navigation, keep_m: f64) -> Stops {
        let mut stops = Stops::default();
        for route in routes {
            let mut of_route = Vec::new();
            for on_route in &route.stops {
                let known = stops.posts.iter().position(|post| post.stop.name == on_route.stop.name);
                let post = known.unwrap_or(stops.posts.len());
                if known.is_none() {
                    let starts = starts_of(surface, routes, navigation, &on_route.stop.name);
                    stops.posts.push(Post::new(surface, &on_route.stop, &starts, keep_m));
                }
                of_route.push(OnRoute { post, share: on_route.share, after_via: on_route.after_via });
            }
            stops.of_route.push(of_route);
        }
        post::lay_lines(surface, &mut stops.posts);
        stops
    }

    /// Somebody comes in: decides where they will stop, together with the first of their group, and gives the errand to
    /// begin with.
    pub(super) fn enter(&mut self, seed: u64, [id, first]: [u32; 2], route: usize) -> Option<Errand> {
        let stops = self.of_route.get(route).filter(|stops| !stops.is_empty())?;
        let visitor = Visitor::new(seed, [id, first], route, stops, &self.posts)?;
        let first = visitor.plan.last().map(|next| stops[next.stop]);
        self.visitors.insert(id, visitor);
        first.filter(|stop| stop.after_via == 0).map(|stop| Errand::come(stop.post))
    }

    /// What became of everybody who stopped, one for each stop.
    pub(super) fn tally(&self) -> Vec<StopTally> {
        self.posts.iter().map(|post| post.tally.clone()).collect()
    }

    /// From now on, keeps every visit that ends.
    pub(super) fn keep_visits(&mut self) {
        self.log.get_or_insert_with(Vec::new);
    }

    /// Every visit that ended since [`Stops::keep_visits`], in the order of their ends.
    pub(super) fn visits(&self) -> &[Visit] {
        self.log.as_deref().unwrap_or(&[])
    }

    /// The name of the stop that an errand leads to; for messages.
    pub(super) fn name_of(&self, errand: &Errand) -> Option<String> {
        self.posts.get(errand.post()).map(|post| post.stop.name.clone())
    }

    /// Looks after everybody who stops, if it is time to.
    pub(super) fn update(
        &mut self,
        (step, time_step_s): (u64, f64),
        surface: Surface<'_>,
        navigation: &Navigation,
        bodies: &[Body],
        courses: &mut [Course],
    ) {
        let every = (UPDATE_S / time_step_s).round().max(1.0) as u64;
        if self.visitors.is_empty() || !step.is_multiple_of(every) {
            return;
        }
        let time_s = step as f64 * time_step_s;
        let mut by_id = std::mem::take(&mut self.by_id);
        roll::call(courses, &mut by_id);
        let round = &mut Round { time_s, surface, navigation, bodies, courses, by_id: &by_id };
        self.forget_those_who_left(round);
        let mut visitors = std::mem::take(&mut self.visitors);
        let mut joining: Vec<Joining> = Vec::new();
        for (&id, visitor) in &mut visitors {
            if let Some(slot) = round.slot(id) {
                self.go_on(visitor, slot, round, &mut joining);
            }
        }
        self.join(joining, &mut visitors, time_s);
        self.call(&mut visitors, round);
        self.line_up(&mut visitors, round);
        visitors.retain(|_, visitor| !visitor.plan.is_empty());
        self.visitors = visitors;
        self.by_id = by_id;
    }

    /// Takes out who is not there any more: they arrived, or gave up.
    fn forget_those_who_left(&mut self, round: &Round<'_>) {
        let posts = &mut self.posts;
        self.visitors.retain(|id, _| {
            let present = round.slot(*id).is_some();
            if !present {
                posts.iter_mut().for_each(|post| post.forget(*id));
            }
            present
        });
    }

    /// One person's next state.
    fn go_on(&mut self, visitor: &mut Visitor, slot: usize, round: &mut Round<'_>, joining: &mut Vec<Joining>) {
        let Some(planned) = visitor.plan.last().copied() else { return };
        let on_route = self.of_route[visitor.route][planned.stop];
        let post = &mut self.posts[on_route.post];
        let p = round.bodies[slot].position();
        let time_s = round.time_s;
        match visitor.state {
            State::Underway => {
                let passed = round.courses[slot].leg as usize >= on_route.after_via;
                if passed {
                    visitor.state = State::Coming { line: None };
                    round.set(slot, Errand::come(on_route.post));
                }
            }
            State::Coming { line } => {
                let far_m = post.field.at(round.surface.ground, p);
                if far_m > NEAR_M + post.reach_m() {
                    return;
                }
                match &mut post.kind {
                    Kind::Spread(spread) => {
                        let (spot_m, facing) = spread.take(round.surface, &post.stop, visitor.id, planned.draw, p);
                        post.tally.crowd(spread.taken(), spread.room(post.stop.spacing_m));
                        visitor.came_s = time_s;
                        visitor.state = State::Settling { since_s: time_s };
                        round.set(slot, Errand::stand(on_route.post, spot_m, facing, true));
                    }
                    Kind::Lines(lines) => {
                        let line = line::choose(lines, line, p, post.stop.dwell_s.mean());
                        visitor.state = State::Coming { line: Some(line) };
                        let tail_m = lines[line].tail_m(planned.draw);
                        let idle_s = time_s - round.courses[slot].improved_s;
                        let distance_m = p.distance(tail_m);
                        if distance_m < JOIN_M || idle_s > JOIN_AFTER_S {
                            joining.push(Joining { post: on_route.post, line, distance_m, id: visitor.id });
                        }
                        let seen = lines[line].seen_from(round.surface, p, tail_m);
                        let errand = match seen {
                            Some(to_m) => Errand::towards(on_route.post, to_m),
                            None => Errand::come(on_route.post),
                        };
                        round.courses[slot].errand = Some(errand);
                    }
                }
            }
            State::Settling { since_s } => {
                let there = round.distance_to_spot(slot) < THERE_M;
                if there || time_s - since_s > SETTLE_S {
                    visitor.begun_s = time_s;
                    visitor.state = State::Staying { until_s: time_s + planned.dwell_s };
                }
            }
            State::Staying { until_s } => {
                round.courses[slot].improved_s = time_s;
                if time_s >= until_s {
                    if let Kind::Spread(spread) = &mut post.kind {
                        spread.leave(visitor.id);
                    }
                    self.leave(visitor, slot, on_route, until_s, round);
                }
            }
            State::Waiting { line } => {
                if let Kind::Lines(lines) = &post.kind
                    && time_s - lines[line].moved_s < post.stop.dwell_s.bounds()[1] + STALLED_S
                {
                    round.courses[slot].improved_s = time_s;
                }
            }
            State::Called { line, place, called_s, begun_s, ready_s } => {
                let distance_m = round.distance_to_spot(slot);
                let begun_s = begun_s.or_else(|| {
                    // Whoever stood in the line steps up at once.
                    (distance_m < STEP_UP_M).then_some(if time_s - ready_s < 3.0 * UPDATE_S { ready_s } else { time_s })
                });
                let begun_s = begun_s.or((time_s - called_s > STEP_UP_S).then_some(time_s));
                visitor.state = State::Called { line, place, called_s, begun_s, ready_s };
                let Some(begun_s) = begun_s else { return };
                round.courses[slot].improved_s = time_s;
                let end_s = begun_s + planned.dwell_s;
                // At a gate, an arm's length is near enough.
                let there = distance_m < if post.stop.kind == StopKind::Gate { 3.0 } else { 2.0 } * THERE_M;
                if time_s < end_s || !there && time_s < end_s + GRACE_S {
                    return;
                }
                visitor.begun_s = begun_s;
                // Waiting for the next look at the stop is nobody's service time.
                let free_s = if time_s - end_s < 1.5 * UPDATE_S { end_s } else { time_s };
                if let Kind::Lines(lines) = &mut post.kind {
                    lines[line].free(place, free_s);
                }
                self.leave(visitor, slot, on_route, free_s, round);
            }
            State::Leaving { until_s } => {
                let passed = round.distance_to_spot(slot) < 0.5;
                if passed || time_s >= until_s {
                    self.done(visitor, slot, round);
                }
            }
        }
    }

    /// Somebody has stayed long enough, until `left_s`.
    fn leave(&mut self, visitor: &mut Visitor, slot: usize, on_route: OnRoute, left_s: f64, round: &mut Round<'_>) {
        let visit = visitor.visit(on_route.post, left_s);
        let onward = self.onward(visitor, round);
        let p = round.bodies[slot].position();
        let others = round.near(p, visitor.id);
        let way_out = self.posts[on_route.post].way_out(round.surface, p, onward, &others);
        let post = &mut self.posts[on_route.post];
        post.tally.add(&visit);
        if let Some(log) = &mut self.log {
            log.push(visit);
        }
        match way_out {
            Some(to_m) => {
                visitor.state = State::Leaving { until_s: round.time_s + LEAVE_S };
                round.set(slot, Errand::pass(on_route.post, to_m));
            }
            None => self.done(visitor, slot, round),
        }
    }

    /// The walking distance to where somebody goes who leaves a stop.
    fn onward<'f>(&'f self, visitor: &Visitor, round: &'f Round<'_>) -> &'f Field {
        let stops = &self.of_route[visitor.route];
        let now = visitor.plan.last().map_or(0, |planned| stops[planned.stop].after_via);
        let next = visitor.plan.iter().rev().nth(1).map(|planned| stops[planned.stop]);
        if let Some(next) = next.filter(|next| next.after_via == now) {
            return &self.posts[next.post].field;
        }
        let legs = &round.navigation.ways[visitor.route].legs;
        &round.navigation.fields[legs[now.min(legs.len() - 1)].field]
    }

    /// The next stop, or the rest of the route.
    fn done(&mut self, visitor: &mut Visitor, slot: usize, round: &mut Round<'_>) {
        visitor.plan.pop();
        visitor.state = State::Underway;
        let course = &mut round.courses[slot];
        course.errand = None;
        course.looks = 1; // looks for the way at once
        course.least_left_m = f32::INFINITY;
        course.improved_s = round.time_s;
        course.blocked_s = 0.0;
    }

    /// Those who reached the tail of a line join it, the nearest first.
    fn join(&mut self, mut joining: Vec<Joining>, visitors: &mut BTreeMap<u32, Visitor>, time_s: f64) {
        joining.sort_by(|a, b| a.distance_m.total_cmp(&b.distance_m).then(a.id.cmp(&b.id)));
        for Joining { post, line, id, .. } in joining {
            let (Kind::Lines(lines), Some(visitor)) = (&mut self.posts[post].kind, visitors.get_mut(&id)) else {
                continue;
            };
            lines[line].order.push_back(id);
            visitor.came_s = time_s;
            visitor.state = State::Waiting { line };
        }
    }

    /// Calls whoever is first to the places that are free.
    fn call(&mut self, visitors: &mut BTreeMap<u32, Visitor>, round: &mut Round<'_>) {
        for (index, post) in self.posts.iter_mut().enumerate() {
            let stop = &post.stop;
            let Kind::Lines(lines) = &mut post.kind else { continue };
            for (number, line) in lines.iter_mut().enumerate() {
                while let Some(&id) = line.order.front() {
                    let found = round.slot(id).and_then(|slot| {
                        Some((slot, visitors.get_mut(&id)?, line.free_place(round.bodies[slot].position())?))
                    });
                    let Some((slot, visitor, place)) = found else { break };
                    line.order.pop_front();
                    let ready_s = line.take(place, id, round.time_s);
                    visitor.state =
                        State::Called { line: number, place, called_s: round.time_s, begun_s: None, ready_s };
                    let draw = visitor.plan.last().map_or(0, |planned| planned.draw);
                    let (spot_m, facing) = line.spot_at(place, stop, draw, round.surface);
                    round.set(slot, Errand::stand(index, spot_m, facing, true));
                }
            }
        }
    }

    /// Gives everybody who waits in a line the place there.
    fn line_up(&mut self, visitors: &mut BTreeMap<u32, Visitor>, round: &mut Round<'_>) {
        for (index, post) in self.posts.iter_mut().enumerate() {
            let Kind::Lines(lines) = &mut post.kind else { continue };
            for line in lines {
                let spots = line.line_up(round, visitors);
                post.tally.crowd(line.order.len(), line.room());
                for (slot, spot_m, facing) in spots {
                    round.set_waiting(slot, Errand::stand(index, spot_m, facing, false));
                }
            }
        }
    }
}

/// The cells that people come from to a stop: starts of routes, and places that they passed before.
fn starts_of(surface: Surface<'_>, routes: &[Route], navigation: &Navigation, name: &str) -> Vec<usize> {
    let lattice = &surface.ground.lattice;
    let mut cells = Vec::new();
    for (route, way) in routes.iter().zip(&navigation.ways) {
        for on_route in route.stops.iter().filter(|on_route| on_route.stop.name == name) {
            let before = on_route.after_via.checked_sub(1).and_then(|via| route.via.get(via));
            match before.map(|via| via.place) {
                Some(Place::Area([min, max])) => cells.extend(lattice.cells_within(Rect { min, max })),
                _ => cells.extend(&way.start_cells),
            }
        }
    }
    cells.retain(|&cell| surface.ground.is_walkable(cell));
    cells.sort_unstable();
    cells.dedup();
    cells
}

/// Somebody who has reached the tail of a line.
#[derive(Clone, Copy, Debug)]
struct Joining {
    post: usize,
    line: usize,
    distance_m: f64,
    id: u32,
}

/// What one look at all stops works on.
struct Round<'a> {
    time_s: f64,
    surface: Surface<'a>,
    navigation: &'a Navigation,
    bodies: &'a [Body],
    courses: &'a mut [Course],
    /// Slots in the order of ids.
    by_id: &'a [u32],
}

impl Round<'_> {
    fn slot(&self, id: u32) -> Option<usize> {
        let id_of = |slot: &u32| self.courses[*slot as usize].id;
        self.by_id.binary_search_by_key(&id, id_of).ok().map(|index| self.by_id[index] as usize)
    }

    fn distance_to_spot(&self, slot: usize) -> f64 {
        let p = self.bodies[slot].position();
        self.courses[slot].errand.map_or(0.0, |errand| errand.spot_m().distance(p))
    }

    /// Sends somebody on an errand; the way there is measured anew.
    fn set(&mut self, slot: usize, errand: Errand) {
        let course = &mut self.courses[slot];
        course.errand = Some(errand);
        course.least_left_m = f32::INFINITY;
        course.improved_s = self.time_s;
    }

    /// The same for somebody in a line: a step forward is no news.
    fn set_waiting(&mut self, slot: usize, errand: Errand) {
        let course = &mut self.courses[slot];
        if course.errand.is_none_or(|before| before.mode() != Mode::Stand || before.squeezes()) {
            self.set(slot, errand);
        } else if course.errand != Some(errand) {
            course.errand = Some(errand);
            course.least_left_m = f32::INFINITY;
        }
    }

    /// Where the others are who stand near `p`.
    fn near(&self, p: Vec2, id: u32) -> Vec<Vec2> {
        let others = self.bodies.iter().zip(self.courses.iter()).filter(|(_, course)| course.id != id);
        others.map(|(body, _)| body.position()).filter(|other| other.distance(p) < NEAR_M).collect()
    }

    fn place_of(&self, id: u32) -> Option<(usize, Vec2)> {
        self.slot(id).map(|slot| (slot, self.bodies[slot].position()))
    }
}
