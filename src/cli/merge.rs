use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use trodden::bake::{OutputOptions, merge};

use super::farm::{self, Form};
use super::progress::Watch;
use super::{Common, bake};

/// Put the parts of a bake together: the same bytes as one bake of all days
///
/// Parts are what `trodden bake --part-of` writes. All have to be of one scenario, of the same files and of this version
/// of trodden, and have each day once. The scenario is in them; the files that it reads must be where they were.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden bake plan.toml --days 1..2/4 --part-of out/parts
  trodden bake plan.toml --days 3..4/4 --part-of out/parts   on another machine, at the same time
  trodden merge out/parts -o out/plan                        as trodden bake plan.toml --days 4

Exit code 1: try again, once the missing days are there or the disk has room; 2: it would fail again.")]
pub struct Merge {
    /// The parts, or folders of them
    #[arg(value_name = "PARTS", required = true)]
    parts: Vec<PathBuf>,
    /// The folder to make
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    /// The folder that the scenario's paths start from [default: where it was when the first part was baked]
    #[arg(long, value_name = "FOLDER")]
    inputs: Option<PathBuf>,
    /// Tell progress and failures in this form too
    #[arg(long, value_name = "FORM", value_parser = farm::form())]
    messages: Option<Form>,
    /// Write even if the files will take more than 20 GB, or more than is free on the disk
    #[arg(long)]
    yes: bool,
    /// Replace an earlier bake; anything else is never replaced
    #[arg(long)]
    force: bool,
}

impl Merge {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        farm::attempt(common, self.messages, || {
            let output = OutputOptions { folder: self.output.clone(), force: self.force };
            let watch = Watch::telling(common, self.messages);
            let report = merge(&self.parts, self.inputs.as_deref(), &output, self.yes, &watch)?;
            if common.quiet { Ok(()) } else { bake::summary(&self.output, &report, common) }
        })
    }
}
