//! Reads a library from a folder.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

use super::listing::LISTING;
use super::{Cause, PatternLibrary, PatternsError, library};
use crate::files::open_input;

/// Limits on the size of a listing and of an image, bytes.
const MOST_LISTING_BYTES: u64 = 4 << 20;
const MOST_IMAGE_BYTES: u64 = 256 << 20;
/// File extensions of pattern images.
const IMAGE_EXTENSIONS: [&str; 6] = ["png", "jpg", "jpeg", "tif", "tiff", "bmp"];

/// A pattern library read from a folder, with what the folder borrows and what it leaves unlisted.
#[derive(Clone, Debug)]
pub struct PatternFolder {
    /// The folder's own patterns in the order of its listing, then the borrowed ones.
    pub library: PatternLibrary,
    /// Number of the folder's own patterns.
    pub own: usize,
    /// Causes that the folder does not list and whose built-in patterns are used. A folder that lists soles does not
    /// borrow heel marks.
    pub borrowed: Vec<Cause>,
    /// Images in the folder that are not listed, relative to it, by name: most likely forgotten.
    pub unlisted: Vec<PathBuf>,
}

impl PatternFolder {
    /// Reads a folder and completes it with built-in patterns.
    ///
    /// # Errors
    /// As [`PatternLibrary::load`].
    pub fn read(folder: &Path) -> Result<PatternFolder, PatternsError> {
        let mut listed: BTreeSet<PathBuf> = BTreeSet::new();
        let mut library = library::read(&listing_text(folder)?, folder, |image| {
            listed.insert(Path::new(image).components().filter(|part| *part != Component::CurDir).collect());
            image_bytes(&folder.join(image))
        })?;
        let own = library.patterns.len();
        let borrowed = missing(&library);
        if !borrowed.is_empty() {
            let built_in = PatternLibrary::built_in().patterns;
            library.patterns.extend(built_in.into_iter().filter(|pattern| borrowed.contains(&pattern.cause)));
        }
        Ok(PatternFolder { library, own, borrowed, unlisted: unlisted(folder, &listed) })
    }
}

impl PatternLibrary {
    /// Loads the library of a folder, or the built-in library without one.
    ///
    /// # Errors
    /// As [`PatternLibrary::load`].
    pub fn open(folder: Option<&Path>) -> Result<PatternLibrary, PatternsError> {
        folder.map_or_else(|| Ok(PatternLibrary::built_in()), PatternLibrary::load)
    }

    /// Loads the `patterns.toml` of a folder and the images that it lists.
    ///
    /// ```toml
    /// [[pattern]]
    /// file = "clog.png"             # relative to the folder; white leaves soil, toes to the right, a left foot
    /// cause = "sole"                # or heel; on walls, upright: hand, arm, shoulder, bag, shoe
    /// form = "palm"                 # hand: palm, drag, fingertips; shoe: toe, heel_line, sole; optional
    /// length_cm = 28.5              # real length of what the image shows, along its width
    /// share = 0.1                   # share among the patterns of its cause
    /// lengths_cm = [22.0, 27.0]     # sole lengths that wear it; left out: all
    /// description = "a wooden clog"
    /// ```
    ///
    /// Images of 4 to 200 px/cm are resampled to 10 px/cm by area. For a wall cause that the folder does not list, the
    /// built-in patterns are used; also for soles, and for heel marks if it lists neither. See
    /// [`PatternFolder::borrowed`].
    ///
    /// # Errors
    /// The listing is missing, too large, not TOML, or has unknown keys or values out of range; a form does not belong
    /// to its cause; an image is missing, empty, too large, of a shape or resolution that does not fit `length_cm`, or
    /// shows nothing; the listing is empty. Messages name line and column of the listing.
    pub fn load(folder: &Path) -> Result<PatternLibrary, PatternsError> {
        PatternFolder::read(folder).map(|read| read.library)
    }
}

/// The causes whose patterns come from the built-in library.
fn missing(library: &PatternLibrary) -> Vec<Cause> {
    let lists = |cause| library.patterns.iter().any(|pattern| pattern.cause == cause);
    // Soles without heel marks are deliberate: no shoe scuffs the floor. Soles are always needed.
    let is_missing = |&cause: &Cause| !(lists(cause) || cause == Cause::Heel && lists(Cause::Sole));
    Cause::ALL.into_iter().filter(is_missing).collect()
}

/// Reads the text of a folder's listing.
pub(super) fn listing_text(folder: &Path) -> Result<String, PatternsError> {
    let file = folder.join(LISTING);
    let text = read_limited(&file, MOST_LISTING_BYTES).map_err(|error| match error {
        Unread::TooLarge(bytes) => {
            PatternsError::ListingTooLarge { file: file.clone(), bytes, most: MOST_LISTING_BYTES }
        }
        Unread::Io(source) => PatternsError::Listing { file: file.clone(), source },
    })?;
    String::from_utf8(text).map_err(|_| PatternsError::Listing {
        file,
        source: io::Error::new(io::ErrorKind::InvalidData, "it is not UTF-8 text"),
    })
}

/// Reads the bytes of an image, up to the limit.
pub(super) fn image_bytes(path: &Path) -> io::Result<Vec<u8>> {
    read_limited(path, MOST_IMAGE_BYTES).map_err(|error| match error {
        Unread::TooLarge(bytes) => io::Error::other(format!("it has {bytes} bytes, allowed are {MOST_IMAGE_BYTES}")),
        Unread::Io(source) => source,
    })
}

/// Finds unlisted images in the folders that hold listed ones; unreadable folders count as empty.
fn unlisted(folder: &Path, listed: &BTreeSet<PathBuf>) -> Vec<PathBuf> {
    let mut places: BTreeSet<&Path> = listed.iter().filter_map(|image| image.parent()).collect();
    places.insert(Path::new(""));
    // Folders outside the library are not searched.
    places.retain(|place| place.components().all(|part| matches!(part, Component::Normal(_))));
    let mut found = BTreeSet::new();
    for place in places {
        for entry in fs::read_dir(folder.join(place)).into_iter().flatten().flatten() {
            let name = PathBuf::from(entry.file_name());
            let is_image = name
                .extension()
                .and_then(|extension| extension.to_str())
                .is_some_and(|extension| IMAGE_EXTENSIONS.contains(&extension.to_ascii_lowercase().as_str()));
            let is_hidden = name.to_string_lossy().starts_with('.');
            let path = place.join(name);
            if is_image && !is_hidden && !listed.contains(&path) && entry.path().is_file() {
                found.insert(path);
            }
        }
    }
    found.into_iter().collect()
}

/// Reason why a file was not read.
enum Unread {
    TooLarge(u64),
    Io(io::Error),
}

fn read_limited(path: &Path, most: u64) -> Result<Vec<u8>, Unread> {
    let file = open_input(path).map_err(Unread::Io)?;
    let bytes = file.metadata().map_err(Unread::Io)?.len();
    if bytes > most {
        return Err(Unread::TooLarge(bytes));
    }
    let mut content = Vec::new();
    // Checked again: a device or a pipe reports no length.
    file.take(most + 1).read_to_end(&mut content).map_err(Unread::Io)?;
    if content.len() as u64 > most { Err(Unread::TooLarge(content.len() as u64)) } else { Ok(content) }
}
