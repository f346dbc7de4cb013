use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use trodden::Error;
use trodden::patterns::{PatternLibrary, contact_sheet};

use super::{Common, print};

/// List the patterns that soles and heels leave, and draw them on a contact sheet
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden patterns --picture sheet.png     the built-in library
  trodden patterns my-soles                a folder of your own, with a patterns.toml")]
pub struct Patterns {
    /// A folder with patterns.toml and its images [default: the built-in library]
    #[arg(value_name = "FOLDER")]
    folder: Option<PathBuf>,
    /// Draw the contact sheet, as a PNG at 10 px/cm
    #[arg(long, value_name = "FILE")]
    picture: Option<PathBuf>,
}

impl Patterns {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        let library = PatternLibrary::open(self.folder.as_deref()).map_err(Error::from)?;
        if !common.quiet {
            print::line(format!("{:<18} {:<5} {:>6} {:>15}  what it is", "name", "cause", "share", "size"))?;
            for pattern in &library.patterns {
                print::line(format!(
                    "{:<18} {:<5} {:4.0} % {:5.1} x {:4.1} cm  {}",
                    pattern.name,
                    pattern.cause.name(),
                    pattern.share * 100.0,
                    pattern.length_cm,
                    pattern.breadth_cm(),
                    pattern.description
                ))?;
            }
        }
        if let Some(path) = &self.picture {
            print::save_picture(&contact_sheet(&library), path)?;
            if !common.quiet {
                print::line(format!("drawn to {}", path.display()))?;
            }
        }
        Ok(ExitCode::SUCCESS)
    }
}
