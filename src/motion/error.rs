use std::path::PathBuf;

use super::recorder::RecordFormat;

/// Why a motion cannot be recorded.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError {
    /// The file's name says nothing of its format.
    #[error("{}: a motion is written to a file whose name ends in {}", path.display(), RecordFormat::endings())]
    UnknownEnding {
        /// The file.
        path: PathBuf,
    },
    /// Frames per second out of range.
    #[error("{fps} frames per second; allowed is {low} to {high}")]
    FrameRate {
        /// What was asked for.
        fps: f64,
        /// Least allowed.
        low: f64,
        /// Most allowed.
        high: f64,
    },
}

impl MotionError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            MotionError::UnknownEnding { .. } => {
                Some("paths.txt is Juelich text, paths.sqlite a JuPedSim database".to_string())
            }
            MotionError::FrameRate { .. } => Some("10 is the crowd's own rate".to_string()),
        }
    }
}
