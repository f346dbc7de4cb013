use std::io;
use std::path::PathBuf;

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
    /// The same run reads this file.
    #[error("cannot write {}: the same run reads it", path.display())]
    IsInput {
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
            FileError::Exists { .. } => Some("the option `force` replaces it; or choose another file".to_string()),
            FileError::IsFolder { .. } | FileError::HasNoName { .. } => Some("name a file".to_string()),
            FileError::IsInput { .. } => Some("choose another file".to_string()),
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
