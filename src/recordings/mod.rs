//! Motions as files: reads what others recorded or simulated, and writes motions for other programs.

mod read;
mod write;

pub use read::{LengthUnit, Recording, RecordingError, RecordingFormat, RecordingOptions, Survey};
pub use write::{FRAME_RATES, RecordForm, Recorded, RecordedWorld, Recorder};
