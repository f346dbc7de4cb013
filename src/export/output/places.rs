//! Where an output folder lives while it is replaced, and how the new one takes its place.

use std::collections::BTreeSet;
use std::ffi::OsString;
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
pub fn is_bake(folder: &Path) -> bool {
    manifest::generator(folder).is_ok_and(|generator| generator == manifest::GENERATOR)
}

/// The output and what lies beside it while it is replaced.
#[derive(Debug)]
pub(super) struct Places {
    pub output: PathBuf,
    /// Results are collected here.
    pub new: PathBuf,
    /// The earlier bake, while the new one takes its place, where the system cannot exchange folders.
    pub old: PathBuf,
    pub lock: PathBuf,
}

impl Places {
    pub fn of(shown: &Path) -> Result<Places, ExportError> {
        let folder = |source| ExportError::Folder { path: shown.to_path_buf(), source };
        // Through a link, the folder that it leads to is replaced, not the link.
        let output = if shown.is_symlink() { fs::canonicalize(shown) } else { absolute(shown) };
        let output = output.map_err(folder)?;
        let (Some(parent), Some(name)) = (output.parent(), output.file_name()) else {
            return Err(ExportError::OutputHasNoName { path: shown.to_path_buf() });
        };
        let beside = |suffix: &str| {
            let mut hidden = OsString::from(".");
            hidden.push(name);
            hidden.push(suffix);
            parent.join(hidden)
        };
        Ok(Places { new: beside(".new"), old: beside(".old"), lock: beside(".lock"), output })
    }

    /// Cleans up what a killed run left; needs the lock. An earlier bake that was set aside comes back.
    ///
    /// # Errors
    /// A folder of the user has the name of the hidden one; something cannot be renamed or removed.
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
            // What it holds of the user's is in the output as well.
            fs::remove_dir_all(new).map_err(failed)?;
        } else if is_bake(new) {
            // Either complete but not in its place yet, or what it replaced.
            clear(new, &self.output).map_err(failed)?;
        } else {
            // Empty: killed between two steps. If it is not, it is the user's and stays.
            let _ = fs::remove_dir(new);
        }
        if new.exists() { Err(ExportError::InTheWay { path: new.clone() }) } else { Ok(()) }
    }

    /// Brings back the bake that was set aside, or removes it if the new one has its place; needs the lock. Gives
    /// whether it came back.
    fn bring_back(&self) -> io::Result<bool> {
        if !is_bake(&self.old) {
            return Ok(false);
        }
        if self.output.exists() {
            clear(&self.old, &self.output)?;
            return Ok(false);
        }
        fs::rename(&self.old, &self.output)?;
        Ok(true)
    }

    /// Puts the new folder in the output's place; gives where the folder is that it replaced.
    ///
    /// # Errors
    /// The system refuses; the output is as it was then.
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

    /// The same where two folders cannot be exchanged in one step.
    pub(super) fn rename_twice(&self) -> io::Result<Option<PathBuf>> {
        if !is_bake(&self.output) {
            // At most what the system puts into folders, and the new one has it too.
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

/// Brings back the bake that a run left as `.NAME.old` when it was killed between two renamings, or removes it if
/// the new one had taken its place. Gives whether there was something to bring back.
///
/// # Errors
/// It cannot be renamed; another process holds the output for seconds without a bake in it.
pub fn restore(path: &Path) -> Result<bool, ExportError> {
    let places = Places::of(path)?;
    let folder_error = |source| ExportError::Folder { path: path.to_path_buf(), source };
    if !is_bake(&places.old) {
        return Ok(false);
    }
    if places.output.exists() {
        // Only tidying up: a reader need not wait for it nor have the right to do it.
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

/// The files that a bake lists, its manifest among them.
pub(super) fn listed(bake: &Path) -> Result<BTreeSet<PathBuf>, ExportError> {
    let files = manifest::listed_files(bake)?;
    Ok(files.iter().map(|file| &**file).chain([MANIFEST_NAME]).map(PathBuf::from).collect())
}

/// Removes a bake: the files that it lists, and the user's files that are in `other` as well. Anything else of the
/// user's moves to `other`, or stays where that has another file of its name. No link is followed.
///
/// The manifest goes last, so that the rest of a killed removal is still recognised as a bake.
///
/// # Errors
/// A file cannot be removed or moved.
pub(super) fn clear(bake: &Path, other: &Path) -> io::Result<()> {
    // Of a manifest that cannot be read, no file is known to be ours.
    let listed = listed(bake).unwrap_or_default();
    let manifest = Path::new(MANIFEST_NAME);
    for entry in entries(bake)? {
        let (path, twin) = (bake.join(&entry.relative), other.join(&entry.relative));
        if entry.kind.is_dir() {
            // One that is not empty holds something that stays.
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

/// Waits until the files of a bake, and the folders that they lie in, are on the disk.
///
/// # Errors
/// A file cannot be written to the disk.
pub(super) fn sync(bake: &Path, files: &[BakePath]) -> io::Result<()> {
    let mut folders = BTreeSet::from([bake.to_path_buf()]);
    for file in files {
        let path = bake.join(file);
        // Windows only writes back what is open for writing.
        File::options().read(true).write(cfg!(windows)).open(&path)?.sync_all()?;
        folders.extend(path.ancestors().skip(1).take_while(|folder| *folder != bake).map(Path::to_path_buf));
    }
    folders.iter().for_each(|folder| sync_folder(folder));
    Ok(())
}

/// Waits until a folder's names are on the disk, where the system can do that.
fn sync_folder(folder: &Path) {
    if let Ok(open) = File::open(folder) {
        let _ = open.sync_all();
    }
}
