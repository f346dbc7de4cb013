//! Reads a library from a folder of one's own.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

use super::{Cause, PatternLibrary, PatternsError, library};
use crate::files::open_input;

/// Name of the list within a library's folder.
pub(super) const LISTING: &str = "patterns.toml";
/// Most bytes of a listing, and of an image.
pub(super) const MOST_LISTING_BYTES: u64 = 4 << 20;
const MOST_IMAGE_BYTES: u64 = 256 << 20;
/// Endings of the images that a folder may hold.
const ENDINGS: [&str; 6] = ["png", "jpg", "jpeg", "tif", "tiff", "bmp"];

/// A folder with a `patterns.toml`, and what the folder says about it.
#[derive(Clone, Debug)]
pub struct PatternFolder {
    /// Its own patterns, in the order of its listing, then those that are borrowed.
    pub library: PatternLibrary,
    /// How many of them are its own.
    pub own: usize,
    /// Causes that it does not list, whose built-in patterns are used, so that soles of one's own do not cost one the
    /// walls. Heel marks are not borrowed by a folder that lists soles: it goes without.
    pub borrowed: Vec<Cause>,
    /// Images that lie in the folder but are not listed, relative to it, by name: most likely forgotten.
    pub unlisted: Vec<PathBuf>,
}

impl PatternFolder {
    /// Reads a folder.
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
            let built_in = PatternLibrary::built_in()?.patterns;
            library.patterns.extend(built_in.into_iter().filter(|pattern| borrowed.contains(&pattern.cause)));
        }
        Ok(PatternFolder { library, own, borrowed, unlisted: unlisted(folder, &listed) })
    }
}

/// The causes that a folder leaves to the built-in library.
fn missing(library: &PatternLibrary) -> Vec<Cause> {
    let lists = |cause| library.patterns.iter().any(|pattern| pattern.cause == cause);
    // Soles without heel marks are meant so: a floor on which nothing drags. Nobody walks without soles.
    let is_missing = |&cause: &Cause| !(lists(cause) || cause == Cause::Heel && lists(Cause::Sole));
    Cause::ALL.into_iter().filter(is_missing).collect()
}

/// The text of a folder's listing.
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

/// The bytes of an image, unless there are far too many.
pub(super) fn image_bytes(path: &Path) -> io::Result<Vec<u8>> {
    read_limited(path, MOST_IMAGE_BYTES).map_err(|error| match error {
        Unread::TooLarge(bytes) => io::Error::other(format!("it has {bytes} bytes, allowed are {MOST_IMAGE_BYTES}")),
        Unread::Io(source) => source,
    })
}

/// Images in the folders from which a listing takes any that it does not list. A folder that cannot be looked through
/// has none.
fn unlisted(folder: &Path, listed: &BTreeSet<PathBuf>) -> Vec<PathBuf> {
    let mut places: BTreeSet<&Path> = listed.iter().filter_map(|image| image.parent()).collect();
    places.insert(Path::new(""));
    // What lies outside the folder is somebody else's.
    places.retain(|place| place.components().all(|part| matches!(part, Component::Normal(_))));
    let mut found = BTreeSet::new();
    for place in places {
        for entry in fs::read_dir(folder.join(place)).into_iter().flatten().flatten() {
            let name = PathBuf::from(entry.file_name());
            let is_image = name
                .extension()
                .and_then(|ending| ending.to_str())
                .is_some_and(|ending| ENDINGS.contains(&ending.to_ascii_lowercase().as_str()));
            let is_hidden = name.to_string_lossy().starts_with('.');
            let path = place.join(name);
            if is_image && !is_hidden && !listed.contains(&path) && entry.path().is_file() {
                found.insert(path);
            }
        }
    }
    found.into_iter().collect()
}

/// Why a file was not read.
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
    // The limit again: some files of the system have no length of their own.
    file.take(most + 1).read_to_end(&mut content).map_err(Unread::Io)?;
    if content.len() as u64 > most { Err(Unread::TooLarge(content.len() as u64)) } else { Ok(content) }
}
