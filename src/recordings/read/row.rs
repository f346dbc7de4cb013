//! Rows of a recording.

use super::RecordingError;
use super::layout::shown;
use crate::math::Vec2;

/// Ids of the file are kept if they are whole numbers below this.
pub(super) const ID_LIMIT: f64 = 1e7;

/// A person's position at one time, in the file's own numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TrajectoryRow {
    pub id: u32,
    /// Line number, from 1; in a database the row number.
    pub line: u64,
    pub time: f64,
    pub at: Vec2,
    pub velocity: Option<Vec2>,
    pub heading: Option<Vec2>,
    /// Time and position of the end of a step that starts here.
    pub until: Option<(f64, Vec2)>,
}

/// Numbering of persons.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Numbering {
    /// Ids of the file.
    Own,
    /// From 1, in order of appearance.
    Appearance,
}

/// Rows that were skipped.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Passed {
    /// Rows without a position, and the line of the first.
    pub nowhere: u64,
    pub first_nowhere: u64,
    /// The last line, if it is cut off.
    pub broken: Option<u64>,
}

/// Why reading stopped.
#[derive(Debug)]
pub(super) enum ReadStop {
    /// An id is not a whole number below [`ID_LIMIT`]: persons must be renumbered.
    Name,
    Error(RecordingError),
}

impl From<RecordingError> for ReadStop {
    fn from(error: RecordingError) -> ReadStop {
        ReadStop::Error(error)
    }
}

/// Names a person in messages.
pub(super) fn who(id: u32, numbering: Numbering) -> String {
    match numbering {
        Numbering::Own => format!("person {id}"),
        Numbering::Appearance => format!("the person who appears as number {id}"),
    }
}

/// Formats a time or frame for messages.
pub(super) fn moment(time: f64, frames: bool) -> String {
    if frames {
        format!("frame {time}")
    } else {
        format!("time {}", shown(time.to_string().as_bytes()).trim_matches('`'))
    }
}
