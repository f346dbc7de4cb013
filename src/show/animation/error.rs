use std::path::PathBuf;

/// Errors of animations.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AnimationError {
    /// The file's name has an ending of no known format.
    #[error("{}: an animation is written to a file whose name ends in .gif, .png or .apng", path.display())]
    UnknownEnding {
        /// The file.
        path: PathBuf,
    },
    /// A number out of its range.
    #[error("the animation's {name} is {value}; allowed is {low} to {high}")]
    Number {
        /// Name of the number.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Least value allowed.
        low: f64,
        /// Largest value allowed.
        high: f64,
    },
}

impl AnimationError {
    /// Suggests a remedy.
    pub fn hint(&self) -> Option<String> {
        match self {
            AnimationError::UnknownEnding { .. } => Some("walk.gif is understood everywhere".to_string()),
            AnimationError::Number { .. } => None,
        }
    }
}
