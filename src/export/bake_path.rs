use std::ffi::OsStr;
use std::fmt;
use std::fs;
use std::ops::Deref;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::error::{ExportError, NotInside};

/// The manifest's name in a bake.
pub(super) const MANIFEST_NAME: &str = "manifest.json";

/// Path of a file inside a bake, relative to the bake's folder, with `/` between its parts.
///
/// Its parts are plain names: no `..`, `.`, empty part, backslash, drive or leading `/`. So it cannot leave the bake,
/// except through a link on the disk, which [`BakePath::within`] checks. The default is empty and stands for no file.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct BakePath(String);

impl BakePath {
    /// Checks a path.
    ///
    /// # Errors
    /// It is not a plain name inside a bake.
    pub fn new(path: impl Into<String>) -> Result<BakePath, NotInside> {
        let path = path.into();
        let is_plain = |part: &str| !matches!(part, "" | "." | "..") && !part.contains(['\\', ':', '\0']);
        match path.is_empty() || path.split('/').all(is_plain) {
            true => Ok(BakePath(path)),
            false => Err(NotInside { path }),
        }
    }

    /// Returns the path of the file in a bake, after checking that it lies inside.
    ///
    /// # Errors
    /// The path is empty, there is no such file, or a link leads out of the bake.
    pub fn within(&self, bake: &Path) -> Result<PathBuf, ExportError> {
        let path = bake.join(&self.0);
        if self.0.is_empty() {
            return Err(ExportError::damaged(&bake.join(MANIFEST_NAME), "it names a file without a name"));
        }
        let real = |path: &Path| fs::canonicalize(path).map_err(ExportError::read(path));
        if real(&path)?.starts_with(real(bake)?) {
            return Ok(path);
        }
        Err(ExportError::damaged(&path, "it is a link that leads out of the bake"))
    }
}

impl TryFrom<String> for BakePath {
    type Error = NotInside;

    fn try_from(path: String) -> Result<BakePath, NotInside> {
        BakePath::new(path)
    }
}

impl From<BakePath> for String {
    fn from(path: BakePath) -> String {
        path.0
    }
}

impl Deref for BakePath {
    type Target = str;

    fn deref(&self) -> &str {
        &self.0
    }
}

impl AsRef<Path> for BakePath {
    fn as_ref(&self) -> &Path {
        Path::new(&self.0)
    }
}

impl AsRef<OsStr> for BakePath {
    fn as_ref(&self) -> &OsStr {
        OsStr::new(&self.0)
    }
}

impl fmt::Display for BakePath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl PartialEq<&str> for BakePath {
    fn eq(&self, other: &&str) -> bool {
        self.0 == **other
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_plain_names_are_paths() {
        for path in ["", "manifest.json", "sums/floor.1001.exr", "a/b/c", "..a", "é.png"] {
            assert_eq!(&*BakePath::new(path).unwrap(), path);
        }
        let outside =
            ["..", "a/..", "../a", "sums/../../a", "/a", "a//b", "a/", "./a", "a/.", "C:/a", "C:a", "a\\b", "\\a"];
        for path in outside {
            assert!(BakePath::new(path).unwrap_err().to_string().contains("inside the bake"), "{path}");
            assert!(serde_json::from_value::<BakePath>(path.into()).is_err(), "{path}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_may_not_lead_out() {
        use std::os::unix::fs::symlink;
        let dir = tempfile::tempdir().unwrap();
        let bake = dir.path().join("bake");
        fs::create_dir_all(bake.join("sums")).unwrap();
        fs::write(bake.join("sums/a"), "a").unwrap();
        fs::write(dir.path().join("victim"), "v").unwrap();
        symlink("a", bake.join("sums/inside")).unwrap();
        symlink("../../victim", bake.join("sums/file")).unwrap();
        symlink(dir.path(), bake.join("folder")).unwrap();
        let within = |path: &str| BakePath::new(path).unwrap().within(&bake);
        assert_eq!(within("sums/a").unwrap(), bake.join("sums/a"));
        assert_eq!(within("sums/inside").unwrap(), bake.join("sums/inside"));
        for path in ["sums/file", "folder/victim"] {
            assert!(within(path).unwrap_err().to_string().contains("leads out of the bake"), "{path}");
        }
        assert!(matches!(within("sums/b"), Err(ExportError::Read { .. })));
        assert!(matches!(within(""), Err(ExportError::Damaged { .. })));
    }
}
