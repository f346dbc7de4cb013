use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use trodden::Error;
use trodden::bake::{ResolveOptions, resolve};
use trodden::export::Target;
use trodden::look::Look;
use trodden::scenario::Preset;

use super::progress::Watch;
use super::{Common, arguments, bake};

/// Grade a finished bake again with another look, or write it for another program, without simulating
///
/// The exact sums that a bake keeps are resolved to textures once more. The textures and previews of the bake are
/// replaced when all new ones are there; sums stay as they are, so that nothing is lost. With --output the bake stays as
/// it is, and another one is made.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden resolve out/station --look vinyl.toml
  trodden resolve out/station --preset wet
  trodden resolve out/station --preset heavy -o out/heavy   the bake stays as it is
  trodden resolve out/station --target unity")]
pub struct Resolve {
    /// The folder that a bake left
    #[arg(value_name = "BAKE")]
    bake: PathBuf,
    /// A look file: TOML with the keys of a scenario's [look]
    #[arg(long, value_name = "FILE", required_unless_present_any = ["preset", "target", "embed", "layers", "output"])]
    look: Option<PathBuf>,
    /// Or the look of a preset
    #[arg(long, value_name = "NAME", value_parser = arguments::preset(), conflicts_with = "look")]
    preset: Option<Preset>,
    /// The program that the textures are for: names, packing, axes, shaders [default: as before]
    #[arg(long, value_name = "NAME", value_parser = arguments::target())]
    target: Option<Target>,
    /// Write every layer on its own too, as EXR: game engines get them only if asked for
    #[arg(long)]
    layers: bool,
    /// Put the textures, reduced, into scene.glb
    #[arg(long)]
    embed: bool,
    /// Write to this folder, and leave the bake as it is
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Replace an earlier bake in that folder; anything else is never replaced
    #[arg(long, requires = "output")]
    force: bool,
}

impl Resolve {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        let look = match (&self.look, self.preset) {
            (Some(file), _) => Some(Look::read(file).map_err(Error::from)?),
            (None, preset) => preset.and_then(|preset| Look::preset(preset.name())),
        };
        let options = ResolveOptions {
            look,
            target: self.target,
            embed: self.embed.then_some(true),
            layers: self.layers.then_some(true),
            folder: self.output.clone(),
            force: self.force,
        };
        let report = resolve(&self.bake, &options, &Watch::new(common))?;
        if !common.quiet {
            bake::summary(self.output.as_deref().unwrap_or(&self.bake), &report, common)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}
