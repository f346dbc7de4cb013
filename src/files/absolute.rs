use std::path::{Component, Path, PathBuf};
use std::{fs, io};

/// An absolute path without `..`, so that nothing has to be made on the way to it: `nope/../a` is `a` even where there is no
/// `nope`. Behind a link, `..` is the folder above what the link leads to.
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
