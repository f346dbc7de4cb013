use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use super::ExportError;
use super::bake_path::{BakePath, MANIFEST_NAME};
use super::manifest::Manifest;
use crate::files::{FileError, LockError, NameLock};

mod places;
mod settled;
mod users;

pub(super) use places::is_bake;
pub use settled::settled;

use places::{Places, UNFINISHED};
use users::UserFiles;

/// Files that the system puts into folders that somebody looks at.
const LITTER: [&str; 3] = [".DS_Store", "Thumbs.db", "desktop.ini"];

/// A folder of results that appears whole or not at all.
///
/// Results are collected in a hidden folder beside the output, `.NAME.new`. [`OutputFolder::publish`] exchanges it with
/// the earlier bake in one step and then removes that bake. Where the system cannot exchange folders, the earlier bake
/// is `.NAME.old` for a moment. Dropping an unpublished folder removes it and leaves the earlier bake unchanged. The
/// process holds a lock on `.NAME.lock` all the time.
///
/// It only replaces an empty folder or, with `force`, an earlier bake. Of that bake it removes the files that the
/// manifest lists. All other files are the user's: they stay at the same place in the folder.
#[derive(Debug)]
pub struct OutputFolder {
    /// Path as the user gave it, for messages.
    shown: PathBuf,
    places: Places,
    force: bool,
    lock: Option<NameLock>,
    /// Parents of the output that were created, outermost first.
    made_parents: Vec<PathBuf>,
    /// The user's files in the output at the beginning.
    users: UserFiles,
    files: Mutex<BTreeSet<BakePath>>,
    /// Whether to remove the hidden folder on drop.
    is_open: bool,
}

impl OutputFolder {
    /// Creates the hidden folder, after cleaning up after a killed run.
    ///
    /// With `force`, it may replace an earlier bake, but never another folder with files in it.
    ///
    /// # Errors
    /// The output is a file, holds files that are not a bake's, holds a bake and `force` is not set, is being written
    /// by another process, or cannot be written.
    pub fn begin(path: &Path, force: bool) -> Result<OutputFolder, ExportError> {
        let places = Places::of(path)?;
        // First before anything is created, and again below under the lock.
        earlier(path, &places.output, force)?;
        let mut folder = OutputFolder {
            shown: path.to_path_buf(),
            places,
            force,
            lock: None,
            made_parents: Vec::new(),
            users: UserFiles::default(),
            files: Mutex::default(),
            is_open: false,
        };
        folder.lock()?;
        folder.places.recover(path)?;
        let listed = earlier(path, &folder.places.output, force)?;
        folder.users = UserFiles::of(&folder.places.output, &listed).map_err(|e| folder.failed(e))?;
        fs::create_dir(&folder.places.new).map_err(|e| folder.failed(e))?;
        folder.is_open = true;
        fs::write(folder.places.new.join(UNFINISHED), "").map_err(|e| folder.failed(e))?;
        Ok(folder)
    }

    fn lock(&mut self) -> Result<(), ExportError> {
        // Another process may remove a parent that it made, just before this one locks.
        for _ in 0..5 {
            let made = make_parents(&self.places.output).map_err(|e| self.failed(e))?;
            self.made_parents.extend(made);
            match NameLock::take(&self.places.lock) {
                Ok(lock) => {
                    self.lock = Some(lock);
                    return Ok(());
                }
                Err(LockError::InUse) => return Err(ExportError::OutputInUse { path: self.shown.clone() }),
                Err(LockError::InTheWay) => return Err(ExportError::InTheWay { path: self.places.lock.clone() }),
                Err(LockError::Io(e)) if e.kind() == io::ErrorKind::NotFound => {}
                Err(LockError::Io(e)) => return Err(self.failed(e)),
            }
        }
        Err(self.failed(io::ErrorKind::NotFound.into()))
    }

    fn failed(&self, source: io::Error) -> ExportError {
        ExportError::Folder { path: self.shown.clone(), source }
    }

    /// The hidden folder in which results are collected until they are published.
    pub fn path(&self) -> &Path {
        &self.places.new
    }

    /// Path of the output as the user gave it.
    pub fn shown(&self) -> &Path {
        &self.shown
    }

    /// Checks, before the run does any work, that no file of the user has one of these names.
    ///
    /// `relative` has `/` between its parts.
    ///
    /// # Errors
    /// [`ExportError::UserFile`].
    pub fn check_free(&self, relative: &[&str]) -> Result<(), ExportError> {
        relative.iter().try_for_each(|relative| self.check_user(&self.users, relative))
    }

    fn check_user(&self, users: &UserFiles, relative: &str) -> Result<(), ExportError> {
        match users.in_the_way(Path::new(relative)) {
            Some(found) => Err(ExportError::UserFile { path: self.shown.join(found) }),
            None => Ok(()),
        }
    }

    /// Checks that no input of the run is a file of the earlier bake, which `publish` removes.
    ///
    /// # Errors
    /// [`FileError::IsInput`].
    pub fn check_not_inputs(&self, inputs: &[PathBuf]) -> Result<(), FileError> {
        let Ok(output) = fs::canonicalize(&self.places.output) else { return Ok(()) };
        for input in inputs.iter().filter(|input| input.is_file()) {
            let real = fs::canonicalize(input).unwrap_or_else(|_| input.clone());
            if real.strip_prefix(&output).is_ok_and(|relative| self.users.in_the_way(relative).is_none()) {
                return Err(FileError::IsInput { path: input.clone() });
            }
        }
        Ok(())
    }

    /// Creates a file, and the folder that it lies in. `relative` has `/` between its parts.
    ///
    /// # Errors
    /// The file cannot be created, or a file of the user has its name.
    pub(crate) fn create(&self, relative: &str) -> Result<OutputFile, ExportError> {
        let relative = BakePath::new(relative)?;
        self.check_user(&self.users, &relative)?;
        let path = self.places.new.join(&relative);
        let shown = self.shown.join(&relative);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(ExportError::write(&shown))?;
        }
        // A kept file is a hard link to the earlier bake's and must not be overwritten.
        let file = File::create_new(&path).map_err(ExportError::write(&shown))?;
        self.note(relative);
        Ok(OutputFile { writer: BufWriter::with_capacity(1 << 16, file), shown })
    }

    /// Creates a file with this content.
    ///
    /// # Errors
    /// The same as for `OutputFolder::create`.
    pub fn write(&self, relative: &str, bytes: &[u8]) -> Result<(), ExportError> {
        self.write_with(relative, |file| file.write_all(bytes))
    }

    /// Creates a file with what `write` gives.
    ///
    /// # Errors
    /// The same as for `OutputFolder::create`.
    pub(crate) fn write_with(
        &self,
        relative: &str,
        write: impl FnOnce(&mut OutputFile) -> io::Result<()>,
    ) -> Result<(), ExportError> {
        let mut file = self.create(relative)?;
        write(&mut file).map_err(OutputFile::explain)?;
        file.close()
    }

    /// Keeps a file of an earlier bake, as a hard link where the disk supports it, else as copy.
    ///
    /// # Errors
    /// The bake has no such file, a link leads out of the bake, or the copy fails.
    pub fn keep(&self, bake: &Path, relative: &BakePath) -> Result<(), ExportError> {
        let shown = bake.join(relative);
        relative.within(bake)?;
        let from = fs::canonicalize(&shown).map_err(ExportError::read(&shown))?;
        if !from.is_file() {
            return Err(ExportError::Read { path: shown, source: io::ErrorKind::NotFound.into() });
        }
        let to = self.places.new.join(relative);
        if let Some(parent) = to.parent() {
            fs::create_dir_all(parent).map_err(ExportError::write(&shown))?;
        }
        users::link_or_copy(&from, &to).map_err(ExportError::write(&shown))?;
        self.note(relative.clone());
        Ok(())
    }

    fn note(&self, relative: BakePath) {
        self.files.lock().unwrap_or_else(PoisonError::into_inner).insert(relative);
    }

    /// Writes the manifest with the list of all files, and moves the folder to the output's place.
    ///
    /// # Errors
    /// The manifest cannot be written; another folder than the earlier bake is at the output's place; a rename fails.
    /// The earlier bake is then at its place.
    pub fn publish(mut self, manifest: &Manifest) -> Result<(), ExportError> {
        self.note(BakePath::new(MANIFEST_NAME)?);
        let files: Vec<BakePath> =
            std::mem::take(&mut *self.files.lock().unwrap_or_else(PoisonError::into_inner)).into_iter().collect();
        let manifest = Manifest { files, ..manifest.clone() };
        self.write(MANIFEST_NAME, &manifest.to_json())?;
        self.take_user_files_over(&manifest.files)?;
        let new = &self.places.new;
        if self.places.output.exists() {
            // The new bake has to be on the disk before the earlier one is removed.
            places::sync(new, &manifest.files).map_err(|e| self.failed(e))?;
        }
        fs::remove_file(new.join(UNFINISHED)).map_err(|e| self.failed(e))?;
        let replaced = self.places.put_in_place().map_err(|e| self.failed(e))?;
        self.is_open = false;
        if let Some(replaced) = replaced {
            // The result is published. The next run removes any rest of the old one.
            let _ = places::clear(&replaced, &self.places.output);
        }
        Ok(())
    }

    /// Links or copies the user's files in the current output into the new folder.
    fn take_user_files_over(&self, files: &[BakePath]) -> Result<(), ExportError> {
        let listed = earlier(&self.shown, &self.places.output, self.force)?;
        let users = UserFiles::of(&self.places.output, &listed).map_err(|e| self.failed(e))?;
        files.iter().try_for_each(|file| self.check_user(&users, file))?;
        users.take_over(&self.places.output, &self.places.new).map_err(|e| self.failed(e))
    }
}

impl Drop for OutputFolder {
    fn drop(&mut self) {
        if self.is_open {
            // A failure cannot be reported here; the next run cleans up.
            let _ = fs::remove_dir_all(&self.places.new);
        }
        drop(self.lock.take());
        for parent in self.made_parents.iter().rev() {
            // Fails for a parent that is not empty, which is right.
            let _ = fs::remove_dir(parent);
        }
    }
}

/// Makes sure that the output may be replaced; gives the files that the earlier bake in it lists.
fn earlier(shown: &Path, output: &Path, force: bool) -> Result<BTreeSet<PathBuf>, ExportError> {
    let path = shown.to_path_buf();
    let entries = match fs::read_dir(output) {
        Ok(entries) => entries,
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(BTreeSet::new()),
        Err(e) if e.kind() == io::ErrorKind::NotADirectory => {
            // The output or one of its parents is a file.
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
    names.retain(|name| !LITTER.contains(&name.as_str()));
    if fs::metadata(output).map_err(folder_error)?.permissions().readonly() {
        return Err(folder_error(io::ErrorKind::PermissionDenied.into()));
    }
    match names.iter().min() {
        None => Ok(BTreeSet::new()),
        Some(found) if !is_bake(output).map_err(folder_error)? => {
            Err(ExportError::NotABake { path, found: found.clone() })
        }
        Some(_) if !force => Err(ExportError::OutputExists { path }),
        Some(_) => places::listed(output),
    }
}

/// Creates the missing parents of `output` and returns them, outermost first.
fn make_parents(output: &Path) -> io::Result<Vec<PathBuf>> {
    let Some(parent) = output.parent() else { return Ok(Vec::new()) };
    let mut missing: Vec<PathBuf> =
        parent.ancestors().take_while(|folder| !folder.exists()).map(Path::to_path_buf).collect();
    missing.reverse();
    fs::create_dir_all(parent)?;
    Ok(missing)
}

/// A file of an [`OutputFolder`]. Its errors name its path in the output.
///
/// [`OutputFile::explain`] gets the error back from an [`io::Error`].
#[derive(Debug)]
pub struct OutputFile {
    writer: BufWriter<File>,
    shown: PathBuf,
}

impl OutputFile {
    /// Flushes and closes the file. Dropping it instead would hide a full disk.
    ///
    /// # Errors
    /// The buffered rest cannot be written.
    pub fn close(mut self) -> Result<(), ExportError> {
        self.flush().map_err(Self::explain)
    }

    /// Unwraps the [`ExportError`] in an I/O error of an output file, also through other writers.
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
