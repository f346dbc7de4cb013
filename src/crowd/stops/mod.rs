//! Stops: people go there, queue or find a spot, stay, and walk on.
//!
//! Everything is decided at fixed times, one person after the other in the order of ids, so that neither threads
//! nor the time step matter: [`Stops::update`] gives everybody at a stop a [`VisitTarget`] (where to stand, in which
//! direction to face), and [`Stops::steer`] turns them there. Agents without a target walk their route.

mod approach;
mod queue;
mod queue_path;
mod service;
mod standing;
mod stop_state;
mod target;
mod update;
mod visit;
mod visitor;

pub(super) use service::Stops;
pub(super) use target::VisitTarget;
pub use visit::{StopTally, Visit};
