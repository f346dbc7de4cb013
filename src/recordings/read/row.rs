//! Rows of a recording.

use super::RecordingError;
use super::layout::shown;
use crate::math::Vec2;

/// Ids of files are kept where they are whole numbers below this.
pub(super) const ID_LIMIT: f64 = 1e7;

/// Somebody's place as the file tells it, in its own numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TrajectoryRow {
    pub id: u32,
    /// Line, from 1; in a database the row's number.
    pub line: u64,
    pub time: f64,
    pub at: Vec2,
    pub velocity: Option<Vec2>,
    pub heading: Option<Vec2>,
    /// When and where a step ends that begins here.
    pub until: Option<(f64, Vec2)>,
}

/// How people are numbered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Numbering {
    /// As in the file.
    Own,
    /// From 1, as they first appear.
    Appearance,
}

/// What was passed over.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Passed {
    /// Rows without a place, and the line of the first.
    pub nowhere: u64,
    pub first_nowhere: u64,
    /// The last line if it breaks off.
    pub broken: Option<u64>,
}

/// What stops rows from coming.
#[derive(Debug)]
pub(super) enum ReadStop {
    /// An id that is no whole number below [`ID_LIMIT`]: people have to be numbered.
    Name,
    Error(RecordingError),
}

impl From<RecordingError> for ReadStop {
    fn from(error: RecordingError) -> ReadStop {
        ReadStop::Error(error)
    }
}

/// Who a row is about, for messages.
pub(super) fn who(id: u32, numbering: Numbering) -> String {
    match numbering {
        Numbering::Own => format!("person {id}"),
        Numbering::Appearance => format!("the person who appears as number {id}"),
    }
}

/// A value of the file for messages.
pub(super) fn moment(time: f64, frames: bool) -> String {
    if frames {
        format!("frame {time}")
    } else {
        format!("time {}", shown(time.to_string().as_bytes()).trim_matches('`'))
    }
}
