use std::fmt;
use std::path::PathBuf;

use super::LOOK_PRESETS;

/// Why the `look` stage cannot go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LookError {
    /// The look file cannot be read.
    #[error("cannot read the look file {path}: {source}", path = .path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// Not TOML, a key that does not exist, or a value of the wrong type.
    #[error("{place}: {message}")]
    Syntax {
        /// Where.
        place: FilePlace,
        /// What is wrong there.
        message: String,
    },
    /// A preset that does not exist.
    #[error("{}there is no look preset {name:?}; there are {}", at(.place), LOOK_PRESETS.join(", "))]
    UnknownPreset {
        /// What was asked for.
        name: String,
        /// Where, if it came from a file.
        place: Option<FilePlace>,
    },
    /// A number beyond what is allowed.
    #[error("{}{range}", at(.place))]
    Range {
        /// Which key, which value, which range.
        range: RangeError,
        /// Where, if it came from a file.
        place: Option<FilePlace>,
    },
    /// The repeated image of a floor or a wall cannot be used.
    #[error("cannot use the image {path}: {message}", path = .path.display())]
    Image {
        /// The image.
        path: PathBuf,
        /// What is wrong with it.
        message: String,
    },
    /// Sums that were made for other walls.
    #[error("the sums are those of {summed} wall faces, but the plan has {faces}")]
    OtherWalls {
        /// Faces of the plan.
        faces: usize,
        /// Faces of the sums.
        summed: usize,
    },
    /// Sums of nobody stand for no history.
    #[error("the sums hold no simulated people; a history of {total_passes} passes needs at least one")]
    NoPeople {
        /// What the look asks for.
        total_passes: u64,
    },
}

/// A place in a look file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilePlace {
    /// The file.
    pub path: PathBuf,
    /// Line, from 1 on.
    pub line: usize,
    /// Column in characters, from 1 on.
    pub column: usize,
}

/// A setting out of its range.
#[derive(Clone, Debug, PartialEq)]
pub struct RangeError {
    /// The key with its sections, as in `film.density`.
    pub key: &'static str,
    /// Its value.
    pub value: f64,
    /// Least value allowed.
    pub low: f64,
    /// Largest value allowed.
    pub high: f64,
}

impl fmt::Display for FilePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.path.display(), self.line, self.column)
    }
}

impl fmt::Display for RangeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let RangeError { key, value, low, high } = self;
        write!(f, "{key} is {value}, allowed is {low} to {high}")
    }
}

fn at(place: &Option<FilePlace>) -> String {
    place.as_ref().map_or(String::new(), |place| format!("{place}: "))
}

impl LookError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            LookError::UnknownPreset { name, .. } => {
                let nearest = LOOK_PRESETS.iter().min_by_key(|known| strsim::levenshtein(known, name))?;
                (strsim::levenshtein(nearest, name) <= 3).then(|| format!("did you mean {nearest:?}?"))
            }
            LookError::Image { .. } => Some(
                "give a PNG, JPEG, BMP, PGM, TIFF or GIF, at most 16384 px a side, as a path relative to the look file"
                    .to_string(),
            ),
            LookError::Syntax { .. } => Some("keys that are left out keep the preset's value".to_string()),
            LookError::OtherWalls { .. } => Some("bake the plan again".to_string()),
            LookError::NoPeople { .. } => Some("bake with --people 1 or more".to_string()),
            LookError::Unreadable { .. } | LookError::Range { .. } => None,
        }
    }
}
