use std::path::{Component, Path, PathBuf};
use std::{fs, io};

/// Returns an absolute path without `.` and `..`.
///
/// `nope/../a` is `a` even if `nope` does not exist. After a link, `..` is the parent of the link's target.
///
/// # Errors
/// The path is empty, or there is no working directory.
pub fn absolute(path: &Path) -> io::Result<PathBuf> {
    let mut found = PathBuf::new();
    for part in std::path::absolute(path)?.components() {
        if part == Component::ParentDir {
            found = fs::canonicalize(&found).unwrap_or(found);
            found.pop();
        } else {
            found.push(part);
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parents_are_resolved_whether_they_are_there_or_not() {
        let folder = tempfile::tempdir().unwrap();
        let root = fs::canonicalize(folder.path()).unwrap();
        assert_eq!(absolute(&root.join("nope/../a/b/..")).unwrap(), root.join("a"));
        assert_eq!(absolute(&root.join("./a")).unwrap(), root.join("a"));
        fs::create_dir_all(root.join("x/y")).unwrap();
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(root.join("x/y"), root.join("link")).unwrap();
            assert_eq!(absolute(&root.join("link/../a")).unwrap(), root.join("x/a"));
        }
        assert_eq!(absolute(Path::new("/../..")).unwrap(), Path::new("/"));
    }
}
