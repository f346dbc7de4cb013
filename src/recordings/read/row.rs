//! Rows of a recording.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

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

/// Hash for ids, which are small and mostly consecutive.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct IdHasher(u64);

impl Hasher for IdHasher {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|&byte| self.write_u32(u32::from(byte)));
    }

    fn write_u32(&mut self, id: u32) {
        // The golden ratio's bits; folded down because the table uses the upper ones too.
        let mixed = (self.0 ^ u64::from(id)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.0 = mixed ^ (mixed >> 32);
    }
}

/// A map from person id to `T`.
pub(super) type ById<T> = HashMap<u32, T, BuildHasherDefault<IdHasher>>;
