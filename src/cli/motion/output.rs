//! Output of all motion tools: the motion, an animation, a picture of the paths.

use std::path::PathBuf;

use clap::Args;
use trodden::motion::People;
use trodden::scenario::{Overrides, Scenario};
use trodden::source::{Given, Ground};
use trodden::walk::{WalkOutputs, WalkReport, show};
use trodden::{Error, Progress, Stopwatch};

use super::super::arguments::{MotionFiles, within};

/// Output options of a motion.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub struct Outputs {
    #[command(flatten)]
    pub files: MotionFiles,
    /// Frames per second that are written; places are interpolated [default: the motion's own]
    #[arg(long, value_name = "N", requires = "output", value_parser = super::super::arguments::frame_rate)]
    #[arg(allow_negative_numbers = true)]
    pub output_fps: Option<f64>,
    /// Draw over this plan (a scenario or a plan alone) instead of open ground
    #[arg(long, value_name = "SCENARIO|PLAN")]
    pub plan: Option<PathBuf>,
    /// Side of a pixel of that plan in metres
    #[arg(long, value_name = "M", requires = "plan", value_parser = within("plan.metres_per_pixel"))]
    #[arg(allow_negative_numbers = true)]
    pub plan_metres_per_pixel: Option<f64>,
    /// Print the summary as JSON
    #[arg(long)]
    pub json: bool,
}

impl Outputs {
    /// Writes a motion to all requested files, but never over one of `inputs`.
    pub fn write(&self, given: &Given, inputs: &[PathBuf], progress: &dyn Progress) -> Result<WalkReport, Error> {
        let overrides = Overrides { metres_per_pixel: self.plan_metres_per_pixel, ..Overrides::default() };
        let scenario = self.plan.as_ref().map(|plan| Scenario::open(plan, &overrides)).transpose()?;
        let of_plan = scenario.iter().flat_map(Scenario::input_files);
        self.outputs().check_not_inputs(&inputs.iter().cloned().chain(of_plan).collect::<Vec<_>>())?;
        let ground = match &scenario {
            Some(scenario) => Ground::of_scenario(scenario, None, &Stopwatch::start(), progress)?,
            None => Ground::around(given)?,
        };
        let people = match &scenario {
            // Of given people it is not known how fast they would have walked.
            Some(scenario) => People::new(scenario.seed, scenario.bodies.clone()),
            None => People::new(1, Default::default()),
        };
        show(given, &ground, &people, &self.outputs(), progress)
    }

    pub fn outputs(&self) -> WalkOutputs {
        WalkOutputs { fps: self.output_fps, ..self.files.outputs() }
    }
}
