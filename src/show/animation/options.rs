use std::path::Path;

use serde::{Deserialize, Serialize};

use super::error::AnimationError;

/// Speed, size and colours of an animation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AnimationOptions {
    /// Playback speed as a factor on real time, 0.1 to 1000.
    ///
    /// `None`: a round number at which the animation lasts at most 20 s.
    pub speed: Option<f64>,
    /// Longer side of the picture, pixels; 200 to 2000.
    pub size_px: u32,
    /// Meaning of people's colours.
    pub colour: AnimationColour,
}

impl Default for AnimationOptions {
    fn default() -> AnimationOptions {
        AnimationOptions { speed: None, size_px: 960, colour: AnimationColour::Speed }
    }
}

/// Meaning of people's colours in an animation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AnimationColour {
    /// Walking speed.
    #[default]
    Speed,
    /// Route.
    Route,
}

/// The file that an animation is written to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AnimationFormat {
    /// Animated GIF.
    Gif,
    /// Animated PNG.
    Png,
}

impl AnimationFormat {
    /// The endings of file names, with the format that each stands for.
    pub const ENDINGS: [(&str, AnimationFormat); 3] =
        [("gif", AnimationFormat::Gif), ("png", AnimationFormat::Png), ("apng", AnimationFormat::Png)];

    /// The format that a file's name asks for.
    ///
    /// # Errors
    /// A name with another ending, or none.
    pub fn of(path: &Path) -> Result<AnimationFormat, AnimationError> {
        let found = path.extension().and_then(|ending| {
            let known = |&&(name, _): &&(&str, AnimationFormat)| ending.eq_ignore_ascii_case(name);
            AnimationFormat::ENDINGS.iter().find(known).map(|&(_, format)| format)
        });
        found.ok_or_else(|| AnimationError::UnknownEnding { path: path.to_path_buf() })
    }
}

impl AnimationOptions {
    /// Least and largest value of [`AnimationOptions::size_px`].
    pub const SIZES_PX: [u32; 2] = [200, 2000];
    /// Least and largest value of [`AnimationOptions::speed`].
    pub const SPEEDS: [f64; 2] = [0.1, 1000.0];

    /// Checks size and speed against their ranges.
    pub(super) fn check(&self) -> Result<(), AnimationError> {
        check("size", f64::from(self.size_px), Self::SIZES_PX.map(f64::from))?;
        self.speed.map_or(Ok(()), |speed| check("speed", speed, Self::SPEEDS))
    }
}

fn check(name: &'static str, value: f64, [low, high]: [f64; 2]) -> Result<(), AnimationError> {
    // Written so that NaN is out of range.
    let allowed = value >= low && value <= high;
    if allowed { Ok(()) } else { Err(AnimationError::Number { name, value, low, high }) }
}
