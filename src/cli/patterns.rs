use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, Subcommand};
use trodden::Error;
use trodden::files::files_in;
use trodden::patterns::{Pattern, PatternFolder, PatternLibrary, contact_sheet};

use super::import_pattern::Import;
use super::{Common, print};

/// List the patterns that shoes, hands and bags leave, draw them, or take one from a photograph
#[derive(Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
#[command(after_help = "\
Examples:
  trodden patterns --picture sheet.png     the built-in library
  trodden patterns my-patterns             a folder of your own, with a patterns.toml
  trodden patterns import wall.jpg --cause hand --scale 42 --into my-patterns
                                           a stain from a photograph with 42 pixels per centimetre")]
pub struct Patterns {
    #[command(subcommand)]
    command: Option<PatternsCommand>,
    /// A folder with patterns.toml and its images [default: the built-in library]
    #[arg(value_name = "FOLDER")]
    folder: Option<PathBuf>,
    /// Draw the contact sheet, as a PNG at 10 px/cm
    #[arg(long, value_name = "FILE")]
    picture: Option<PathBuf>,
    /// Replace the picture if it is there
    #[arg(long, requires = "picture")]
    force: bool,
}

#[derive(Subcommand)]
enum PatternsCommand {
    Import(Import),
}

impl Patterns {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        if let Some(PatternsCommand::Import(import)) = &self.command {
            return import.run(common);
        }
        let inputs = self.folder.as_deref().map(files_in).unwrap_or_default();
        let picture = self.picture.as_ref().map(|path| print::plan_file(path, self.force, &inputs)).transpose()?;
        let library = match &self.folder {
            None => PatternLibrary::built_in(),
            Some(folder) => own(folder, common)?,
        };
        if !common.quiet {
            list(&library)?;
        }
        if let (Some(path), Some(file)) = (&self.picture, picture) {
            print::save_picture(&contact_sheet(&library), file)?;
            if !common.quiet {
                print::line(format!("drawn to {}", path.display()))?;
            }
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// Reads a folder's own patterns. Prints the causes that it borrows and its unlisted images.
fn own(folder: &Path, common: &Common) -> anyhow::Result<PatternLibrary> {
    let read = PatternFolder::read(folder).map_err(Error::from)?;
    let mut patterns = read.library.patterns;
    patterns.truncate(read.own);
    if !common.quiet {
        if !read.borrowed.is_empty() {
            let causes: Vec<&str> = read.borrowed.iter().map(|cause| cause.name()).collect();
            print::line(format!("not listed here, so the built-in ones are used: {}", causes.join(", ")))?;
        }
        for image in &read.unlisted {
            let image = folder.join(image);
            let message = format!("{} is not listed in patterns.toml: it is not used", image.display());
            print::to_stderr(&print::warning(&message, common));
        }
    }
    Ok(PatternLibrary { patterns })
}

fn list(library: &PatternLibrary) -> anyhow::Result<()> {
    let name = library.patterns.iter().map(|pattern| pattern.name.chars().count()).fold(18, usize::max);
    print::line(format!("{:<name$} {:<8} {:<10} {:>6} {:>15}  what it is", "name", "cause", "form", "share", "size"))?;
    library.patterns.iter().try_for_each(|pattern| print::line(row(pattern, name)))
}

fn row(pattern: &Pattern, name: usize) -> String {
    format!(
        "{:<name$} {:<8} {:<10} {:4.0} % {:5.1} x {:4.1} cm  {}",
        pattern.name,
        pattern.cause.name(),
        pattern.form.map_or("", |form| form.name()),
        pattern.share * 100.0,
        pattern.length_cm,
        pattern.breadth_cm(),
        pattern.description
    )
}
