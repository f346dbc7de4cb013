//! Lets people in: at openings from beyond the floor's edge, in rooms wherever there is space.

use std::collections::VecDeque;

use super::CrowdOptions;
use super::agents::Agents;
use super::arrivals::Arrival;
use super::environment::Environment;
use super::neighbours::NeighbourGrid;
use super::state::{BodyState, Heading, Traits, WalkState};
use super::stops::Stops;
use super::tally::{Stuck, Tally};
use super::wayfinding::{Wayfinder, entry_place};
use crate::math::{Purpose, SplitMix64, Vec2, person_stream, sin_cos, vec2};
use crate::routes::{Place, Route};

/// Depth beyond an opening's edge between which people appear and vanish, metres.
const APPEAR_M: [f64; 2] = [1.6, 2.7];
const VANISH_M: [f64; 2] = [1.0, 2.3];
/// Gap beyond the exclusion distance that people who enter want, metres.
const ENTRY_ROOM_M: f32 = 0.25;
/// Places that a person tries in each step.
const TRIES: usize = 4;
/// Distance between members of a group who come in one after the other, metres.
const COMPANY_M: [f64; 2] = [0.7, 0.95];
/// Directions that are tried around the member before.
const COMPANY_WAYS: usize = 8;
/// Time after which a person who finds no room beside the group enters anywhere, seconds.
const COMPANY_S: f64 = 5.0;
/// People of one queue who try to enter in each step.
const HEADS: usize = 4;
/// The same where everybody starts at once: between two rebuilds of the grid.
const MOST_AT_ONCE: usize = 1024;
/// Multiple of the patience after which all who wait at a blocked entrance are stuck.
const PATIENCE_LIMIT: f64 = 5.0;

/// Queues of people who wait to enter.
#[derive(Debug, Default)]
pub(super) struct Entrances {
    next_arrival: usize,
    queues: Vec<EntryQueue>,
    queue_of_route: Vec<usize>,
}

#[derive(Debug)]
struct EntryQueue {
    waiting: VecDeque<Waiting>,
    last_entry_s: f64,
}

#[derive(Debug)]
struct Waiting {
    arrival: Arrival,
    tries: SplitMix64,
}

impl Entrances {
    /// Routes that begin at the same place share a queue.
    pub(super) fn new(routes: &[Route]) -> Entrances {
        let mut places: Vec<Place> = Vec::new();
        let mut queue_of_route = Vec::new();
        for route in routes {
            let known = places.iter().position(|p| *p == route.start);
            queue_of_route.push(known.unwrap_or(places.len()));
            if known.is_none() {
                places.push(route.start);
            }
        }
        let queues = places.iter().map(|_| EntryQueue { waiting: VecDeque::new(), last_entry_s: 0.0 }).collect();
        Entrances { next_arrival: 0, queues, queue_of_route }
    }

    pub(super) fn is_empty(&self, arrivals: &[Arrival]) -> bool {
        self.next_arrival >= arrivals.len() && self.queues.iter().all(|q| q.waiting.is_empty())
    }

    /// Time of the next arrival, seconds, if no queue holds anybody.
    pub(super) fn next_arrival_s(&self, arrivals: &[Arrival]) -> Option<f64> {
        let nobody = self.queues.iter().all(|q| q.waiting.is_empty());
        arrivals.get(self.next_arrival).filter(|_| nobody).map(|a| a.time_s)
    }

    /// Lets in those who are due and find room.
    pub(super) fn admit(&mut self, admission: &mut Admission<'_>) {
        let time_s = admission.time_s;
        while let Some(&arrival) = admission.arrivals.get(self.next_arrival).filter(|a| a.time_s <= time_s) {
            let rng = &mut person_stream(admission.seed, arrival.id, Purpose::Arrival);
            rng.set_word_pos(16); // behind the draws of the arrival list
            let queue = &mut self.queues[self.queue_of_route[arrival.route]];
            if queue.waiting.is_empty() {
                queue.last_entry_s = time_s;
            }
            queue.waiting.push_back(Waiting { arrival, tries: SplitMix64::new(rand::RngExt::random(rng)) });
            self.next_arrival += 1;
        }
        let at_once = admission.options.entry_seconds == Some(0.0);
        while self.admit_heads(admission) && at_once {
            admission.neighbours.rebuild(&admission.agents.bodies);
        }
    }

    /// Lets in some of those at the heads of their queues; returns whether somebody got in.
    fn admit_heads(&mut self, admission: &mut Admission<'_>) -> bool {
        let (present, time_s) = (admission.agents.bodies.len(), admission.time_s);
        let at_once = admission.options.entry_seconds == Some(0.0);
        let heads = if at_once { (present / 4).clamp(HEADS, MOST_AT_ONCE) } else { HEADS };
        for queue in &mut self.queues {
            let mut head = 0;
            for _ in 0..heads.min(queue.waiting.len()) {
                let entered = admission.try_to_enter(&mut queue.waiting[head], present);
                if entered {
                    queue.waiting.remove(head);
                    queue.last_entry_s = time_s;
                } else {
                    head += 1;
                }
            }
            let patience_s = PATIENCE_LIMIT * admission.options.patience_seconds;
            if !queue.waiting.is_empty() && time_s - queue.last_entry_s > patience_s {
                for waiting in queue.waiting.drain(..) {
                    let route = waiting.arrival.route;
                    let place_m = admission.environment.routes[route].gates.first().map_or(Vec2::ZERO, |g| g.at(0.5));
                    admission.tally.stuck.push(Stuck { id: waiting.arrival.id, place_m, route, stop: None });
                }
            }
        }
        admission.agents.bodies.len() > present
    }
}

/// What lets people in: the state of the crowd at the end of a step.
pub(super) struct Admission<'s> {
    pub(super) environment: &'s Environment<'s>,
    pub(super) options: &'s CrowdOptions,
    pub(super) seed: u64,
    pub(super) arrivals: &'s [Arrival],
    pub(super) agents: &'s mut Agents,
    pub(super) neighbours: &'s mut NeighbourGrid,
    pub(super) stops: &'s mut Stops,
    pub(super) tally: &'s mut Tally,
    /// Time since the start, seconds.
    pub(super) time_s: f64,
}

impl Admission<'_> {
    fn try_to_enter(&mut self, waiting: &mut Waiting, present: usize) -> bool {
        let Arrival { id, route, .. } = waiting.arrival;
        let mut traits = self.traits_of(id);
        if let Some(companion) = self.companion(id) {
            let late = self.time_s - waiting.arrival.time_s > COMPANY_S || self.options.entry_seconds == Some(0.0);
            let draw = f64::from(waiting.tries.unit());
            let beside = self.places_beside(companion, route, &traits, draw);
            let free = beside.into_iter().flatten().find(|&p| self.has_room(p, traits.exclusion_m, present));
            if let Some(p) = free {
                self.enter(id, route, traits, p, [draw, f64::from(waiting.tries.unit())]);
                return true;
            }
            if !late {
                return false;
            }
        }
        for attempt in 0..TRIES {
            let mut unit = || f64::from(waiting.tries.unit());
            let draws = [unit(), unit()];
            if attempt > 0 {
                traits.lane = unit() as f32;
            }
            let Some(p) = self.entry_place(route, &traits, draws) else { continue };
            if self.has_room(p, traits.exclusion_m, present) {
                self.enter(id, route, traits, p, draws);
                return true;
            }
        }
        false
    }

    /// Traits of a person; members of a group walk at one speed, and towards one place.
    fn traits_of(&self, id: u32) -> Traits {
        let mut traits = Traits::draw(self.seed, id, self.options);
        let others = self.agents.groups.members(id).len().saturating_sub(1);
        if others > 0 {
            let first = Traits::draw(self.seed, self.agents.groups.first(id), self.options);
            let slower_m_s = self.options.groups.slowdown as f32 * others as f32;
            traits.speed_m_s = (first.speed_m_s - slower_m_s).max(0.5 * first.speed_m_s);
            traits.lane = first.lane;
            traits.goal_draw = first.goal_draw;
        }
        traits
    }

    /// Slot of the member of a person's group who came in last.
    fn companion(&self, id: u32) -> Option<usize> {
        let members = self.agents.groups.members(id);
        let is_member = |walk: &WalkState| members.contains(&walk.id);
        if members.len() < 2 { None } else { self.agents.walks.iter().rposition(is_member) }
    }

    /// Free places around a companion and in sight, in turn from the direction that a draw in `[0, 1)` gives.
    ///
    /// At an opening they lie as far beyond it as all entry places do.
    fn places_beside(
        &self,
        companion: usize,
        route: usize,
        traits: &Traits,
        draw: f64,
    ) -> [Option<Vec2>; COMPANY_WAYS] {
        let ground = self.environment.ground();
        let at = self.agents.bodies[companion].position();
        let distance_m = COMPANY_M[0] + (COMPANY_M[1] - COMPANY_M[0]) * draw;
        std::array::from_fn(|way| {
            let turn = (draw + way as f64 / COMPANY_WAYS as f64) * std::f64::consts::TAU;
            let (sin, cos) = sin_cos(turn);
            let p = at + vec2(cos, sin) * distance_m;
            let limit_m = f64::from(traits.wall_exclusion_m).min(ground.gap_limit_m(p));
            let outside = match self.environment.routes[route].start {
                Place::Opening(index) => self.environment.plan.openings.get(index).is_some_and(|opening| {
                    let depth_m = (p - opening.from_m).dot(opening.side.outward());
                    depth_m > APPEAR_M[0] - 1.0 && depth_m < APPEAR_M[1]
                }),
                Place::Area(_) => true,
            };
            // Behind the wall of a narrow opening there may be a gap too.
            let walkable = ground.lattice.cell_at(p).is_some_and(|cell| ground.is_walkable(cell));
            let free =
                outside && walkable && ground.clearance_m(p) >= limit_m && ground.sight(self.environment.walls, at, p);
            free.then_some(p)
        })
    }

    /// Place at which a person appears, if it is free of walls.
    fn entry_place(&self, route: usize, traits: &Traits, draws: [f64; 2]) -> Option<Vec2> {
        let ground = self.environment.ground();
        match self.environment.routes[route].start {
            Place::Opening(index) => {
                let opening = self.environment.plan.openings.get(index)?;
                let depth_m = APPEAR_M[0] + (APPEAR_M[1] - APPEAR_M[0]) * draws[0];
                Some(entry_place(opening, traits) + opening.side.outward() * depth_m)
            }
            Place::Area(_) => {
                let cells = &self.environment.navigation.ways[route].start_cells;
                let cell = *cells.get((draws[0] * cells.len() as f64) as usize)?;
                // Anywhere within the cell: the draw's lower digits say where.
                let within = vec2((draws[0] * cells.len() as f64).fract(), draws[1]) - vec2(0.5, 0.5);
                let p = ground.lattice.centre(cell) + within * ground.lattice.cell_m();
                let limit = f64::from(traits.wall_exclusion_m).min(ground.gap_limit_m(p));
                (ground.clearance_m(p) >= limit).then_some(p)
            }
        }
    }

    /// Whether a place keeps the distance from all agents, newcomers of this step included.
    fn has_room(&self, p: Vec2, exclusion_m: f32, present: usize) -> bool {
        let (x, y) = (p.x as f32, p.y as f32);
        let free = |body: &BodyState| {
            let (dx, dy) = (self.neighbours.dx(x, body.x), body.y - y);
            let wanted = 0.5 * exclusion_m + body.half_exclusion_m + self.entry_room_m();
            dx * dx + dy * dy >= wanted * wanted
        };
        let mut room = self.agents.bodies[present..].iter().all(&free);
        self.neighbours.around(x, y, |range, _| {
            room = room && self.neighbours.slots[range].iter().all(|&slot| free(&self.agents.bodies[slot as usize]));
        });
        room
    }

    fn entry_room_m(&self) -> f32 {
        // All at once means: as densely as bodies go.
        if self.options.entry_seconds == Some(0.0) { 0.0 } else { ENTRY_ROOM_M }
    }

    fn enter(&mut self, id: u32, route: usize, traits: Traits, p: Vec2, draws: [f64; 2]) {
        let depth_m = VANISH_M[0] + (VANISH_M[1] - VANISH_M[0]) * f64::from(traits.goal_draw);
        let end_m = match self.environment.routes[route].goal {
            Place::Opening(_) => vec2(depth_m, 0.0),
            Place::Area(_) => {
                let ground = self.environment.ground();
                let cells = &self.environment.navigation.ways[route].goal_cells;
                let at = (f64::from(traits.goal_draw) * cells.len() as f64) as usize;
                let within = vec2(draws[1], draws[0]) - vec2(0.5, 0.5);
                ground.lattice.centre(cells[at.min(cells.len() - 1)]) + within * ground.lattice.cell_m()
            }
        };
        let mut walk = WalkState {
            route: route as u32,
            improved_s: self.time_s,
            end_m,
            visit: self.stops.enter(self.seed, [id, self.agents.groups.first(id)], route),
            ..WalkState::new(id, Heading::new(1.0, 0.0))
        };
        let wayfinder = Wayfinder::new(self.environment);
        let left_m = wayfinder.advance(&mut walk, p, self.time_s);
        let gate = self.environment.routes[route].gates.first();
        let ahead = gate.and_then(|g| (g.right_m - g.left_m).left().normalized()).unwrap_or(vec2(1.0, 0.0));
        let aim = wayfinder.aim(&walk, &traits, (p, left_m), ahead, self.time_s);
        let (aim_x, aim_y) = (aim.x as f32, aim.y as f32);
        walk.heading = Heading::new(aim_x, aim_y);
        walk.wanted = [aim_x, aim_y];
        self.agents.bodies.push(BodyState {
            x: p.x as f32,
            y: p.y as f32,
            vx: aim_x * traits.speed_m_s,
            vy: aim_y * traits.speed_m_s,
            aim_x,
            aim_y,
            half_exclusion_m: 0.5 * traits.exclusion_m,
            clearance_m: self.environment.navigation.ground.clearance_at_least_m(p) as f32,
        });
        self.agents.traits.push(traits);
        self.agents.walks.push(walk);
        self.tally.entered += 1;
    }
}
