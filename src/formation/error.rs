use super::{LEAST_PEOPLE, MOST_PEOPLE};
use crate::math::NoConvergence;
use crate::motion::MotionError;
use crate::progress::Interrupted;
use crate::recordings::RecordingError;

/// Errors of formations.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FormationError {
    /// An invalid request.
    #[error(transparent)]
    Request(#[from] super::RequestError),
    /// Too few people.
    #[error("{people} people are too few for a formation; at least {least} are needed")]
    TooFew {
        /// Number of people.
        people: usize,
        /// Least number of people.
        least: usize,
    },
    /// Too many people for a matrix of all pairs.
    #[error("{people} people are too many for one formation; at most {most} are allowed")]
    TooMany {
        /// Number of people.
        people: usize,
        /// Largest number of people.
        most: usize,
    },
    /// Fewer than two key formations.
    #[error("{keys} key formations are too few; at least 2 are needed, a first and a last one")]
    TooFewKeys {
        /// Number of key formations.
        keys: usize,
    },
    /// A key formation whose number of positions differs from the number of people.
    #[error("key formation {key} at {time_s} s has {places} positions for the {people} people of the example")]
    Places {
        /// Number of the key formation, from 1.
        key: usize,
        /// Time of the key formation, seconds.
        time_s: f64,
        /// Number of positions.
        places: usize,
        /// Number of people in the example.
        people: usize,
    },
    /// A position or time of a key formation out of range.
    #[error("key formation {key}: {what} is {value}; allowed is -1e7 to 1e7")]
    KeyNumber {
        /// Number of the key formation, from 1.
        key: usize,
        /// Name of the value.
        what: String,
        /// The value.
        value: f64,
    },
    /// A position of the example out of range.
    #[error("the example has person {id} at ({x}, {y}) m at {time_s} s; allowed is -1e7 to 1e7 m")]
    ExampleNumber {
        /// The person's id.
        id: u32,
        /// Time of the frame, seconds.
        time_s: f64,
        /// The coordinate x, metres.
        x: f64,
        /// The coordinate y, metres.
        y: f64,
    },
    /// A frame rate or start time of the example out of range.
    #[error("the example has {fps} frames per second and starts at {start_s} s")]
    ExampleTime {
        /// Frames per second.
        fps: f64,
        /// Time of the first frame, seconds.
        start_s: f64,
    },
    /// Key formations that are not in the order of time.
    #[error("key formation {key} at {time_s} s does not come after the one before it, at {before_s} s")]
    KeyOrder {
        /// Number of the later one, from 1.
        key: usize,
        /// Time of the key formation, seconds.
        time_s: f64,
        /// Time of the one before it, seconds.
        before_s: f64,
    },
    /// Two key formations in one frame of the example.
    #[error("key formations {} and {key}, at {before_s} and {time_s} s, fall into one frame of the example, which has {fps} frames per second", key - 1)]
    SameMoment {
        /// Number of the later one, from 1.
        key: usize,
        /// Time of the key formation, seconds.
        time_s: f64,
        /// Time of the one before it, seconds.
        before_s: f64,
        /// Frames per second of the example.
        fps: f64,
    },
    /// A key formation before the example begins or after it ends.
    #[error("key formation {key} is at {time_s} s, but the example lasts from {from_s:.3} to {to_s:.3} s")]
    BeyondExample {
        /// Number of the key formation, from 1.
        key: usize,
        /// Time of the key formation, seconds.
        time_s: f64,
        /// Start of the example, seconds.
        from_s: f64,
        /// End of the example, seconds.
        to_s: f64,
    },
    /// An adjacency with repeated, too few or unknown members.
    #[error("adjacency {edit}: {problem}")]
    Members {
        /// Number of the adjacency, from 1.
        edit: usize,
        /// The problem.
        problem: String,
    },
    /// An option out of range.
    #[error("{option} is {value}; allowed is {low} to {high}")]
    Option {
        /// Name of the option.
        option: &'static str,
        /// The value.
        value: f64,
        /// Least value.
        low: f64,
        /// Largest value.
        high: f64,
    },
    /// A matrix that is not a rotation.
    #[error("the matrix is not a rotation: {problem}")]
    NoRotation {
        /// The problem.
        problem: String,
    },
    /// An eigenvector iteration that does not converge.
    #[error(transparent)]
    NoConvergence(#[from] NoConvergence),
    /// An error of a recording.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// An error of the motion.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The user stopped the calculation.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

impl FormationError {
    /// A remedy that the user can try.
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            FormationError::Request(error) => return error.hint(),
            FormationError::Recording(error) => return error.hint(),
            FormationError::Motion(error) => return error.hint(),
            FormationError::Interrupted(_) => return None,
            FormationError::TooFew { .. } => "take an example with more people who are present throughout".to_string(),
            FormationError::TooMany { .. } => {
                "make small crowds of a few people each, and a large crowd of which each of them is one individual"
                    .to_string()
            }
            FormationError::TooFewKeys { .. } => {
                "the example's own first and last positions can serve as key formations".to_string()
            }
            FormationError::Places { .. } => {
                "a key formation has one position for each person in the example".to_string()
            }
            FormationError::KeyOrder { .. } => "sort key formations by time; times must differ".to_string(),
            FormationError::SameMoment { fps, .. } => {
                format!("keep key formations at least {:.3} s apart, or take more frames per second", 1.0 / fps)
            }
            FormationError::BeyondExample { from_s, to_s, .. } => {
                format!("move it to {from_s:.3} to {to_s:.3} s, or take a longer example")
            }
            FormationError::Members { .. } => "people are counted from 0 in the example's order".to_string(),
            FormationError::NoRotation { .. } => "match the second basis to the first one before".to_string(),
            FormationError::ExampleNumber { .. }
            | FormationError::ExampleTime { .. }
            | FormationError::KeyNumber { .. }
            | FormationError::Option { .. }
            | FormationError::NoConvergence(_) => return None,
        };
        Some(hint)
    }
}

/// Checks the number of people in a formation.
///
/// # Errors
/// [`FormationError::TooFew`], [`FormationError::TooMany`].
pub(super) fn check_people(people: usize) -> Result<(), FormationError> {
    if people < LEAST_PEOPLE {
        return Err(FormationError::TooFew { people, least: LEAST_PEOPLE });
    }
    if people > MOST_PEOPLE {
        return Err(FormationError::TooMany { people, most: MOST_PEOPLE });
    }
    Ok(())
}
