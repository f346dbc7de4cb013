use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use trodden::Error;
use trodden::motion::People;
use trodden::recordings::Survey;
use trodden::source::{Given, Ground};
use trodden::walk::{WalkOutputs, show};

use super::super::print;
use super::super::progress::Watch;
use super::Common;
use super::input::RecordingInput;

/// Say what a recording holds: people, rate, duration, bounds, speed; draw its paths
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden motion info paths.txt
  trodden motion info telemetry.csv --paths ways.png
  trodden motion info paths.txt --unit cm --fps 16
  trodden motion info paths.sqlite --json | jq .people

Formats are found by content. What a file does not say is assumed by how people walk, and told as a warning.")]
pub struct Info {
    #[command(flatten)]
    input: RecordingInput,
    /// Draw the ways that people took as a PNG
    #[arg(long, help_heading = "Output", value_name = "FILE")]
    paths: Option<PathBuf>,
    /// Replace a file that is there
    #[arg(long, help_heading = "Output", requires = "paths")]
    force: bool,
    /// Print as JSON
    #[arg(long, help_heading = "Output")]
    json: bool,
}

impl Info {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        let watch = Watch::new(common);
        let recording = self.input.open(&watch)?;
        if self.paths.is_some() {
            let given = Given::recording(recording.clone());
            let ground = Ground::around(&given)?;
            let outputs = WalkOutputs { paths: self.paths.clone(), force: self.force, ..WalkOutputs::default() };
            outputs.check_not_inputs(std::slice::from_ref(&self.input.file)).map_err(Error::from)?;
            show(&given, &ground, &People::new(1, Default::default()), &outputs, &watch)?;
        }
        drop(watch);
        let survey = recording.survey();
        if self.json {
            print::line(serde_json::to_string_pretty(survey)?)?;
        } else {
            print::line(told(survey))?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

fn told(survey: &Survey) -> String {
    let Survey { fps, people, frames, places, bounds_m, .. } = survey;
    let mut text = format!("format     {}, in {}", survey.format.title(), survey.unit.plural());
    if !survey.in_order {
        text.push_str(", not in the order of time: sorted in memory");
    }
    let mut line = |name: &str, what: String| text.push_str(&format!("\n{name:<9}  {what}"));
    let returns = match survey.returns {
        0 => String::new(),
        1 => "; once somebody came back after a gap, as another person".to_string(),
        many => format!("; {many} times somebody came back after a gap, as another person"),
    };
    line("people", format!("{people}, {places} places{returns}"));
    let duration_s = survey.span_s[1] - survey.span_s[0];
    line("time", format!("{duration_s:.2} s, {frames} moments, {fps} frames per second"));
    let present_s = if *people > 0 { survey.person_seconds / *people as f64 } else { 0.0 };
    line("present", format!("{present_s:.2} s each in the mean, {:.1} s together", survey.person_seconds));
    line("speed", format!("{:.2} m/s in the mean", survey.mean_speed_m_s));
    let (min, max) = (bounds_m.min, bounds_m.max);
    let extent = format!("{:.2} x {:.2} m", bounds_m.width(), bounds_m.height());
    line("extent", format!("{extent}, from ({:.2}, {:.2}) to ({:.2}, {:.2})", min.x, min.y, max.x, max.y));
    text
}
