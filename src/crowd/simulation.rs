use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering::Relaxed;

use rayon::prelude::*;

use super::arrivals::{self, Arrival};
use super::avoidance::Sights;
use super::entrances::Entrances;
use super::neighbours::Neighbours;
use super::options::SpeedTable;
use super::roll;
use super::seen::Seen;
use super::social_force::Groups;
use super::state::{Body, Course, Traits};
use super::steering::Steering;
use super::stops::{Stops, Surface, Visit};
use super::surroundings::{OPEN_M, SENSE_M, Surroundings};
use super::tally::{Tally, Trail};
use super::walking::{CALMS_DOWN_M_S2, Move, Scene};
use super::{CrowdError, CrowdOptions, Stuck};
use crate::math::{Rect, Vec2, vec2};
use crate::motion::{Frame, Motion, MotionError, People, Walker};
use crate::plan::FloorPlan;
use crate::routes::{Navigation, Route};
use crate::walls::{APRON_M, Walls};

mod correcting;
mod leaving;

/// How often people look for their way, seconds.
const LOOK_S: f64 = 0.5;
/// With no wall nearer than this, metres, ...
const OPEN_GROUND_M: f32 = 1.2;
/// ... people look for their way only every so many times that they look out for others.
const OPEN_GROUND_LOOKS: u8 = 2;
/// Whoever met somebody who came the other way does not return to their own lane for so long, seconds.
const YIELDS_S: f32 = 6.0;
/// Steps after which everybody is put in the order of the grid.
const ORDER_STEPS: u64 = 16;
/// Nobody is moved faster than so many times their own speed.
const MOST_SPEED: f32 = 1.1;
/// Bodies per piece of parallel work.
pub(super) const CHUNK: usize = 128;

/// People walking along routes, step by step.
pub struct Crowd<'a> {
    pub(super) plan: &'a FloorPlan,
    pub(super) walls: &'a Walls,
    pub(super) routes: &'a [Route],
    pub(super) navigation: Navigation,
    pub(super) options: CrowdOptions,
    pub(super) seed: u64,
    pub(super) arrivals: Vec<Arrival>,
    pub(super) entrances: Entrances,
    pub(super) speeds: SpeedTable,
    pub(super) surroundings: Surroundings,
    /// Everybody present: bodies, traits, courses, roughly in the order of the grid.
    pub(super) bodies: Vec<Body>,
    pub(super) traits: Vec<Traits>,
    pub(super) courses: Vec<Course>,
    pub(super) neighbours: Neighbours,
    pub(super) moves: Vec<Move>,
    /// Corrected places in the order of the neighbours' grid, and the next round's.
    pub(super) places: [Vec<[f32; 2]>; 2],
    /// Slots in the order of ids, made anew for every frame.
    pub(super) by_id: Vec<u32>,
    pub(super) step: u64,
    /// Whether somebody arrived in this step.
    pub(super) some_arrived: bool,
    /// For each route, who went before.
    pub(super) trails: Vec<Trail>,
    pub(super) stops: Stops,
    pub(super) tally: Tally,
    /// Who walks with whom.
    pub(super) groups: Groups,
    /// Being pushed moves nobody faster than so many times their own speed.
    pub(super) most_speed: f32,
}

impl<'a> Crowd<'a> {
    /// A crowd that has not entered yet.
    ///
    /// # Errors
    /// Options out of range, no routes, routes that do not belong to the plan.
    pub fn new(
        plan: &'a FloorPlan,
        walls: &'a Walls,
        routes: &'a [Route],
        people: &People,
        options: &CrowdOptions,
    ) -> Result<Crowd<'a>, CrowdError> {
        options.check()?;
        let navigation = Navigation::new(plan, walls, routes)?;
        Crowd::with_navigation(plan, walls, routes, navigation, people, options)
    }

    /// The same with a navigation at hand, see [`Navigation::find`].
    ///
    /// # Errors
    /// As [`Crowd::new`].
    pub fn with_navigation(
        plan: &'a FloorPlan,
        walls: &'a Walls,
        routes: &'a [Route],
        navigation: Navigation,
        people: &People,
        options: &CrowdOptions,
    ) -> Result<Crowd<'a>, CrowdError> {
        options.check()?;
        if routes.is_empty() {
            return Err(CrowdError::NoRoutes);
        }
        let seed = people.seed();
        let surface = Surface { plan, walls, ground: &navigation.ground };
        let keep_m = options.wall_exclusion.bounds()[1] + 0.02;
        let area = Rect { min: Vec2::ZERO, max: vec2(plan.width_m(), plan.height_m()) }.grown(APRON_M);
        Ok(Crowd {
            arrivals: arrivals::list(plan, routes, seed, options),
            entrances: Entrances::new(routes),
            speeds: SpeedTable::new(options.speed_law),
            surroundings: Surroundings::new(&navigation.ground, walls),
            neighbours: Neighbours::new(area, SENSE_M as f32, options.period_x.map(|p| p as f32)),
            bodies: Vec::new(),
            traits: Vec::new(),
            courses: Vec::new(),
            moves: Vec::new(),
            places: [Vec::new(), Vec::new()],
            by_id: Vec::new(),
            step: 0,
            some_arrived: false,
            trails: vec![Trail::default(); routes.len()],
            stops: Stops::new(surface, routes, &navigation, keep_m),
            tally: Tally::default(),
            groups: Groups::default(),
            most_speed: MOST_SPEED,
            plan,
            walls,
            routes,
            navigation,
            options: options.clone(),
            seed,
        })
    }

    /// Who comes when and on which route, in the order of ids.
    pub fn arrivals(&self) -> &[Arrival] {
        &self.arrivals
    }

    /// What became of everybody so far.
    pub fn tally(&self) -> Tally {
        Tally { stops: self.stops.tally(), ..self.tally.clone() }
    }

    /// Keeps every visit of a stop that ends from now on, for [`Crowd::visits`]: memory grows with them.
    pub fn keep_visits(&mut self) {
        self.stops.keep_visits();
    }

    /// Every visit of a stop that ended since [`Crowd::keep_visits`], in the order of their ends.
    pub fn visits(&self) -> &[Visit] {
        self.stops.visits()
    }

    /// Who has got stuck so far.
    pub fn stuck(&self) -> &[Stuck] {
        &self.tally.stuck
    }

    /// Seconds since the start.
    pub fn time_s(&self) -> f64 {
        self.step as f64 * self.options.time_step
    }

    /// How many people are present.
    pub fn present(&self) -> usize {
        self.bodies.len()
    }

    /// Whether nobody is left to walk, or the time is up.
    pub fn is_over(&self) -> bool {
        let all_gone = self.bodies.is_empty() && self.entrances.is_empty(&self.arrivals);
        all_gone || self.options.end_seconds.is_some_and(|end| self.time_s() >= end)
    }

    /// Goes on by one time step.
    pub fn advance(&mut self) {
        self.skip_idle_time();
        self.neighbours.rebuild(&self.bodies);
        self.put_in_order();
        self.look_after_stops();
        self.look();
        self.choose_moves();
        self.correct();
        self.take_places();
        self.step += 1;
        self.admit();
        self.let_go();
    }

    /// With nobody present, goes on to the next arrival.
    fn skip_idle_time(&mut self) {
        if self.bodies.is_empty()
            && let Some(next_s) = self.entrances.next_arrival_s(&self.arrivals)
        {
            self.step = self.step.max((next_s / self.options.time_step) as u64);
        }
    }

    /// Now and then, puts everybody in the order of the grid, so that who is near in space is near in memory.
    pub(super) fn put_in_order(&mut self) {
        if !self.step.is_multiple_of(ORDER_STEPS) {
            return;
        }
        let slots = &self.neighbours.slots;
        self.bodies.clone_from(&self.neighbours.bodies);
        self.traits = slots.iter().map(|&slot| self.traits[slot as usize]).collect();
        self.courses = slots.iter().map(|&slot| self.courses[slot as usize]).collect();
        self.neighbours.rebuild(&self.bodies);
    }

    /// Serves whoever is at a stop.
    pub(super) fn look_after_stops(&mut self) {
        let surface = Surface { plan: self.plan, walls: self.walls, ground: &self.navigation.ground };
        let clock = (self.step, self.options.time_step);
        self.stops.update(clock, surface, &self.navigation, &self.bodies, &mut self.courses);
    }

    /// Everybody whose turn it is looks for the way.
    fn look(&mut self) {
        let every = (LOOK_S / self.options.time_step).round().max(1.0) as u64;
        let (step, time_s) = (self.step, self.time_s());
        let look_s = every as f32 * self.options.time_step as f32;
        let steering =
            Steering { plan: self.plan, walls: self.walls, routes: self.routes, navigation: &self.navigation };
        let sights = Sights {
            neighbours: &self.neighbours,
            ground: &self.navigation.ground,
            walls: self.walls,
            alignment: self.options.alignment as f32,
        };
        let stops = &self.stops;
        let look = |((body, course), traits): ((&mut Body, &mut Course), &Traits)| {
            // Who stands or queues keeps to the spot more closely than who walks to the way.
            let halves = if course.errand.is_some() { 2 } else { 1 };
            if !(u64::from(course.id) + step).is_multiple_of((every / halves).max(1)) {
                return;
            }
            if let Some(errand) = course.errand {
                stops.steer(&errand, (body, course, traits), &sights, time_s, look_s / halves as f32);
                return;
            }
            course.looks = course.looks.wrapping_add(1);
            if body.clearance_m < OPEN_GROUND_M || course.looks.is_multiple_of(OPEN_GROUND_LOOKS) {
                let p = body.position();
                steering.advance(course, p, time_s);
                let last = vec2(f64::from(body.aim_x), f64::from(body.aim_y));
                let aim = steering.aim(course, traits, p, last, time_s);
                course.wanted = [aim.x as f32, aim.y as f32];
                course.pace = steering.pace(course, p);
            }
            let wanted = course.wanted;
            let detour = sights.detour(body, traits.speed_m_s, wanted);
            [body.aim_x, body.aim_y] = detour.turn(wanted, [body.aim_x, body.aim_y]);
            course.yields_s = if detour.against { YIELDS_S } else { course.yields_s - look_s };
            let blocked_s = if sights.is_blocked(body, wanted) { look_s } else { -4.0 * look_s };
            course.blocked_s = (course.blocked_s + blocked_s).max(0.0);
            body.half_exclusion_m = 0.5 * traits.exclusion_m * course.squeeze();
        };
        if self.bodies.len() < 2 * CHUNK {
            self.bodies.iter_mut().zip(&mut self.courses).zip(&self.traits).for_each(look);
        } else {
            let people = self.bodies.par_iter_mut().zip(&mut self.courses).zip(&self.traits);
            people.with_min_len(CHUNK).for_each(look);
        }
    }

    /// Everybody chooses the next move.
    fn choose_moves(&mut self) {
        let scene = Scene {
            neighbours: &self.neighbours,
            surroundings: &self.surroundings,
            ground: &self.navigation.ground,
            walls: self.walls,
            speeds: &self.speeds,
            alignment: self.options.alignment as f32,
            dt: self.options.time_step as f32,
        };
        let (traits, courses) = (&self.traits, &self.courses);
        let slots = &self.neighbours.slots;
        self.moves.resize_with(self.bodies.len(), Move::default);
        in_chunks(&mut self.moves, |start, moves| {
            let mut seen = Seen::default();
            for (k, next) in moves.iter_mut().enumerate() {
                let index = start + k;
                let slot = slots[index] as usize;
                *next = scene.next(index, &traits[slot], courses[slot].pace, &mut seen);
            }
        });
    }

    /// Takes up the corrected places, and notes who has arrived.
    pub(super) fn take_places(&mut self) {
        let dt = self.options.time_step as f32;
        let time_s = (self.step + 1) as f64 * self.options.time_step;
        let period = self.options.period_x.map(|p| p as f32);
        let most_speed = self.most_speed;
        let steering =
            Steering { plan: self.plan, walls: self.walls, routes: self.routes, navigation: &self.navigation };
        let ground = &self.navigation.ground;
        let places = &self.places[0];
        let some_arrived = AtomicBool::new(false);
        let take = |(((body, course), traits), &index): (((&mut Body, &mut Course), &Traits), &u32)| {
            let [x, y] = places[index as usize];
            let (dx, dy) = (x - body.x, y - body.y);
            let (vx, vy) = (dx / dt, dy / dt);
            // Being pushed makes nobody run.
            let own_speed = (body.vx * body.vx + body.vy * body.vy).sqrt();
            let most = (most_speed * traits.speed_m_s).max(own_speed - CALMS_DOWN_M_S2 * dt);
            let speed = (vx * vx + vy * vy).sqrt();
            let ease = if speed > most { most / speed } else { 1.0 };
            (body.vx, body.vy) = (vx * ease, vy * ease);
            (body.x, body.y) = (x, y);
            course.turn(body, dt);
            if let Some(period) = period
                && !(0.0..period).contains(&x)
            {
                body.x = if x < 0.0 { x + period } else { x - period };
                course.leg = 0;
                course.least_left_m = f32::INFINITY;
                body.clearance_m = 0.0;
            }
            // However it moved, no wall has come nearer than this.
            body.clearance_m -= speed * dt + 1e-3;
            if body.clearance_m < OPEN_M {
                body.clearance_m = ground.clearance_at_least_m(body.position()) as f32;
            }
            course.arrived = !course.led
                && course.errand.is_none()
                && steering.has_arrived(course, body.position(), speed.min(most), time_s);
            if course.arrived {
                some_arrived.store(true, Relaxed);
            }
        };
        let mut bodies = std::mem::take(&mut self.bodies);
        let mut courses = std::mem::take(&mut self.courses);
        let (traits, indices) = (&self.traits, &self.neighbours.index_of_slot);
        if bodies.len() < 2 * CHUNK {
            bodies.iter_mut().zip(&mut courses).zip(traits).zip(indices).for_each(take);
        } else {
            let people = bodies.par_iter_mut().zip(&mut courses).zip(traits).zip(indices);
            people.with_min_len(CHUNK).for_each(take);
        }
        (self.bodies, self.courses) = (bodies, courses);
        self.some_arrived = some_arrived.into_inner();
    }

    /// Lets those enter who are due and find room.
    pub(super) fn admit(&mut self) {
        let time_s = self.time_s();
        let mut entrances = std::mem::take(&mut self.entrances);
        entrances.admit(self, time_s);
        self.entrances = entrances;
    }

    pub(super) fn parts(&mut self) -> Parts<'_, 'a> {
        Parts {
            steering: Steering {
                plan: self.plan,
                walls: self.walls,
                routes: self.routes,
                navigation: &self.navigation,
            },
            plan: self.plan,
            options: &self.options,
            seed: self.seed,
            arrivals: &self.arrivals,
            bodies: &mut self.bodies,
            traits: &mut self.traits,
            courses: &mut self.courses,
            neighbours: &self.neighbours,
            stops: &mut self.stops,
            tally: &mut self.tally,
            groups: &self.groups,
        }
    }
}

/// What entrances work on.
pub(super) struct Parts<'s, 'a> {
    pub(super) steering: Steering<'s>,
    pub(super) plan: &'a FloorPlan,
    pub(super) options: &'s CrowdOptions,
    pub(super) seed: u64,
    pub(super) arrivals: &'s [Arrival],
    pub(super) bodies: &'s mut Vec<Body>,
    pub(super) traits: &'s mut Vec<Traits>,
    pub(super) courses: &'s mut Vec<Course>,
    pub(super) neighbours: &'s Neighbours,
    pub(super) stops: &'s mut Stops,
    pub(super) tally: &'s mut Tally,
    pub(super) groups: &'s Groups,
}

impl Motion for Crowd<'_> {
    fn next_frame(&mut self, frame: &mut Frame) -> Result<bool, MotionError> {
        if self.is_over() {
            return Ok(false);
        }
        self.advance();
        frame.time_s = self.time_s();
        roll::call(&self.courses, &mut self.by_id);
        frame.walkers.clear();
        frame.walkers.extend(self.by_id.iter().map(|&slot| {
            let (body, course) = (&self.bodies[slot as usize], &self.courses[slot as usize]);
            Walker {
                id: course.id,
                position_m: body.position(),
                velocity_m_s: vec2(f64::from(body.vx), f64::from(body.vy)),
                heading: Some(course.heading.into_vec()),
            }
        }));
        Ok(true)
    }

    fn share_done(&self) -> f64 {
        let gone = self.tally.arrived + self.tally.stuck.len() as u64;
        gone as f64 / self.arrivals.len().max(1) as f64
    }
}

/// Runs `work` on pieces of a slice, side by side if there are enough, with the index at which each begins.
pub(super) fn in_chunks<T: Send>(items: &mut [T], work: impl Fn(usize, &mut [T]) + Sync) {
    if items.len() < 2 * CHUNK {
        work(0, items);
    } else {
        items.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, items)| work(chunk * CHUNK, items));
    }
}
