//! Social forces with groups: people push each other by their mere presence, and friends walk side by side.
//!
//! The interaction of strangers is that of Moussaid, Helbing, Garnier, Johansson, Combe, Theraulaz 2009 (doi
//! 10.1098/rspb.2009.0405), see [`SocialForceOptions`]; what keeps groups of two to four together is that of Moussaid,
//! Perozo, Garnier, Helbing, Theraulaz 2010 (doi 10.1371/journal.pone.0010047), see [`GroupOptions`]. Where people want to
//! go, how they come in and leave, stops, and that nobody stands in anybody else or in a wall is the same as for the other
//! model: a [`Crowd`] whose moves are chosen here.

mod control;
mod forces;
mod groups;
mod options;
mod walking;

pub use control::Present;
pub(super) use groups::Groups;
pub use options::{CrowdModel, GroupOptions, SocialForceOptions};

use std::collections::BTreeMap;
use std::ops::Range;

use rayon::prelude::*;

use super::avoidance::Sights;
use super::roll;
use super::simulation::{CHUNK, Crowd, in_chunks};
use super::state::{Body, Course, Traits};
use super::steering::Steering;
use super::walking::Move;
use super::{Arrival, CrowdError, CrowdOptions, Simulation, Stuck, Tally, Visit};
use crate::math::vec2;
use crate::motion::{Frame, Motion, MotionError, People, Walker};
use crate::plan::FloorPlan;
use crate::routes::{Navigation, Route};
use crate::walls::Walls;
use control::Lead;
use forces::Forces;
use walking::Scene;

/// Forces are worked out anew at least this often, seconds: they grow steep where people meet.
const LONGEST_STEP_S: f64 = 0.05;
/// How often people look for their way, seconds.
const LOOK_S: f64 = 0.3;
/// Whoever met somebody who came the other way does not return to their own lane for so long, seconds.
const YIELDS_S: f32 = 6.0;
/// Those who come the other way are seen up to so far ahead, metres.
const AHEAD_M: f32 = 4.0;
/// Nobody minds others of their group who are farther away than this, metres: they have lost each other.
const LOST_M: f32 = 8.0;

/// People walking along routes under social forces, alone and in groups.
pub struct SocialCrowd<'a> {
    /// Everything but the choice of moves. Its time step is a part of the one that was asked for.
    base: Crowd<'a>,
    /// Steps of the base in a step that was asked for.
    parts: u64,
    forces: Forces,
    /// For each id the slot that the person had when the step began; other ids may stand there now.
    slot_of: Vec<u32>,
    /// Whom somebody outside of the crowd moves.
    led: BTreeMap<u32, Lead>,
    /// Onlookers so far: the `k`-th has the id `arrivals + k`.
    onlookers: u32,
}

impl<'a> SocialCrowd<'a> {
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
    ) -> Result<SocialCrowd<'a>, CrowdError> {
        options.check()?;
        let navigation = Navigation::new(plan, walls, routes)?;
        SocialCrowd::with_navigation(plan, walls, routes, navigation, people, options)
    }

    /// The same with a navigation at hand, see [`Navigation::find`].
    ///
    /// # Errors
    /// As [`SocialCrowd::new`].
    pub fn with_navigation(
        plan: &'a FloorPlan,
        walls: &'a Walls,
        routes: &'a [Route],
        navigation: Navigation,
        people: &People,
        options: &CrowdOptions,
    ) -> Result<SocialCrowd<'a>, CrowdError> {
        options.check()?;
        // A hair less, so that 0.1 s are two parts and not three.
        let parts = (options.time_step / LONGEST_STEP_S - 1e-6).ceil().max(1.0);
        let fine = CrowdOptions { time_step: options.time_step / parts, ..options.clone() };
        let mut base = Crowd::with_navigation(plan, walls, routes, navigation, people, &fine)?;
        base.groups = Groups::draw(&mut base.arrivals, routes, &options.arrivals, &options.groups, people.seed());
        base.most_speed = options.social_force.most_speed as f32;
        Ok(SocialCrowd {
            base,
            parts: parts as u64,
            forces: Forces::new(&options.social_force, &options.groups),
            slot_of: Vec::new(),
            led: BTreeMap::new(),
            onlookers: 0,
        })
    }

    /// Who comes when and on which route, in the order of ids. The members of a group come together.
    pub fn arrivals(&self) -> &[Arrival] {
        &self.base.arrivals
    }

    /// What became of everybody so far.
    pub fn tally(&self) -> Tally {
        self.base.tally()
    }

    /// Who has got stuck so far.
    pub fn stuck(&self) -> &[Stuck] {
        self.base.stuck()
    }

    /// Keeps every visit of a stop that ends from now on, for [`SocialCrowd::visits`].
    pub fn keep_visits(&mut self) {
        self.base.keep_visits();
    }

    /// Every visit of a stop that ended since [`SocialCrowd::keep_visits`], in the order of their ends.
    pub fn visits(&self) -> &[Visit] {
        self.base.visits()
    }

    /// The ids of everybody in this person's group, the person included; they follow each other. Some may not have come
    /// yet, or have left.
    pub fn group_of(&self, id: u32) -> Range<u32> {
        self.base.groups.members(id)
    }

    /// Seconds since the start.
    pub fn time_s(&self) -> f64 {
        self.base.time_s()
    }

    /// How many people are present; onlookers are not counted.
    pub fn present(&self) -> usize {
        self.base.bodies.len() - self.onlookers as usize
    }

    /// Whether nobody is left to walk, or the time is up.
    pub fn is_over(&self) -> bool {
        let all_gone = self.present() == 0 && self.base.entrances.is_empty(&self.base.arrivals);
        all_gone || self.base.options.end_seconds.is_some_and(|end| self.time_s() >= end - 1e-9)
    }

    /// Goes on by one time step.
    pub fn advance(&mut self) {
        self.skip_idle_time();
        self.begin_leading();
        for part in 0..self.parts {
            self.base.neighbours.rebuild(&self.base.bodies);
            self.base.put_in_order();
            self.find_slots();
            self.base.look_after_stops();
            self.look();
            self.choose_moves((part + 1) as f64 / self.parts as f64);
            self.base.correct();
            self.base.take_places();
            self.finish_leading();
            self.base.step += 1;
            self.base.admit();
            self.base.let_go();
        }
    }

    /// With nobody present, goes on to the next arrival, by whole steps.
    fn skip_idle_time(&mut self) {
        if self.present() == 0
            && let Some(next_s) = self.base.entrances.next_arrival_s(&self.base.arrivals)
        {
            let steps = (next_s / self.base.options.time_step) as u64 / self.parts;
            self.base.step = self.base.step.max(steps * self.parts);
        }
    }

    fn find_slots(&mut self) {
        self.slot_of.resize(self.base.arrivals.len() + self.onlookers as usize, u32::MAX);
        for (slot, course) in self.base.courses.iter().enumerate() {
            self.slot_of[course.id as usize] = slot as u32;
        }
    }

    /// Everybody whose turn it is looks for the way.
    fn look(&mut self) {
        let base = &mut self.base;
        let every = (LOOK_S / base.options.time_step).round().max(1.0) as u64;
        let (step, time_s) = (base.step, base.time_s());
        let look_s = every as f32 * base.options.time_step as f32;
        let steering =
            Steering { plan: base.plan, walls: base.walls, routes: base.routes, navigation: &base.navigation };
        let sights = Sights {
            neighbours: &base.neighbours,
            ground: &base.navigation.ground,
            walls: base.walls,
            alignment: base.options.alignment as f32,
        };
        let stops = &base.stops;
        let look = |((body, course), traits): ((&mut Body, &mut Course), &Traits)| {
            if !(u64::from(course.id) + step).is_multiple_of(every) || course.led {
                return;
            }
            if let Some(errand) = course.errand {
                stops.steer(&errand, (body, course, traits), &sights, time_s, look_s);
                return;
            }
            let p = body.position();
            steering.advance(course, p, time_s);
            let last = vec2(f64::from(body.aim_x), f64::from(body.aim_y));
            let aim = steering.aim(course, traits, p, last, time_s);
            let wanted = [aim.x as f32, aim.y as f32];
            course.wanted = wanted;
            course.pace = steering.pace(course, p);
            [body.aim_x, body.aim_y] = wanted;
            course.yields_s = if meets(&sights, body) { YIELDS_S } else { course.yields_s - look_s };
            let blocked_s = if sights.is_blocked(body, wanted) { look_s } else { -4.0 * look_s };
            course.blocked_s = (course.blocked_s + blocked_s).max(0.0);
            body.half_exclusion_m = 0.5 * traits.exclusion_m * course.squeeze();
        };
        if base.bodies.len() < 2 * CHUNK {
            base.bodies.iter_mut().zip(&mut base.courses).zip(&base.traits).for_each(look);
        } else {
            let people = base.bodies.par_iter_mut().zip(&mut base.courses).zip(&base.traits);
            people.with_min_len(CHUNK).for_each(look);
        }
    }

    /// Everybody chooses the next move; who is led is at this share of the way.
    fn choose_moves(&mut self, share: f64) {
        let mut moves = std::mem::take(&mut self.base.moves);
        let base = &self.base;
        let scene = Scene {
            neighbours: &base.neighbours,
            ground: &base.navigation.ground,
            walls: base.walls,
            forces: self.forces,
            most_speed: base.most_speed,
            time_s: base.time_s(),
            dt: base.options.time_step as f32,
        };
        moves.resize_with(base.bodies.len(), Move::default);
        in_chunks(&mut moves, |start, moves| {
            for (k, next) in moves.iter_mut().enumerate() {
                let index = start + k;
                let slot = base.neighbours.slots[index] as usize;
                let course = &base.courses[slot];
                *next = match self.led.get(&course.id) {
                    Some(lead) => lead.part_way(share),
                    None => {
                        let (mates, count) = self.mates(course, &base.bodies[slot]);
                        scene.next(index, &base.traits[slot], course.pace, &mates[..count])
                    }
                };
            }
        });
        self.base.moves = moves;
    }

    /// The others of somebody's group who walk along, as indices into the sorted bodies. Whoever is at a stop, or on the
    /// way to one, is on their own.
    fn mates(&self, course: &Course, body: &Body) -> ([u32; 3], usize) {
        let (mut mates, mut count) = ([0; 3], 0);
        let members = self.base.groups.members(course.id);
        if members.len() < 2 || course.errand.is_some() {
            return (mates, count);
        }
        for id in members.filter(|&id| id != course.id) {
            let Some(slot) = self.slot(id) else { continue };
            let (other, there) = (&self.base.courses[slot], &self.base.bodies[slot]);
            let (dx, dy) = (self.base.neighbours.dx(body.x, there.x), there.y - body.y);
            let lost = dx * dx + dy * dy > LOST_M * LOST_M;
            if let Some(mate) = mates.get_mut(count)
                && other.errand.is_none()
                && !lost
            {
                *mate = self.base.neighbours.index_of_slot[slot];
                count += 1;
            }
        }
        (mates, count)
    }

    /// Where in the lists somebody is who is present.
    fn slot(&self, id: u32) -> Option<usize> {
        let slot = *self.slot_of.get(id as usize)? as usize;
        (self.base.courses.get(slot)?.id == id).then_some(slot)
    }
}

/// Whether somebody ahead comes the other way.
fn meets(sights: &Sights<'_>, me: &Body) -> bool {
    let mut found = false;
    let (cx, cy) = (me.x + 0.5 * AHEAD_M * me.aim_x, me.y + 0.5 * AHEAD_M * me.aim_y);
    sights.neighbours.around(cx, cy, |range, shift| {
        found |= sights.neighbours.bodies[range].iter().any(|body| {
            let (dx, dy) = (body.x + shift - me.x, body.y - me.y);
            let ahead = dx * me.aim_x + dy * me.aim_y > 0.05 && dx * dx + dy * dy < AHEAD_M * AHEAD_M;
            ahead && body.aim_x * me.aim_x + body.aim_y * me.aim_y < -0.7
        });
    });
    found
}

impl Motion for SocialCrowd<'_> {
    fn next_frame(&mut self, frame: &mut Frame) -> Result<bool, MotionError> {
        if self.is_over() {
            return Ok(false);
        }
        self.advance();
        frame.time_s = self.time_s();
        frame.walkers.clear();
        let mut by_id = std::mem::take(&mut self.base.by_id);
        roll::call(&self.base.courses, &mut by_id);
        frame.walkers.extend(by_id.iter().filter_map(|&slot| {
            let (body, course) = (&self.base.bodies[slot as usize], &self.base.courses[slot as usize]);
            (!self.is_onlooker(course.id)).then(|| Walker {
                id: course.id,
                position_m: body.position(),
                velocity_m_s: vec2(f64::from(body.vx), f64::from(body.vy)),
                heading: Some(course.heading.into_vec()),
            })
        }));
        self.base.by_id = by_id;
        Ok(true)
    }

    fn share_done(&self) -> f64 {
        self.base.share_done()
    }
}

impl Simulation for SocialCrowd<'_> {
    fn arrivals(&self) -> &[Arrival] {
        SocialCrowd::arrivals(self)
    }

    fn tally(&self) -> Tally {
        SocialCrowd::tally(self)
    }

    fn stuck(&self) -> &[Stuck] {
        SocialCrowd::stuck(self)
    }
}
