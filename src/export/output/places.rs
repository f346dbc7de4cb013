//! Paths of an output folder during its replacement, and the replacement itself.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::ffi::{OsStr, OsString};
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::users::is_same;
use crate::export::ExportError;
use crate::export::bake_path::{BakePath, MANIFEST_NAME};
use crate::export::manifest;
use crate::files::{LockError, NameLock, absolute, entries};

/// Marks the hidden folder while results are collected in it. By this the leftovers of a killed run are told from a
/// folder of the user.
pub(super) const UNFINISHED: &str = ".unfinished";

/// How long a reader waits for a bake whose folder is being renamed.
const LONGEST_WAIT: Duration = Duration::from_secs(5);

/// Whether the folder holds a bake of ours, as its manifest's `generator` says.
///
/// # Errors
/// The system refuses to read the manifest.
pub fn is_bake(folder: &Path) -> io::Result<bool> {
    match manifest::generator(folder) {
        Ok(generator) => Ok(generator == manifest::GENERATOR),
        Err(error) => refused(error).map_or(Ok(false), Err),
    }
}

/// The error of a system that refuses to read a manifest; none for a manifest that is missing or somebody else's.
fn refused(error: ExportError) -> Option<io::Error> {
    use io::ErrorKind::{FileTooLarge, InvalidInput, IsADirectory, NotADirectory, NotFound};
    let ExportError::Read { source, .. } = &error else { return None };
    let kind = source.kind();
    let says_other = matches!(kind, NotFound | NotADirectory | IsADirectory | InvalidInput | FileTooLarge);
    (!says_other).then(|| io::Error::new(kind, error))
}

/// Longest name of an output that hidden names repeat whole, bytes; file systems allow 255.
const LONGEST_NAME: usize = 240;

/// The name, or its beginning and a check sum that tells it from others that begin so.
fn short(name: &OsStr) -> Cow<'_, OsStr> {
    let bytes = name.as_encoded_bytes();
    if bytes.len() <= LONGEST_NAME {
        return name.into();
    }
    let mut sum = flate2::Crc::new();
    sum.update(bytes);
    let start: String = name.to_string_lossy().chars().take(50).collect();
    OsString::from(format!("{start}-{:08x}", sum.sum())).into()
}

/// The output and what lies beside it while it is replaced.
#[derive(Debug)]
pub(super) struct Places {
    pub output: PathBuf,
    /// Hidden folder in which results are collected.
    pub new: PathBuf,
    /// The earlier bake during the replacement, where the system cannot exchange folders.
    pub old: PathBuf,
    pub lock: PathBuf,
}

impl Places {
    pub fn of(shown: &Path) -> Result<Places, ExportError> {
        let folder = |source| ExportError::Folder { path: shown.to_path_buf(), source };
        // Replaces the target of a link, not the link.
        let output = if shown.is_symlink() { fs::canonicalize(shown) } else { absolute(shown) };
        let output = output.map_err(folder)?;
        let (Some(parent), Some(name)) = (output.parent(), output.file_name()) else {
            return Err(ExportError::OutputHasNoName { path: shown.to_path_buf() });
        };
        let beside = |suffix: &str| {
            let mut hidden = OsString::from(".");
            hidden.push(short(name));
            hidden.push(suffix);
            parent.join(hidden)
        };
        Ok(Places { new: beside(".new"), old: beside(".old"), lock: beside(".lock"), output })
    }

    /// Cleans up after a killed run and restores an earlier bake that it moved aside. Needs the lock.
    ///
    /// # Errors
    /// A folder of the user has the name of the hidden one; a rename or a removal fails.
    pub fn recover(&self, shown: &Path) -> Result<(), ExportError> {
        let failed = |source| ExportError::Folder { path: shown.to_path_buf(), source };
        self.bring_back().map_err(failed)?;
        let new = &self.new;
        match fs::symlink_metadata(new) {
            Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(()),
            Err(e) => return Err(failed(e)),
            Ok(found) if found.is_dir() => {}
            Ok(_) => return Err(ExportError::InTheWay { path: new.clone() }),
        }
        if new.join(UNFINISHED).is_file() {
            // The user's files in it are also in the output.
            fs::remove_dir_all(new).map_err(failed)?;
        } else if is_bake(new).map_err(failed)? {
            // Either a complete bake that is not published yet, or the bake that it replaced.
            clear(new, &self.output).map_err(failed)?;
        } else {
            // An empty folder is left of a killed run. Any other belongs to the user and stays.
            let _ = fs::remove_dir(new);
        }
        if new.exists() { Err(ExportError::InTheWay { path: new.clone() }) } else { Ok(()) }
    }

    /// Restores the bake that was moved aside, or removes it if the output exists. Needs the lock.
    ///
    /// Returns whether the bake was restored.
    fn bring_back(&self) -> io::Result<bool> {
        if !is_bake(&self.old)? {
            return Ok(false);
        }
        if self.output.exists() {
            clear(&self.old, &self.output)?;
            return Ok(false);
        }
        fs::rename(&self.old, &self.output)?;
        Ok(true)
    }

    /// Moves the new folder to the output's place, and returns where the replaced folder is now.
    ///
    /// # Errors
    /// The system refuses; the output is then unchanged.
    pub fn put_in_place(&self) -> io::Result<Option<PathBuf>> {
        if fs::symlink_metadata(&self.output).is_err() {
            fs::rename(&self.new, &self.output)?;
            return Ok(None);
        }
        let replaced = match exchange(&self.new, &self.output) {
            Ok(()) => Some(self.new.clone()),
            Err(_) => self.rename_twice()?,
        };
        if let Some(parent) = self.output.parent() {
            sync_folder(parent);
        }
        Ok(replaced)
    }

    /// Replaces the output by two renames, where two folders cannot be exchanged.
    pub(super) fn rename_twice(&self) -> io::Result<Option<PathBuf>> {
        if !is_bake(&self.output)? {
            // It holds at most the file browser's files, which the new folder has too.
            clear(&self.output, &self.new)?;
            fs::rename(&self.new, &self.output)?;
            return Ok(None);
        }
        fs::rename(&self.output, &self.old)?;
        if let Err(error) = fs::rename(&self.new, &self.output) {
            // If this fails too, the next run brings the old bake back.
            let _ = fs::rename(&self.old, &self.output);
            return Err(error);
        }
        Ok(Some(self.old.clone()))
    }
}

/// Exchanges two folders in one step.
#[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
fn exchange(a: &Path, b: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    Ok(renameat_with(CWD, a, CWD, b, RenameFlags::EXCHANGE)?)
}

#[cfg(not(any(target_os = "linux", target_os = "android", target_vendor = "apple")))]
fn exchange(_: &Path, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

/// Restores the bake that a killed run left as `.NAME.old`, or removes it if a new one exists.
///
/// Returns whether the bake was restored.
///
/// # Errors
/// The rename fails, or another process holds the lock for seconds while the output has no bake.
pub fn restore(path: &Path) -> Result<bool, ExportError> {
    let places = Places::of(path)?;
    let folder_error = |source| ExportError::Folder { path: path.to_path_buf(), source };
    if !is_bake(&places.old).map_err(folder_error)? {
        return Ok(false);
    }
    if places.output.exists() {
        // A reader neither has to wait for the cleaning up nor needs the right to do it.
        if let Ok(_lock) = NameLock::take(&places.lock) {
            let _ = places.bring_back();
        }
        return Ok(false);
    }
    match NameLock::wait(&places.lock, LONGEST_WAIT) {
        Ok(_lock) => places.bring_back().map_err(folder_error),
        Err(LockError::InUse) => Err(ExportError::OutputInUse { path: path.to_path_buf() }),
        Err(LockError::InTheWay) => Err(ExportError::InTheWay { path: places.lock.clone() }),
        Err(LockError::Io(e)) => Err(folder_error(e)),
    }
}

/// Lists the files of a bake, including its manifest.
pub(super) fn listed(bake: &Path) -> Result<BTreeSet<PathBuf>, ExportError> {
    let files = manifest::listed_files(bake)?;
    Ok(files.iter().map(|file| &**file).chain([MANIFEST_NAME]).map(PathBuf::from).collect())
}

/// Removes a bake: the files that it lists, and the user's files that `other` has too.
///
/// Other files of the user move to `other`, or stay if `other` has another file of that name. Links are not followed.
/// The manifest goes last, so that the rest of an interrupted removal is still recognised as a bake.
///
/// # Errors
/// A file cannot be removed or moved.
pub(super) fn clear(bake: &Path, other: &Path) -> io::Result<()> {
    // Without a manifest of ours, all files count as the user's.
    let listed = listed(bake).or_else(|error| refused(error).map_or_else(|| Ok(BTreeSet::new()), Err))?;
    let manifest = Path::new(MANIFEST_NAME);
    for entry in entries(bake)? {
        let (path, twin) = (bake.join(&entry.relative), other.join(&entry.relative));
        if entry.kind.is_dir() {
            // Fails for a folder that is not empty, which is right.
            let _ = fs::remove_dir(path);
        } else if entry.relative != manifest {
            if listed.contains(&entry.relative) || is_same(&path, &twin)? {
                fs::remove_file(path)?;
            } else if other.is_dir() && fs::symlink_metadata(&twin).is_err() {
                fs::create_dir_all(twin.parent().unwrap_or(other))?;
                fs::rename(path, twin)?;
            }
        }
    }
    let rest = fs::read_dir(bake)?.flatten().any(|entry| Path::new(&entry.file_name()) != manifest);
    if !rest {
        fs::remove_dir_all(bake)?;
    }
    Ok(())
}

/// Waits until the files of a bake and their folders are on the disk.
///
/// # Errors
/// A file cannot be synchronised.
pub(super) fn sync(bake: &Path, files: &[BakePath]) -> io::Result<()> {
    let mut folders = BTreeSet::from([bake.to_path_buf()]);
    for file in files {
        let path = bake.join(file);
        // Windows only synchronises files that are open for writing.
        File::options().read(true).write(cfg!(windows)).open(&path)?.sync_all()?;
        folders.extend(path.ancestors().skip(1).take_while(|folder| *folder != bake).map(Path::to_path_buf));
    }
    folders.iter().for_each(|folder| sync_folder(folder));
    Ok(())
}

/// Waits until a folder's entries are on the disk, where the system supports it.
fn sync_folder(folder: &Path) {
    if let Ok(open) = File::open(folder) {
        let _ = open.sync_all();
    }
}
