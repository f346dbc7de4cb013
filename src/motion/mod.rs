//! The hub: a motion as a stream of frames with the position of each person. Later stages do not know whether the
//! frames were simulated, recorded, interpolated or spliced. A [`Recorder`](crate::recordings::Recorder) writes them to a file that other programs
//! read, a [`Recording`](crate::recordings::Recording) reads such files.

mod ensemble;
mod error;
mod frame;
mod mileage;
mod person;
mod resampler;
mod statures;

pub use ensemble::Ensemble;
pub(crate) use ensemble::MOST_PLACES;
pub use error::{MotionError, SourceError};
pub use frame::{Frame, Motion, Walker};
pub(crate) use mileage::Mileage;
pub use person::{Bag, BagKind, BodyOptions, CarrySide, People, Person};
pub(crate) use resampler::{FASTEST_M_S, Resampler};
pub use statures::Statures;
