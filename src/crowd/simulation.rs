use rayon::prelude::*;

use super::arrivals::{self, Arrival};
use super::avoidance::Sights;
use super::entrances::Entrances;
use super::neighbours::Neighbours;
use super::options::SpeedTable;
use super::state::{Body, Course, Traits};
use super::steering::Steering;
use super::surroundings::{SENSE_M, Surroundings};
use super::walking::{Move, Scene, Seen, off_walls};
use super::{CrowdError, CrowdOptions};
use crate::Error;
use crate::math::{Rect, Vec2, vec2};
use crate::motion::{Frame, Motion, People, Walker};
use crate::plan::FloorPlan;
use crate::routes::{Navigation, Route};
use crate::walls::{APRON_M, Walls};

/// How often people look for their way, seconds.
const LOOK_S: f64 = 0.4;
/// Rounds of moving bodies apart and out of walls in each step.
const CORRECTIONS: usize = 4;
/// Bodies per piece of parallel work.
const CHUNK: usize = 128;
/// Without any way made for so many times the patience, somebody is stuck even while others arrive.
const PATIENCE_LIMIT: f64 = 5.0;
/// How often the crowd looks for stuck people, seconds.
const STUCK_CHECK_S: f64 = 1.0;

/// People walking along routes, step by step.
pub struct Crowd<'a> {
    plan: &'a FloorPlan,
    walls: &'a Walls,
    routes: &'a [Route],
    navigation: Navigation,
    options: CrowdOptions,
    seed: u64,
    arrivals: Vec<Arrival>,
    entrances: Entrances,
    speeds: SpeedTable,
    surroundings: Surroundings,
    /// Everybody present by ascending id: bodies, traits, courses.
    pub(super) bodies: Vec<Body>,
    pub(super) traits: Vec<Traits>,
    pub(super) courses: Vec<Course>,
    pub(super) neighbours: Neighbours,
    moves: Vec<Move>,
    /// Corrected places in the order of the neighbours' grid, and the next round's.
    places: [Vec<[f32; 2]>; 2],
    step: u64,
    last_arrived_s: Vec<f64>,
    tally: Tally,
}

/// What became of everybody.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// How many entered.
    pub entered: u64,
    /// How many reached their goal.
    pub arrived: u64,
    /// Who made no way any more and was taken out.
    pub stuck: Vec<Stuck>,
}

/// Somebody who made no way any more.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Stuck {
    /// Who.
    pub id: u32,
    /// Where, metres.
    pub place_m: Vec2,
    /// Index of the route.
    pub route: usize,
}

impl Stuck {
    /// Says who and where.
    pub fn describe(&self, routes: &[Route]) -> String {
        let route = routes.get(self.route).map_or("unknown", |route| &route.name);
        format!("person {} of route \"{route}\" got stuck at [{:.2}, {:.2}]", self.id, self.place_m.x, self.place_m.y)
    }
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
            step: 0,
            last_arrived_s: vec![0.0; routes.len()],
            tally: Tally::default(),
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
        self.tally.clone()
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

    fn steering(&self) -> Steering<'_> {
        Steering { plan: self.plan, walls: self.walls, routes: self.routes, navigation: &self.navigation }
    }

    /// Everybody whose turn it is looks for the way.
    fn look(&mut self) {
        let every = (LOOK_S / self.options.time_step).round().max(1.0) as u64;
        let (step, time_s) = (self.step, self.time_s());
        let look_s = every as f32 * self.options.time_step as f32;
        let steering =
            Steering { plan: self.plan, walls: self.walls, routes: self.routes, navigation: &self.navigation };
        let sights = Sights { neighbours: &self.neighbours, ground: &self.navigation.ground, walls: self.walls };
        let look = |((body, course), traits): ((&mut Body, &mut Course), &Traits)| {
            if !(u64::from(course.id) + step).is_multiple_of(every) {
                return;
            }
            let p = body.position();
            steering.advance(course, p, time_s);
            let last = vec2(f64::from(body.aim_x), f64::from(body.aim_y));
            let aim = steering.aim(course, traits, p, last, time_s);
            let wanted = [aim.x as f32, aim.y as f32];
            [body.aim_x, body.aim_y] = sights.heading(body, traits, wanted, [body.aim_x, body.aim_y]);
            course.pace = steering.pace(course, p);
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

    /// Moves bodies apart where they overlap, and out of walls, which have the last word.
    fn correct(&mut self) {
        let [now, next] = &mut self.places;
        now.clear();
        now.extend(self.moves.iter().map(|m| [m.x, m.y]));
        next.resize(now.len(), [0.0; 2]);
        let (moves, neighbours) = (&self.moves, &self.neighbours);
        let (ground, walls) = (&self.navigation.ground, self.walls);
        for _ in 0..CORRECTIONS {
            let before: &[[f32; 2]] = now;
            in_chunks(next, |start, places| {
                for (k, place) in places.iter_mut().enumerate() {
                    let index = start + k;
                    let from = neighbours.bodies[index].position();
                    let pushed = apart(index, &moves[index], before, neighbours);
                    let to = vec2(f64::from(pushed[0]), f64::from(pushed[1]));
                    let free = off_walls(ground, walls, from, to, f64::from(moves[index].wall_limit_m));
                    *place = [free.x as f32, free.y as f32];
                }
            });
            std::mem::swap(now, next);
        }
    }

    /// Takes up the corrected places.
    fn take_places(&mut self) {
        let dt = self.options.time_step as f32;
        let period = self.options.period_x.map(|p| p as f32);
        let ground = &self.navigation.ground;
        for (index, &slot) in self.neighbours.slots.iter().enumerate() {
            let body = &mut self.bodies[slot as usize];
            let [x, y] = self.places[0][index];
            let (vx, vy) = ((x - body.x) / dt, (y - body.y) / dt);
            // Being pushed makes nobody run.
            let most = 1.1 * self.traits[slot as usize].speed_m_s;
            let speed = (vx * vx + vy * vy).sqrt();
            let ease = if speed > most { most / speed } else { 1.0 };
            (body.vx, body.vy) = (vx * ease, vy * ease);
            (body.x, body.y) = (x, y);
            if let Some(period) = period
                && !(0.0..period).contains(&x)
            {
                body.x = if x < 0.0 { x + period } else { x - period };
                let course = &mut self.courses[slot as usize];
                course.gate = 0;
                course.least_left_m = f32::INFINITY;
            }
            body.clearance_m = ground.clearance_at_least_m(body.position()) as f32;
        }
    }

    /// Lets those enter who are due and find room.
    fn admit(&mut self) {
        let time_s = self.time_s();
        let mut entrances = std::mem::take(&mut self.entrances);
        entrances.admit(self, time_s);
        self.entrances = entrances;
    }

    /// Takes out those who have arrived, and those who are stuck.
    fn let_go(&mut self) {
        let time_s = self.time_s();
        let patience_s = self.options.patience_seconds;
        let check_steps = (STUCK_CHECK_S / self.options.time_step).round().max(1.0) as u64;
        let check_stuck = self.step.is_multiple_of(check_steps);
        let mut keep = vec![true; 0];
        let steering = self.steering();
        let mut arrived = Vec::new();
        let mut stuck = Vec::new();
        for (body, course) in self.bodies.iter().zip(&self.courses) {
            let route = course.route as usize;
            let speed = (body.vx * body.vx + body.vy * body.vy).sqrt();
            let idle_s = time_s - course.improved_s;
            let mut stays = true;
            if steering.has_arrived(course, body.position(), speed, time_s) {
                arrived.push(route);
                stays = false;
            } else if check_stuck && idle_s > patience_s {
                let others_wait_too = time_s - self.last_arrived_s[route] > patience_s;
                if others_wait_too || idle_s > PATIENCE_LIMIT * patience_s {
                    stuck.push(Stuck { id: course.id, place_m: body.position(), route });
                    stays = false;
                }
            }
            keep.push(stays);
        }
        if arrived.is_empty() && stuck.is_empty() {
            return;
        }
        for route in arrived {
            self.tally.arrived += 1;
            self.last_arrived_s[route] = time_s;
        }
        self.tally.stuck.extend(stuck);
        retain(&mut self.bodies, &keep);
        retain(&mut self.traits, &keep);
        retain(&mut self.courses, &keep);
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
            tally: &mut self.tally,
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
    pub(super) tally: &'s mut Tally,
}

impl Motion for Crowd<'_> {
    fn next_frame(&mut self, frame: &mut Frame) -> Result<bool, Error> {
        if self.is_over() {
            return Ok(false);
        }
        self.advance();
        frame.time_s = self.time_s();
        frame.walkers.clear();
        frame.walkers.extend(self.bodies.iter().zip(&self.courses).map(|(body, course)| Walker {
            id: course.id,
            position_m: body.position(),
            velocity_m_s: vec2(f64::from(body.vx), f64::from(body.vy)),
        }));
        Ok(true)
    }

    fn share_done(&self) -> f64 {
        let gone = self.tally.arrived + self.tally.stuck.len() as u64;
        gone as f64 / self.arrivals.len().max(1) as f64
    }
}

/// The place of a body after it and its neighbours have each given half of their overlap.
fn apart(index: usize, own: &Move, places: &[[f32; 2]], neighbours: &Neighbours) -> [f32; 2] {
    let [x, y] = places[index];
    let half_m = neighbours.bodies[index].half_exclusion_m;
    let (mut px, mut py, mut count) = (0.0f32, 0.0f32, 0.0f32);
    for &other in &own.contacts[..own.contact_count as usize] {
        let other = other as usize;
        let [ox, oy] = places[other];
        let (dx, dy) = (neighbours.dx(x, ox), oy - y);
        let exclusion_m = half_m + neighbours.bodies[other].half_exclusion_m;
        let d2 = dx * dx + dy * dy;
        if d2 >= exclusion_m * exclusion_m {
            continue;
        }
        let d = d2.sqrt();
        // Two in one place part along x, the first one to the left.
        let (nx, ny) = if d > 1e-5 { (dx / d, dy / d) } else { (if index < other { 1.0 } else { -1.0 }, 0.0) };
        let push = 0.5 * (exclusion_m - d);
        px -= push * nx;
        py -= push * ny;
        count += 1.0;
    }
    if count == 0.0 {
        return [x, y];
    }
    // Several pushes at once overshoot: in part they say the same.
    let ease = 1.1 / (0.6 + 0.4 * count).max(1.0);
    [x + px * ease, y + py * ease]
}

/// Runs `work` on pieces of a slice, side by side if there are enough, with the index at which each begins.
fn in_chunks<T: Send>(items: &mut [T], work: impl Fn(usize, &mut [T]) + Sync) {
    if items.len() < 2 * CHUNK {
        work(0, items);
    } else {
        items.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, items)| work(chunk * CHUNK, items));
    }
}

fn retain<T>(items: &mut Vec<T>, keep: &[bool]) {
    let mut keep = keep.iter();
    items.retain(|_| keep.next().copied().unwrap_or(true));
}
