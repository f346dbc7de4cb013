use std::fmt;
use std::path::PathBuf;

use super::{Cause, ImportError};

/// A place in a `patterns.toml`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ListedAt {
    /// The listing.
    pub file: PathBuf,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

impl fmt::Display for ListedAt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.file.display(), self.line, self.column)
    }
}

/// Why a pattern library cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PatternsError {
    /// The folder has no `patterns.toml`, or it cannot be read.
    #[error("cannot read the pattern list {}: {source}", .file.display())]
    Listing {
        /// The listing.
        file: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The listing is far too large to be one.
    #[error("the pattern list {} has {bytes} bytes, allowed are {most}", .file.display())]
    ListingTooLarge {
        /// The listing.
        file: PathBuf,
        /// Its size.
        bytes: u64,
        /// The limit.
        most: u64,
    },
    /// Not TOML, a key that does not exist, or a value of the wrong type.
    #[error("{at}: {message}")]
    Syntax {
        /// Where.
        at: ListedAt,
        /// What the parser says.
        message: String,
    },
    /// A number beyond what it may be.
    #[error("{at}: {key} is {value}, allowed is {allowed}")]
    Value {
        /// Where.
        at: ListedAt,
        /// Which key.
        key: &'static str,
        /// What it is.
        value: String,
        /// What it may be.
        allowed: String,
    },
    /// More patterns than marks can name.
    #[error("{} lists {count} patterns, allowed are {most}", .file.display())]
    TooMany {
        /// The listing.
        file: PathBuf,
        /// How many it lists.
        count: usize,
        /// The limit.
        most: usize,
    },
    /// An image that is missing or cannot be decoded.
    #[error("{at}: cannot read the image {}: {reason}", .image.display())]
    Image {
        /// Where it is listed.
        at: ListedAt,
        /// The image.
        image: PathBuf,
        /// What the system or the decoder says.
        reason: String,
    },
    /// An image that can be read but is no pattern.
    #[error("{at}: {} {problem}", .image.display())]
    Unfit {
        /// Where it is listed.
        at: ListedAt,
        /// The image.
        image: PathBuf,
        /// What is wrong, with the value and the allowed range.
        problem: String,
    },
    /// Nobody can walk without soles.
    #[error("{} lists no pattern with cause = \"{}\"", .file.display(), .cause.name())]
    NoneOf {
        /// The listing.
        file: PathBuf,
        /// What is missing.
        cause: Cause,
    },
    /// No pattern can be taken from a photograph.
    #[error(transparent)]
    Import(#[from] ImportError),
}

impl PatternsError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            PatternsError::Listing { .. } => {
                "a pattern library is a folder with a patterns.toml and the images that it lists; leave the folder \
                 out to use the built-in library"
            }
            PatternsError::Syntax { .. } | PatternsError::NoneOf { .. } => {
                "each pattern is a table [[pattern]] with file, cause (sole, heel, hand, arm, shoulder, bag or shoe), \
                 length_cm and share, and, if you like, form, lengths_cm = [from, to] and description"
            }
            PatternsError::Image { .. } => "file is a path relative to patterns.toml; PNG, JPEG, TIFF and BMP are read",
            PatternsError::Unfit { .. } => {
                "a pattern is cut out to its shape: white leaves soil, black leaves none, toes or the drag to the right, \
                 a left foot, 10 px per centimetre of length_cm (finer is reduced)"
            }
            PatternsError::Import(error) => return error.hint(),
            PatternsError::ListingTooLarge { .. } | PatternsError::Value { .. } | PatternsError::TooMany { .. } => {
                return None;
            }
        };
        Some(hint.to_owned())
    }
}
