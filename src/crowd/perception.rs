//! What agents perceive when a step begins.

use super::environment::Environment;
use super::neighbours::NeighbourGrid;
use super::state::BodyState;
use crate::math::vec2;

/// Radius within which agents take in others and the floor around them, metres.
pub(super) const SENSE_M: f64 = 2.0;
/// Clearance from which on walls have no influence on how much floor an agent senses, metres.
pub(super) const OPEN_M: f32 = 2.4;

/// The environment and the state of all agents at the beginning of a step.
pub(super) struct Perception<'s> {
    pub(super) environment: &'s Environment<'s>,
    pub(super) neighbours: &'s NeighbourGrid,
    /// How quickly agents align with others, per second.
    pub(super) alignment: f32,
    /// Time since the start, seconds.
    pub(super) time_s: f64,
    /// Time step, seconds.
    pub(super) dt: f32,
}

impl Perception<'_> {
    /// Whether no wall hides the place at this offset from an agent, metres.
    #[inline]
    pub(super) fn sees(&self, me: &BodyState, dx: f32, dy: f32) -> bool {
        let at = me.position();
        self.environment.sight(at, at + vec2(f64::from(dx), f64::from(dy)))
    }
}
