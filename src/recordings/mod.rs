//! Trajectory files: reads recordings of other programs and writes motions for them.

mod read;
mod write;

pub use read::{LengthUnit, Recording, RecordingError, RecordingFormat, RecordingOptions, Survey};
pub use write::{FRAME_RATES, RecordForm, Recorded, RecordedWorld, Recorder};
