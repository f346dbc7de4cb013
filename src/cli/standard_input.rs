//! Standard input as a file.

use std::cell::OnceCell;
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use anyhow::Context;
use tempfile::TempDir;

use super::print::Refused;

const FILE_NAME: &str = "-";
/// File name of the copy.
const SPOOLED: &str = "stdin";
const SHOWN: &str = "standard input";
/// Largest scenario or plan on standard input, bytes.
const MOST_BYTES: u64 = 1 << 30;

/// Whether a file name stands for standard input.
pub fn is_meant(path: &Path) -> bool {
    path == Path::new(FILE_NAME)
}

/// Whether a text is the YAML of a ROS map rather than a scenario.
pub fn is_ros_map(text: &str) -> bool {
    let has = |key: &str| {
        text.lines().any(|line| line.strip_prefix(key).is_some_and(|rest| rest.trim_start().starts_with(':')))
    };
    has("image") && has("resolution")
}

/// What stands in messages and names of results in the place of a file's name.
pub fn shown() -> &'static Path {
    Path::new(SHOWN)
}

/// A temporary copy of standard input, removed on drop.
#[derive(Debug, Default)]
pub struct Spool(OnceCell<TempDir>);

impl Spool {
    /// Copies all of standard input to a file and returns its path.
    pub fn fill(&self) -> anyhow::Result<PathBuf> {
        self.hold(|path| io::copy(&mut io::stdin().lock(), &mut fs::File::create(path)?).map(drop))
    }

    /// Writes bytes from standard input to a file and returns its path.
    pub fn keep(&self, bytes: &[u8]) -> anyhow::Result<PathBuf> {
        self.hold(|path| fs::write(path, bytes))
    }

    fn hold(&self, write: impl FnOnce(&Path) -> io::Result<()>) -> anyhow::Result<PathBuf> {
        let folder = tempfile::tempdir().context("cannot make a temporary folder for standard input")?;
        let path = folder.path().join(SPOOLED);
        write(&path).context("cannot copy standard input to a temporary file")?;
        // Each owner asks only once.
        let _ = self.0.set(folder);
        Ok(path)
    }

    /// Replaces the path of the copy in an error by `standard input`.
    pub fn explain(&self, error: trodden::Error) -> anyhow::Error {
        let Some(folder) = self.0.get() else { return error.into() };
        let copy = folder.path().join(SPOOLED).display().to_string();
        let message = error.to_string();
        if !message.contains(&copy) {
            return error.into();
        }
        let hint = error.hint().map(|hint| hint.replace(&copy, SHOWN).into());
        Refused { message: message.replace(&copy, SHOWN), hint }.into()
    }
}

/// Reads all of standard input, a scenario or a plan.
pub fn read() -> anyhow::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    io::stdin().lock().take(MOST_BYTES + 1).read_to_end(&mut bytes).context("cannot read standard input")?;
    let problem = match bytes.len() as u64 {
        0 => "standard input is empty".to_string(),
        length if length > MOST_BYTES => format!("standard input has more than {MOST_BYTES} bytes"),
        _ => return Ok(bytes),
    };
    let hint = Some("a scenario or the image of a plan is read from it".into());
    Err(Refused { message: problem, hint }.into())
}
