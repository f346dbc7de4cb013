//! Turns motion into marks: footfalls, heel marks and wall contacts, without pixels.
//!
//! [`Footfalls`] takes frames one by one and keeps only the people who are present. Each person passes through
//!
//! 1. `track`: the path, resampled to a fixed clock and smoothed over a stride, so that footfalls depend neither on the
//!    source's frame rate nor on body sway;
//! 2. `gait`: a phase that grows by one per step length walked; at every whole step `feet` sets down the left or the
//!    right foot in turn. `rest` draws the feet of a person who stops together and shifts them while standing;
//! 3. `soil` and `heels`: soil prints and heel marks;
//! 4. `contacts`: touches of walls;
//! 5. `standing`: whiles of standing;
//! 6. `wheels`: lines of cases that are pulled and of trolleys that are pushed.
//!
//! Random events have rates per metre walked, per radian turned, per second stood or per event, so the number of marks
//! does not depend on the source's time step.

mod chairs;
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
mod standing;
mod track;
mod wheels;

pub use contact::Contact;
pub use contacts::{
    ContactOptions, ContactPlaces, ContactRule, Door, DoorRequest, Fixture, FixtureAt, FixtureKind, FixtureRequest,
};
pub use error::MarksError;
pub use footfalls::Footfalls;
pub use options::{HeelOptions, MarksOptions, SoilOptions, Weather};

use crate::math::Vec2;
use crate::patterns::Cause;

/// A footfall, a heel mark, a while of standing, or a stretch that a wheel rolled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// Cause: sole or heel.
    pub cause: Cause,
    /// Middle of the pattern in the plan frame, metres.
    pub place_m: Vec2,
    /// Unit vector: direction of the toes or of the drag.
    pub heading: Vec2,
    /// Whether the pattern, drawn as a left foot, is mirrored.
    pub mirrored: bool,
    /// Index into [`crate::patterns::PatternLibrary::patterns`].
    pub pattern: u16,
    /// Length along the heading, metres.
    pub length_m: f32,
    /// Forward slip of the heel, metres, 0 to 0.03.
    pub smear_m: f32,
    /// Twist of the ball on the floor, radians counter-clockwise; 0 unless the person turns.
    pub twist_rad: f32,
    /// Share of the heel's load carried by the ball, 0 to 1; grows with speed, 1 for a runner on the ball.
    pub forefoot: f32,
    /// Wear beyond that of a step straight on, in passes: footfalls that turn, stop or set out.
    pub effort: f32,
    /// Seconds that a person stood here, facing across `heading`; 0 for footfalls and heel marks. A while of standing
    /// adds to `dwell` alone.
    pub stood_s: f32,
    /// Breadth of the line that a wheel or the leg of a chair left along `heading`, turning by `twist_rad`, metres; 0 for all other marks. A
    /// wheel adds `strength` passes to `wheels` alone (of cause heel: optical density of rubber to `scuff`), and over its
    /// length that grows by `effort`.
    pub wheel_m: f32,
    /// Footfalls: pressure, about 1, added to `passes` and `presence` as a factor. Heel marks: optical density.
    pub strength: f32,
    /// Optical density of soil at full coverage; 0 for people without soil on their shoes.
    pub soil: f32,
    /// The same if it rains outside.
    pub wet: f32,
    /// Random word of the pair of shoes, expanded into worn spots by the stamp.
    pub wear: u32,
    /// Random word of the mark, expanded into partial prints, blur, noise and bend by the stamp.
    pub variation: u64,
}

impl Mark {
    /// Whether a step left it: a footfall or a heel mark, not a while of standing nor a wheel.
    pub(crate) fn is_of_step(&self) -> bool {
        self.stood_s == 0.0 && self.wheel_m == 0.0
    }
}

/// Origin of a person, which decides the soil on the shoes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// Whether the person came after the floor was mopped; only these leave soil.
    pub fresh: bool,
    /// Whether the person came from outside the plan; the others have walked indoors for a while.
    pub from_outside: bool,
}

impl Origin {
    /// Origins by person id; the last `fresh_people` of the arrival list are fresh.
    pub fn of_arrivals(from_outside: impl ExactSizeIterator<Item = bool>, fresh_people: u32) -> Vec<Origin> {
        let first_fresh = from_outside.len().saturating_sub(fresh_people as usize);
        let origin = |(id, from_outside)| Origin { fresh: id >= first_fresh, from_outside };
        from_outside.enumerate().map(origin).collect()
    }
}
