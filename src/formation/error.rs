use super::{LEAST_PEOPLE, MOST_PEOPLE};
use crate::motion::MotionError;
use crate::progress::Interrupted;
use crate::recordings::RecordingError;

/// Why formations cannot be interpolated.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FormationError {
    /// A formation cannot be made as it is asked for.
    #[error(transparent)]
    Request(#[from] super::RequestError),
    /// Too few people.
    #[error("{people} people are too few for a formation; at least {least} are needed")]
    TooFew {
        /// How many there are.
        people: usize,
        /// How many are needed.
        least: usize,
    },
    /// More people than a matrix of all pairs is made for.
    #[error("{people} people are too many for one formation; at most {most} are allowed")]
    TooMany {
        /// How many there are.
        people: usize,
        /// How many are allowed.
        most: usize,
    },
    /// Nothing to interpolate between.
    #[error("{keys} key formations are too few; at least 2 are needed, a first and a last one")]
    TooFewKeys {
        /// How many there are.
        keys: usize,
    },
    /// A key formation with more or fewer places than there are people.
    #[error("key formation {key} at {time_s} s has {places} places for the {people} people of the example")]
    Places {
        /// Which one, from 1.
        key: usize,
        /// Its time, seconds.
        time_s: f64,
        /// How many places it has.
        places: usize,
        /// How many people the example has.
        people: usize,
    },
    /// A place or time of a key formation that is no usable number.
    #[error("key formation {key}: {what} is {value}; allowed is -1e7 to 1e7")]
    KeyNumber {
        /// Which one, from 1.
        key: usize,
        /// Which number of it.
        what: String,
        /// Its value.
        value: f64,
    },
    /// A place of the example that is no usable number.
    #[error("the example has person {id} at ({x}, {y}) m at {time_s} s; allowed is -1e7 to 1e7 m")]
    ExampleNumber {
        /// Who.
        id: u32,
        /// When, seconds.
        time_s: f64,
        /// Where, metres.
        x: f64,
        /// Where, metres.
        y: f64,
    },
    /// Moments per second of the example that are no usable number.
    #[error("the example has {fps} moments per second and starts at {start_s} s")]
    ExampleTime {
        /// Moments per second.
        fps: f64,
        /// Time of the first moment, seconds.
        start_s: f64,
    },
    /// Key formations that do not follow each other.
    #[error("key formation {key} at {time_s} s does not come after the one before it, at {before_s} s")]
    KeyOrder {
        /// The later one of the two, from 1.
        key: usize,
        /// Its time, seconds.
        time_s: f64,
        /// Time of the one before, seconds.
        before_s: f64,
    },
    /// Two key formations at one moment of the example.
    #[error("key formations {} and {key}, at {before_s} and {time_s} s, fall into one moment of the example, which has {fps} per second", key - 1)]
    SameMoment {
        /// The later one of the two, from 1.
        key: usize,
        /// Its time, seconds.
        time_s: f64,
        /// Time of the one before, seconds.
        before_s: f64,
        /// Moments per second of the example.
        fps: f64,
    },
    /// A key formation before the example begins or after it ends.
    #[error("key formation {key} is at {time_s} s, but the example lasts from {from_s:.3} to {to_s:.3} s")]
    BeyondExample {
        /// Which one, from 1.
        key: usize,
        /// Its time, seconds.
        time_s: f64,
        /// When the example begins, seconds.
        from_s: f64,
        /// When it ends, seconds.
        to_s: f64,
    },
    /// An adjacency that names somebody twice, nobody, or somebody who is not there.
    #[error("adjacency {edit}: {problem}")]
    Members {
        /// Which one, from 1.
        edit: usize,
        /// What is wrong.
        problem: String,
    },
    /// An option out of range.
    #[error("{option} is {value}; allowed is {low} to {high}")]
    Option {
        /// Which.
        option: &'static str,
        /// Its value.
        value: f64,
        /// Least allowed.
        low: f64,
        /// Most allowed.
        high: f64,
    },
    /// A matrix that does not turn without mirroring.
    #[error("the matrix is no rotation: {problem}")]
    NoRotation {
        /// What is wrong.
        problem: String,
    },
    /// Eigenvectors that are not found.
    #[error("the eigenvectors of {size} x {size} numbers were not found in {iterations} steps")]
    NoConvergence {
        /// Rows of the matrix.
        size: usize,
        /// Steps taken.
        iterations: usize,
    },
    /// A recording that is asked for cannot be read.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// The motion cannot go on, or cannot be held.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The user stopped the work.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

impl FormationError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            FormationError::Request(error) => return error.hint(),
            FormationError::Recording(error) => return error.hint(),
            FormationError::Motion(error) => return error.hint(),
            FormationError::Interrupted(_) => return None,
            FormationError::TooFew { .. } => "take an example in which more people are present throughout".to_string(),
            FormationError::TooMany { .. } => {
                "make small crowds of a few people each, and a large crowd in which each of them is one".to_string()
            }
            FormationError::TooFewKeys { .. } => {
                "the example's own first and last places will do as key formations".to_string()
            }
            FormationError::Places { .. } => "a key formation has one place for everybody in the example".to_string(),
            FormationError::KeyOrder { .. } => "sort key formations by time; no two have the same".to_string(),
            FormationError::SameMoment { fps, .. } => {
                format!("keep key formations at least {:.3} s apart, or take more moments per second", 1.0 / fps)
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
            | FormationError::NoConvergence { .. } => return None,
        };
        Some(hint)
    }
}

/// Whether so many people can be a formation.
///
/// # Errors
/// Too few, too many.
pub(super) fn check_people(people: usize) -> Result<(), FormationError> {
    if people < LEAST_PEOPLE {
        return Err(FormationError::TooFew { people, least: LEAST_PEOPLE });
    }
    if people > MOST_PEOPLE {
        return Err(FormationError::TooMany { people, most: MOST_PEOPLE });
    }
    Ok(())
}
