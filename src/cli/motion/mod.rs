//! `trodden motion`: tools for recordings and for motions made from them, one file per tool.

use std::process::ExitCode;

use clap::{Args, Subcommand};

use super::Common;

mod convert;
mod features;
mod formation;
mod info;
mod input;
mod keys;
mod mixing;
mod output;
mod units;

pub use input::{Alignment, Reading};

/// Read, convert and make motions: recordings, formations, features, units
///
/// All these tools read and write the same files, so that the result of one can be the input of another, and of
/// `trodden bake --motion`. docs/recordings.md describes the formats.
#[derive(Args)]
pub struct Motion {
    #[command(subcommand)]
    command: Tool,
}

#[derive(Subcommand)]
enum Tool {
    Info(info::Info),
    Convert(convert::Convert),
    Formation(Box<formation::Formation>),
    Features(Box<features::Features>),
    Units(units::Units),
}

impl Motion {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        match &self.command {
            Tool::Info(info) => info.run(common),
            Tool::Convert(convert) => convert.run(common),
            Tool::Formation(formation) => formation.run(common),
            Tool::Units(units) => units.run(common),
            Tool::Features(features) => features.run(common),
        }
    }
}
