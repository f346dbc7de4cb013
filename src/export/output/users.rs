//! The user's files in the folder of a bake.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use crate::files::{Entry, entries, have_same_bytes};

/// The user's files in a folder, as paths relative to it.
#[derive(Debug, Default)]
pub(super) struct UserFiles {
    /// Files and links.
    files: BTreeSet<PathBuf>,
    /// Empty folders.
    folders: BTreeSet<PathBuf>,
}

impl UserFiles {
    /// Collects all files that are not in `listed`; empty if the folder does not exist.
    pub fn of(folder: &Path, listed: &BTreeSet<PathBuf>) -> io::Result<UserFiles> {
        let mut users = UserFiles::default();
        if !folder.exists() {
            return Ok(users);
        }
        let mut used = BTreeSet::new();
        for Entry { relative, kind } in entries(folder)? {
            used.extend(relative.parent().map(Path::to_path_buf));
            if !kind.is_dir() {
                if !listed.contains(&relative) {
                    users.files.insert(relative);
                }
            } else if !used.contains(&relative) {
                users.folders.insert(relative);
            }
        }
        Ok(users)
    }

    /// Returns the user's file or folder that conflicts with a new file of this name.
    pub fn in_the_way(&self, relative: &Path) -> Option<&Path> {
        let file = self.files.iter().find(|file| relative.starts_with(file) || file.starts_with(relative));
        file.or_else(|| self.folders.iter().find(|folder| folder.starts_with(relative))).map(PathBuf::as_path)
    }

    /// Links or copies the files into another folder; they also stay here.
    ///
    /// # Errors
    /// A file can neither be linked nor copied.
    pub fn take_over(&self, from: &Path, to: &Path) -> io::Result<()> {
        let mut made = BTreeSet::new();
        for relative in self.files.iter().chain(&self.folders) {
            let folders = relative.ancestors().skip(usize::from(self.files.contains(relative)));
            made.extend(folders.filter(|folder| !to.join(folder).exists()).map(Path::to_path_buf));
            let (from, to) = (from.join(relative), to.join(relative));
            if self.folders.contains(relative) {
                fs::create_dir_all(to)?;
                continue;
            }
            fs::create_dir_all(to.parent().unwrap_or(Path::new("")))?;
            match fs::read_link(&from) {
                Ok(target) => link_again(&target, &from, &to)?,
                Err(_) => link_or_copy(&from, &to)?,
            }
        }
        // Permissions last and innermost first: a folder may be read-only.
        made.iter()
            .rev()
            .try_for_each(|folder| fs::set_permissions(to.join(folder), fs::metadata(from.join(folder))?.permissions()))
    }
}

/// Hard-links a file, or copies it where the disk has no hard links. Never replaces a file.
pub(super) fn link_or_copy(from: &Path, to: &Path) -> io::Result<()> {
    if fs::hard_link(from, to).is_ok() {
        return Ok(());
    }
    let found = fs::metadata(from)?;
    if !found.is_file() {
        return Err(io::ErrorKind::Unsupported.into());
    }
    let mut copy = File::create_new(to)?;
    io::copy(&mut File::open(from)?, &mut copy)?;
    copy.set_modified(found.modified()?)?;
    copy.set_permissions(found.permissions())?;
    copy.sync_all()
}

#[cfg(unix)]
fn link_again(target: &Path, _from: &Path, to: &Path) -> io::Result<()> {
    std::os::unix::fs::symlink(target, to)
}

#[cfg(windows)]
fn link_again(target: &Path, from: &Path, to: &Path) -> io::Result<()> {
    if from.is_dir() {
        std::os::windows::fs::symlink_dir(target, to)
    } else {
        std::os::windows::fs::symlink_file(target, to)
    }
}

#[cfg(not(any(unix, windows)))]
fn link_again(_target: &Path, _from: &Path, _to: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

/// Whether two paths are the same file, or files or links with equal content.
pub(super) fn is_same(a: &Path, b: &Path) -> io::Result<bool> {
    let (Ok(found_a), Ok(found_b)) = (fs::symlink_metadata(a), fs::symlink_metadata(b)) else { return Ok(false) };
    if found_a.is_symlink() && found_b.is_symlink() {
        return Ok(fs::read_link(a)? == fs::read_link(b)?);
    }
    if is_one_file(&found_a, &found_b) {
        return Ok(true);
    }
    if !found_a.is_file() || !found_b.is_file() {
        return Ok(false);
    }
    Ok(have_same_bytes(a, b)?)
}

#[cfg(unix)]
fn is_one_file(a: &fs::Metadata, b: &fs::Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    (a.dev(), a.ino()) == (b.dev(), b.ino())
}

#[cfg(not(unix))]
fn is_one_file(_: &fs::Metadata, _: &fs::Metadata) -> bool {
    false
}
