use super::target::{ApproachMode, VisitTarget};
use crate::crowd::agents::Agents;
use crate::crowd::environment::Environment;
use crate::crowd::state::WalkState;
use crate::math::Vec2;

/// All agents as an update of the stops sees and changes them.
pub(super) struct StopsUpdate<'a> {
    /// Time since the start, seconds.
    pub(super) time_s: f64,
    pub(super) environment: &'a Environment<'a>,
    pub(super) agents: &'a mut Agents,
    /// Slots in the order of ids.
    pub(super) by_id: &'a [u32],
}

impl StopsUpdate<'_> {
    pub(super) fn position(&self, slot: usize) -> Vec2 {
        self.agents.bodies[slot].position()
    }

    pub(super) fn walk(&mut self, slot: usize) -> &mut WalkState {
        &mut self.agents.walks[slot]
    }

    /// Slot of an agent that is present.
    pub(super) fn slot(&self, id: u32) -> Option<usize> {
        let id_of = |slot: &u32| self.agents.walks[*slot as usize].id;
        self.by_id.binary_search_by_key(&id, id_of).ok().map(|index| self.by_id[index] as usize)
    }

    /// Distance of an agent to where it stands or passes, metres.
    pub(super) fn distance_to_spot(&self, slot: usize) -> f64 {
        let p = self.position(slot);
        self.agents.walks[slot].visit.map_or(0.0, |target| target.spot_m().distance(p))
    }

    /// Sends an agent to a new target; the way there is measured again.
    pub(super) fn set(&mut self, slot: usize, target: VisitTarget) {
        let time_s = self.time_s;
        let walk = self.walk(slot);
        walk.visit = Some(target);
        walk.least_left_m = f32::INFINITY;
        walk.improved_s = time_s;
    }

    /// Sends an agent in a queue to its place: a step forward keeps the time since it came nearer.
    pub(super) fn set_waiting(&mut self, slot: usize, target: VisitTarget) {
        let walk = self.walk(slot);
        if walk.visit.is_none_or(|before| before.mode != ApproachMode::Stand || before.squeezes) {
            self.set(slot, target);
        } else if walk.visit != Some(target) {
            walk.visit = Some(target);
            walk.least_left_m = f32::INFINITY;
        }
    }

    /// Positions of others within `within_m` of `p`, metres.
    pub(super) fn near(&self, p: Vec2, id: u32, within_m: f64) -> Vec<Vec2> {
        let others = self.agents.bodies.iter().zip(&self.agents.walks).filter(|(_, walk)| walk.id != id);
        others.map(|(body, _)| body.position()).filter(|other| other.distance(p) < within_m).collect()
    }

    pub(super) fn place_of(&self, id: u32) -> Option<(usize, Vec2)> {
        self.slot(id).map(|slot| (slot, self.position(slot)))
    }
}
