//! What a shell knows of the program: completions and manual pages.

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Context;
use clap::{Args, Command};
use clap_complete::Shell;

use super::print;

/// Print what completes the program's options and files in a shell.
///
/// For example `trodden completions bash > ~/.local/share/bash-completion/completions/trodden`.
#[derive(Args)]
pub struct Completions {
    /// The shell.
    shell: Shell,
}

impl Completions {
    pub fn run(&self, mut cli: Command) -> anyhow::Result<ExitCode> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut cli, "trodden", &mut script);
        print::text(&String::from_utf8_lossy(&script))?;
        Ok(ExitCode::SUCCESS)
    }
}

/// Write the manual pages: one for the program, one for each subcommand.
///
/// For example `trodden man ~/.local/share/man/man1`; then `man trodden-bake` shows one.
#[derive(Args)]
pub struct Man {
    /// Folder for the pages; without one, the program's page is printed.
    #[arg(value_name = "DIR")]
    folder: Option<PathBuf>,
}

impl Man {
    pub fn run(&self, cli: Command) -> anyhow::Result<ExitCode> {
        match &self.folder {
            Some(folder) => {
                std::fs::create_dir_all(folder)
                    .and_then(|()| clap_mangen::generate_to(cli, folder))
                    .with_context(|| format!("cannot write manual pages into {}", folder.display()))?;
            }
            None => {
                let mut page = Vec::new();
                clap_mangen::Man::new(cli).render(&mut page)?;
                print::text(&String::from_utf8_lossy(&page))?;
            }
        }
        Ok(ExitCode::SUCCESS)
    }
}
