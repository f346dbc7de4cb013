//! Route finding: where people walk through the plan.
//!
//! Takes the plan, its walls and the scenario's requests; returns [`Route`]s: a start, via places, a goal, and gates
//! across the shortest path. [`Navigation`] holds the data for walking: the ground in cells, the walking distance from
//! every cell to each place, and a potential flow per leg of a route, which spreads people over all reasonable paths.
//! They use the full width of corridors, all of a hall, and every gap between pillars. Walking needs no path search.

mod defaults;
mod draft;
mod error;
mod field;
mod flow;
mod gates;
mod ground;
mod lattice;
mod lanes;
mod legs;
mod life;
mod narrow;
mod navigation;
mod place;
mod request;
mod ribbon;
mod route;
mod sheet;
mod solve;
mod stop;
mod stop_ways;
mod targets;
#[cfg(test)]
mod tests;
mod timetable;

pub use error::{FloorPoint, Gap, RoutesError};
pub use navigation::{Navigation, find};
pub use place::{Gate, Place, Via};
pub use request::{PlaceRequest, RouteRequest, RoutesOptions, SharedStop, ViaRequest};
pub use route::{Route, RouteLife};
pub use stop::{Facing, RouteStop, Stop, StopAt, StopKind, StopRequest};
pub use timetable::{Timetable, TimetableKind};

pub(crate) use field::Field;
pub(crate) use flow::Flow;
pub(crate) use ground::Ground;
pub(crate) use lattice::Lattice;
pub(crate) use legs::{Leg, RouteLegs};
pub(crate) use narrow::{Narrow, NarrowPlaces};
pub(crate) use route::USUAL_M_S;
pub(crate) use stop_ways::StopWay;
