//! Rooms of a plan: where walls with doors divide its floor, what each is, where people stay in it, and where the
//! building begins.
//!
//! The floor is divided at [doorways](crate::walls::Doorway), and at doors where the plan tells them. What is left
//! together is a room: a [`Room`] has an area, doors, a name by its place ("room 1" is the one farthest up and left) and a
//! [`RoomKind`]. [`Use`] says what a building is for, and what people do in each kind of room.

mod divide;
mod entrances;
mod find;
mod grid;
mod kind;
mod life;
mod request;
mod stays;
mod uses;

pub use entrances::Entrance;
pub use find::{Room, Rooms};
pub use kind::RoomKind;
pub use life::Life;
pub(crate) use request::UnfitRoom;
pub use request::{LifeOptions, RoomRequest};
pub use stays::Spot;
pub(crate) use stays::Zone;
pub(crate) use uses::Habits;
pub use uses::Use;
