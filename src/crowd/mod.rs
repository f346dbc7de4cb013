//! Simulates the crowd: agents walk along routes, stop on the way, and play units.
//!
//! Takes routes and people; gives a [`Motion`](crate::motion::Motion), the [`Simulation`]. It holds the agents and all that
//! is common to the models of walking: arrivals, entrances, stops, spots with units, exclusion of bodies, walls, stuck
//! people. A steering model decides in which direction an agent turns and what its next velocity is, given its
//! neighbourhood. There are two, chosen by [`CrowdModel`]:
//!
//! - boids without cohesion (Reynolds 1987, doi 10.1145/37402.37406), extended as the Grime paper (Takenaka, Tanaka,
//!   Sagawa) describes: separation below an acceptable distance that shrinks in a dense crowd, alignment with those who go
//!   the same way, a speed that falls with the number of people ahead;
//! - social forces with groups of up to four (Moussaid et al. 2009, 2010).
//!
//! More than 5000 lines, since both models, the queues of stops and the spots of units work on the same agents within one
//! step; a folder each keeps them apart: `boids`, `social_force`, `stops`, `spots`.
//!
//! Each step is a pure function of the state before it, so that neither the order of agents nor the number of threads
//! matters. In a step
//!
//! 1. stops are updated: queues move on, stays end,
//! 2. agents look for their way along the flow that spreads people over all sensible ways, or for their spot at a stop,
//! 3. agents choose their moves, bodies are moved apart (*exclusion distance*), and last and exactly out of walls,
//! 4. people enter who are due and find room; those who have arrived or got stuck leave.

mod error;
mod options;
mod arrivals;
mod groups;
mod environment;
mod state;
mod neighbours;
mod perception;
mod avoidance;
mod wayfinding;
mod moves;
mod agents;
mod model;
mod boids;
mod social_force;
mod stops;
mod spots;
mod collisions;
mod tally;
mod entrances;
mod departures;
mod capacity;
mod standstill;
mod simulation;

pub use agents::AgentSnapshot;
pub use arrivals::Arrival;
pub use capacity::Overload;
pub use error::CrowdError;
pub use options::{CrowdModel, CrowdOptions, SpeedLaw};
pub use simulation::Simulation;
pub use social_force::{GroupOptions, SocialForceOptions};
pub use spots::{MeanAndMax, SpotReport, SpotRequest};
pub use standstill::Standstill;
pub use stops::{StopTally, Visit};
pub use tally::{Stuck, Tally};
