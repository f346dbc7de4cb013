//! What a model of walking decides: an agent's direction, and its next velocity.

use super::agents::Agents;
use super::moves::Move;
use super::perception::Perception;
use super::state::AgentMut;

/// Largest acceleration of a walking person, metres per second squared.
pub(super) const MOST_ACCELERATION: f32 = 5.0;
/// Deceleration of an agent that was led faster than it walks, metres per second squared.
pub(super) const CALMS_DOWN_M_S2: f32 = 2.5;

/// A model of walking: how agents choose their direction, and their next velocity among others.
///
/// Both are pure functions of the state at the beginning of the step, so that neither the order of agents nor the number
/// of threads matters. Everything else (arrivals, stops, units, exclusion of bodies, walls) is the same for all models.
pub(super) trait SteeringModel: Send + Sync {
    /// The model's time steps and limits.
    fn settings(&self) -> ModelSettings;

    /// Turns an agent that walks its route towards where it wants to go, and sets its pace.
    ///
    /// Returns whether somebody ahead comes the other way.
    fn turn(&self, agent: AgentMut<'_>, perception: &Perception<'_>) -> bool;

    /// Chooses the next moves of the agents from index `first` of the neighbours' grid on.
    fn next_moves(&self, agents: &Agents, perception: &Perception<'_>, first: usize, moves: &mut [Move]);
}

/// Time steps and limits of a model.
#[derive(Clone, Copy, Debug)]
pub(super) struct ModelSettings {
    /// Longest time step, seconds; longer ones are divided.
    pub(super) longest_step_s: f64,
    /// Interval at which agents look for their way, seconds.
    pub(super) look_s: f64,
    /// How many times as often those at a stop, or on the way to one, look for their spot.
    pub(super) looks_at_stops: u64,
    /// Fastest that others push an agent, as a multiple of the agent's own speed.
    pub(super) most_speed: f32,
    /// How much before its end a walk counts as over, seconds.
    pub(super) end_tolerance_s: f64,
}
