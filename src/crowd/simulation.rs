use std::ops::Range;
use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering::Relaxed;

use super::agents::{AgentSnapshot, Agents, in_chunks};
use super::arrivals::{self, Arrival};
use super::boids::Boids;
use super::capacity::{self, Overload};
use super::collisions::Collisions;
use super::departures::{Departures, StepEnd};
use super::entrances::{Admission, Entrances};
use super::environment::Environment;
use super::groups::Groups;
use super::model::{CALMS_DOWN_M_S2, ModelSettings, SteeringModel};
use super::moves::Move;
use super::neighbours::NeighbourGrid;
use super::options::CrowdModel;
use super::perception::{OPEN_M, Perception, SENSE_M};
use super::social_force::SocialForce;
use super::spots::{SpotRequest, Spots};
use super::standstill::{Standstill, StandstillWatch};
use super::stops::{Stops, Visit};
use super::tally::{Stuck, Tally};
use super::wayfinding::Wayfinder;
use super::{CrowdError, CrowdOptions};
use crate::math::{Rect, Vec2, vec2};
use crate::motion::{Frame, Motion, MotionError, People, Walker};
use crate::plan::FloorPlan;
use crate::routes::{Navigation, Route};
use crate::walls::{APRON_M, Walls};

/// Time for which an agent does not return to its lane after somebody came the other way, seconds.
const YIELDS_S: f32 = 6.0;
/// Steps after which agents are put into the order of the neighbours' grid.
const ORDER_STEPS: u64 = 16;

/// A crowd that walks along routes, step by step, under the model that its options name.
///
/// As a [`Motion`] it gives one frame for each time step; people who have arrived or got stuck are in no frame any more.
pub struct Simulation<'a> {
    environment: Environment<'a>,
    /// Options; the time step is that of a substep.
    options: CrowdOptions,
    /// Time step between frames, seconds, and the number of substeps.
    frame_s: f64,
    substeps: u64,
    seed: u64,
    model: Box<dyn SteeringModel>,
    settings: ModelSettings,
    arrivals: Vec<Arrival>,
    entrances: Entrances,
    departures: Departures,
    agents: Agents,
    neighbours: NeighbourGrid,
    moves: Vec<Move>,
    collisions: Collisions,
    stops: Stops,
    spots: Spots,
    tally: Tally,
    standstill: StandstillWatch,
    /// Number of the substep.
    step: u64,
    /// Slots in the order of ids; sorted for every frame.
    by_id: Vec<u32>,
}

impl<'a> Simulation<'a> {
    /// A crowd before anybody has entered; measures the way along the routes first.
    ///
    /// # Errors
    /// Options out of range, no routes, routes that do not belong to the plan.
    ///
    /// # Example
    /// ```
    /// use trodden::crowd::{CrowdOptions, Simulation};
    /// use trodden::motion::{Frame, Motion, People};
    /// use trodden::{plan::FloorPlan, routes, walls::Walls};
    ///
    /// // Five people in a corridor of 12 x 3 m.
    /// let floor = (0..120 * 40).map(|k: u32| u8::from((5..35).contains(&(k / 120)))).collect();
    /// let plan = FloorPlan::from_mask(120, 40, 0.1, floor);
    /// let walls = Walls::trace(&plan, &Default::default());
    /// let routes = routes::find(&plan, &walls, &Default::default())?;
    /// let people = People::new(1, Default::default());
    /// let options = CrowdOptions { people: 5, ..CrowdOptions::default() };
    /// let mut crowd = Simulation::new(&plan, &walls, &routes, &people, &options)?;
    /// let mut frame = Frame::default();
    /// while crowd.next_frame(&mut frame)? {}
    /// assert_eq!(crowd.tally().arrived, 5);
    /// # Ok::<(), trodden::Error>(())
    /// ```
    pub fn new(
        plan: &'a FloorPlan,
        walls: &'a Walls,
        routes: &'a [Route],
        people: &People,
        options: &CrowdOptions,
    ) -> Result<Simulation<'a>, CrowdError> {
        options.check()?;
        let navigation = Navigation::new(plan, walls, routes)?;
        Simulation::with_navigation(plan, walls, routes, navigation, people, options)
    }

    /// A crowd on routes that have been measured already, see [`Navigation::find`].
    ///
    /// # Errors
    /// Options out of range, no routes.
    pub fn with_navigation(
        plan: &'a FloorPlan,
        walls: &'a Walls,
        routes: &'a [Route],
        navigation: Navigation,
        people: &People,
        options: &CrowdOptions,
    ) -> Result<Simulation<'a>, CrowdError> {
        Simulation::with_spots(plan, walls, routes, navigation, people, options, &[])
    }

    /// A crowd with spots at which units are played; with any spot, it walks under social forces.
    ///
    /// # Errors
    /// As [`Simulation::with_navigation`]; a spot in a wall or off the floor; units that cannot be read.
    pub fn with_spots(
        plan: &'a FloorPlan,
        walls: &'a Walls,
        routes: &'a [Route],
        navigation: Navigation,
        people: &People,
        options: &CrowdOptions,
        spots: &[SpotRequest],
    ) -> Result<Simulation<'a>, CrowdError> {
        options.check()?;
        if routes.is_empty() {
            return Err(CrowdError::NoRoutes);
        }
        let seed = people.seed();
        let environment = Environment { plan, walls, routes, navigation };
        let spots = Spots::new(&environment, spots)?;
        let mut arrivals = arrivals::list(plan, routes, seed, options);
        let mut groups = Groups::default();
        let in_groups = options.model == CrowdModel::SocialForce || !spots.is_empty();
        let model: Box<dyn SteeringModel> = if in_groups {
            groups = Groups::draw(&mut arrivals, routes, &options.arrivals, &options.groups, seed);
            Box::new(SocialForce::new(options))
        } else {
            Box::new(Boids::new(&environment, options))
        };
        let settings = model.settings();
        // A hair less, so that rounding adds no part.
        let substeps = (options.time_step / settings.longest_step_s - 1e-6).ceil().max(1.0);
        let keep_m = options.wall_exclusion.bounds()[1] + 0.02;
        let area = Rect { min: Vec2::ZERO, max: vec2(plan.width_m(), plan.height_m()) }.grown(APRON_M);
        let mut agents = Agents::new(arrivals.len() as u32, groups);
        spots.stand_viewers(&mut agents, seed, options);
        Ok(Simulation {
            entrances: Entrances::new(routes),
            departures: Departures::new(routes.len()),
            neighbours: NeighbourGrid::new(area, SENSE_M as f32, options.period_x.map(|p| p as f32)),
            moves: Vec::new(),
            collisions: Collisions::default(),
            stops: Stops::new(&environment, keep_m),
            tally: Tally::default(),
            standstill: StandstillWatch::default(),
            step: 0,
            by_id: Vec::new(),
            options: CrowdOptions { time_step: options.time_step / substeps, ..options.clone() },
            frame_s: options.time_step,
            substeps: substeps as u64,
            environment,
            seed,
            model,
            settings,
            arrivals,
            agents,
            spots,
        })
    }

    /// Arrival list: when each person comes, and on which route, in the order of ids.
    pub fn arrivals(&self) -> &[Arrival] {
        &self.arrivals
    }

    /// Counts of people, stops and units so far.
    pub fn tally(&self) -> Tally {
        Tally { stops: self.stops.tally(), spots: self.spots.reports(), ..self.tally.clone() }
    }

    /// People who have got stuck so far.
    pub fn stuck(&self) -> &[Stuck] {
        &self.tally.stuck
    }

    /// Works out where more people will come than can pass: at openings, narrow places, gates and counters, from the arrival
    /// list. The tally holds it from then on.
    pub fn foresee(&mut self) -> &[Overload] {
        let first_of_group = |id| self.agents.group_of(id).start;
        let Simulation { environment, arrivals, stops, seed, .. } = &*self;
        self.tally.overloads = capacity::overloads(environment, arrivals, stops, *seed, first_of_group);
        &self.tally.overloads
    }

    /// Who has waited where so far while the crowd hardly got on, each place once.
    pub fn standstills(&self) -> &[Standstill] {
        &self.tally.standstills
    }

    /// Keeps every visit of a stop that ends from now on, for [`Simulation::visits`]: memory grows with them.
    pub fn keep_visits(&mut self) {
        self.stops.keep_visits();
    }

    /// Visits of stops that ended since [`Simulation::keep_visits`], in the order of their ends.
    pub fn visits(&self) -> &[Visit] {
        self.stops.visits()
    }

    /// Ids of everybody in a person's group, the person included: a range, of which some may not have come yet, or have left.
    pub fn group_of(&self, id: u32) -> Range<u32> {
        self.agents.group_of(id)
    }

    /// Time since the start, seconds.
    pub fn time_s(&self) -> f64 {
        self.step as f64 * self.options.time_step
    }

    /// Number of people present, onlookers left out.
    pub fn present(&self) -> usize {
        self.agents.present()
    }

    /// Whether everybody has come and left, or the time is up.
    pub fn is_over(&self) -> bool {
        let all_gone = self.present() == 0 && self.entrances.is_empty(&self.arrivals);
        let end_s = self.options.end_seconds.map(|end| end - self.settings.end_tolerance_s);
        all_gone || end_s.is_some_and(|end| self.time_s() >= end)
    }

    /// Snapshots of all people present, onlookers left out, in no particular order.
    pub fn agents(&self) -> impl Iterator<Item = AgentSnapshot> + '_ {
        self.agents.snapshots()
    }

    /// Snapshot of a person or an onlooker; `None` before a person has come and after they have left.
    pub fn agent(&self, id: u32) -> Option<AgentSnapshot> {
        self.agents.get(id)
    }

    /// Leads an agent: in the next step it goes to `position_m` and has this velocity there.
    ///
    /// The body faces along the unit vector `heading`, or else where it goes. The agent stays there until it is led on or
    /// [released](Simulation::release). Others see it and make way; walls and the bodies of others are the caller's
    /// business. A led agent does not arrive, does not get stuck, and is not served at stops.
    ///
    /// Returns false if the agent is not present, or if a number is not finite or beyond 1000 km of the origin.
    pub fn lead(&mut self, id: u32, position_m: Vec2, velocity_m_s: Vec2, heading: Option<Vec2>) -> bool {
        self.agents.lead(id, position_m, velocity_m_s, heading)
    }

    /// Lets a led agent walk on by the model, from place and velocity as they are.
    ///
    /// Returns whether it was led; onlookers cannot be released.
    pub fn release(&mut self, id: u32) -> bool {
        let time_s = self.time_s();
        self.agents.release(id, time_s)
    }

    /// Adds an onlooker, such as a viewer: an agent on no route, whom others walk around.
    ///
    /// `radius_m` is the body's radius. Onlookers are in no frame and no tally. Returns the id by which the onlooker can be
    /// [led](Simulation::lead); `None` if the place is not finite or the radius not within 0.05 to 5 m.
    pub fn stand(&mut self, position_m: Vec2, radius_m: f64) -> Option<u32> {
        self.agents.stand(position_m, radius_m, self.seed, &self.options)
    }

    /// Goes on by one time step.
    pub fn advance(&mut self) {
        self.skip_idle_time();
        self.agents.begin_leading();
        for substep in 1..=self.substeps {
            self.neighbours.rebuild(&self.agents.bodies);
            self.put_in_order();
            self.agents.note_slots();
            self.stops.update((self.step, self.options.time_step), &self.environment, &mut self.agents);
            self.look();
            self.choose_moves(substep as f64 / self.substeps as f64);
            let some_arrived = self.take_places();
            self.agents.finish_leading(self.time_s());
            self.step += 1;
            self.admit();
            let end = StepEnd { step: self.step, time_step_s: self.options.time_step, some_arrived };
            let patience_s = self.options.patience_seconds;
            self.departures.let_go(end, patience_s, &mut self.agents, &self.stops, &mut self.tally);
            let known = &mut self.tally.standstills;
            self.standstill.look(
                (self.step, self.options.time_step),
                self.environment.routes,
                &self.agents,
                &self.stops,
                known,
            );
        }
    }

    /// While the plan is empty, skips to the next arrival by whole steps.
    fn skip_idle_time(&mut self) {
        if self.present() == 0
            && let Some(next_s) = self.entrances.next_arrival_s(&self.arrivals)
        {
            let steps = (next_s / self.options.time_step) as u64 / self.substeps;
            self.step = self.step.max(steps * self.substeps);
        }
    }

    /// Puts agents into the order of the grid now and then, so that neighbours in space are neighbours in memory.
    fn put_in_order(&mut self) {
        if self.step.is_multiple_of(ORDER_STEPS) {
            self.agents.reorder(&self.neighbours.bodies, &self.neighbours.slots);
            self.neighbours.rebuild(&self.agents.bodies);
        }
    }

    /// Lets every agent whose turn it is look for its way, or for its spot at a stop.
    fn look(&mut self) {
        let every = (self.settings.look_s / self.options.time_step).round().max(1.0) as u64;
        let look_s = every as f32 * self.options.time_step as f32;
        let (step, looks_at_stops) = (self.step, self.settings.looks_at_stops);
        let perception = perception(&self.environment, &self.neighbours, &self.options, self.step);
        let (model, stops) = (&self.model, &self.stops);
        self.agents.for_each(|_, mut agent| {
            let looks = if agent.walk.visit.is_some() { looks_at_stops } else { 1 };
            if agent.walk.led || !(u64::from(agent.walk.id) + step).is_multiple_of((every / looks).max(1)) {
                return;
            }
            if let Some(target) = agent.walk.visit {
                stops.steer(&target, agent, &perception, look_s / looks as f32);
                return;
            }
            let against = model.turn(agent.reborrow(), &perception);
            let walk = agent.walk;
            walk.yields_s = if against { YIELDS_S } else { walk.yields_s - look_s };
            let blocked_s = if perception.is_blocked(agent.body, walk.wanted) { look_s } else { -4.0 * look_s };
            walk.blocked_s = (walk.blocked_s + blocked_s).max(0.0);
            agent.body.half_exclusion_m = 0.5 * agent.traits.exclusion_m * walk.squeeze();
        });
    }

    /// Lets every agent choose its next move; led agents are at this share of their step.
    fn choose_moves(&mut self, share: f64) {
        let perception = perception(&self.environment, &self.neighbours, &self.options, self.step);
        let (model, agents) = (&self.model, &self.agents);
        self.moves.resize_with(agents.bodies.len(), Move::default);
        in_chunks(&mut self.moves, |first, moves| model.next_moves(agents, &perception, first, moves));
        agents.move_led(share, &self.neighbours.index_of_slot, &mut self.moves);
    }

    /// Moves everybody to their corrected places; returns whether somebody has arrived.
    fn take_places(&mut self) -> bool {
        let dt = self.options.time_step as f32;
        let time_s = (self.step + 1) as f64 * self.options.time_step;
        let period = self.options.period_x.map(|p| p as f32);
        let most_speed = self.settings.most_speed;
        let places = self.collisions.correct(&self.moves, &self.neighbours, &self.environment);
        let (ground, indices) = (self.environment.ground(), &self.neighbours.index_of_slot);
        let wayfinder = Wayfinder::new(&self.environment);
        let some_arrived = AtomicBool::new(false);
        self.agents.for_each(|slot, agent| {
            let (body, walk) = (agent.body, agent.walk);
            let [x, y] = places[indices[slot] as usize];
            let (dx, dy) = (x - body.x, y - body.y);
            let (vx, vy) = (dx / dt, dy / dt);
            // Being pushed makes an agent no faster than it may walk.
            let own_speed = (body.vx * body.vx + body.vy * body.vy).sqrt();
            let most = (most_speed * agent.traits.speed_m_s).max(own_speed - CALMS_DOWN_M_S2 * dt);
            let speed = (vx * vx + vy * vy).sqrt();
            let ease = if speed > most { most / speed } else { 1.0 };
            (body.vx, body.vy) = (vx * ease, vy * ease);
            (body.x, body.y) = (x, y);
            walk.turn(body, dt);
            if let Some(period) = period
                && !(0.0..period).contains(&x)
            {
                body.x = if x < 0.0 { x + period } else { x - period };
                walk.leg = 0;
                walk.least_left_m = f32::INFINITY;
                body.clearance_m = 0.0;
            }
            // However it moved, walls have come nearer by this at most.
            body.clearance_m -= speed * dt + 1e-3;
            if body.clearance_m < OPEN_M {
                body.clearance_m = ground.clearance_at_least_m(body.position()) as f32;
            }
            walk.arrived = !walk.led
                && walk.visit.is_none()
                && wayfinder.has_arrived(walk, body.position(), speed.min(most), time_s);
            if walk.arrived {
                some_arrived.store(true, Relaxed);
            }
        });
        some_arrived.into_inner()
    }

    /// Lets those enter who are due and find room.
    fn admit(&mut self) {
        let mut admission = Admission {
            time_s: self.step as f64 * self.options.time_step,
            environment: &self.environment,
            options: &self.options,
            seed: self.seed,
            arrivals: &self.arrivals,
            agents: &mut self.agents,
            neighbours: &mut self.neighbours,
            stops: &mut self.stops,
            tally: &mut self.tally,
        };
        self.entrances.admit(&mut admission);
    }

    /// Writes everybody present into a frame, by ascending ids, onlookers left out.
    fn fill(&mut self, frame: &mut Frame) {
        frame.time_s = self.time_s();
        self.agents.slots_by_id(&mut self.by_id);
        frame.walkers.clear();
        frame.walkers.extend(self.by_id.iter().filter_map(|&slot| {
            let (body, walk) = (&self.agents.bodies[slot as usize], &self.agents.walks[slot as usize]);
            (!self.agents.is_onlooker(walk.id)).then(|| Walker {
                id: walk.id,
                position_m: body.position(),
                velocity_m_s: body.velocity(),
                heading: Some(walk.heading.into_vec()),
            })
        }));
    }
}

fn perception<'s>(
    environment: &'s Environment<'s>,
    neighbours: &'s NeighbourGrid,
    options: &CrowdOptions,
    step: u64,
) -> Perception<'s> {
    Perception {
        environment,
        neighbours,
        alignment: options.alignment as f32,
        time_s: step as f64 * options.time_step,
        dt: options.time_step as f32,
    }
}

impl Motion for Simulation<'_> {
    fn next_frame(&mut self, frame: &mut Frame) -> Result<bool, MotionError> {
        if self.is_over() {
            return Ok(false);
        }
        self.advance();
        self.fill(frame);
        self.spots.play(frame, self.frame_s, &mut self.agents, self.environment.walls);
        Ok(true)
    }

    fn share_done(&self) -> f64 {
        let gone = self.tally.arrived + self.tally.stuck.len() as u64;
        gone as f64 / self.arrivals.len().max(1) as f64
    }
}
