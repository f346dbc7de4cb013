//! Output files that appear complete or not at all, and never overwrite by accident.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use tempfile::TempPath;

mod absolute;
mod error;
mod folder;
mod input;
mod lock;
mod names;

pub use absolute::absolute;
pub use error::FileError;
pub use folder::files_in;
pub(crate) use folder::{Entry, Unreadable, entries, have_same_bytes};
pub use input::{LARGEST_IMAGE_BYTES, read_input};
pub(crate) use input::{open_input, open_input_up_to, read_text};
pub(crate) use lock::{LockError, NameLock};
pub use names::{check_not_input, same_file};

use names::{Destination, Stream};

/// A file that appears under its name when it is complete.
///
/// It is written beside the place where it will be, under a name that no other file has, and renamed by
/// [`WholeFile::publish`]. Dropped unpublished, it is removed, and what was there before stays as it was. Through a
/// link, the file that it leads to is written. What a killed run left beside the same file is removed. A device, a pipe or a descriptor, such as `/dev/stdout`, is written to
/// as it is: there is nothing to rename.
#[derive(Debug)]
pub struct WholeFile {
    /// Path as the user gave it, for messages.
    shown: PathBuf,
    place: Place,
    force: bool,
}

#[derive(Debug)]
enum Place {
    /// A file to be renamed. It is locked as long as it is held, so that no other run takes it for a leftover.
    Beside { written: TempPath, held: File, target: PathBuf },
    /// Something that is written to directly.
    Stream(Stream),
}

/// The longest part of a file's name that the temporary name repeats, characters.
const REPEATED: usize = 50;
/// What stands in temporary names between the file's own name and a few random letters and digits, and after them.
const OURS: &str = ".trodden-";
const NEW: &str = ".new";
const RANDOM: usize = 6;
/// From this age on a temporary file that nobody holds was left by a killed run.
const LEFT_AFTER: Duration = Duration::from_secs(3600);

impl WholeFile {
    /// Checks that the file may be written, and creates the temporary file.
    ///
    /// # Errors
    /// The file exists and `force` is not set; a folder has its name; its folder is not writable.
    pub fn begin(path: &Path, force: bool) -> Result<WholeFile, FileError> {
        let shown = path.to_path_buf();
        let failed = |source| FileError::Write { path: path.to_path_buf(), source };
        let target = match Destination::of(path).map_err(failed)? {
            Destination::Stream(stream) => return Ok(WholeFile { shown, place: Place::Stream(stream), force }),
            Destination::Name(target) => target,
        };
        if target.is_dir() {
            return Err(FileError::IsFolder { path: shown });
        }
        let Some(name) = target.file_name() else { return Err(FileError::HasNoName { path: shown }) };
        if target.exists() && !force {
            return Err(FileError::Exists { path: shown });
        }
        let start: String = name.to_string_lossy().chars().take(REPEATED).collect();
        let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let start = format!(".{start}{OURS}");
        remove_leftovers(folder, &start);
        let (held, written) = new_file(folder, &start).map_err(failed)?.into_parts();
        // Elsewhere a lock would keep this run itself, or its database, from the file. A disk that cannot lock does no harm.
        #[cfg(target_os = "linux")]
        let _ = held.try_lock();
        Ok(WholeFile { shown, place: Place::Beside { written, held, target }, force })
    }

    /// Path to write to until the file is published.
    pub fn path(&self) -> &Path {
        match &self.place {
            Place::Beside { written, .. } => written,
            Place::Stream(_) => &self.shown,
        }
    }

    /// Whether it is a device, a pipe or a descriptor, written sequentially.
    pub fn is_stream(&self) -> bool {
        matches!(self.place, Place::Stream(_))
    }

    /// Opens the file to write it from its start.
    ///
    /// # Errors
    /// Error of the system.
    pub fn create(&self) -> Result<BufWriter<File>, FileError> {
        let file = match &self.place {
            Place::Beside { written, .. } => File::options().write(true).truncate(true).open(written),
            Place::Stream(stream) => stream.open(),
        };
        Ok(BufWriter::with_capacity(1 << 16, file.map_err(|source| self.failed(source))?))
    }

    /// Wraps an error of writing to this file.
    pub fn failed(&self, source: io::Error) -> FileError {
        FileError::Write { path: self.shown.clone(), source }
    }

    /// Writes the whole content; the caller still has to publish the file.
    ///
    /// # Errors
    /// Error of the system.
    pub fn write(&self, bytes: &[u8]) -> Result<(), FileError> {
        let mut file = self.create()?;
        file.write_all(bytes).and_then(|()| file.flush()).map_err(|source| self.failed(source))
    }

    /// Renames the file, which must be closed, to its destination. Returns its size in bytes, 0 for a stream.
    ///
    /// # Errors
    /// The file has appeared meanwhile and may not be replaced; error of the system.
    pub fn publish(self) -> Result<u64, FileError> {
        let WholeFile { shown, place, force } = self;
        let Place::Beside { written, held, target } = place else { return Ok(0) };
        drop(held);
        let failed = |source| FileError::Write { path: shown.clone(), source };
        let size = fs::metadata(&written).map_err(failed)?.len();
        if !force {
            return match written.persist_noclobber(&target) {
                Ok(()) => Ok(size),
                Err(refused) if refused.error.kind() == io::ErrorKind::AlreadyExists || target.exists() => {
                    Err(FileError::Exists { path: shown })
                }
                // Some disks support neither renaming without replacement nor links.
                Err(refused) => refused.path.persist(&target).map(|()| size).map_err(|e| failed(plain(e.error))),
            };
        }
        // The new content has to be on the disk before the old one is replaced.
        File::options().write(true).open(&written).and_then(|file| file.sync_all()).map_err(failed)?;
        written.persist(&target).map_err(|refused| failed(plain(refused.error)))?;
        Ok(size)
    }
}

/// Creates a file with a unique name in a folder, with default permissions.
fn new_file(folder: &Path, start: &str) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(start).rand_bytes(RANDOM).suffix(NEW);
    #[cfg(unix)]
    let rights = std::os::unix::fs::PermissionsExt::from_mode(0o666);
    #[cfg(unix)]
    builder.permissions(rights);
    builder.tempfile_in(folder).map_err(plain)
}

/// Removes temporary files whose names begin like this and that killed runs left.
fn remove_leftovers(folder: &Path, start: &str) {
    let is_ours = |name: &str| {
        let random = name.strip_prefix(start).and_then(|rest| rest.strip_suffix(NEW));
        random.is_some_and(|random| random.len() == RANDOM && random.bytes().all(|byte| byte.is_ascii_alphanumeric()))
    };
    let is_left = |entry: &fs::DirEntry| {
        let is_old = |found: fs::Metadata| {
            found.is_file() && found.modified().is_ok_and(|at| at.elapsed().is_ok_and(|age| age >= LEFT_AFTER))
        };
        let is_free = |file: File| !matches!(file.try_lock(), Err(fs::TryLockError::WouldBlock));
        entry.metadata().is_ok_and(is_old) && File::open(entry.path()).is_ok_and(is_free)
    };
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        if entry.file_name().to_str().is_some_and(is_ours) && is_left(&entry) {
            // Only tidying up: this run does not need it.
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// An error of the system without the temporary name, which would tell the user nothing.
fn plain(error: io::Error) -> io::Error {
    let source = error.get_ref().and_then(|inner| inner.source()).and_then(|source| source.downcast_ref::<io::Error>());
    match source.and_then(io::Error::raw_os_error) {
        Some(code) => io::Error::from_raw_os_error(code),
        None => error,
    }
}

/// Writes a file completely or not at all.
///
/// # Errors
/// The same as for [`WholeFile::begin`] and [`WholeFile::publish`].
pub fn write_whole(path: &Path, bytes: &[u8], force: bool) -> Result<u64, FileError> {
    let file = WholeFile::begin(path, force)?;
    file.write(bytes)?;
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
    fn of_two_writers_the_second_finds_the_file_there() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.txt");
        let [first, second] = [(); 2].map(|()| WholeFile::begin(&path, false).unwrap());
        first.write(b"first").unwrap();
        second.write(b"second").unwrap();
        first.publish().unwrap();
        assert!(matches!(second.publish(), Err(FileError::Exists { .. })));
        assert_eq!(fs::read(&path).unwrap(), b"first");
        assert_eq!(names(dir.path()), ["a.txt"]);
    }

    #[test]
    fn files_with_similar_names_stay() {
        let dir = tempfile::tempdir().unwrap();
        for name in [".a.txt.new", ".a.txt.lock"] {
            fs::write(dir.path().join(name), name).unwrap();
        }
        write_whole(&dir.path().join("a.txt"), b"a", false).unwrap();
        assert_eq!(names(dir.path()), [".a.txt.lock", ".a.txt.new", "a.txt"]);
        assert_eq!(fs::read(dir.path().join(".a.txt.lock")).unwrap(), b".a.txt.lock");
    }

    #[test]
    fn what_killed_runs_left_is_removed_and_nothing_else() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.txt");
        let hours_ago = |path: &Path, hours: u64| {
            let at = std::time::SystemTime::now() - Duration::from_secs(3600 * hours);
            File::options().write(true).open(path).unwrap().set_modified(at).unwrap();
        };
        let stay =
            [".a.txt.backup.new", ".a.txt.trodden-mine.new", ".a.txt.trodden-abc-ef.new", ".b.txt.trodden-abcdef.new"];
        for name in stay.iter().chain(&[".a.txt.trodden-Abc123.new"]) {
            fs::write(dir.path().join(name), name).unwrap();
            hours_ago(&dir.path().join(name), 2);
        }
        fs::write(dir.path().join(".a.txt.trodden-fresh1.new"), "of a run at work").unwrap();
        // Another run has been at work for hours.
        let at_work = WholeFile::begin(&path, false).unwrap();
        if cfg!(target_os = "linux") {
            hours_ago(at_work.path(), 5);
        }
        write_whole(&path, b"a", false).unwrap();
        let mut wanted = stay.to_vec();
        let of_work = at_work.path().file_name().unwrap().to_string_lossy().into_owned();
        wanted.extend(["a.txt", ".a.txt.trodden-fresh1.new", &of_work]);
        wanted.sort_unstable();
        assert_eq!(names(dir.path()), wanted);
    }

    #[cfg(unix)]
    #[test]
    fn files_have_the_rights_of_any_new_file() {
        use std::os::unix::fs::PermissionsExt;
        let dir = tempfile::tempdir().unwrap();
        let [plain, whole] = ["plain", "whole"].map(|name| dir.path().join(name));
        fs::write(&plain, "x").unwrap();
        write_whole(&whole, b"x", false).unwrap();
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&whole), mode(&plain));
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

    #[cfg(unix)]
    #[test]
    fn a_link_that_leads_nowhere_yet_leads_to_the_new_file() {
        let dir = tempfile::tempdir().unwrap();
        let link = dir.path().join("link.txt");
        std::os::unix::fs::symlink("real.txt", &link).unwrap();
        write_whole(&link, b"x", false).unwrap();
        assert!(link.is_symlink());
        assert_eq!(fs::read(dir.path().join("real.txt")).unwrap(), b"x");
        // A cycle of links is an error, not an endless loop.
        let ring = dir.path().join("ring.txt");
        std::os::unix::fs::symlink("ring.txt", &ring).unwrap();
        assert!(matches!(WholeFile::begin(&ring, true), Err(FileError::Write { .. })));
    }

    #[cfg(unix)]
    #[test]
    fn a_device_stays_a_device() {
        for force in [false, true] {
            assert_eq!(write_whole(Path::new("/dev/null"), b"x", force).unwrap(), 0);
        }
        assert!(!Path::new("/dev/null").is_file());
    }
}
