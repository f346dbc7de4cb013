//! The crowd from above, moving: an animated GIF or PNG.

mod encode;
mod error;
mod options;
mod palette;
mod recorder;
mod reel;
mod scene;
mod tails;
#[cfg(test)]
mod tests;

pub use error::AnimationError;
pub use options::{ANIMATION_SIZES_PX, ANIMATION_SPEEDS, AnimationColour, AnimationFormat, AnimationOptions};
pub use recorder::{Animation, AnimationReport};
