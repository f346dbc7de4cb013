//! Locks between processes.

use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

/// Content of a lock file, which tells it from a file of the user with the same name.
const MARK: &[u8] = b"While a trodden writes the folder beside this file, it holds a lock on it.\n";

/// Time between two attempts to take the lock.
const PAUSE: Duration = Duration::from_millis(20);

/// An exclusive lock between processes, held while the value lives.
///
/// The lock file is created if missing, and removed with the lock. A lock file that a killed process left is reused. A
/// file of the user is locked but never written or removed.
#[derive(Debug)]
pub struct NameLock {
    path: PathBuf,
    file: Option<File>,
    is_ours: bool,
}

/// Why a lock was not taken.
#[derive(Debug)]
pub enum LockError {
    /// Another process holds the lock.
    InUse,
    /// A folder or a link has the name of the lock file.
    InTheWay,
    /// Error of the system.
    Io(io::Error),
}

impl NameLock {
    /// Takes the lock if no other process holds it.
    ///
    /// # Errors
    /// Another process holds it; a folder or a link has the name; the system refuses.
    pub fn take(path: &Path) -> Result<NameLock, LockError> {
        loop {
            let Some((mut file, made)) = open(path)? else { continue };
            match file.try_lock() {
                // Some network disks cannot lock; there, two processes at once are not detected.
                Ok(()) | Err(TryLockError::Error(_)) => {}
                Err(TryLockError::WouldBlock) if is_named(&file, path) => return Err(LockError::InUse),
                Err(TryLockError::WouldBlock) => continue,
            }
            // The previous owner removed the file; a lock on it excludes nobody.
            if !is_named(&file, path) {
                continue;
            }
            let is_ours = made || is_marked(&mut file);
            return Ok(NameLock { path: path.to_path_buf(), file: Some(file), is_ours });
        }
    }

    /// Takes the lock, waiting for another process for at most `longest`.
    ///
    /// # Errors
    /// The same as for [`NameLock::take`].
    pub fn wait(path: &Path, longest: Duration) -> Result<NameLock, LockError> {
        let start = Instant::now();
        loop {
            match NameLock::take(path) {
                Err(LockError::InUse) if start.elapsed() < longest => thread::sleep(PAUSE),
                taken => return taken,
            }
        }
    }
}

impl Drop for NameLock {
    fn drop(&mut self) {
        if self.is_ours {
            // Before unlocking, so that it is not the next process's file. A file that stays does no harm.
            let _ = fs::remove_file(&self.path);
        }
        drop(self.file.take());
    }
}

/// Opens or creates the lock file. Returns whether it was created; `None` if it appeared or vanished meanwhile.
fn open(path: &Path) -> Result<Option<(File, bool)>, LockError> {
    match fs::symlink_metadata(path) {
        Ok(found) if !found.is_file() => Err(LockError::InTheWay),
        Ok(_) => match File::options().read(true).write(true).open(path) {
            Ok(file) => Ok(Some((file, false))),
            Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(e) => Err(LockError::Io(e)),
        },
        Err(e) if e.kind() == io::ErrorKind::NotFound => make(path).map_err(LockError::Io),
        Err(e) => Err(LockError::Io(e)),
    }
}

/// Creates the lock file together with its content: other processes never see it empty.
fn make(path: &Path) -> io::Result<Option<(File, bool)>> {
    let mut file = super::new_file(path.parent().unwrap_or(Path::new(".")), ".lock.")?;
    file.write_all(MARK)?;
    match file.persist_noclobber(path) {
        Ok(file) => Ok(Some((file, true))),
        Err(refused) if refused.error.kind() == io::ErrorKind::AlreadyExists => Ok(None),
        // Some disks support neither renaming without replacement nor links. There the content follows a moment later;
        // a process that misses it does not remove the file.
        Err(_) => match File::options().read(true).write(true).create_new(true).open(path) {
            Ok(mut file) => file.write_all(MARK).map(|()| Some((file, true))),
            Err(e) if e.kind() == io::ErrorKind::AlreadyExists => Ok(None),
            Err(e) => Err(e),
        },
    }
}

fn is_named(file: &File, path: &Path) -> bool {
    let by_name = same_file::Handle::from_path(path);
    let by_file = file.try_clone().and_then(same_file::Handle::from_file);
    matches!((by_name, by_file), (Ok(a), Ok(b)) if a == b)
}

fn is_marked(file: &mut File) -> bool {
    let mut text = Vec::new();
    let read = file.rewind().and_then(|()| file.take(MARK.len() as u64 + 1).read_to_end(&mut text));
    read.is_ok() && text == MARK
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_at_a_time_has_the_lock_and_nothing_is_left() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join(".out.lock");
        let lock = NameLock::take(&path).unwrap();
        assert!(matches!(NameLock::take(&path), Err(LockError::InUse)));
        assert!(matches!(NameLock::wait(&path, PAUSE), Err(LockError::InUse)));
        drop(lock);
        assert!(!path.exists());
        // A lock file left by a killed process.
        fs::write(&path, MARK).unwrap();
        drop(NameLock::take(&path).unwrap());
        assert!(!path.exists());
    }

    #[test]
    fn a_file_of_the_user_stays() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join(".out.lock");
        for text in ["", "mine"] {
            fs::write(&path, text).unwrap();
            let lock = NameLock::take(&path).unwrap();
            assert!(matches!(NameLock::take(&path), Err(LockError::InUse)));
            drop(lock);
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        }
        fs::remove_file(&path).unwrap();
        fs::create_dir(&path).unwrap();
        assert!(matches!(NameLock::take(&path), Err(LockError::InTheWay)));
    }

    #[test]
    fn many_threads_never_hold_it_together() {
        use std::sync::atomic::{AtomicU32, Ordering};
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join(".out.lock");
        let (inside, taken) = (AtomicU32::new(0), AtomicU32::new(0));
        thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    for _ in 0..200 {
                        if let Ok(lock) = NameLock::take(&path) {
                            assert_eq!(inside.fetch_add(1, Ordering::SeqCst), 0);
                            taken.fetch_add(1, Ordering::SeqCst);
                            inside.fetch_sub(1, Ordering::SeqCst);
                            drop(lock);
                        }
                    }
                });
            }
        });
        assert!(taken.into_inner() > 0);
        assert!(!path.exists());
    }
}
