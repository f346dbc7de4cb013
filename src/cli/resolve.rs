use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use trodden::Error;
use trodden::bake::{ResolveOptions, resolve, resolve_series};
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
  trodden resolve out/station --passes 1e3,1e4,1e5 -o out/ages   the same floor at three ages
  trodden resolve out/station --target unity")]
pub struct Resolve {
    /// The folder that a bake left
    #[arg(value_name = "BAKE")]
    bake: PathBuf,
    /// A look file: TOML with the keys of a scenario's [look]
    #[arg(long, value_name = "FILE", required_unless_present_any = ["preset", "target", "embed", "lamps", "ceiling", "usd", "sdf", "layers", "bits", "dirt", "png", "output", "passes"])]
    look: Option<PathBuf>,
    /// Or another preset for the bake's look; what its scenario changed from the preset stays, such as materials
    #[arg(long, value_name = "NAME", value_parser = arguments::preset(), conflicts_with = "look")]
    preset: Option<Preset>,
    /// The program that the textures are for: names, packing, axes, shaders [default: as before]
    #[arg(long, value_name = "NAME", value_parser = arguments::target())]
    target: Option<Target>,
    /// Write every layer on its own too, as EXR: game engines get them only if asked for
    #[arg(long)]
    layers: bool,
    /// Bits per channel of masks, wear and height; 16 are not dithered [default: as before]
    #[arg(long, value_name = "8|16", value_parser = arguments::bits())]
    bits: Option<u32>,
    /// Write the clean surface and the dirt on it, with its opacity, as images of their own too: to lay it on another surface
    #[arg(long)]
    dirt: bool,
    /// How PNG textures are compressed: small takes a third off, and half as long again [default: as before]
    #[arg(long, value_name = "small|fast", value_parser = arguments::png())]
    png: Option<bool>,
    /// Put the textures, reduced, into scene.glb
    #[arg(long)]
    embed: bool,
    /// Put the lamps of the stills into scene.glb, to be lit like them
    #[arg(long)]
    lamps: bool,
    /// Close the rooms of the scene with a ceiling, to be lit inside
    #[arg(long)]
    ceiling: bool,
    /// Write the scene as scene.usda too, for Omniverse, Isaac Sim and Houdini
    #[arg(long)]
    usd: bool,
    /// Write scene.sdf too, a world for Gazebo: the scene, and what robots run into
    #[arg(long)]
    sdf: bool,
    /// Ages, as numbers of people who have walked: one bake for each in --output, and a flip-book of every picture
    #[arg(long, value_name = "N,N,...", value_delimiter = ',', value_parser = passes, requires = "output")]
    passes: Vec<u64>,
    /// Write to this folder, and leave the bake as it is
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Replace an earlier bake in that folder; anything else is never replaced
    #[arg(long, requires = "output")]
    force: bool,
}

impl Resolve {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        let options = ResolveOptions {
            look: self.look.as_deref().map(Look::read).transpose().map_err(Error::from)?,
            preset: self.preset.map(|preset| preset.name().to_string()),
            target: self.target,
            embed: self.embed.then_some(true),
            lamps: self.lamps.then_some(true),
            ceiling: self.ceiling.then_some(true),
            usd: self.usd.then_some(true),
            sdf: self.sdf.then_some(true),
            layers: self.layers.then_some(true),
            bits: self.bits,
            dirt: self.dirt.then_some(true),
            small_png: self.png,
            folder: self.output.clone(),
            force: self.force,
        };
        if let (Some(folder), false) = (&self.output, self.passes.is_empty()) {
            let reports = resolve_series(&self.bake, &options, &self.passes, folder, &Watch::new(common))?;
            for (total_passes, report) in self.passes.iter().zip(&reports).filter(|_| !common.quiet) {
                bake::summary(&folder.join(format!("passes_{total_passes}")), report, common)?;
            }
            return Ok(ExitCode::SUCCESS);
        }
        let report = resolve(&self.bake, &options, &Watch::new(common))?;
        if !common.quiet {
            bake::summary(self.output.as_deref().unwrap_or(&self.bake), &report, common)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// A number of people, such as `20000` or `1e5`.
pub fn passes(text: &str) -> Result<u64, String> {
    match text.trim().parse::<f64>() {
        Ok(number) if (1.0..=1e9).contains(&number) && number.fract() == 0.0 => Ok(number as u64),
        _ => Err("give a whole number from 1 to 1e9, such as 20000 or 1e5".to_string()),
    }
}
