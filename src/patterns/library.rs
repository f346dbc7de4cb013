//! The pattern library: the built-in one, and choosing patterns by share.

use std::io;
use std::path::Path;

use super::decode::{self, PatternImageError};
use super::listing::{self, LISTING, ListedPattern};
use super::{Cause, Form, Pattern, PatternsError};

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
    "hand_cloud.png",
    "hand_push.png",
    "hand_lean.png",
    "hand_smudge.png",
    "hand_heel.png",
    "hand_print.png",
    "hand_drag_four.png",
    "hand_drag_three.png",
    "hand_drag_two.png",
    "hand_drag_palm.png",
    "hand_drag_back.png",
    "hand_tips_four.png",
    "hand_tips_two.png",
    "hand_tips_slip.png",
    "arm_forearm.png",
    "arm_forearm_long.png",
    "arm_forearm_lean.png",
    "arm_elbow.png",
    "arm_elbow_rub.png",
    "arm_elbow_slide.png",
    "arm_sleeve.png",
    "shoulder_rub.png",
    "shoulder_pass.png",
    "shoulder_lean.png",
    "shoulder_seams.png",
    "shoulder_upper_arm.png",
    "shoulder_back.png",
    "shoulder_brush.png",
    "bag_edge.png",
    "bag_edge_long.png",
    "bag_corner.png",
    "bag_corner_hit.png",
    "bag_smear.png",
    "bag_rucksack.png",
    "bag_scrapes.png",
    "bag_bumper.png",
    "bag_wheel.png",
    "bag_strap.png",
    "shoe_toe_kick.png",
    "shoe_toe_scuff.png",
    "shoe_toe_swipe.png",
    "shoe_toe_double.png",
    "shoe_line_long.png",
    "shoe_line_short.png",
    "shoe_line_bow.png",
    "shoe_sole_edge.png",
    "shoe_sole_ball.png",
    "shoe_sole_tread.png",
    "heel_smear.png",
    "heel_pivot.png",
    "toe_drag.png",
];

/// The pattern library: coverage images by cause, with their shares.
#[derive(Clone, Debug)]
pub struct PatternLibrary {
    /// Patterns in the order of `patterns.toml`; marks refer to a pattern by its index here.
    pub patterns: Vec<Pattern>,
}

impl PatternLibrary {
    /// Returns the built-in library.
    ///
    /// It has ten soles, eleven heel marks and at least six stains of each wall cause, drawn by
    /// `examples/draw_patterns`.
    pub fn built_in() -> PatternLibrary {
        let open = |file: &str| {
            let found = BUILT_IN.iter().find(|(name, _)| *name == file);
            found.map(|(_, bytes)| bytes.to_vec()).ok_or_else(|| io::Error::from(io::ErrorKind::NotFound))
        };
        let library = read(BUILT_IN_LISTING, Path::new("built-in patterns"), open);
        library.expect("tests read the compiled-in patterns")
    }

    /// Chooses among the patterns of a cause by share; `draw` is uniform in `[0, 1)`.
    ///
    /// A sole length in centimetres limits the choice to patterns worn at that length, or to the nearest range.
    /// Returns the index in [`PatternLibrary::patterns`]; `None` without a pattern of the cause.
    pub fn pick(&self, cause: Cause, draw: f64, sole_length_cm: Option<f64>) -> Option<u16> {
        let off = |pattern: &Pattern| match (sole_length_cm, pattern.lengths_cm) {
            (Some(length), Some([from, to])) => (from - length).max(length - to).max(0.0),
            _ => 0.0,
        };
        let of_cause = || self.patterns.iter().filter(|pattern| pattern.cause == cause);
        let least = of_cause().map(off).fold(f64::INFINITY, f64::min);
        self.pick_among(draw, |pattern| pattern.cause == cause && off(pattern) <= least)
    }

    /// Chooses among the patterns of a cause and form by share; `draw` is uniform in `[0, 1)`.
    ///
    /// Without a form, or where no pattern of the cause has it, all patterns of the cause are candidates. Returns the
    /// index in [`PatternLibrary::patterns`]; `None` without a pattern of the cause.
    pub fn pick_form(&self, cause: Cause, form: Option<Form>, draw: f64) -> Option<u16> {
        let of_form =
            form.and_then(|form| self.pick_among(draw, |pattern| pattern.cause == cause && pattern.form == Some(form)));
        of_form.or_else(|| self.pick_among(draw, |pattern| pattern.cause == cause))
    }

    fn pick_among(&self, draw: f64, counts: impl Fn(&Pattern) -> bool) -> Option<u16> {
        let among = || self.patterns.iter().enumerate().filter(|(_, pattern)| counts(pattern));
        let total: f64 = among().map(|(_, pattern)| pattern.share).sum();
        let mut left = draw * total;
        let mut chosen = None;
        for (place, pattern) in among() {
            chosen = u16::try_from(place).ok();
            left -= pattern.share;
            if left < 0.0 {
                break;
            }
        }
        chosen
    }
}

/// Builds a library from the text of a listing; `open` returns the bytes of an image.
pub(super) fn read(
    text: &str,
    folder: &Path,
    mut open: impl FnMut(&str) -> io::Result<Vec<u8>>,
) -> Result<PatternLibrary, PatternsError> {
    let entries = listing::parse(text, &folder.join(LISTING))?;
    let totals = Cause::ALL.map(|cause| entries.iter().filter(|e| e.cause == cause).map(|e| e.share).sum::<f64>());
    let mut patterns = Vec::with_capacity(entries.len());
    for entry in entries {
        let total = totals[entry.cause as usize];
        patterns.push(pattern(entry, total, folder, &mut open)?);
    }
    Ok(PatternLibrary { patterns })
}

fn pattern(
    entry: ListedPattern,
    total_share: f64,
    folder: &Path,
    open: &mut impl FnMut(&str) -> io::Result<Vec<u8>>,
) -> Result<Pattern, PatternsError> {
    let path = folder.join(&entry.file);
    let unreadable = |reason: String| PatternsError::Image { at: entry.listed_at.clone(), image: path.clone(), reason };
    let bytes = open(&entry.file).map_err(|error| unreadable(error.to_string()))?;
    let coverage = decode::read(&bytes, entry.cause, entry.length_cm).map_err(|refused| match refused {
        PatternImageError::Unreadable(reason) => unreadable(reason),
        PatternImageError::Unfit(problem) => {
            PatternsError::Unfit { at: entry.listed_at.clone(), image: path.clone(), problem }
        }
    })?;
    let stem = Path::new(&entry.file).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    Ok(Pattern {
        name: stem.unwrap_or(entry.file),
        description: entry.description,
        cause: entry.cause,
        form: entry.form,
        length_cm: entry.length_cm,
        share: entry.share / total_share,
        lengths_cm: entry.lengths_cm,
        width_px: coverage.width_px,
        height_px: coverage.height_px,
        coverage: coverage.values,
    })
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
    fn the_built_in_library_holds_patterns_of_every_cause() {
        let library = PatternLibrary::built_in();
        let counts = Cause::ALL.map(|cause| library.patterns.iter().filter(|pattern| pattern.cause == cause).count());
        assert_eq!(counts, [10, 11, 14, 7, 7, 10, 10]);
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
        let (loaded, built_in) = (PatternLibrary::load(&folder).unwrap(), PatternLibrary::built_in());
        for (a, b) in loaded.patterns.iter().zip(&built_in.patterns) {
            assert_eq!((&a.name, &a.coverage), (&b.name, &b.coverage));
        }
    }

    #[test]
    fn soles_are_picked_by_share_and_length() {
        let library = PatternLibrary::built_in();
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
    fn a_form_is_picked_by_share_and_missing_forms_fall_back_to_the_cause() {
        let library = PatternLibrary::built_in();
        let draws = 10_000;
        let mut counts = vec![0.0; library.patterns.len()];
        for n in 0..draws {
            let draw = (f64::from(n) + 0.5) / f64::from(draws);
            let place = library.pick_form(Cause::Hand, Some(Form::Drag), draw).unwrap();
            counts[usize::from(place)] += 1.0 / f64::from(draws);
        }
        let dragged = |pattern: &&Pattern| pattern.form == Some(Form::Drag);
        let total: f64 = library.patterns.iter().filter(dragged).map(|pattern| pattern.share).sum();
        for (pattern, count) in library.patterns.iter().zip(counts) {
            let expected = if dragged(&pattern) { pattern.share / total } else { 0.0 };
            assert!((count - expected).abs() < 2e-4, "{}: {count} instead of {expected}", pattern.name);
        }
        let cause = |form, draw| {
            let place = library.pick_form(Cause::Arm, form, draw).unwrap();
            (place, library.patterns[usize::from(place)].cause)
        };
        for n in 0..100 {
            let draw = f64::from(n) / 100.0;
            assert_eq!(cause(Some(Form::Palm), draw), cause(None, draw));
            assert_eq!(cause(None, draw).1, Cause::Arm);
        }
        let soles = PatternLibrary { patterns: library.patterns[..10].to_vec() };
        assert_eq!(soles.pick_form(Cause::Hand, Some(Form::Palm), 0.5), None);
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
        at(
            &ENTRY.replace("sole", "elbow"),
            "patterns.toml:3:9: unknown variant `elbow`, expected one of `sole`, `heel`, ",
        );
        let shoe = ENTRY.replace("sole", "shoe");
        at(
            &format!("{shoe}form = \"palm\"\n"),
            "patterns.toml:6:8: form is \"palm\", allowed is \"toe\", \"heel_line\" or \"sole\" for cause = \"shoe\"",
        );
        at(
            &format!("{ENTRY}form = \"sole\"\n"),
            "patterns.toml:6:8: form is \"sole\", allowed is none for cause = \"sole\"",
        );
        at(&format!("{ENTRY}form = \"fist\"\n"), "patterns.toml:6:8: unknown variant `fist`");
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
