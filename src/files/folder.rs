//! What lies in folders.

use std::fs::{self, File, FileType};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// A file or folder that cannot be read.
#[derive(Debug)]
pub(crate) struct Unreadable {
    pub path: PathBuf,
    pub source: io::Error,
}

impl Unreadable {
    fn of(path: &Path) -> impl Fn(io::Error) -> Unreadable {
        move |source| Unreadable { path: path.to_path_buf(), source }
    }
}

impl From<Unreadable> for io::Error {
    fn from(error: Unreadable) -> io::Error {
        error.source
    }
}

/// Something in a folder.
pub(crate) struct Entry {
    /// Its path from that folder.
    pub relative: PathBuf,
    pub kind: FileType,
}

/// All that lies in a folder at any depth, what a folder holds before the folder itself. No link is followed.
///
/// # Errors
/// A folder cannot be read.
pub(crate) fn entries(folder: &Path) -> Result<Vec<Entry>, Unreadable> {
    fn collect(folder: &Path, relative: &Path, out: &mut Vec<Entry>) -> Result<(), Unreadable> {
        for entry in fs::read_dir(folder).map_err(Unreadable::of(folder))? {
            let entry = entry.map_err(Unreadable::of(folder))?;
            let relative = relative.join(entry.file_name());
            let kind = entry.file_type().map_err(Unreadable::of(folder))?;
            if kind.is_dir() {
                collect(&entry.path(), &relative, out)?;
            }
            out.push(Entry { relative, kind });
        }
        Ok(())
    }
    let mut out = Vec::new();
    collect(folder, Path::new(""), &mut out)?;
    Ok(out)
}

/// Whether two files hold the same bytes.
///
/// # Errors
/// A file cannot be read.
pub(crate) fn have_same_bytes(a: &Path, b: &Path) -> Result<bool, Unreadable> {
    let open = |path: &Path| -> Result<(File, u64), Unreadable> {
        let file = File::open(path).map_err(Unreadable::of(path))?;
        let length = file.metadata().map_err(Unreadable::of(path))?.len();
        Ok((file, length))
    };
    let ((mut file_a, length_a), (mut file_b, length_b)) = (open(a)?, open(b)?);
    if length_a != length_b {
        return Ok(false);
    }
    let (mut bytes_a, mut bytes_b) = (Vec::new(), Vec::new());
    loop {
        for (file, path, bytes) in [(&mut file_a, a, &mut bytes_a), (&mut file_b, b, &mut bytes_b)] {
            bytes.clear();
            file.take(1 << 16).read_to_end(bytes).map_err(Unreadable::of(path))?;
        }
        if bytes_a != bytes_b || bytes_a.is_empty() {
            return Ok(bytes_a == bytes_b);
        }
    }
}

/// The files that lie in a folder itself; nothing if it cannot be read.
pub fn files_in(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries.map(|entry| entry.path()).filter(|path| path.is_file()).collect()
}
