//! Route finding: where people walk through the plan.
//!
//! Takes the plan, its walls and what a scenario asks for; gives [`Route`]s: a start, places to pass, a goal, and
//! gates across the shortest way. [`Navigation`] keeps what the walking itself needs: the ground measured in cells, for
//! every place that a route leads to the walking distance from everywhere, and for every leg of a route how people
//! spread over all the sensible ways (a potential flow), so that corridors are walked over their whole width, halls
//! beside their middle too, and between pillars every gap. No path is searched while people walk.

mod defaults;
mod draft;
mod error;
mod field;
mod flow;
mod gates;
mod ground;
mod lattice;
mod legs;
mod navigation;
mod place;
mod request;
mod ribbon;
mod route;
mod sheet;
mod solve;
mod stop;
mod targets;
#[cfg(test)]
mod tests;
mod timetable;

pub use error::{FloorPoint, Gap, RoutesError};
pub use navigation::{Navigation, find};
pub use place::{Gate, Place, Via};
pub use request::{PlaceRequest, RouteRequest, RoutesOptions, SharedStop, ViaRequest};
pub use route::Route;
pub use stop::{Facing, RouteStop, Stop, StopAt, StopKind, StopRequest};
pub use timetable::{Timetable, TimetableKind};

pub(crate) use field::Field;
pub(crate) use flow::Flow;
pub(crate) use ground::Ground;
pub(crate) use lattice::Lattice;
pub(crate) use navigation::{Leg, RouteLegs};
