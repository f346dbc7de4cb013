use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use trodden::Error;
use trodden::bake::resolve;
use trodden::look::Look;
use trodden::scenario::Preset;

use super::progress::Watch;
use super::{Common, arguments, bake};

/// Grade a finished bake again with another look, without simulating
///
/// The exact sums that a bake keeps are resolved to textures once more. The textures and previews of the bake are
/// replaced when all new ones are there; sums stay as they are, so that nothing is lost.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden resolve out/station --look vinyl.toml
  trodden resolve out/station --preset wet")]
pub struct Resolve {
    /// The folder that a bake left
    #[arg(value_name = "BAKE")]
    bake: PathBuf,
    /// A look file: TOML with the keys of a scenario's [look]
    #[arg(long, value_name = "FILE", required_unless_present = "preset")]
    look: Option<PathBuf>,
    /// Or the look of a preset
    #[arg(long, value_name = "NAME", value_parser = arguments::preset(), conflicts_with = "look")]
    preset: Option<Preset>,
}

impl Resolve {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        let look = match &self.look {
            Some(file) => Look::read(file).map_err(Error::from)?,
            None => Look::preset(self.preset.unwrap_or_default().name()).unwrap_or_default(),
        };
        let report = resolve(&self.bake, &look, &Watch::new(common))?;
        if !common.quiet {
            bake::summary(&self.bake, &report, common)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}
