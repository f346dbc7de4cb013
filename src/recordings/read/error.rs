use std::path::PathBuf;

use super::format::RecordingFormat;
use crate::files::FileError;
use crate::motion::SourceError;
use crate::progress::Interrupted;

/// What recordings look like.
pub(super) const LINES: &str = "a recording has a line for everybody in every frame: who, when, x, y";

/// Why a recording cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordingError {
    /// The file cannot be read.
    #[error("cannot read {}: {problem}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        problem: String,
        /// What to do about that.
        hint: &'static str,
    },
    /// Nobody is in it.
    #[error("{}: the recording is empty: {what}", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
        /// How empty it is.
        what: &'static str,
    },
    /// None of the formats.
    #[error("{}: this is no recording of people: {found}", path.display())]
    Unknown {
        /// The file.
        path: PathBuf,
        /// What it looks like.
        found: String,
        /// What to do about that.
        hint: String,
    },
    /// A line that makes no sense.
    #[error("{}, line {line}: {problem}", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// The line, from 1; in a database the row's number.
        line: u64,
        /// What is wrong, with the value.
        problem: String,
        /// What to do about that.
        hint: String,
    },
    /// Somebody is at two places at once.
    #[error(
        "{}, line {line}: {who} is at ({:.3}, {:.3}) and at ({:.3}, {:.3}) at {moment}",
        path.display(), places[0][0], places[0][1], places[1][0], places[1][1]
    )]
    Twice {
        /// The file.
        path: PathBuf,
        /// The line of the second place.
        line: u64,
        /// Who it is.
        who: String,
        /// When, as the file counts.
        moment: String,
        /// Both places, in the file's own unit.
        places: [[f64; 2]; 2],
    },
    /// The file counts frames, and nothing tells how many make a second.
    #[error("{}: nothing tells how many frames make a second", path.display())]
    UnknownRate {
        /// The file.
        path: PathBuf,
    },
    /// The database is damaged, or another program's.
    #[error("{}: {problem}", path.display())]
    Database {
        /// The file.
        path: PathBuf,
        /// What SQLite says, or what is missing.
        problem: String,
    },
    /// The user stopped the reading.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
    /// An option is out of range.
    #[error("{option} = {value}: {allowed}")]
    Option {
        /// Which.
        option: &'static str,
        /// What was asked for.
        value: String,
        /// What is allowed.
        allowed: String,
    },
    /// The file's name says nothing of its format.
    #[error("{}: a motion is written to a file whose name ends in {endings}", path.display())]
    UnknownEnding {
        /// The file.
        path: PathBuf,
        /// The endings that are known.
        endings: String,
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
        /// Frames per second that were asked for.
        fps: f64,
        /// Least allowed.
        low: f64,
        /// Most allowed.
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
    /// What the user can do about it.
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
