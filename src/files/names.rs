//! Resolves the file that a name stands for.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use super::FileError;

/// Longest chain of links to follow.
const LINKS: usize = 40;

/// Folders that list the process's open files by number.
const DESCRIPTORS: [&str; 3] = ["/dev/fd", "/proc/self/fd", "/proc/thread-self/fd"];

/// Destination of a user's path.
pub(super) enum Destination {
    /// Path of a file with links resolved; it may not exist.
    Name(PathBuf),
    Stream(Stream),
}

/// A device, a pipe or an open file of this process.
#[derive(Debug)]
pub(super) struct Stream {
    path: PathBuf,
    is_descriptor: bool,
}

impl Destination {
    pub fn of(path: &Path) -> io::Result<Destination> {
        let mut target = path.to_path_buf();
        for _ in 0..LINKS {
            if target.parent().is_some_and(|folder| DESCRIPTORS.iter().any(|known| folder == Path::new(known))) {
                return Ok(Destination::Stream(Stream { path: target, is_descriptor: true }));
            }
            let Ok(next) = fs::read_link(&target) else {
                let is_other = fs::metadata(&target).is_ok_and(|found| !found.is_file() && !found.is_dir());
                return Ok(match is_other {
                    true => Destination::Stream(Stream { path: target, is_descriptor: false }),
                    false => Destination::Name(target),
                });
            };
            target = target.parent().unwrap_or(Path::new("")).join(next);
        }
        Err(io::Error::other("too many links lead to it"))
    }
}

impl Stream {
    /// Opens it for writing, descriptors at their end.
    pub fn open(&self) -> io::Result<File> {
        if let Some(own) = self.standard() {
            return own;
        }
        File::options().append(self.is_descriptor).write(true).open(&self.path)
    }

    /// Returns standard output or standard error, which keep their position in a file.
    #[cfg(unix)]
    fn standard(&self) -> Option<io::Result<File>> {
        use std::os::fd::AsFd;
        if !self.is_descriptor {
            return None;
        }
        let own = match self.path.file_name()?.to_str()? {
            "1" => io::stdout().as_fd().try_clone_to_owned(),
            "2" => io::stderr().as_fd().try_clone_to_owned(),
            _ => return None,
        };
        Some(own.map(File::from))
    }

    #[cfg(not(unix))]
    fn standard(&self) -> Option<io::Result<File>> {
        None
    }
}

/// Whether two paths lead to the same file, which may not exist.
pub fn same_file(a: &Path, b: &Path) -> bool {
    // Opening a pipe would wait for its reader.
    let is_plain = |path: &Path| fs::metadata(path).is_ok_and(|found| found.is_file() || found.is_dir());
    if is_plain(a) && is_plain(b) {
        return same_file::is_same_file(a, b).unwrap_or(false);
    }
    match (Destination::of(a), Destination::of(b)) {
        (Ok(Destination::Name(a)), Ok(Destination::Name(b))) => real(&a) == real(&b),
        _ => false,
    }
}

/// Returns a normal form: absolute, its folder without links, `.` and `..`.
fn real(path: &Path) -> PathBuf {
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let folder = absolute.parent().and_then(|folder| fs::canonicalize(folder).ok());
    match (folder, absolute.file_name()) {
        (Some(folder), Some(name)) => folder.join(name),
        _ => absolute,
    }
}

/// Makes sure that an output is none of the files that the same run reads.
///
/// # Errors
/// [`FileError::IsInput`].
pub fn check_not_input(output: &Path, inputs: &[PathBuf]) -> Result<(), FileError> {
    match inputs.iter().any(|input| input.is_file() && same_file(output, input)) {
        true => Err(FileError::IsInput { path: output.to_path_buf() }),
        false => Ok(()),
    }
}
