use std::process::ExitCode;

use clap::Args;
use trodden::source::Given;

use super::super::progress::Watch;
use super::Common;
use super::input::RecordingInput;
use super::output::Outputs;

/// Write a motion in another format, at another rate or place; draw and animate it
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden motion convert paths.sqlite -o paths.txt
  trodden motion convert paths.txt -o paths.csv.gz        named columns, for engines and pandas
  trodden motion convert paths.txt -o postvis.traj        for Vadere
  trodden motion convert paths.txt -o - --as csv | head
  curl https://example.org/paths.txt | trodden motion convert - -o paths.sqlite
  trodden motion convert telemetry.csv --animation play.gif
  trodden motion convert paths.txt --rotation 90 --shift 12,0 --plan plan.toml --paths ways.png")]
pub struct Convert {
    #[command(flatten)]
    input: RecordingInput,
    #[command(flatten)]
    outputs: Outputs,
}

impl Convert {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        self.outputs.files.check(&["motion", "convert"], self.outputs.json)?;
        self.outputs.files.probe()?;
        let watch = Watch::new(common);
        let given = Given::recording(self.input.open(&watch)?);
        let report = self.outputs.write(&given, std::slice::from_ref(&self.input.file), &watch)?;
        self.outputs.files.tell(&report, self.outputs.json, common)?;
        Ok(ExitCode::SUCCESS)
    }
}
