use std::path::Path;

use crate::recordings::{RecordingError, RecordingFormat};

/// File name ending of gzipped files.
const PACKED: &str = "gz";

/// File format of a written motion, and whether it is gzipped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordForm {
    /// The format.
    pub format: RecordingFormat,
    /// Whether the file is gzipped; text formats only.
    pub packed: bool,
}

impl RecordForm {
    /// File name endings and their formats. `.gz` may follow the ending of a text.
    pub const ENDINGS: [(&str, RecordingFormat); 6] = [
        ("txt", RecordingFormat::Juelich),
        ("csv", RecordingFormat::Csv),
        ("traj", RecordingFormat::Vadere),
        ("sqlite", RecordingFormat::Jupedsim),
        ("sqlite3", RecordingFormat::Jupedsim),
        ("db", RecordingFormat::Jupedsim),
    ];

    /// Returns the form for a file name; with `format` given, only the name's `.gz` counts.
    ///
    /// # Errors
    /// The name has an unknown ending or none; a database cannot be gzipped.
    pub fn of(path: &Path, format: Option<RecordingFormat>) -> Result<RecordForm, RecordingError> {
        let unknown = || RecordingError::UnknownEnding { path: path.to_path_buf(), endings: RecordForm::endings() };
        let is = |path: &Path, name: &str| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(name));
        let packed = is(path, PACKED);
        let bare = if packed { path.with_extension("") } else { path.to_path_buf() };
        let known = || RecordForm::ENDINGS.into_iter().find(|(name, _)| is(&bare, name)).map(|(_, format)| format);
        let form = RecordForm { format: format.or_else(known).ok_or_else(unknown)?, packed };
        match (form.format.is_text() || !packed, format) {
            (true, _) => Ok(form),
            (false, None) => Err(unknown()),
            (false, Some(format)) => Err(RecordingError::NoText { format }),
        }
    }

    /// List of all known endings, for messages.
    pub fn endings() -> String {
        let names: Vec<String> = RecordForm::ENDINGS.iter().map(|(ending, _)| format!(".{ending}")).collect();
        let (last, others) = names.split_last().expect("there are endings");
        format!("{} or {last}, texts also in .gz", others.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(name: &str, format: Option<RecordingFormat>) -> Option<(RecordingFormat, bool)> {
        RecordForm::of(Path::new(name), format).ok().map(|form| (form.format, form.packed))
    }

    #[test]
    fn names_say_the_format() {
        use RecordingFormat::{Csv, Juelich, Jupedsim, Pathfinder, Vadere};
        for (name, format) in [
            ("a.txt", Some((Juelich, false))),
            ("x/a.b.CSV", Some((Csv, false))),
            ("a.traj.gz", Some((Vadere, true))),
            ("a.txt.GZ", Some((Juelich, true))),
            ("a.Db", Some((Jupedsim, false))),
            ("a.sqlite.gz", None),
            ("a.gz", None),
            (".txt", None),
            (".csv.gz", None),
            ("txt", None),
            ("", None),
        ] {
            assert_eq!(of(name, None), format, "{name}");
        }
        assert_eq!(of("a.csv", Some(Pathfinder)), Some((Pathfinder, false)));
        assert_eq!(of("data.gz", Some(Pathfinder)), Some((Pathfinder, true)));
        assert_eq!(of("data", Some(Jupedsim)), Some((Jupedsim, false)));
        assert_eq!(of("data.gz", Some(Jupedsim)), None);
    }

    #[test]
    fn endings_are_named() {
        assert_eq!(RecordForm::endings(), ".txt, .csv, .traj, .sqlite, .sqlite3 or .db, texts also in .gz");
    }
}
