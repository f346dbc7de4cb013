use std::fmt;
use std::path::PathBuf;

use super::{Cause, ImportError};

/// Position in a `patterns.toml`.
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

/// Error in a pattern library.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PatternsError {
    /// The folder has no `patterns.toml`, or it cannot be read.
    #[error("cannot read the pattern list {}: {source}", .file.display())]
    Listing {
        /// The listing.
        file: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// The listing is too large.
    #[error("the pattern list {} has {bytes} bytes, allowed are {most}", .file.display())]
    ListingTooLarge {
        /// The listing.
        file: PathBuf,
        /// Size of the listing.
        bytes: u64,
        /// The limit.
        most: u64,
    },
    /// The listing is not TOML, has an unknown key or a value of the wrong type.
    #[error("{at}: {message}")]
    Syntax {
        /// Position in the listing.
        at: ListedAt,
        /// Message of the parser.
        message: String,
    },
    /// A value is out of range.
    #[error("{at}: {key} is {value}, allowed is {allowed}")]
    Value {
        /// Position in the listing.
        at: ListedAt,
        /// Key in the listing.
        key: &'static str,
        /// The value.
        value: String,
        /// Allowed values.
        allowed: String,
    },
    /// The listing has too many patterns.
    #[error("{} lists {count} patterns, allowed are {most}", .file.display())]
    TooMany {
        /// The listing.
        file: PathBuf,
        /// Number of patterns.
        count: usize,
        /// The limit.
        most: usize,
    },
    /// An image is missing or cannot be decoded.
    #[error("{at}: cannot read the image {}: {reason}", .image.display())]
    Image {
        /// Position in the listing.
        at: ListedAt,
        /// The image.
        image: PathBuf,
        /// Message of the operating system or the decoder.
        reason: String,
    },
    /// An image is decoded but is not a pattern.
    #[error("{at}: {} {problem}", .image.display())]
    Unfit {
        /// Position in the listing.
        at: ListedAt,
        /// The image.
        image: PathBuf,
        /// The problem, with the value and the allowed range.
        problem: String,
    },
    /// The listing has no pattern of a cause that is needed.
    #[error("{} lists no pattern with cause = \"{}\"", .file.display(), .cause.name())]
    MissingCause {
        /// The listing.
        file: PathBuf,
        /// The missing cause.
        cause: Cause,
    },
    /// A photograph cannot be imported.
    #[error(transparent)]
    Import(#[from] ImportError),
}

impl PatternsError {
    /// Hint for the user.
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            PatternsError::Listing { .. } => {
                "a pattern library is a folder with a patterns.toml and the images that it lists; leave the folder \
                 out to use the built-in library"
            }
            PatternsError::Syntax { .. } | PatternsError::MissingCause { .. } => {
                "each pattern is a table [[pattern]] with file, cause (sole, heel, hand, arm, shoulder, bag or shoe), \
                 length_cm and share, and optionally form, lengths_cm = [from, to] and description"
            }
            PatternsError::Image { .. } => "file is a path relative to patterns.toml; PNG, JPEG, TIFF and BMP are read",
            PatternsError::Unfit { .. } => {
                "a pattern is cut out to its shape: white leaves soil, black leaves none; toes or the drag point to the \
                 right; a sole is a left foot; 10 px per centimetre of length_cm (finer images are reduced)"
            }
            PatternsError::Import(error) => return error.hint(),
            PatternsError::ListingTooLarge { .. } | PatternsError::Value { .. } | PatternsError::TooMany { .. } => {
                return None;
            }
        };
        Some(hint.to_owned())
    }
}
