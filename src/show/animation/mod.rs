//! The crowd from above, moving: an animated GIF or PNG.

mod encode;
mod error;
mod options;
mod palette;
mod recorder;
mod packed_frames;
mod crowd_view;
mod trails;
#[cfg(test)]
mod tests;

pub use error::AnimationError;
pub use options::{AnimationColour, AnimationFormat, AnimationOptions};
pub use recorder::{Animation, AnimationReport};
