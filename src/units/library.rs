use std::path::{Path, PathBuf};

use super::error::UnitsError;
use super::file::LARGEST_BYTES;
use super::unit::Unit;
use crate::files::read_text;

/// The files of `floorplans/units/`, compiled in so that an installed program needs no folder.
macro_rules! built_in {
    ($($file:literal),* $(,)?) => {
        &[$(($file, include_str!(concat!("../../floorplans/units/", $file)))),*]
    };
}

const BUILT_IN: &[(&str, &str)] = built_in![
    "child_runs_ahead.toml",
    "comes_and_leaves.toml",
    "crosses.toml",
    "crosses_comes.toml",
    "drifts_across.toml",
    "family.toml",
    "family_met.toml",
    "four_come.toml",
    "four_stroll.toml",
    "greet.toml",
    "greet_comes.toml",
    "greet_leaves.toml",
    "greet_passed.toml",
    "hurries_past.toml",
    "late_notice.toml",
    "late_notice_leaves.toml",
    "lets_pass.toml",
    "lets_pass_leaves.toml",
    "lets_pass_met.toml",
    "looks_around.toml",
    "looks_around_leaves.toml",
    "looks_back.toml",
    "lost.toml",
    "lost_comes.toml",
    "overtakes_away.toml",
    "overtakes_away_comes.toml",
    "overtakes_away_leaves.toml",
    "overtakes_away_third.toml",
    "overtakes_towards.toml",
    "overtakes_towards_met.toml",
    "pair_and_one.toml",
    "pair_comes.toml",
    "pair_in_the_way.toml",
    "pair_leaves.toml",
    "pair_lingers.toml",
    "pair_met.toml",
    "pair_opens.toml",
    "pair_opens_and_one.toml",
    "pair_opens_leaves.toml",
    "pair_parts.toml",
    "pair_parts_leaves.toml",
    "pair_points.toml",
    "pair_shoe.toml",
    "pair_shoe_leaves.toml",
    "pair_talks.toml",
    "pair_talks_comes.toml",
    "pair_talks_leaves.toml",
    "pairs_pass.toml",
    "passes_pair.toml",
    "past_a_pair.toml",
    "phone.toml",
    "phone_both.toml",
    "phone_comes.toml",
    "phone_leaves.toml",
    "runs.toml",
    "shoe.toml",
    "shoe_comes.toml",
    "shoe_leaves.toml",
    "slows_down.toml",
    "startles.toml",
    "stops_in_front.toml",
    "three_and_one.toml",
    "three_come.toml",
    "three_go.toml",
    "three_leave.toml",
    "three_map.toml",
    "three_part.toml",
    "three_strangers.toml",
    "turns_back.toml",
    "turns_back_comes.toml",
    "two_come.toml",
    "two_pairs.toml",
    "two_pairs_and_one.toml",
    "two_pairs_passed.toml",
    "walked_1.toml",
    "walked_2.toml",
    "walked_3.toml",
    "walked_4.toml",
    "walked_5.toml",
    "walked_6.toml",
    "walked_7.toml",
    "walked_8.toml",
    "yields.toml",
];

/// A collection of units, in the order of their names.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UnitLibrary {
    /// All units.
    pub units: Vec<Unit>,
}

impl UnitLibrary {
    /// The built-in units: drawn scenes and clips of simulated motion, made by `examples/draw_units`.
    ///
    /// # Errors
    /// None in a program that passes its tests; the signature is that of [`UnitLibrary::load`].
    pub fn built_in() -> Result<UnitLibrary, UnitsError> {
        UnitLibrary::of_files(BUILT_IN.iter().map(|(name, text)| (PathBuf::from("built-in units").join(name), *text)))
    }

    /// Names and texts of the built-in unit files, as a starting point for new units.
    pub fn built_in_files() -> &'static [(&'static str, &'static str)] {
        BUILT_IN
    }

    /// The units in a folder, or the built-in ones.
    ///
    /// # Errors
    /// As [`UnitLibrary::load`].
    pub fn open(folder: Option<&Path>) -> Result<UnitLibrary, UnitsError> {
        folder.map_or_else(UnitLibrary::built_in, UnitLibrary::load)
    }

    /// Loads every file of a folder whose name ends in `.toml`, see [`Unit::parse`].
    ///
    /// # Errors
    /// A folder that cannot be read or has no unit; a file that is no unit, with line and column; two units of one name.
    pub fn load(folder: &Path) -> Result<UnitLibrary, UnitsError> {
        let unreadable = |path: &Path, problem: String| UnitsError::Unreadable { path: path.to_path_buf(), problem };
        let entries = std::fs::read_dir(folder).map_err(|error| unreadable(folder, error.to_string()))?;
        let mut paths: Vec<PathBuf> = Vec::new();
        for entry in entries {
            let path = entry.map_err(|error| unreadable(folder, error.to_string()))?.path();
            if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
                paths.push(path);
            }
        }
        // The system lists files in any order.
        paths.sort();
        let mut files = Vec::new();
        for path in paths {
            let bytes = std::fs::metadata(&path).map_err(|error| unreadable(&path, error.to_string()))?.len();
            if bytes > LARGEST_BYTES {
                return Err(unreadable(&path, format!("it has {bytes} bytes, allowed are {LARGEST_BYTES}")));
            }
            let text = read_text(&path).map_err(|error| unreadable(&path, error.to_string()))?;
            files.push((path, text));
        }
        if files.is_empty() {
            return Err(UnitsError::NoUnits { folder: folder.to_path_buf() });
        }
        UnitLibrary::of_files(files.iter().map(|(path, text)| (path.clone(), text.as_str())))
    }

    fn of_files<'t>(files: impl Iterator<Item = (PathBuf, &'t str)>) -> Result<UnitLibrary, UnitsError> {
        let mut found: Vec<(Unit, PathBuf)> = Vec::new();
        for (path, text) in files {
            let unit = Unit::parse(text, &path)?;
            if let Some((_, first)) = found.iter().find(|(known, _)| known.name == unit.name) {
                return Err(UnitsError::SameName { name: unit.name, first: first.clone(), second: path });
            }
            found.push((unit, path));
        }
        found.sort_by(|(a, _), (b, _)| a.name.cmp(&b.name));
        Ok(UnitLibrary { units: found.into_iter().map(|(unit, _)| unit).collect() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_read_in_the_order_of_names_and_mistakes_name_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let write = |file: &str, text: &str| std::fs::write(folder.path().join(file), text).unwrap();
        assert!(matches!(UnitLibrary::load(folder.path()), Err(UnitsError::NoUnits { .. })));
        assert!(matches!(UnitLibrary::load(&folder.path().join("none")), Err(UnitsError::Unreadable { .. })));
        let unit = |name: &str| {
            format!(
                "name = \"{name}\"\narea = [3.0, 4.0]\nduration = 1.0\n[[member]]\npath = [[0.0, 1.0, 2.0, 0], [1.0, 1.0, 1.0, 0]]\n"
            )
        };
        write("x.toml", &unit("a"));
        write("b.toml", &unit("c"));
        write("notes.txt", "not a unit");
        let names: Vec<String> = UnitLibrary::load(folder.path()).unwrap().units.into_iter().map(|u| u.name).collect();
        assert_eq!(names, ["a", "c"]);
        write("y.toml", &unit("c"));
        let error = UnitLibrary::load(folder.path()).unwrap_err();
        assert!(matches!(error, UnitsError::SameName { .. }), "{error}");
        write("y.toml", "name = \"d\"\narea = [3.0, 4.0]\nduration = many\n");
        let error = UnitLibrary::load(folder.path()).unwrap_err();
        assert!(error.to_string().contains("y.toml:3:12"), "{error}");
        assert!(error.hint().is_some());
    }
}
