use std::collections::BTreeSet;
use std::fs::{self, File, TryLockError};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use super::manifest::{self, Manifest};
use super::{ExportError, Report};
use crate::files::absolute;

/// Held under an exclusive lock by the run that writes the folder, so that the leftovers of a killed run can be told
/// from the work of a living one.
const LOCK: &str = ".lock";

/// A folder of results that appears whole or not at all.
///
/// Results are collected in a hidden folder beside the output, `.NAME.new`. [`OutputFolder::publish`] renames an
/// earlier bake to `.NAME.old`, the new folder to `NAME`, and removes the old one. Dropped unpublished, the new
/// folder is removed and the earlier bake stays as it was.
///
/// Only an empty folder or, when forced, an earlier bake of ours is ever replaced.
#[derive(Debug)]
pub struct OutputFolder {
    /// As the user gave it, for messages.
    shown: PathBuf,
    places: Places,
    lock: Option<File>,
    /// Parents of the output that did not exist before, outermost first.
    made_parents: Vec<PathBuf>,
    files: Mutex<BTreeSet<String>>,
    published: bool,
}

/// Where an output folder lives while it is replaced.
#[derive(Debug)]
struct Places {
    output: PathBuf,
    new: PathBuf,
    old: PathBuf,
}

impl Places {
    fn of(shown: &Path) -> Result<Places, ExportError> {
        let folder = |source| ExportError::Folder { path: shown.to_path_buf(), source };
        // Through a link, the folder that it leads to is replaced, not the link.
        let output = if shown.is_symlink() { fs::canonicalize(shown) } else { absolute(shown) };
        let output = output.map_err(folder)?;
        let (Some(parent), Some(name)) = (output.parent(), output.file_name()) else {
            return Err(ExportError::OutputHasNoName { path: shown.to_path_buf() });
        };
        let beside = |suffix: &str| {
            let mut hidden = std::ffi::OsString::from(".");
            hidden.push(name);
            hidden.push(suffix);
            parent.join(hidden)
        };
        Ok(Places { new: beside(".new"), old: beside(".old"), output })
    }
}

impl OutputFolder {
    /// Makes the hidden folder, after having cleaned up what a killed run may have left.
    ///
    /// With `force`, an earlier bake may be replaced; anything else that is not empty never is.
    ///
    /// # Errors
    /// The output is a file, holds something else than a bake, holds a bake and `force` is not set, is being
    /// written by another process, or cannot be written.
    pub fn begin(path: &Path, force: bool) -> Result<OutputFolder, ExportError> {
        let places = Places::of(path)?;
        let folder_error = |source| ExportError::Folder { path: path.to_path_buf(), source };
        restore(path)?;
        check_replaceable(path, &places.output, force)?;
        let made_parents = make_parents(&places.output).map_err(folder_error)?;
        let mut folder = OutputFolder {
            shown: path.to_path_buf(),
            places,
            lock: None,
            made_parents,
            files: Mutex::default(),
            published: true, // nothing to clean up yet
        };
        folder.make_new()?;
        folder.published = false;
        folder.lock = Some(lock_new(&folder.places.new).map_err(folder_error)?);
        Ok(folder)
    }

    fn make_new(&self) -> Result<(), ExportError> {
        let new = &self.places.new;
        let folder_error = |source| ExportError::Folder { path: self.shown.clone(), source };
        match fs::create_dir(new) {
            Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {
                match leftover(new).map_err(folder_error)? {
                    Leftover::Abandoned => remove_bake(new).map_err(folder_error)?,
                    Leftover::InUse => return Err(ExportError::OutputInUse { path: self.shown.clone() }),
                    Leftover::Foreign => return Err(ExportError::InTheWay { path: new.clone() }),
                }
                fs::create_dir(new).map_err(folder_error)
            }
            made => {
                if made.is_err() {
                    self.remove_made_parents();
                }
                made.map_err(folder_error)
            }
        }
    }

    /// The hidden folder in which results are collected until they are published.
    pub fn path(&self) -> &Path {
        &self.places.new
    }

    /// The output as the user gave it.
    pub fn shown(&self) -> &Path {
        &self.shown
    }

    /// Makes a file (and the folder that it lies in). `relative` has `/` between its parts.
    ///
    /// # Errors
    /// The file cannot be made.
    pub fn create(&self, relative: &str) -> Result<OutputFile, ExportError> {
        let path = self.places.new.join(relative);
        let shown = self.shown.join(relative);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(ExportError::write(&shown))?;
        }
        // A file that was kept shares its data with the earlier bake and must not be written over.
        let file = File::create_new(&path).map_err(ExportError::write(&shown))?;
        self.note(relative);
        Ok(OutputFile { writer: BufWriter::with_capacity(1 << 16, file), shown })
    }

    /// Writes a small file in one go.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, relative: &str, bytes: &[u8]) -> Result<(), ExportError> {
        let mut file = self.create(relative)?;
        file.write_all(bytes).map_err(OutputFile::explain)?;
        file.close()
    }

    /// Takes a file of the earlier bake over unchanged: as a second name of the same data where the disk can do
    /// that, as a copy elsewhere.
    ///
    /// # Errors
    /// The earlier bake has no such file, or it cannot be copied.
    pub fn keep(&self, relative: &str) -> Result<(), ExportError> {
        let shown = self.shown.join(relative);
        let (from, to) = (self.places.output.join(relative), self.places.new.join(relative));
        if let Some(parent) = to.parent() {
            fs::create_dir_all(parent).map_err(ExportError::write(&shown))?;
        }
        if !from.is_file() {
            return Err(ExportError::Read { path: shown, source: io::ErrorKind::NotFound.into() });
        }
        if fs::hard_link(&from, &to).is_err() {
            fs::copy(&from, &to).map_err(ExportError::write(&shown))?;
        }
        self.note(relative);
        Ok(())
    }

    fn note(&self, relative: &str) {
        self.files.lock().unwrap_or_else(PoisonError::into_inner).insert(relative.to_string());
    }

    /// Writes the manifest, with the list of all files, and puts the folder in the output's place.
    ///
    /// # Errors
    /// The manifest cannot be written or a folder cannot be renamed; the earlier bake is in its place then.
    pub fn publish(mut self, manifest: &Manifest) -> Result<(), ExportError> {
        self.note(manifest::FILE_NAME);
        let files = std::mem::take(&mut *self.files.lock().unwrap_or_else(PoisonError::into_inner));
        let manifest = Manifest { files: files.into_iter().collect(), ..manifest.clone() };
        self.write(manifest::FILE_NAME, &manifest.to_json())?;
        let folder_error = |source| ExportError::Folder { path: self.shown.clone(), source };
        // An open file keeps some systems from renaming the folder.
        drop(self.lock.take());
        fs::remove_file(self.places.new.join(LOCK)).map_err(folder_error)?;
        let replaced = set_aside(&self.places).map_err(folder_error)?;
        if let Err(source) = fs::rename(&self.places.new, &self.places.output) {
            if replaced {
                // Whether or not this works: the next start restores the old bake.
                let _ = fs::rename(&self.places.old, &self.places.output);
            }
            return Err(folder_error(source));
        }
        self.published = true;
        if replaced {
            // The result is in its place. A rest of the old one is removed by the next start.
            let _ = remove_bake(&self.places.old);
        }
        Ok(())
    }

    fn remove_made_parents(&self) {
        for parent in self.made_parents.iter().rev() {
            // Not empty any more: somebody else uses it.
            let _ = fs::remove_dir(parent);
        }
    }
}

impl Drop for OutputFolder {
    fn drop(&mut self) {
        if !self.published {
            drop(self.lock.take());
            // Nobody is left to tell; the next start cleans up.
            let _ = remove_bake(&self.places.new);
            self.remove_made_parents();
        }
    }
}

/// Brings back the bake that a run left as `.NAME.old` when it was killed between two renamings, or removes it if
/// the new one had taken its place. Gives whether there was something to bring back.
///
/// # Errors
/// It cannot be renamed or removed.
pub fn restore(path: &Path) -> Result<bool, ExportError> {
    let places = Places::of(path)?;
    let folder_error = |source| ExportError::Folder { path: path.to_path_buf(), source };
    if !is_bake(&places.old) {
        return Ok(false);
    }
    let restored = !places.output.exists();
    if restored {
        fs::rename(&places.old, &places.output).map_err(folder_error)?;
    } else {
        remove_bake(&places.old).map_err(folder_error)?;
    }
    Ok(restored)
}

/// All that a bake holds at its top.
const BAKED: [&str; 10] = [
    "floor",
    "walls",
    "sums",
    "preview",
    "shaders",
    "scene.glb",
    "scene",
    "index.html",
    manifest::FILE_NAME,
    Report::FILE_NAME,
];

/// Whether the folder holds a bake of ours, as its manifest's `generator` says.
pub fn is_bake(folder: &Path) -> bool {
    manifest::generator(folder).is_ok_and(|generator| generator == manifest::GENERATOR)
}

fn check_replaceable(shown: &Path, output: &Path, force: bool) -> Result<(), ExportError> {
    let path = shown.to_path_buf();
    let entries = match fs::read_dir(output) {
        Ok(entries) => entries,
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(()),
        Err(e) if e.kind() == io::ErrorKind::NotADirectory => {
            // Either it is a file itself, or a part of the way to it is one.
            return Err(if output.exists() {
                ExportError::OutputIsFile { path }
            } else {
                ExportError::Folder { path, source: e }
            });
        }
        Err(source) => return Err(ExportError::Folder { path, source }),
    };
    let folder_error = |source| ExportError::Folder { path: shown.to_path_buf(), source };
    let mut names = Vec::new();
    for entry in entries {
        names.push(entry.map_err(folder_error)?.file_name().to_string_lossy().into_owned());
    }
    names.sort();
    if fs::metadata(output).map_err(folder_error)?.permissions().readonly() {
        return Err(folder_error(io::ErrorKind::PermissionDenied.into()));
    }
    match names.first() {
        None => Ok(()),
        Some(found) if !is_bake(output) => Err(ExportError::NotABake { path, found: found.clone() }),
        Some(_) if !force => Err(ExportError::OutputExists { path }),
        // What somebody else put into a bake is not ours to remove.
        Some(_) => match names.iter().find(|name| !BAKED.contains(&name.as_str())) {
            Some(found) => Err(ExportError::NotABake { path, found: found.clone() }),
            None => Ok(()),
        },
    }
}

/// Makes the folders above `output` that are missing, and gives them, outermost first.
fn make_parents(output: &Path) -> io::Result<Vec<PathBuf>> {
    let Some(parent) = output.parent() else { return Ok(Vec::new()) };
    let mut missing: Vec<PathBuf> =
        parent.ancestors().take_while(|folder| !folder.exists()).map(Path::to_path_buf).collect();
    missing.reverse();
    fs::create_dir_all(parent)?;
    Ok(missing)
}

fn lock_new(new: &Path) -> io::Result<File> {
    let lock = File::create(new.join(LOCK))?;
    match lock.try_lock() {
        // Some network disks cannot lock: then only leftovers are taken less carefully.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(lock),
        Err(TryLockError::WouldBlock) => Err(io::ErrorKind::WouldBlock.into()),
    }
}

enum Leftover {
    /// A killed run of ours left it.
    Abandoned,
    /// A living run writes it.
    InUse,
    /// It is not ours.
    Foreign,
}

fn leftover(new: &Path) -> io::Result<Leftover> {
    match File::open(new.join(LOCK)) {
        Ok(lock) => Ok(match lock.try_lock() {
            Err(TryLockError::WouldBlock) => Leftover::InUse,
            _ => Leftover::Abandoned,
        }),
        // Killed before the lock was made, or after it was removed.
        Err(_) => Ok(match fs::read_dir(new)?.next().is_none() || is_bake(new) {
            true => Leftover::Abandoned,
            false => Leftover::Foreign,
        }),
    }
}

/// Clears the output's place; gives whether an earlier bake was set aside for that.
fn set_aside(places: &Places) -> io::Result<bool> {
    if !places.output.exists() {
        return Ok(false);
    }
    if is_bake(&places.output) {
        fs::rename(&places.output, &places.old)?;
        return Ok(true);
    }
    // Fails unless it is empty: something may have been put there since the start.
    fs::remove_dir(&places.output)?;
    Ok(false)
}

/// Removes a bake, its manifest and its lock last, so that a killed removal leaves what is still recognised as ours.
fn remove_bake(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_name() == manifest::FILE_NAME || entry.file_name() == LOCK {
            continue;
        }
        if entry.file_type()?.is_dir() {
            fs::remove_dir_all(entry.path())?;
        } else {
            fs::remove_file(entry.path())?;
        }
    }
    fs::remove_dir_all(folder)
}

/// A file of an [`OutputFolder`]. Its errors name the place where the file would have appeared: see
/// [`OutputFile::explain`].
#[derive(Debug)]
pub struct OutputFile {
    writer: BufWriter<File>,
    shown: PathBuf,
}

impl OutputFile {
    /// Writes what is buffered and closes the file. A file that is only dropped hides a full disk.
    ///
    /// # Errors
    /// The rest cannot be written.
    pub fn close(mut self) -> Result<(), ExportError> {
        self.flush().map_err(Self::explain)
    }

    /// The error behind one that came out of writing to an output file, through whatever wrote to it.
    pub fn explain(error: io::Error) -> ExportError {
        let kind = error.kind();
        match error.into_inner().map(|inner| inner.downcast::<ExportError>()) {
            Some(Ok(inner)) => *inner,
            Some(Err(other)) => ExportError::Write { path: PathBuf::new(), source: io::Error::new(kind, other) },
            None => ExportError::Write { path: PathBuf::new(), source: kind.into() },
        }
    }

    fn named(&self, source: io::Error) -> io::Error {
        io::Error::new(source.kind(), ExportError::Write { path: self.shown.clone(), source })
    }
}

impl Write for OutputFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.write(bytes).map_err(|e| self.named(e))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush().map_err(|e| self.named(e))
    }
}

impl Seek for OutputFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.writer.seek(to).map_err(|e| self.named(e))
    }
}

#[cfg(test)]
mod tests;
