use std::path::PathBuf;

use super::features::FeaturesError;
use super::formation::FormationError;
use super::recorder::RecordForm;
use super::recording::{RecordingError, RecordingFormat};
use super::units::UnitsError;

/// Why a motion cannot be recorded, read or made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError {
    /// The file's name says nothing of its format.
    #[error("{}: a motion is written to a file whose name ends in {}", path.display(), RecordForm::endings())]
    UnknownEnding {
        /// The file.
        path: PathBuf,
    },
    /// The format is no text: it can neither be packed nor printed.
    #[error("a {} can neither be packed by gzip nor printed", format.title())]
    NoText {
        /// The format.
        format: RecordingFormat,
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
    /// A recording cannot be read.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// Formations cannot be interpolated.
    #[error(transparent)]
    Formation(#[from] FormationError),
    /// Features cannot be worked on.
    #[error(transparent)]
    Features(#[from] FeaturesError),
    /// Units cannot be cut or used.
    #[error(transparent)]
    Units(#[from] UnitsError),
}

impl MotionError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            MotionError::UnknownEnding { .. } => {
                let known = "paths.txt is Juelich text, paths.csv a CSV with named columns, paths.traj Vadere's, \
                             paths.sqlite a JuPedSim database";
                Some(known.to_string())
            }
            MotionError::NoText { .. } => Some("name a file such as paths.sqlite".to_string()),
            MotionError::FrameRate { .. } => Some("10 is the crowd's own rate".to_string()),
            MotionError::NobodyThroughout { .. } => {
                Some("choose another or a shorter time, with --from and --to, or --span".to_string())
            }
            MotionError::TooLong { .. } => Some("choose a shorter time, or fewer frames per second".to_string()),
            MotionError::Recording(error) => error.hint(),
            MotionError::Formation(error) => error.hint(),
            MotionError::Features(error) => error.hint(),
            MotionError::Units(error) => error.hint(),
        }
    }
}
