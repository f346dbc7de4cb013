//! The hub: a stream of frames that say where everybody is. What comes after it does not know whether the
//! frames were simulated, recorded, interpolated or spliced. A [`Recorder`] writes them to a file that other programs
//! read, a [`Recording`] reads such files.

mod ensemble;
mod error;
mod mileage;
mod person;
mod resampler;
mod statures;

pub use ensemble::{Ensemble, EnsembleMotion, MOST_PLACES};
pub use error::{MotionError, SourceError};
pub use mileage::Mileage;
pub use person::{Bag, BagKind, BodyOptions, CarrySide, People, Person, STRIDE_SPEED_M_S};
pub(crate) use resampler::{FASTEST_M_S, Resampler};
pub use statures::Statures;

use crate::math::Vec2;

/// One person at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walker {
    /// Who it is: the person's number in the arrival list.
    pub id: u32,
    /// Middle of the body, plan frame, metres. May lie beyond the plan's edge.
    pub position_m: Vec2,
    /// Velocity, metres per second.
    pub velocity_m_s: Vec2,
    /// Unit vector in which the body faces, if the source knows: who stands and turns has no velocity to tell it by.
    pub heading: Option<Vec2>,
}

/// Everybody at one moment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Seconds since the start.
    pub time_s: f64,
    /// Everybody who is present, by ascending id.
    pub walkers: Vec<Walker>,
}

/// A stream of frames in ascending time.
pub trait Motion {
    /// Fills `frame` with the next one and says whether there was one.
    ///
    /// A person who is missing from a frame has left for good.
    ///
    /// # Errors
    /// [`MotionError`]: whatever stops the source: a recording that cannot be read, a crowd that cannot walk.
    fn next_frame(&mut self, frame: &mut Frame) -> Result<bool, MotionError>;

    /// Share of the whole that has been given out, 0 to 1, as well as the source can tell.
    fn share_done(&self) -> f64;
}
