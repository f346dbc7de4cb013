//! Turns motion into marks: where a foot was set down, where a heel scraped, where a wall was touched. Still without
//! pixels.
//!
//! [`Footfalls`] takes frames one by one and keeps only the people who are present. Each of them passes through
//!
//! 1. `track`: the path on a clock of its own, smoothed over a stride, so that neither the source's frame rate nor
//!    the sway of a body decides where feet fall;
//! 2. `gait`: a phase that grows by a step per step length walked; at every whole step one of the `feet` is set down,
//!    left and right in turn, as the body faces; who comes to `rest` draws them together, and shifts them while
//!    standing;
//! 3. `soil` and `heels`: what the shoe leaves there;
//! 4. `contacts`: what of the body touches the walls that it passes.
//!
//! Everything that can happen more or less often is a rate per metre walked, per radian turned, per second stood or per
//! event; the number of marks does not depend on the source's time step.

mod contact;
mod contacts;
mod error;
mod feet;
mod footfalls;
mod gait;
mod heels;
mod options;
mod rest;
mod soil;
mod track;

pub use contact::Contact;
pub use contacts::{
    ContactOptions, ContactPlaces, ContactRule, Door, DoorRequest, Fixture, FixtureAt, FixtureKind, FixtureRequest,
};
pub use error::MarksError;
pub use footfalls::Footfalls;
pub use options::{HeelOptions, MarksOptions, SoilOptions, Weather};

use crate::math::Vec2;
use crate::patterns::Cause;

/// A footfall or a scuff.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// What leaves it.
    pub cause: Cause,
    /// Middle of the pattern in the plan frame, metres.
    pub place_m: Vec2,
    /// Unit vector: where the toes point, or the drag goes.
    pub heading: Vec2,
    /// Whether the pattern, drawn as a left foot, is mirrored.
    pub mirrored: bool,
    /// Index into [`crate::patterns::PatternLibrary::patterns`].
    pub pattern: u16,
    /// Real length along the heading, metres (heel marks: of the drag).
    pub length_m: f32,
    /// How far the heel slips forward, metres, 0 to 0.03.
    pub smear_m: f32,
    /// How far the ball twists on the floor while the foot stands, radians counter-clockwise; 0 unless the person turns.
    pub twist_rad: f32,
    /// How much of the heel's load has gone over to the ball, 0 to 1: the faster the more; 1 is somebody who runs on
    /// the ball and hardly touches the floor with the heel.
    pub forefoot: f32,
    /// Footfalls: pressure, about 1, added to `passes` and `presence` as a factor. Heel marks: optical density.
    pub strength: f32,
    /// Optical density of the soil that this print leaves where coverage is full; 0 unless the person is one of the fresh.
    pub soil: f32,
    /// The same word for all prints of a pair of shoes: expanded by the stamp into where that pair is worn.
    pub wear: u32,
    /// Expanded by the stamp into all its variation: partial prints, blur, noise, bend.
    pub variation: u64,
}

/// Where somebody comes from, as far as the shoes tell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// One of the last people since the floor was mopped: only their prints can be read.
    pub fresh: bool,
    /// Came in from outside the plan; everybody else has walked indoors for a while.
    pub from_outside: bool,
}

impl Origin {
    /// Origins by id: `from_outside` in the order of the arrival list, of which the last `fresh_people` are fresh.
    pub fn of_arrivals(from_outside: impl ExactSizeIterator<Item = bool>, fresh_people: u32) -> Vec<Origin> {
        let first_fresh = from_outside.len().saturating_sub(fresh_people as usize);
        let origin = |(id, from_outside)| Origin { fresh: id >= first_fresh, from_outside };
        from_outside.enumerate().map(origin).collect()
    }
}
