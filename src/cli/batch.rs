use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use clap::error::ErrorKind;
use trodden::Error;
use trodden::bake::{Batch, batch};
use trodden::export::Target;
use trodden::look::Look;
use trodden::scenario::{Overrides, Preset};

use super::arguments::{self, ScenarioArguments, WrongUsage};
use super::progress::Watch;
use super::resolve::passes;
use super::{Common, print};

/// Most bakes of a batch.
const MOST: usize = 99_999;

/// Bake a scenario many times, with other seeds, looks and ages: for training data and for choosing
///
/// Every seed is baked with every look at every age, each to a numbered folder; batch.json lists them. The crowd of a seed
/// walks once for all of them. Each is the same, to the byte, as a bake of its own. What is there already is not baked
/// again: after an interruption the same command goes on.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden batch plan.toml --seeds 1..100 -o out/floors                      100 crowds
  trodden batch plan.toml --seeds 1..10 --look vinyl.toml --look wet --passes 1e3,1e5 -o out/floors
                                                                            10 crowds, 40 floors")]
pub struct BatchCommand {
    #[command(flatten)]
    scenario: ScenarioArguments,
    /// Seeds: numbers and ranges with a comma between them [default: the scenario's]
    #[arg(long, value_name = "N|A..B,...", value_parser = seeds)]
    seeds: Option<Seeds>,
    /// A look file, or the name of a preset; may come several times [default: the scenario's]
    #[arg(long = "look", value_name = "FILE|NAME")]
    looks: Vec<PathBuf>,
    /// Ages, as numbers of people who have walked [default: each look's]
    #[arg(long, value_name = "N,N,...", value_delimiter = ',', value_parser = passes)]
    passes: Vec<u64>,
    /// The folder to put the numbered folders in
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    /// The program that the textures are for: names, packing, axes, shaders [default: gltf]
    #[arg(long, value_name = "NAME", value_parser = arguments::target())]
    target: Option<Target>,
    /// Make the floors alone: no walls, no scene, no stills, no page
    #[arg(long)]
    floor_only: bool,
    /// Write every layer on its own too, as EXR
    #[arg(long)]
    layers: bool,
    /// Bake even if the files of a bake will take more than 20 GB, or more than is free on the disk
    #[arg(long)]
    yes: bool,
    /// Bake all again, over an earlier batch
    #[arg(long)]
    force: bool,
}

#[derive(Clone)]
struct Seeds(Vec<u64>);

impl BatchCommand {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        let usage =
            |message: String| Err(WrongUsage { command: &["batch"], kind: ErrorKind::ValueValidation, message }.into());
        let scenario = self.scenario.with(&Overrides {
            target: self.target,
            walls: self.floor_only.then_some(false),
            any_size: self.yes,
            layers: self.layers.then_some(true),
            ..self.scenario.overrides()
        })?;
        let looks = self.looks.iter().map(|look| read_look(look, &scenario.look)).collect::<Result<Vec<_>, Error>>()?;
        let wanted = Batch {
            seeds: self.seeds.clone().map_or_else(Vec::new, |seeds| seeds.0),
            looks,
            passes: self.passes.clone(),
            folder: self.output.clone(),
            force: self.force,
        };
        let count = wanted.seeds.len().max(1) * wanted.looks.len().max(1) * wanted.passes.len().max(1);
        if count > MOST {
            return usage(format!("these are {count} bakes; allowed are up to {MOST}"));
        }
        if wanted.passes.iter().collect::<BTreeSet<_>>().len() < wanted.passes.len() {
            return usage("--passes has a number twice".to_string());
        }
        let done = batch(&scenario, &wanted, &Watch::new(common)).map_err(|error| self.scenario.explain(error))?;
        if !common.quiet {
            let list = self.output.join("batch.json");
            print::line(format!("{} of {count} bakes are new; {} lists all", done.len(), list.display()))?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// A look with its name: that of a preset, over which the scenario's changes lie, or of the file.
fn read_look(look: &Path, scenario: &Look) -> Result<(String, Look), Error> {
    let name = look.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let preset = Preset::ALL.into_iter().find(|preset| Path::new(preset.name()) == look);
    match preset {
        Some(preset) => Ok((name, scenario.with_preset(preset.name())?)),
        None => Ok((name, Look::read(look)?)),
    }
}

/// Seeds such as `1..100` or `3,7,20..29`; both ends belong to a range.
fn seeds(text: &str) -> Result<Seeds, String> {
    let wrong = || format!("give seeds such as 1..100 or 3,7,20..29, each once, at most {MOST}");
    let mut all = BTreeSet::new();
    for part in text.split(',') {
        let (first, last) = part.split_once("..").unwrap_or((part, part));
        let number = |text: &str| text.trim().parse::<u64>().map_err(|_| wrong());
        let (first, last) = (number(first)?, number(last)?);
        if first > last || last - first >= MOST as u64 || !(first..=last).all(|seed| all.insert(seed)) {
            return Err(wrong());
        }
    }
    if all.len() > MOST { Err(wrong()) } else { Ok(Seeds(all.into_iter().collect())) }
}
