use crate::progress::Interrupted;

/// Why a motion cannot go on, or cannot be held.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError {
    /// Nobody is there throughout a time.
    #[error("nobody is present throughout, from {from_s:.2} to {to_s:.2} s")]
    NobodyThroughout {
        /// Start of the time, seconds.
        from_s: f64,
        /// Its end, seconds.
        to_s: f64,
    },
    /// More than can be worked on as a whole.
    #[error("the motion has more than {most} places, people times moments")]
    TooLong {
        /// The most that are allowed.
        most: usize,
    },
    /// The recording or the crowd that the motion comes from cannot go on.
    #[error("{0}")]
    Source(Box<dyn SourceError>),
    /// The user stopped the work.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

/// The error of a stage that a motion comes from.
pub trait SourceError: std::error::Error + Send + Sync + 'static {
    /// What the user can do about it.
    fn hint(&self) -> Option<String>;
}

impl MotionError {
    /// Wraps the error of the stage that a motion comes from.
    pub fn of_source(error: impl SourceError) -> MotionError {
        MotionError::Source(Box::new(error))
    }

    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            MotionError::NobodyThroughout { .. } => Some("choose another or a shorter time".to_string()),
            MotionError::TooLong { .. } => Some("choose a shorter time, or fewer frames per second".to_string()),
            MotionError::Source(error) => error.hint(),
            MotionError::Interrupted(_) => None,
        }
    }
}
