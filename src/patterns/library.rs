//! Loads libraries and chooses from them.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::decode::{self, Refused};
use super::listing::{self, Entry};
use super::{Cause, Pattern, PatternLibrary, PatternsError};

/// Name of the list within a library's folder.
const LISTING: &str = "patterns.toml";
/// Most bytes of a listing, and of an image.
const MOST_LISTING_BYTES: u64 = 4 << 20;
const MOST_IMAGE_BYTES: u64 = 256 << 20;

/// The files of `patterns/`, compiled in so that an installed program needs no folder.
macro_rules! built_in {
    ($($file:literal),* $(,)?) => {
        &[$(($file, include_bytes!(concat!("../../patterns/", $file)))),*]
    };
}

const BUILT_IN_LISTING: &str = include_str!("../../patterns/patterns.toml");
const BUILT_IN: &[(&str, &[u8])] = built_in![
    "leather_shoe.png",
    "court_trainer.png",
    "running_shoe.png",
    "boot.png",
    "high_heel.png",
    "sandal.png",
    "loafer.png",
    "canvas_shoe.png",
    "ballerina.png",
    "child_shoe.png",
    "heel_arc.png",
    "heel_hook.png",
    "heel_skid.png",
    "heel_streak.png",
    "heel_dash.png",
    "heel_pair.png",
    "heel_sweep.png",
    "heel_flick.png",
];

impl PatternLibrary {
    /// The library that comes with the program: ten soles and eight heel marks, drawn by
    /// `examples/draw_patterns`.
    ///
    /// # Errors
    /// None in a program that passes its tests; the signature is that of [`PatternLibrary::load`].
    pub fn built_in() -> Result<PatternLibrary, PatternsError> {
        let open = |file: &str| {
            let found = BUILT_IN.iter().find(|(name, _)| *name == file);
            found.map(|(_, bytes)| bytes.to_vec()).ok_or_else(|| io::Error::from(io::ErrorKind::NotFound))
        };
        read(BUILT_IN_LISTING, Path::new("built-in patterns"), open)
    }

    /// The library in a folder, or the built-in one.
    ///
    /// # Errors
    /// As [`PatternLibrary::load`].
    pub fn open(folder: Option<&Path>) -> Result<PatternLibrary, PatternsError> {
        folder.map_or_else(PatternLibrary::built_in, PatternLibrary::load)
    }

    /// Loads a folder: its `patterns.toml` and the images that it lists.
    ///
    /// ```toml
    /// [[pattern]]
    /// file = "clog.png"             # relative to the folder; white leaves soil, toes to the right, a left foot
    /// cause = "sole"                # or "heel"
    /// length_cm = 28.5              # real length of what the image shows, along its width
    /// share = 0.1                   # how often it occurs among those of its cause
    /// lengths_cm = [22.0, 27.0]     # lengths of sole that wear it; left out: all
    /// description = "a wooden clog"
    /// ```
    ///
    /// Images of any resolution from 4 to 200 px/cm are brought to 10 px/cm by area.
    ///
    /// # Errors
    /// A listing that is missing, too large, not TOML, has unknown keys or values out of range; an image that is
    /// missing, empty, too large, of another shape or resolution than `length_cm` says, or that shows nothing; no
    /// sole at all. Messages name line and column of the listing.
    pub fn load(folder: &Path) -> Result<PatternLibrary, PatternsError> {
        let file = folder.join(LISTING);
        let text = read_limited(&file, MOST_LISTING_BYTES).map_err(|error| match error {
            Unread::TooLarge(bytes) => {
                PatternsError::ListingTooLarge { file: file.clone(), bytes, most: MOST_LISTING_BYTES }
            }
            Unread::Io(source) => PatternsError::Listing { file: file.clone(), source },
        })?;
        let text = String::from_utf8(text).map_err(|_| PatternsError::Listing {
            file: file.clone(),
            source: io::Error::new(io::ErrorKind::InvalidData, "it is not UTF-8 text"),
        })?;
        read(&text, folder, |image| {
            read_limited(&folder.join(image), MOST_IMAGE_BYTES).map_err(|error| match error {
                Unread::TooLarge(bytes) => {
                    io::Error::other(format!("it has {bytes} bytes, allowed are {MOST_IMAGE_BYTES}"))
                }
                Unread::Io(source) => source,
            })
        })
    }

    /// Chooses among the patterns of a cause by share: `draw` is uniform in `[0, 1)`. With a sole length only those
    /// count that are worn at that length; where there is none, the one whose range is nearest.
    ///
    /// Returns the pattern's place in [`PatternLibrary::patterns`], or `None` if there is none of the cause.
    pub fn pick(&self, cause: Cause, draw: f64, sole_length_cm: Option<f64>) -> Option<u16> {
        let off = |pattern: &Pattern| match (sole_length_cm, pattern.lengths_cm) {
            (Some(length), Some([from, to])) => (from - length).max(length - to).max(0.0),
            _ => 0.0,
        };
        let of_cause = || self.patterns.iter().enumerate().filter(|(_, pattern)| pattern.cause == cause);
        let least = of_cause().map(|(_, pattern)| off(pattern)).fold(f64::INFINITY, f64::min);
        let worn = || of_cause().filter(|(_, pattern)| off(pattern) <= least);
        let total: f64 = worn().map(|(_, pattern)| pattern.share).sum();
        let mut left = draw * total;
        let mut chosen = None;
        for (place, pattern) in worn() {
            chosen = u16::try_from(place).ok();
            left -= pattern.share;
            if left < 0.0 {
                break;
            }
        }
        chosen
    }
}

/// Makes a library of a listing's text; `open` gives the bytes of the images.
fn read(
    text: &str,
    folder: &Path,
    open: impl Fn(&str) -> io::Result<Vec<u8>>,
) -> Result<PatternLibrary, PatternsError> {
    let entries = listing::parse(text, &folder.join(LISTING))?;
    let totals = Cause::ALL.map(|cause| entries.iter().filter(|e| e.cause == cause).map(|e| e.share).sum::<f64>());
    let mut patterns = Vec::with_capacity(entries.len());
    for entry in entries {
        let total = totals[entry.cause as usize];
        patterns.push(pattern(entry, total, folder, &open)?);
    }
    Ok(PatternLibrary { patterns })
}

fn pattern(
    entry: Entry,
    total_share: f64,
    folder: &Path,
    open: impl Fn(&str) -> io::Result<Vec<u8>>,
) -> Result<Pattern, PatternsError> {
    let path = folder.join(&entry.file);
    let unreadable = |reason: String| PatternsError::Image { at: entry.listed_at.clone(), image: path.clone(), reason };
    let bytes = open(&entry.file).map_err(|error| unreadable(error.to_string()))?;
    let coverage = decode::read(&bytes, entry.length_cm).map_err(|refused| match refused {
        Refused::Unreadable(reason) => unreadable(reason),
        Refused::Unfit(problem) => PatternsError::Unfit { at: entry.listed_at.clone(), image: path.clone(), problem },
    })?;
    let stem = Path::new(&entry.file).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    Ok(Pattern {
        name: stem.unwrap_or(entry.file),
        description: entry.description,
        cause: entry.cause,
        length_cm: entry.length_cm,
        share: entry.share / total_share,
        lengths_cm: entry.lengths_cm,
        width_px: coverage.width_px,
        height_px: coverage.height_px,
        coverage: coverage.values,
    })
}

/// Why a file was not read.
enum Unread {
    TooLarge(u64),
    Io(io::Error),
}

fn read_limited(path: &Path, most: u64) -> Result<Vec<u8>, Unread> {
    let file = File::open(path).map_err(Unread::Io)?;
    let bytes = file.metadata().map_err(Unread::Io)?.len();
    if bytes > most {
        return Err(Unread::TooLarge(bytes));
    }
    let mut content = Vec::new();
    // The limit again: a device or a pipe has no length of its own.
    file.take(most + 1).read_to_end(&mut content).map_err(Unread::Io)?;
    if content.len() as u64 > most { Err(Unread::TooLarge(content.len() as u64)) } else { Ok(content) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    const ENTRY: &str = "[[pattern]]\nfile = \"boot.png\"\ncause = \"sole\"\nlength_cm = 31.0\nshare = 1.0\n";

    fn library_of(listing: &str) -> Result<PatternLibrary, PatternsError> {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(LISTING), listing).unwrap();
        for (name, bytes) in BUILT_IN {
            fs::write(folder.path().join(name), bytes).unwrap();
        }
        PatternLibrary::load(folder.path())
    }

    fn message_of(listing: &str) -> String {
        library_of(listing).map(|_| ()).unwrap_err().to_string()
    }

    #[test]
    fn the_built_in_library_holds_ten_soles_and_eight_heel_marks() {
        let library = PatternLibrary::built_in().unwrap();
        let count = |cause| library.patterns.iter().filter(|pattern| pattern.cause == cause).count();
        assert_eq!((count(Cause::Sole), count(Cause::Heel)), (10, 8));
        assert_eq!(library.patterns.len(), BUILT_IN.len(), "an image is compiled in but not listed");
        for pattern in &library.patterns {
            assert_eq!(f64::from(pattern.width_px), pattern.length_cm * 10.0, "{}", pattern.name);
            assert_eq!(pattern.coverage.len(), (pattern.width_px * pattern.height_px) as usize);
            assert!(!pattern.description.is_empty());
        }
    }

    #[test]
    fn a_folder_gives_what_is_compiled_in() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("patterns");
        let (loaded, built_in) = (PatternLibrary::load(&folder).unwrap(), PatternLibrary::built_in().unwrap());
        for (a, b) in loaded.patterns.iter().zip(&built_in.patterns) {
            assert_eq!((&a.name, &a.coverage), (&b.name, &b.coverage));
        }
    }

    #[test]
    fn soles_are_picked_by_share_and_length() {
        let library = PatternLibrary::built_in().unwrap();
        let draws = 10_000;
        let mut counts = vec![0.0; library.patterns.len()];
        for n in 0..draws {
            let draw = (f64::from(n) + 0.5) / f64::from(draws);
            let place = library.pick(Cause::Sole, draw, None).unwrap();
            counts[usize::from(place)] += 1.0 / f64::from(draws);
        }
        for (pattern, count) in library.patterns.iter().zip(counts) {
            let expected = if pattern.cause == Cause::Sole { pattern.share } else { 0.0 };
            assert!((count - expected).abs() < 2e-4, "{}: {count} instead of {expected}", pattern.name);
        }
        let named =
            |draw, length| &library.patterns[usize::from(library.pick(Cause::Sole, draw, length).unwrap())].name;
        for n in 0..100 {
            assert_ne!(named(f64::from(n) / 100.0, Some(29.5)), "child_shoe");
            assert_eq!(named(f64::from(n) / 100.0, Some(19.5)), "child_shoe");
        }
        assert_eq!(named(0.5, Some(5.0)), "child_shoe", "nearest range when none fits");
    }

    #[test]
    fn errors_name_line_and_column() {
        let at = |listing: &str, expected: &str| {
            let message = message_of(listing);
            assert!(message.contains(expected), "{message}\nshould hold\n{expected}");
        };
        at(&ENTRY.replace("share = 1.0", "share = -1.0"), "patterns.toml:5:9: share is -1, allowed is above 0");
        at(&ENTRY.replace("share = 1.0", "share = nan"), "patterns.toml:5:9: share is NaN");
        at(&ENTRY.replace("31.0", "310.0"), "patterns.toml:4:13: length_cm is 310, allowed is 8 to 45");
        at(&ENTRY.replace("sole", "elbow"), "patterns.toml:3:9: unknown variant `elbow`, expected `sole` or `heel`");
        at(&ENTRY.replace("share", "chance"), "patterns.toml:5:1: unknown field `chance`");
        at(&ENTRY.replace("share = 1.0", ""), "missing field `share`");
        at(&format!("{ENTRY}lengths_cm = [30.0, 20.0]\n"), "patterns.toml:6:14: lengths_cm is [30, 20]");
        at(&ENTRY.replace("boot", "shoes/bot"), "patterns.toml:2:8: cannot read the image");
        at(&ENTRY.replace("boot", "heel_arc"), "patterns.toml:2:8");
        at("", "lists no pattern with cause = \"sole\"");
        at("[[pattern]", "patterns.toml:1:");
        at(&ENTRY.repeat(1001), "lists 1001 patterns, allowed are 1000");
    }

    #[test]
    fn a_missing_folder_and_a_binary_listing_are_errors() {
        let error = PatternLibrary::load(Path::new("/no/such/folder")).unwrap_err();
        assert!(error.to_string().contains("/no/such/folder/patterns.toml"), "{error}");
        assert!(error.hint().unwrap().contains("built-in"));
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(LISTING), [0xff, 0xfe, 0x00]).unwrap();
        assert!(PatternLibrary::load(folder.path()).unwrap_err().to_string().contains("UTF-8"));
    }
}
