use std::path::PathBuf;

use super::format::RecordingFormat;
use crate::files::FileError;
use crate::motion::SourceError;
use crate::progress::Interrupted;

/// Hint that describes the rows of a recording.
pub(super) const LINES: &str = "a recording has a line for everybody in every frame: who, when, x, y";

/// Errors of reading and writing recordings.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordingError {
    /// The file cannot be read.
    #[error("cannot read {}: {problem}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Message of the operating system.
        problem: String,
        /// Remedy.
        hint: &'static str,
    },
    /// The file has no positions.
    #[error("{}: the recording is empty: {what}", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
        /// Which part of the content is missing.
        what: &'static str,
    },
    /// The file has an unknown format.
    #[error("{}: this is no recording of people: {found}", path.display())]
    Unknown {
        /// The file.
        path: PathBuf,
        /// Description of the content that was found.
        found: String,
        /// Remedy.
        hint: String,
    },
    /// A line cannot be parsed, or its values are out of range.
    #[error("{}, line {line}: {problem}", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// The line, from 1; in a database the row's number.
        line: u64,
        /// The problem, with the value.
        problem: String,
        /// Remedy.
        hint: String,
    },
    /// A person has two positions at one time.
    #[error(
        "{}, line {line}: {who} is at ({:.3}, {:.3}) and at ({:.3}, {:.3}) at {moment}",
        path.display(), places[0][0], places[0][1], places[1][0], places[1][1]
    )]
    Twice {
        /// The file.
        path: PathBuf,
        /// Line of the second position.
        line: u64,
        /// The person.
        who: String,
        /// Time or frame, in the file's own numbers.
        moment: String,
        /// Both positions, in the file's length unit.
        places: [[f64; 2]; 2],
    },
    /// The file counts frames but gives no frame rate.
    #[error("{}: nothing tells how many frames make a second", path.display())]
    UnknownRate {
        /// The file.
        path: PathBuf,
    },
    /// The database is damaged or has other tables.
    #[error("{}: {problem}", path.display())]
    Database {
        /// The file.
        path: PathBuf,
        /// Message of SQLite, or what is missing.
        problem: String,
    },
    /// The user stopped the reading.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
    /// An option is out of range.
    #[error("{option} = {value}: {allowed}")]
    Option {
        /// Name of the option.
        option: &'static str,
        /// The given value.
        value: String,
        /// Allowed range.
        allowed: String,
    },
    /// The file name's ending names no known format.
    #[error("{}: a motion is written to a file whose name ends in {endings}", path.display())]
    UnknownEnding {
        /// The file.
        path: PathBuf,
        /// List of known endings.
        endings: String,
    },
    /// The format is binary: it can be neither gzipped nor printed.
    #[error("a {} can neither be packed by gzip nor printed", format.title())]
    NoText {
        /// The format.
        format: RecordingFormat,
    },
    /// The frame rate is out of range, 1/s.
    #[error("{fps} frames per second; allowed is {low} to {high}")]
    FrameRate {
        /// The given rate, 1/s.
        fps: f64,
        /// Smallest allowed rate, 1/s.
        low: f64,
        /// Largest allowed rate, 1/s.
        high: f64,
    },
    /// The file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
}

impl SourceError for RecordingError {
    fn hint(&self) -> Option<String> {
        RecordingError::hint(self)
    }
}

impl RecordingError {
    /// Returns the remedy, for the user.
    pub fn hint(&self) -> Option<String> {
        let text = match self {
            RecordingError::File(error) => return error.hint(),
            RecordingError::UnknownEnding { .. } => {
                "paths.txt is Juelich text, paths.csv a CSV with named columns, paths.traj Vadere's, paths.sqlite a \
                 JuPedSim database"
            }
            RecordingError::NoText { .. } => "name a file such as paths.sqlite",
            RecordingError::FrameRate { .. } => "10 is the crowd's own rate",
            RecordingError::Unknown { hint, .. } | RecordingError::Line { hint, .. } => hint,
            RecordingError::Twice { .. } => {
                "ids must be different for different people: if another column tells them apart, name it with \
                 the option `columns`"
            }
            RecordingError::UnknownRate { .. } => {
                "give the rate with the option `fps`: for most recordings by camera 16, 25 or 30"
            }
            RecordingError::Database { .. } => {
                "read are JuPedSim's databases, with the tables trajectory_data (frame, id, pos_x, pos_y) and metadata"
            }
            RecordingError::Option { option: "columns", .. } => {
                "name the columns in order with the option `columns = \"id,frame,x,y\"`, - for an unused one"
            }
            RecordingError::Empty { .. } => LINES,
            RecordingError::Unreadable { hint, .. } => hint,
            RecordingError::Interrupted(_) | RecordingError::Option { .. } => return None,
        };
        (!text.is_empty()).then(|| text.to_owned())
    }
}
