//! Walks people along routes: Boids without cohesion (Reynolds 1987, doi 10.1145/37402.37406), extended as the
//! Grime paper (Takenaka, Tanaka, Sagawa) describes.
//!
//! Takes routes and people; gives a [`Motion`](crate::motion::Motion). Each step is a pure function of the state before it, so that
//! neither the order of people nor the number of threads matters. In a step, everybody
//!
//! 1. looks for the way: along the flow that spreads people over all sensible ways ([`steering`](self)); whoever is at a
//!    stop, or on the way to one, for their place there ([`stops`](self)),
//! 2. looks around: whom they make way for (*separation*, below an acceptable distance that shrinks as density
//!    grows), whose heading they take up (*alignment*), and how dense the floor ahead is, which limits their speed,
//! 3. moves, is moved out of other bodies (*exclusion distance*), and last and exactly out of walls.

mod arrivals;
mod avoidance;
mod entrances;
mod error;
mod model;
mod neighbours;
mod options;
mod roll;
mod seen;
mod simulation;
mod social_force;
mod spots;
mod state;
mod steering;
mod stops;
mod surroundings;
mod tally;
mod walking;

pub use arrivals::Arrival;
pub use error::CrowdError;
pub use model::{Simulation, simulate};
pub use options::{CrowdOptions, SpeedLaw};
pub use simulation::Crowd;
pub use social_force::{CrowdModel, GroupOptions, Present, SocialCrowd, SocialForceOptions};
pub use spots::{SpotReport, SpotRequest, Spots, Spread};
pub use stops::{StopTally, Visit};
pub use tally::{Stuck, Tally};
