//! A person's path between two contact checks.

use crate::math::Vec2;
use crate::motion::{CarrySide, Person};

/// The stretch of a person's path between two contact checks.
pub(super) struct ContactStep<'a> {
    pub person: &'a Person,
    /// Position at the previous check, metres.
    pub from_m: Vec2,
    /// Position now, metres.
    pub at_m: Vec2,
    /// Unit vector: where the body faces.
    pub facing: Vec2,
    /// Unit vector of the walking direction.
    pub way: Vec2,
    pub velocity_m_s: Vec2,
    pub walked_m: f64,
    pub stood_s: f64,
}

/// Whether a person carries luggage on a side.
pub(super) fn carries(person: &Person, on_left: bool) -> bool {
    let side = if on_left { CarrySide::Left } else { CarrySide::Right };
    person.bag.is_some_and(|bag| bag.side == side)
}
