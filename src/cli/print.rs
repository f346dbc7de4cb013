//! Output to standard output and standard error, and files of results.

use std::borrow::Cow;
use std::fmt::Display;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::ColorChoice;
use clap::builder::styling::{AnsiColor, Style};
use trodden::export::Manifest;
use trodden::files::{WholeFile, check_not_input, write_whole};
use trodden::show::encode_picture;

use super::Common;

const ERROR: Style = AnsiColor::Red.on_default().bold();
const WARNING: Style = AnsiColor::Yellow.on_default().bold();
const HINT: Style = AnsiColor::Cyan.on_default().bold();

/// Writes a line to standard output.
///
/// A closed pipe is an error here, so that the work stops; [`failure`] does not report it.
pub fn line(text: impl Display) -> anyhow::Result<()> {
    Ok(writeln!(io::stdout(), "{}", plain(&text.to_string()))?)
}

/// Writes text unchanged to standard output.
pub fn text(text: &str) -> anyhow::Result<()> {
    Ok(io::stdout().write_all(text.as_bytes())?)
}

/// Prints why a command failed: the error, its causes, a hint.
pub fn failure(error: &anyhow::Error, common: &Common) -> ExitCode {
    if is_broken_pipe(error) {
        return ExitCode::SUCCESS;
    }
    let colour = common.colours(&io::stderr());
    let named = |text: String| with_flags(&text, &common.flags);
    let mut text = format!("{} {}\n", label("error", ERROR, colour), plain(&named(error.to_string())));
    let mut last = error.to_string();
    for cause in error.chain().skip(1).map(ToString::to_string) {
        // Many messages already contain their cause.
        if !last.contains(&cause) {
            text.push_str(&format!("  caused by: {}\n", plain(&named(cause.clone()))));
            last = cause;
        }
    }
    let ours = error.chain().find_map(trodden::Error::hint_of);
    let refused = error.downcast_ref::<Refused>().and_then(|refused| refused.hint.as_ref()).map(ToString::to_string);
    if let Some(hint) = ours.or(refused) {
        text.push_str(&format!("{} {}\n", label("hint", HINT, colour), plain(&named(hint))));
    }
    to_stderr(&text);
    ExitCode::FAILURE
}

/// The text of a warning.
pub fn warning(message: &str, common: &Common) -> String {
    format!(
        "{} {}\n",
        label("warning", WARNING, common.colours(&io::stderr())),
        plain(&with_flags(message, &common.flags))
    )
}

/// Writes to standard error and ignores failures.
pub fn to_stderr(text: &str) {
    let _ = io::stderr().write_all(text.as_bytes());
}

/// How the library names an option that is a flag on the command line: "the option `fps`", "the option `fps = 25`".
pub const OPTION: &str = "the option `";

/// Names the options of the library as the flags that the command has: "the option `fps = 25`" becomes "--fps 25".
fn with_flags(text: &str, flags: &[String]) -> String {
    let mut parts = text.split(OPTION);
    let mut named = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let (option, rest) = part.split_once('`').unwrap_or((part, ""));
        let (name, value) = option.split_once(" = ").unwrap_or((option, ""));
        let flag = name.replace('_', "-");
        if flags.contains(&flag) {
            named.push_str(format!("--{flag} {}", value.trim_matches('"')).trim_end());
            named.push_str(rest);
        } else {
            named.push_str(OPTION);
            named.push_str(part);
        }
    }
    named
}

/// Text that leaves the terminal as it is: control characters and those that turn the direction of writing are shown
/// as escapes, but for ends of lines. Names of files, routes and stops may hold any.
fn plain(text: &str) -> Cow<'_, str> {
    let turns = |c: char| matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    let is_unsafe = |c: char| c != '\n' && (c.is_control() || turns(c));
    if !text.contains(is_unsafe) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if is_unsafe(c) { shown.extend(c.escape_unicode()) } else { shown.push(c) }
    }
    Cow::Owned(shown)
}

fn label(name: &str, style: Style, colour: bool) -> String {
    if colour { format!("{style}{name}:{style:#}") } else { format!("{name}:") }
}

/// Whether the reader of standard output closed the pipe, as `head` does.
pub fn is_broken_pipe(error: &anyhow::Error) -> bool {
    let is_one = |cause: &(dyn std::error::Error + 'static)| {
        cause.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
    };
    error.chain().any(is_one)
}

impl Common {
    /// Whether to colour the output to a stream.
    pub fn colours(&self, stream: &impl IsTerminal) -> bool {
        match self.color {
            ColorChoice::Always => true,
            ColorChoice::Never => false,
            // https://no-color.org
            ColorChoice::Auto => {
                let unwanted = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
                stream.is_terminal() && !unwanted
            }
        }
    }
}

/// An error of the command line itself, with a hint.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
pub struct Refused {
    pub message: String,
    pub hint: Option<Cow<'static, str>>,
}

/// A file that a command writes when its work is done.
pub struct PlannedFile {
    path: PathBuf,
    force: bool,
}

/// Checks, before the work begins, that a file may be written.
///
/// Refuses an existing file without `force`, and always a file that the command reads.
pub fn plan_file(path: &Path, force: bool, inputs: &[PathBuf]) -> Result<PlannedFile, trodden::Error> {
    check_not_input(path, inputs)?;
    // Begun and dropped: a command that a signal ends leaves nothing behind.
    WholeFile::begin(path, force)?;
    Ok(PlannedFile { path: path.to_path_buf(), force })
}

/// Writes a picture as PNG, whatever the file's extension.
pub fn save_picture(picture: &image::RgbImage, file: PlannedFile) -> Result<(), trodden::Error> {
    save(&encode_picture(picture), file)
}

/// Writes a planned file, completely or not at all.
pub fn save(bytes: &[u8], file: PlannedFile) -> Result<(), trodden::Error> {
    write_whole(&file.path, bytes, file.force)?;
    Ok(())
}

/// Lists the files that reading a bake, or a single image, needs.
pub fn files_of(bake: &Path) -> Vec<PathBuf> {
    let listed = Manifest::read(bake).map(|manifest| manifest.files).unwrap_or_default();
    let image = Some(bake.to_path_buf()).filter(|path| path.is_file());
    listed.iter().map(|file| bake.join(file)).chain(image).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_of_the_library_become_the_flags_of_the_command() {
        let flags = ["fps".to_string(), "mix-fps".to_string()];
        for (text, named) in [
            ("give the rate with the option `fps`: 25", "give the rate with --fps: 25"),
            ("as in the option `mix_fps = \"25\"`", "as in --mix-fps 25"),
            ("the option `unit` overrides it", "the option `unit` overrides it"),
            ("did you mean `fps`?", "did you mean `fps`?"),
            ("an end in the option `fps", "an end in --fps"),
        ] {
            assert_eq!(with_flags(text, &flags), named);
        }
    }
}
