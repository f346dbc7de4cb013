//! Files that appear whole or not at all.

use std::ffi::OsString;
use std::fs::{self, File, TryLockError};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

mod absolute;
mod input;

pub use absolute::absolute;
pub use input::{LARGEST_IMAGE_BYTES, LARGEST_TEXT_BYTES, open_input, open_input_up_to, read_input, read_text};

/// Why a file cannot be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// There is such a file, and nobody said that it may be replaced.
    #[error("{} exists already", path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// A folder has this name.
    #[error("cannot write {}: it is a folder", path.display())]
    IsFolder {
        /// The folder.
        path: PathBuf,
    },
    /// The path ends without a name, as `..` does.
    #[error("cannot write {}: it has no file name", path.display())]
    HasNoName {
        /// The path.
        path: PathBuf,
    },
    /// Another process writes the same file right now.
    #[error("another trodden is writing {} right now", path.display())]
    InUse {
        /// The file.
        path: PathBuf,
    },
    /// The system refuses.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

impl FileError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            FileError::Exists { .. } => Some("--force replaces it; or choose another file".to_string()),
            FileError::IsFolder { .. } | FileError::HasNoName { .. } => Some("name a file".to_string()),
            FileError::InUse { .. } => Some("wait for it, or choose another file".to_string()),
            FileError::Write { source, .. } => match source.kind() {
                io::ErrorKind::NotFound => Some("make its folder first".to_string()),
                io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
                    Some("the disk is full: make room, or choose another disk".to_string())
                }
                io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
                    Some("choose a folder that you may write to".to_string())
                }
                _ => None,
            },
        }
    }
}

/// A file that appears under its name when it is complete.
///
/// It is written as `.NAME.new` beside the place where it will be, and renamed by [`WholeFile::publish`]. Dropped
/// unpublished, it is removed, and what was there before stays as it was. What a killed process left behind is
/// replaced by the next one.
#[derive(Debug)]
pub struct WholeFile {
    /// As the user gave it, for messages.
    shown: PathBuf,
    target: PathBuf,
    new: PathBuf,
    lock: PathBuf,
    /// Held while the file is written, so that two processes never write the same.
    locked: Option<File>,
    force: bool,
    published: bool,
}

impl WholeFile {
    /// Makes sure that the file may be written, and reserves its place.
    ///
    /// # Errors
    /// A file of this name unless `force` is set, a folder of this name, no right to write to its folder, another
    /// process that writes the same file.
    pub fn begin(path: &Path, force: bool) -> Result<WholeFile, FileError> {
        let shown = path.to_path_buf();
        // Through a link, the file that it leads to is replaced, not the link.
        let target = fs::canonicalize(path).ok().filter(|_| path.is_symlink()).unwrap_or_else(|| shown.clone());
        let Some(name) = target.file_name() else { return Err(FileError::HasNoName { path: shown }) };
        if target.is_dir() {
            return Err(FileError::IsFolder { path: shown });
        }
        let beside = |suffix: &str| {
            let mut hidden = OsString::from(".");
            hidden.push(name);
            hidden.push(suffix);
            target.with_file_name(hidden)
        };
        let (new, lock) = (beside(".new"), beside(".lock"));
        let mut file = WholeFile { shown, target, new, lock, locked: None, force, published: false };
        file.check_replaceable()?;
        file.reserve()?;
        Ok(file)
    }

    /// Where to write until the file is published.
    pub fn path(&self) -> &Path {
        &self.new
    }

    /// Makes the file, to be written by way of [`WholeFile::path`]'s name.
    ///
    /// # Errors
    /// The system refuses.
    pub fn create(&self) -> Result<BufWriter<File>, FileError> {
        let file = File::create(&self.new).map_err(|source| self.failed(source))?;
        Ok(BufWriter::with_capacity(1 << 16, file))
    }

    /// The error of a write to this file that failed.
    pub fn failed(&self, source: io::Error) -> FileError {
        FileError::Write { path: self.shown.clone(), source }
    }

    /// Puts the file, which must be closed, in its place; gives its size in bytes.
    ///
    /// # Errors
    /// A file of this name that has appeared in the meantime, unless it may be replaced; the system refuses.
    pub fn publish(mut self) -> Result<u64, FileError> {
        self.check_replaceable()?;
        let size = fs::metadata(&self.new).map_err(|source| self.failed(source))?.len();
        fs::rename(&self.new, &self.target).map_err(|source| self.failed(source))?;
        self.published = true;
        Ok(size)
    }

    fn check_replaceable(&self) -> Result<(), FileError> {
        match self.target.exists() && !self.force {
            true => Err(FileError::Exists { path: self.shown.clone() }),
            false => Ok(()),
        }
    }

    fn reserve(&mut self) -> Result<(), FileError> {
        let failed = |source| FileError::Write { path: self.shown.clone(), source };
        let lock = File::create(&self.lock).map_err(failed)?;
        match lock.try_lock() {
            Err(TryLockError::WouldBlock) => {
                // Not ours to remove.
                self.published = true;
                return Err(FileError::InUse { path: self.shown.clone() });
            }
            // Some network disks cannot lock: then only two processes at once are not told apart.
            Ok(()) | Err(TryLockError::Error(_)) => self.locked = Some(lock),
        }
        match fs::remove_file(&self.new) {
            Err(source) if source.kind() != io::ErrorKind::NotFound => Err(self.failed(source)),
            _ => Ok(()),
        }
    }
}

impl Drop for WholeFile {
    fn drop(&mut self) {
        if !self.published {
            // Nobody is left to tell; the next start cleans up.
            let _ = fs::remove_file(&self.new);
        }
        if self.locked.take().is_some() {
            let _ = fs::remove_file(&self.lock);
        }
    }
}

/// Writes a file in one go, whole or not at all.
///
/// # Errors
/// As [`WholeFile::begin`] and [`WholeFile::publish`].
pub fn write_whole(path: &Path, bytes: &[u8], force: bool) -> Result<u64, FileError> {
    let file = WholeFile::begin(path, force)?;
    let written = file.create()?.into_inner().map_err(|error| error.into_error());
    written.and_then(|mut open| open.write_all(bytes)).map_err(|source| file.failed(source))?;
    file.publish()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_appears_when_it_is_published_and_not_before() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.txt");
        let file = WholeFile::begin(&path, false).unwrap();
        file.create().unwrap().write_all(b"whole").unwrap();
        assert!(!path.exists());
        assert_eq!(file.publish().unwrap(), 5);
        assert_eq!(fs::read(&path).unwrap(), b"whole");
        assert_eq!(names(dir.path()), ["a.txt"]);
    }

    #[test]
    fn an_abandoned_file_leaves_what_was_there() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.txt");
        fs::write(&path, "earlier").unwrap();
        assert!(matches!(WholeFile::begin(&path, false), Err(FileError::Exists { .. })));
        let file = WholeFile::begin(&path, true).unwrap();
        file.create().unwrap().write_all(b"half").unwrap();
        drop(file);
        assert_eq!(fs::read(&path).unwrap(), b"earlier");
        assert_eq!(names(dir.path()), ["a.txt"]);
        assert_eq!(write_whole(&path, b"later", true).unwrap(), 5);
        assert_eq!(fs::read(&path).unwrap(), b"later");
    }

    #[test]
    fn two_never_write_the_same_file_and_leftovers_are_replaced() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.txt");
        let first = WholeFile::begin(&path, false).unwrap();
        first.create().unwrap().write_all(b"first").unwrap();
        assert!(matches!(WholeFile::begin(&path, false), Err(FileError::InUse { .. })));
        first.publish().unwrap();
        // As a killed process leaves them.
        fs::write(dir.path().join(".b.txt.new"), "half of it").unwrap();
        fs::write(dir.path().join(".b.txt.lock"), "").unwrap();
        write_whole(&dir.path().join("b.txt"), b"b", false).unwrap();
        assert_eq!(names(dir.path()), ["a.txt", "b.txt"]);
    }

    #[test]
    fn folders_and_missing_folders_are_refused_with_a_hint() {
        let dir = tempfile::tempdir().unwrap();
        assert!(matches!(WholeFile::begin(dir.path(), true), Err(FileError::IsFolder { .. })));
        let error = WholeFile::begin(&dir.path().join("no/where.txt"), true).unwrap_err();
        assert_eq!(error.hint().unwrap(), "make its folder first");
        assert!(matches!(
            WholeFile::begin(Path::new(".."), true),
            Err(FileError::IsFolder { .. } | FileError::HasNoName { .. })
        ));
        assert!(names(dir.path()).is_empty());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link() {
        let dir = tempfile::tempdir().unwrap();
        let (real, link) = (dir.path().join("real.txt"), dir.path().join("link.txt"));
        fs::write(&real, "earlier").unwrap();
        std::os::unix::fs::symlink(&real, &link).unwrap();
        write_whole(&link, b"later", true).unwrap();
        assert!(link.is_symlink());
        assert_eq!(fs::read(&real).unwrap(), b"later");
    }
}
