use std::fmt;
use std::path::PathBuf;

use crate::motion::MotionError;
use crate::progress::Interrupted;

/// A location in a unit file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitAt {
    /// The file.
    pub file: PathBuf,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

impl fmt::Display for UnitAt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.file.display(), self.line, self.column)
    }
}

/// Errors of crowd units.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum UnitsError {
    /// A file or folder cannot be read.
    #[error("cannot read {}: {problem}", path.display())]
    Unreadable {
        /// The file or folder.
        path: PathBuf,
        /// The system's message.
        problem: String,
    },
    /// A folder without any unit.
    #[error("{}: there is no unit (a file that ends in .toml) in this folder", folder.display())]
    NoUnits {
        /// The folder.
        folder: PathBuf,
    },
    /// Not TOML, a key that does not exist, or a value of the wrong type.
    #[error("{at}: {message}")]
    Syntax {
        /// The location.
        at: UnitAt,
        /// The parser's message.
        message: String,
    },
    /// A value out of range, or a motion that people cannot make.
    #[error("{at}: {problem}")]
    Value {
        /// The location.
        at: UnitAt,
        /// The problem, with the value and the allowed range.
        problem: String,
    },
    /// Two units of one name.
    #[error("{} and {} both hold a unit called \"{name}\"", first.display(), second.display())]
    SameName {
        /// The name.
        name: String,
        /// The first file.
        first: PathBuf,
        /// The second file.
        second: PathBuf,
    },
    /// An option out of its range.
    #[error("{name} is {value}, allowed is {low} to {high}")]
    Number {
        /// The option.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Least value allowed.
        low: f64,
        /// Largest value allowed.
        high: f64,
    },
    /// Nothing to cut at a spot.
    #[error("no unit found at [{x:.2}, {y:.2}]: {reason}")]
    NothingToCut {
        /// The spot's x, metres.
        x: f64,
        /// The spot's y, metres.
        y: f64,
        /// The reason.
        reason: String,
    },
    /// An error of the motion.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The user stopped the calculation.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

impl UnitsError {
    /// A remedy that the user can try.
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            UnitsError::Unreadable { .. } | UnitsError::NoUnits { .. } => {
                "name a folder with unit files, as cutting units out of a recording makes one; without a folder the built-in \
                 units are used"
            }
            UnitsError::Syntax { .. } => {
                "a unit has name, area = [width, depth], duration, and a [[member]] per person with path = [[t, x, y, \
                 heading in degrees], ...] and, for those who belong together, the same group"
            }
            UnitsError::Value { .. } => {
                "the viewer starts at [0, 0] and looks along +y; metres, seconds, degrees counter-clockwise from +x"
            }
            UnitsError::SameName { .. } => "give one of them another name",
            UnitsError::NothingToCut { .. } => {
                "choose a spot that people pass, a shorter least duration, or a smaller distance to others"
            }
            UnitsError::Motion(error) => return error.hint(),
            UnitsError::Number { .. } | UnitsError::Interrupted(_) => return None,
        };
        Some(hint.to_string())
    }
}
