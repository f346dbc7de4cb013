use crate::progress::Interrupted;

/// Errors of a motion.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError {
    /// A time span without a person who is present throughout.
    #[error("no person is present throughout, from {from_s:.2} to {to_s:.2} s")]
    NobodyThroughout {
        /// Start of the time span, seconds.
        from_s: f64,
        /// End of the time span, seconds.
        to_s: f64,
    },
    /// More positions than an ensemble holds.
    #[error("the motion has more than {most} positions, people times frames")]
    TooLong {
        /// Largest number of positions, people times frames.
        most: usize,
    },
    /// An error of the recording or the crowd that the motion comes from.
    #[error("{0}")]
    Source(Box<dyn SourceError>),
    /// The user stopped the calculation.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

/// The error of a stage that a motion comes from.
pub trait SourceError: std::error::Error + Send + Sync + 'static {
    /// A remedy that the user can try.
    fn hint(&self) -> Option<String>;
}

impl MotionError {
    /// Wraps the error of the stage that a motion comes from.
    pub fn of_source(error: impl SourceError) -> MotionError {
        MotionError::Source(Box::new(error))
    }

    /// A remedy that the user can try.
    pub fn hint(&self) -> Option<String> {
        match self {
            MotionError::NobodyThroughout { .. } => Some("choose another time span, or a shorter one".to_string()),
            MotionError::TooLong { .. } => Some("choose a shorter time span, or fewer frames per second".to_string()),
            MotionError::Source(error) => error.hint(),
            MotionError::Interrupted(_) => None,
        }
    }
}
