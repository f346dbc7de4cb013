//! A folder to run the program in.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Output};

use image::{GrayImage, Luma};

pub struct Sandbox {
    folder: tempfile::TempDir,
}

/// What a run left behind.
#[derive(Debug)]
pub struct Ran {
    /// The exit code; 128 and the signal's number where a signal ended the program, as shells have it.
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
    /// Names and contents of everything below the folder.
    before: BTreeMap<PathBuf, Vec<u8>>,
    after: BTreeMap<PathBuf, Vec<u8>>,
}

impl Sandbox {
    pub fn new() -> Sandbox {
        Sandbox { folder: tempfile::tempdir().unwrap() }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, bytes).unwrap();
        path
    }

    /// A corridor of 8 x 3 m from west to east, with walls of half a metre, as `plan.png`.
    pub fn plan(&self) -> PathBuf {
        let path = self.path("plan.png");
        corridor().save(&path).unwrap();
        path
    }

    /// The program, ready to be run here, without a terminal and its colours.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_trodden"));
        command.args(arguments).current_dir(self.folder.path()).env_remove("NO_COLOR");
        command
    }

    pub fn run(&self, arguments: &[&str]) -> Ran {
        self.run_command(&mut self.command(arguments))
    }

    pub fn run_command(&self, command: &mut Command) -> Ran {
        let before = self.contents();
        let output = command.output().unwrap();
        self.ran(before, output)
    }

    pub fn ran(&self, before: BTreeMap<PathBuf, Vec<u8>>, output: Output) -> Ran {
        // Temporary folders have names that differ from run to run.
        let clean = |bytes: Vec<u8>| {
            String::from_utf8(bytes).unwrap().replace(&self.folder.path().display().to_string(), "[SANDBOX]")
        };
        let after = self.contents();
        Ran { code: code(output.status), out: clean(output.stdout), err: clean(output.stderr), before, after }
    }

    pub fn contents(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        fn collect(folder: &Path, found: &mut BTreeMap<PathBuf, Vec<u8>>) {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    collect(&path, found);
                    found.insert(path, Vec::new());
                } else {
                    let bytes = fs::read(&path).unwrap_or_default();
                    found.insert(path, bytes);
                }
            }
        }
        let mut found = BTreeMap::new();
        collect(self.folder.path(), &mut found);
        found
    }
}

#[cfg(unix)]
fn code(status: ExitStatus) -> Option<i32> {
    use std::os::unix::process::ExitStatusExt;
    status.code().or_else(|| Some(128 + status.signal()?))
}

#[cfg(not(unix))]
fn code(status: ExitStatus) -> Option<i32> {
    status.code()
}

/// See [`Sandbox::plan`].
pub fn corridor() -> GrayImage {
    GrayImage::from_fn(80, 40, |_, y| Luma([if (5..35).contains(&y) { 255 } else { 0 }]))
}

impl Ran {
    /// Ended well.
    #[track_caller]
    pub fn succeeds(self) -> Ran {
        assert_eq!(self.code, Some(0), "{}\n{}", self.out, self.err);
        assert!(!self.err.contains("panicked"), "{}", self.err);
        self
    }

    /// Ended with this exit code and one clear error that has all these parts; nothing was written.
    #[track_caller]
    pub fn fails(self, code: i32, parts: &[&str]) -> Ran {
        assert_eq!(self.code, Some(code), "out: {}\nerr: {}", self.out, self.err);
        let errors = self.err.lines().filter(|line| line.starts_with("error: ")).count();
        assert_eq!(errors, 1, "{}", self.err);
        assert!(!self.err.contains("panicked"), "{}", self.err);
        for part in parts {
            assert!(self.err.contains(part), "no {part:?} in:\n{}", self.err);
        }
        assert_eq!(self.out, "");
        let names = |contents: &BTreeMap<PathBuf, Vec<u8>>| contents.keys().cloned().collect::<Vec<_>>();
        assert_eq!(names(&self.after), names(&self.before), "files came or went");
        assert!(self.after == self.before, "a file changed");
        self
    }

    /// Failed with code 1; gives what it said, in whatever colours.
    #[allow(dead_code)] // not every folder of tests needs it
    #[track_caller]
    #[allow(dead_code)] // not every test program looks at colours
    pub fn fails_in_colour(self) -> String {
        assert_eq!((self.code, self.out.as_str()), (Some(1), ""));
        self.err
    }

    /// The paths below the folder that were not there before.
    #[allow(dead_code)] // not every folder of tests needs it
    pub fn made(&self) -> Vec<&Path> {
        self.after.keys().filter(|path| !self.before.contains_key(*path)).map(PathBuf::as_path).collect()
    }
}
