use crate::motion::MotionError;
use crate::progress::Interrupted;
use std::fmt;
use std::path::PathBuf;

/// A place in a unit's file.
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

/// Why units cannot be cut or used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum UnitsError {
    /// A file or folder cannot be read.
    #[error("cannot read {}: {problem}", path.display())]
    Unreadable {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
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
        /// Where.
        at: UnitAt,
        /// What the parser says.
        message: String,
    },
    /// Something that nobody can do, or that a unit cannot hold.
    #[error("{at}: {problem}")]
    Value {
        /// Where.
        at: UnitAt,
        /// What is wrong, with the value and what is allowed.
        problem: String,
    },
    /// Two units of one name.
    #[error("{} and {} both hold a unit called \"{name}\"", first.display(), second.display())]
    SameName {
        /// The name.
        name: String,
        /// A file.
        first: PathBuf,
        /// The other file.
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
        /// The spot, metres.
        x: f64,
        /// The spot, metres.
        y: f64,
        /// Why.
        reason: String,
    },
    /// The motion cannot go on, or cannot be held.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The user stopped the work.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

impl UnitsError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            UnitsError::Unreadable { .. } | UnitsError::NoUnits { .. } => {
                "name a folder with unit files; `trodden motion units RECORDING --at x,y --towards x,y -o FOLDER` makes \
                 one; without a folder the built-in units are used"
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
                "choose a spot that people pass, a shorter --least-seconds, or a smaller --apart"
            }
            UnitsError::Motion(error) => return error.hint(),
            UnitsError::Number { .. } | UnitsError::Interrupted(_) => return None,
        };
        Some(hint.to_string())
    }
}
