use std::fmt;
use std::path::PathBuf;

use super::LOOK_PRESETS;
use crate::options::OptionError;
use crate::patterns::ImportError;

/// Errors of the `look` stage.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LookError {
    /// The look file cannot be read.
    #[error("cannot read the look file {path}: {source}", path = .path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// Invalid TOML, an unknown key, or a value of the wrong type.
    #[error("{place}: {message}")]
    Syntax {
        /// Position of the error.
        place: FilePlace,
        /// Description of the error.
        message: String,
        /// What to write instead.
        hint: Option<String>,
    },
    /// The look has an unknown preset.
    #[error("{}there is no look preset {name:?}; there are {}", at(.place), LOOK_PRESETS.join(", "))]
    UnknownPreset {
        /// The unknown name.
        name: String,
        /// Position of the value, if it is from a file.
        place: Option<FilePlace>,
    },
    /// A number beyond what is allowed.
    #[error("{}{error}", at(.place))]
    Option {
        /// Which key, which value, which range.
        error: OptionError,
        /// Place of the value, if it came from a file.
        place: Option<FilePlace>,
    },
    /// The image of a floor or wall cannot be used.
    #[error("cannot use the image {path}: {message}", path = .path.display())]
    Image {
        /// The image.
        path: PathBuf,
        /// Description of the error.
        message: String,
    },
    /// The photograph of a floor cannot be read.
    #[error("{path}: {source}", path = .path.display())]
    Photo {
        /// The photograph.
        path: PathBuf,
        /// Description of the error.
        source: ImportError,
    },
    /// A look cannot be measured in the photograph of a floor.
    #[error("{path}: {message}", path = .path.display())]
    Fit {
        /// The photograph.
        path: PathBuf,
        /// Description of the error.
        message: String,
        /// What to do.
        hint: &'static str,
    },
    /// An area of the floor has neither an outline nor a room.
    #[error("look.area {number} has an outline of {corners} corners and no room")]
    NoOutline {
        /// Number of the area, from 1.
        number: usize,
        /// Number of corners.
        corners: usize,
    },
    /// The place of an area's room is not on the floor.
    #[error("look.area {number}: there is no floor at ({}, {}) m", place_m[0], place_m[1])]
    NotInRoom {
        /// Number of the area, from 1.
        number: usize,
        /// The place, metres.
        place_m: [f64; 2],
    },
    /// The sums belong to other walls.
    #[error("the sums are those of {summed} wall faces, but the plan has {faces}")]
    OtherWalls {
        /// Number of faces in the plan.
        faces: usize,
        /// Number of faces in the sums.
        summed: usize,
    },
    /// The sums have no simulated people.
    #[error("the sums hold no simulated people; a history of {total_passes} passes needs at least one")]
    NoPeople {
        /// Total passes of the look.
        total_passes: u64,
    },
}

/// A position in a look file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilePlace {
    /// The file.
    pub path: PathBuf,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

impl fmt::Display for FilePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.path.display(), self.line, self.column)
    }
}

fn at(place: &Option<FilePlace>) -> String {
    place.as_ref().map_or(String::new(), |place| format!("{place}: "))
}

impl LookError {
    /// Returns the remedy, for the user.
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
            LookError::Photo { source: ImportError::Size { .. }, .. } => {
                Some("photograph the floor with 32 px a side at least, 64 million in all".to_string())
            }
            LookError::Photo { source, .. } => source.hint(),
            LookError::Fit { hint, .. } => Some(hint.to_string()),
            LookError::NoOutline { .. } => Some(
                "give outline = [[2.0, 1.0], [6.5, 4.0]] (two opposite corners, or three and more in a row, metres), or \
                 room = [3.0, 2.5]"
                    .to_string(),
            ),
            LookError::NotInRoom { .. } => {
                Some("give a place in the room, in metres from the plan's lower left corner".to_string())
            }
            LookError::Syntax { hint, .. } => {
                hint.clone().or_else(|| Some("keys that are left out keep the preset's value".to_string()))
            }
            LookError::OtherWalls { .. } => Some("bake the plan again".to_string()),
            LookError::NoPeople { .. } => Some("bake a crowd of at least one person".to_string()),
            LookError::Unreadable { .. } | LookError::Option { .. } => None,
        }
    }
}
