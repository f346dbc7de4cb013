//! Everybody present: their state, their groups, and who is led from outside of the crowd.

use std::collections::BTreeMap;
use std::ops::Range;

use rayon::prelude::*;

use super::CrowdOptions;
use super::groups::Groups;
use super::moves::Move;
use super::state::{AgentMut, BodyState, Heading, Traits, WalkState};
use crate::math::{Vec2, vec2};

/// Agents per piece of parallel work.
const CHUNK: usize = 128;
/// With more ids than this many times the agents between the first and the last of them, the ids are sorted.
const SPARSE: usize = 16;
/// Largest distance from the origin, metres, and largest speed, metres per second: single precision holds no more.
const FARTHEST_M: f64 = 1e6;

/// Whether a place or a velocity is finite and within [`FARTHEST_M`]; false for NaN.
fn is_possible(v: Vec2) -> bool {
    v.length() <= FARTHEST_M
}

/// State of an agent at the end of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AgentSnapshot {
    /// Number of the person.
    pub id: u32,
    /// Middle of the body, metres.
    pub position_m: Vec2,
    /// Velocity, metres per second.
    pub velocity_m_s: Vec2,
    /// Unit vector in which the body faces.
    pub heading: Vec2,
    /// Unit vector in which the person wants to walk.
    pub aim: Vec2,
    /// Speed at which the person walks when alone, metres per second.
    pub free_speed_m_s: f64,
    /// Radius of the body, metres: half of the distance that others keep.
    pub radius_m: f64,
    /// Index of the person's route.
    pub route: usize,
    /// Whether the person is at a stop, or on the way to one.
    pub at_stop: bool,
    /// Whether the caller leads the person, see [`Simulation::lead`](super::Simulation::lead).
    pub led: bool,
}

/// Motion of a led agent in one step.
#[derive(Clone, Copy, Debug, Default)]
struct LedMotion {
    from_m: Vec2,
    to_m: Vec2,
    velocity_m_s: Vec2,
    heading: Option<Vec2>,
}

impl LedMotion {
    /// The move to the place at this share of the step.
    fn at(&self, share: f64) -> Move {
        let to_m = self.from_m.lerp(self.to_m, share);
        Move { x: to_m.x as f32, y: to_m.y as f32, fixed: true, ..Move::default() }
    }
}

/// All agents as structure of arrays, in slots roughly in the order of the neighbours' grid.
#[derive(Debug, Default)]
pub(super) struct Agents {
    pub(super) bodies: Vec<BodyState>,
    pub(super) traits: Vec<Traits>,
    pub(super) walks: Vec<WalkState>,
    pub(super) groups: Groups,
    /// For each id the slot that the agent had when the step began; other agents may be there now.
    slot_of: Vec<u32>,
    led: BTreeMap<u32, LedMotion>,
    /// Number of people who arrive over time: the `k`-th onlooker has the id `arrivals + k`.
    arrivals: u32,
    onlookers: u32,
}

impl Agents {
    /// An empty crowd before so many arrivals.
    pub(super) fn new(arrivals: u32, groups: Groups) -> Agents {
        Agents { arrivals, groups, ..Agents::default() }
    }

    /// Number of people present, onlookers left out.
    pub(super) fn present(&self) -> usize {
        self.bodies.len() - self.onlookers as usize
    }

    pub(super) fn is_onlooker(&self, id: u32) -> bool {
        id >= self.arrivals
    }

    /// Calls `work` with every agent and its slot, in parallel if there are many.
    pub(super) fn for_each(&mut self, work: impl Fn(usize, AgentMut<'_>) + Sync + Send) {
        let work = |(slot, ((body, walk), traits)): (usize, ((&mut BodyState, &mut WalkState), &Traits))| {
            work(slot, AgentMut { body, walk, traits });
        };
        if self.bodies.len() < 2 * CHUNK {
            self.bodies.iter_mut().zip(&mut self.walks).zip(&self.traits).enumerate().for_each(work);
        } else {
            let agents = self.bodies.par_iter_mut().zip(&mut self.walks).zip(&self.traits).enumerate();
            agents.with_min_len(CHUNK).for_each(work);
        }
    }

    /// Puts the agents into the order of these slots.
    pub(super) fn reorder(&mut self, bodies: &[BodyState], slots: &[u32]) {
        self.bodies.clear();
        self.bodies.extend_from_slice(bodies);
        self.traits = slots.iter().map(|&slot| self.traits[slot as usize]).collect();
        self.walks = slots.iter().map(|&slot| self.walks[slot as usize]).collect();
    }

    /// Keeps the agents in the slots that `keep` marks.
    pub(super) fn retain(&mut self, keep: &[bool]) {
        retain(&mut self.bodies, keep);
        retain(&mut self.traits, keep);
        retain(&mut self.walks, keep);
    }

    /// Notes every agent's slot, for [`Agents::slot`].
    pub(super) fn note_slots(&mut self) {
        self.slot_of.resize((self.arrivals + self.onlookers) as usize, u32::MAX);
        for (slot, walk) in self.walks.iter().enumerate() {
            self.slot_of[walk.id as usize] = slot as u32;
        }
    }

    /// The slot of an agent that was present when the step began and still is.
    pub(super) fn slot(&self, id: u32) -> Option<usize> {
        let slot = *self.slot_of.get(id as usize)? as usize;
        (self.walks.get(slot)?.id == id).then_some(slot)
    }

    /// Fills `slots` with the slots of all agents in the order of ids.
    pub(super) fn slots_by_id(&self, slots: &mut Vec<u32>) {
        let ids = || self.walks.iter().map(|walk| walk.id);
        let (first, last) = (ids().min().unwrap_or(0), ids().max().unwrap_or(0));
        let range = (last - first) as usize + 1;
        slots.clear();
        if range > SPARSE * (self.walks.len() + 1) {
            slots.extend(0..self.walks.len() as u32);
            slots.sort_unstable_by_key(|&slot| self.walks[slot as usize].id);
            return;
        }
        // Ids follow arrivals, so that those present lie close together: one place for each.
        slots.resize(range, u32::MAX);
        for (slot, id) in ids().enumerate() {
            slots[(id - first) as usize] = slot as u32;
        }
        slots.retain(|&slot| slot != u32::MAX);
    }

    /// Snapshots of all people, onlookers left out, in the order of slots.
    pub(super) fn snapshots(&self) -> impl Iterator<Item = AgentSnapshot> + '_ {
        (0..self.walks.len()).map(|slot| self.snapshot(slot)).filter(|agent| !self.is_onlooker(agent.id))
    }

    /// Snapshot of one agent, onlookers included.
    pub(super) fn get(&self, id: u32) -> Option<AgentSnapshot> {
        let slot = self.slot(id).or_else(|| self.walks.iter().position(|walk| walk.id == id))?;
        Some(self.snapshot(slot))
    }

    fn snapshot(&self, slot: usize) -> AgentSnapshot {
        let (body, walk, traits) = (&self.bodies[slot], &self.walks[slot], &self.traits[slot]);
        AgentSnapshot {
            id: walk.id,
            position_m: body.position(),
            velocity_m_s: body.velocity(),
            heading: walk.heading.into_vec(),
            aim: body.aim(),
            free_speed_m_s: f64::from(traits.speed_m_s),
            radius_m: f64::from(body.half_exclusion_m),
            route: walk.route as usize,
            at_stop: walk.visit.is_some(),
            led: walk.led,
        }
    }

    /// Ids of everybody in a person's group, the person included.
    pub(super) fn group_of(&self, id: u32) -> Range<u32> {
        self.groups.members(id)
    }

    /// Leads an agent in the next step, see [`Simulation::lead`](super::Simulation::lead).
    pub(super) fn lead(&mut self, id: u32, to_m: Vec2, velocity_m_s: Vec2, heading: Option<Vec2>) -> bool {
        let possible = is_possible(to_m) && is_possible(velocity_m_s) && heading.is_none_or(is_possible);
        let found = self.walks.iter().position(|walk| walk.id == id);
        let Some(slot) = found.filter(|_| possible) else { return false };
        self.walks[slot].led = true;
        let heading = heading.and_then(Vec2::normalized);
        let from_m = self.bodies[slot].position();
        self.led.insert(id, LedMotion { from_m, to_m, velocity_m_s, heading });
        true
    }

    /// The slots of those who are led, onlookers included, in the order of ids.
    pub(super) fn led_slots(&self) -> impl Iterator<Item = usize> + '_ {
        self.led.keys().filter_map(|&id| self.slot(id))
    }

    /// Lets a led agent walk on by the model, see [`Simulation::release`](super::Simulation::release).
    pub(super) fn release(&mut self, id: u32, time_s: f64) -> bool {
        if self.is_onlooker(id) || self.led.remove(&id).is_none() {
            return false;
        }
        let Some(slot) = self.walks.iter().position(|walk| walk.id == id) else { return false };
        let walk = &mut self.walks[slot];
        walk.led = false;
        walk.least_left_m = f32::INFINITY;
        walk.improved_s = time_s;
        walk.blocked_s = 0.0;
        walk.looks = 1;
        self.bodies[slot].clearance_m = 0.0;
        true
    }

    /// Adds an onlooker, see [`Simulation::stand`](super::Simulation::stand).
    pub(super) fn stand(&mut self, at_m: Vec2, radius_m: f64, seed: u64, options: &CrowdOptions) -> Option<u32> {
        if !is_possible(at_m) || !(0.05..=5.0).contains(&radius_m) {
            return None;
        }
        let id = self.arrivals + self.onlookers;
        self.onlookers += 1;
        self.bodies.push(BodyState {
            x: at_m.x as f32,
            y: at_m.y as f32,
            aim_x: 1.0,
            half_exclusion_m: radius_m as f32,
            ..BodyState::default()
        });
        let mut traits = Traits::draw(seed, id, options);
        traits.exclusion_m = 2.0 * radius_m as f32;
        self.traits.push(traits);
        self.walks.push(WalkState { led: true, pace: 0.0, ..WalkState::new(id, Heading::new(1.0, 0.0)) });
        self.lead(id, at_m, Vec2::ZERO, Some(vec2(1.0, 0.0)));
        Some(id)
    }

    /// Notes before a step from where led agents set out, and forgets those who have left.
    pub(super) fn begin_leading(&mut self) {
        if self.led.is_empty() {
            return;
        }
        let mut present = Vec::with_capacity(self.led.len());
        for (body, walk) in self.bodies.iter().zip(&self.walks) {
            if let Some(led) = self.led.get_mut(&walk.id) {
                led.from_m = body.position();
                present.push(walk.id);
            }
        }
        present.sort_unstable();
        self.led.retain(|id, _| present.binary_search(id).is_ok());
    }

    /// Replaces the moves of led agents: by now they are at this share of the step.
    pub(super) fn move_led(&self, share: f64, index_of_slot: &[u32], moves: &mut [Move]) {
        if self.led.is_empty() {
            return;
        }
        for (walk, &index) in self.walks.iter().zip(index_of_slot) {
            if let Some(led) = self.led.get(&walk.id) {
                moves[index as usize] = led.at(share);
            }
        }
    }

    /// Gives led agents, once moved, the velocity and the heading that they were told.
    pub(super) fn finish_leading(&mut self, time_s: f64) {
        if self.led.is_empty() {
            return;
        }
        for (body, walk) in self.bodies.iter_mut().zip(&mut self.walks) {
            let Some(led) = self.led.get(&walk.id) else { continue };
            (body.vx, body.vy) = (led.velocity_m_s.x as f32, led.velocity_m_s.y as f32);
            if let Some(heading) = led.heading {
                walk.heading = Heading::new(heading.x as f32, heading.y as f32);
            }
            if let Some(aim) = led.velocity_m_s.normalized().or(led.heading) {
                [body.aim_x, body.aim_y] = [aim.x as f32, aim.y as f32];
            }
            walk.improved_s = time_s;
        }
    }
}

fn retain<T>(items: &mut Vec<T>, keep: &[bool]) {
    let mut keep = keep.iter();
    items.retain(|_| keep.next().copied().unwrap_or(true));
}

/// Runs `work` on pieces of a slice, in parallel if it is long, with the index at which each piece begins.
pub(super) fn in_chunks<T: Send>(items: &mut [T], work: impl Fn(usize, &mut [T]) + Sync) {
    if items.len() < 2 * CHUNK {
        work(0, items);
    } else {
        items.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, items)| work(chunk * CHUNK, items));
    }
}
