use std::process::ExitCode;

use clap::Args;
use trodden::walk::{WalkOutputs, walk};

use super::Common;
use super::arguments::{MotionFiles, ScenarioArguments, frame_rate};
use super::progress::Watch;

/// Walk a crowd through a plan and write where everybody went, for PedPy, JuPedSim and your own tools
///
/// The same crowd as that of a bake, without its floor. Without any file to write, only the summary says how it went:
/// how many arrived, who got stuck.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden crowd floorplans/station.toml -o paths.txt
  trodden crowd plan.toml -o paths.sqlite --fps 25      for JuPedSim and PedPy
  trodden crowd plan.toml -o paths.csv --fps 30         for a game engine
  trodden crowd plan.toml --animation crowd.gif         to see it
  trodden crowd plan.toml --people 5000 --paths ways.png
  trodden crowd plan.png --json -q | jq .mean_speed_m_s

Places are the middles of bodies in metres, origin at the image's lower left, y up; on a ROS map, in the map's frame.
People come and go up to 3 m beyond the image's sides. Frame k shows the moment k / fps seconds.")]
#[command(mut_arg("texels_per_metre", |argument| argument.hide(true)), mut_arg("quick", |argument| argument.hide(true)))]
pub struct Crowd {
    #[command(flatten)]
    scenario: ScenarioArguments,
    #[command(flatten)]
    files: MotionFiles,
    /// Frames per second of the motion; between steps, places are interpolated [default: one per step, 10]
    #[arg(long, value_name = "N", requires = "output", value_parser = frame_rate, allow_negative_numbers = true)]
    fps: Option<f64>,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
}

impl Crowd {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        self.files.check(&["crowd"], self.json)?;
        let scenario = self.scenario.scenario()?;
        let outputs = WalkOutputs { fps: self.fps, ..self.files.outputs() };
        let report = walk(&scenario, &outputs, &Watch::new(common)).map_err(|error| self.scenario.explain(error))?;
        self.files.tell(&report, self.json, common)?;
        Ok(ExitCode::SUCCESS)
    }
}
