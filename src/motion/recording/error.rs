use std::path::PathBuf;

use super::rows::LINES;

/// Why a recording cannot be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
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
    /// Somebody asked to stop.
    #[error("reading {} was interrupted", path.display())]
    Interrupted {
        /// The file.
        path: PathBuf,
    },
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
}

impl RecordingError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        let text = match self {
            RecordingError::Unknown { hint, .. } | RecordingError::Line { hint, .. } => hint,
            RecordingError::Twice { .. } => {
                "ids must be different for different people: if another column tells them apart, name it with --columns"
            }
            RecordingError::UnknownRate { .. } => {
                "give the rate with --fps: for most recordings by camera 16, 25 or 30"
            }
            RecordingError::Database { .. } => {
                "read are JuPedSim's databases, with the tables trajectory_data (frame, id, pos_x, pos_y) and metadata"
            }
            RecordingError::Option { option: "columns", .. } => {
                "as --columns id,frame,x,y: a word for each column in turn, - for one that is of no use"
            }
            RecordingError::Empty { .. } => LINES,
            RecordingError::Unreadable { hint, .. } => hint,
            RecordingError::Interrupted { .. } | RecordingError::Option { .. } => return None,
        };
        (!text.is_empty()).then(|| text.to_owned())
    }
}
