//! Suggests a file for a name that does not exist.

use std::path::{Path, PathBuf};

/// File extensions of plan images.
const IMAGES: [&str; 10] = ["pgm", "ppm", "pnm", "png", "jpg", "jpeg", "bmp", "tif", "tiff", "gif"];
/// File extensions of maps.
const MAPS: [&str; 2] = ["yaml", "yml"];

/// Least length of a name that counts when another name contains it, characters.
const SHORTEST: usize = 3;

/// Finds the file beside a missing one, also image or map, with the most similar name.
///
/// The edit distance must be at most a third of the name's length, or one name contain the other. Ties go to the first
/// by name.
pub(super) fn similar_file(missing: &Path) -> Option<PathBuf> {
    let wanted = stem(missing)?;
    let kind = kind(missing)?;
    let most = (wanted.chars().count() / 3).max(1);
    let folder = missing.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let files = std::fs::read_dir(folder).ok()?.flatten().map(|entry| missing.with_file_name(entry.file_name()));
    files
        .filter(|path| self::kind(path).is_some_and(|other| other == kind))
        .filter_map(|path| {
            let found = stem(&path)?;
            let holds = |long: &str, short: &str| short.chars().count() >= SHORTEST && long.contains(short);
            let distance = strsim::damerau_levenshtein(&wanted, &found);
            (distance <= most || holds(&found, &wanted) || holds(&wanted, &found)).then_some((distance, path))
        })
        .min()
        .map(|(_, path)| path)
}

/// The name without extension, in lower case.
fn stem(path: &Path) -> Option<String> {
    Some(path.file_stem()?.to_str()?.to_lowercase())
}

/// The extensions of the same kind as a file's.
fn kind(path: &Path) -> Option<&'static [&'static str]> {
    let ending = path.extension()?.to_str()?.to_lowercase();
    [IMAGES.as_slice(), MAPS.as_slice()].into_iter().find(|kind| kind.contains(&ending.as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_of_the_same_kind_is_meant() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["berlin.png", "berlin.yaml", "porto_2.toml", "sport.png", "room.pgm"] {
            std::fs::write(folder.path().join(name), "x").unwrap();
        }
        let found = |name: &str| similar_file(&folder.path().join(name)).and_then(|p| Some(p.file_name()?.to_owned()));
        assert_eq!(found("porto.yaml"), None);
        assert_eq!(found("berlim.yaml").unwrap(), "berlin.yaml");
        assert_eq!(found("Berlin.jpg").unwrap(), "berlin.png");
        assert_eq!(found("rooms.png").unwrap(), "room.pgm");
        assert_eq!(found("berlin_2.png").unwrap(), "berlin.png");
        assert_eq!(found("berlin"), None);
    }
}
