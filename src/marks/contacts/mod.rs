//! Contacts: where people touch walls while they walk, turn, pass doors, and stand.
//!
//! The smoothed path is checked every 25 cm walked or half a second stood. A check lists the possible touches with their
//! expected numbers: walls on either side by their distance, jambs of passed doors, corners turned round, fixtures in
//! reach. The expected numbers run down one exponential clock per person; when it runs out, one touch is drawn. Most
//! people who walk a corridor touch nothing.

mod model;
mod options;
mod place_index;
mod places;
mod requests;
mod state;
mod step;
mod touch;
mod wall_patterns;
mod wall_side;

pub(super) use model::Contacts;
pub use options::{ContactOptions, ContactRule};
pub use places::{ContactPlaces, Door, Fixture};
pub use requests::{DoorRequest, FixtureAt, FixtureKind, FixtureRequest};
pub(super) use state::{ContactState, ContactTick};
