//! The pattern library: images of single stains, sorted by cause, with their real size and share.
//!
//! A library is a folder with `patterns.toml` and the images that it lists. White leaves full soil, black leaves
//! none. Toes, or the direction of a drag, point to the right. A sole is a **left** foot as its print lies on the
//! floor, with the big toe below. Wall patterns are upright, as seen by a viewer of the wall.
//! [`PatternLibrary::built_in`] is compiled in.

mod cause;
mod contact_sheet;
mod decode;
mod error;
mod folder;
pub(crate) mod font;
mod import;
mod library;
mod listing;
mod pattern;

pub use cause::{Cause, Form};
pub use contact_sheet::contact_sheet;
pub(crate) use contact_sheet::side_by_side;
pub use error::{ListedAt, PatternsError};
pub use folder::PatternFolder;
pub use import::{
    ImportEntry, ImportError, ImportOptions, ImportedPattern, PhotoScale, SavedPattern, import_picture, name_of_photo,
};
pub(crate) use import::{PixelRaster, decode_photo, quantile};
pub use library::PatternLibrary;
pub(crate) use pattern::PATTERN_PX_PER_CM;
pub use pattern::Pattern;
