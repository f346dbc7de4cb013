//! Output files of a motion.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::error::ErrorKind;
use trodden::files::{WholeFile, same_file};
use trodden::recordings::{FRAME_RATES, RecordForm, RecordingFormat};
use trodden::show::{AnimationColour, AnimationFormat, AnimationOptions};
use trodden::walk::{MotionOutput, WalkOutputs, WalkReport};

use super::super::{Common, print};
use super::usage::WrongUsage;
use super::{number_within, one_of};

/// Output files of a motion: positions, animation, picture of the paths.
#[derive(Args)]
pub struct MotionFiles {
    /// Write the motion: .txt is Juelich text, .csv a CSV with named columns, .traj Vadere's steps, each also in .gz;
    /// .sqlite, .sqlite3 and .db are a JuPedSim database; - prints text
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// How the motion is written, where the file's name does not say
    #[arg(id = "as", long = "as", value_name = "NAME", requires = "output", value_parser = recording_format())]
    format: Option<RecordingFormat>,
    /// Draw the crowd from above, moving: .gif, or .png and .apng for an animated PNG
    #[arg(long, value_name = "FILE", value_parser = animation_file)]
    animation: Option<PathBuf>,
    /// How many times as fast as in life [default: such that it takes at most 20 s]
    #[arg(long, value_name = "X", requires = "animation", value_parser = speed, allow_negative_numbers = true)]
    animation_speed: Option<f64>,
    /// Longer side of the animation in pixels, 200 to 2000 [default: 960]
    #[arg(long, value_name = "PX", requires = "animation", allow_negative_numbers = true)]
    #[arg(value_parser = clap::value_parser!(u32).range(AnimationOptions::SIZES_PX[0] as i64..=AnimationOptions::SIZES_PX[1] as i64))]
    animation_size: Option<u32>,
    /// What people's colours say [default: speed]
    #[arg(long, value_name = "WHAT", requires = "animation", value_parser = colour())]
    animation_colour: Option<AnimationColour>,
    /// Draw the ways that people took, and where they got stuck, as a PNG
    #[arg(long, value_name = "FILE")]
    paths: Option<PathBuf>,
    /// Replace files that are there
    #[arg(long)]
    force: bool,
}

impl MotionFiles {
    /// Refuses options of a subcommand that contradict each other.
    pub fn check(&self, command: &'static [&'static str], json: bool) -> Result<(), WrongUsage> {
        let refuse = |kind: ErrorKind, message: String| Err(WrongUsage { command, kind, message });
        if let Err(problem) = self.form() {
            let path = self.output.as_deref().unwrap_or(Path::new("")).display();
            let message = format!("invalid value '{path}' for '--output <FILE>': {problem}");
            return refuse(ErrorKind::ValueValidation, message);
        }
        if self.prints_motion() && json {
            let message =
                "the motion and the JSON summary cannot both go to standard output: name a file with --output";
            return refuse(ErrorKind::ArgumentConflict, message.to_string());
        }
        let output = self.output.as_ref().filter(|_| !self.prints_motion());
        let files = [("--output", output), ("--animation", self.animation.as_ref()), ("--paths", self.paths.as_ref())];
        for (number, (option, file)) in files.iter().enumerate() {
            for (other_option, other) in &files[number + 1..] {
                if let (Some(file), Some(other)) = (file, other)
                    && same_file(file, other)
                {
                    let message = format!("{option} and {other_option} name the same file");
                    return refuse(ErrorKind::ArgumentConflict, message);
                }
            }
        }
        Ok(())
    }

    /// Checks, before the work begins, that all files can be written.
    pub fn probe(&self) -> Result<(), trodden::Error> {
        let motion = self.output.as_ref().filter(|_| !self.prints_motion());
        for path in [motion, self.animation.as_ref(), self.paths.as_ref()].into_iter().flatten() {
            WholeFile::begin(path, self.force)?;
        }
        Ok(())
    }

    /// Checks that the file's name gives a format for the motion.
    fn form(&self) -> Result<(), String> {
        let Some(path) = &self.output else { return Ok(()) };
        if self.prints_motion() {
            let text = self.format.is_none_or(RecordingFormat::is_text);
            return if text { Ok(()) } else { Err("a database cannot be printed: name a file".to_string()) };
        }
        match (RecordForm::of(path, self.format), self.format) {
            (Ok(_), _) => Ok(()),
            (Err(_), None) => Err(format!("known endings are {}; --as says it for others", RecordForm::endings())),
            (Err(error), Some(_)) => Err(error.to_string()),
        }
    }

    fn prints_motion(&self) -> bool {
        self.output.as_deref() == Some(Path::new(STANDARD_OUTPUT))
    }

    /// Returns the outputs for the library, at the motion's own frame rate.
    pub fn outputs(&self) -> WalkOutputs {
        let default = AnimationOptions::default();
        let options = AnimationOptions {
            speed: self.animation_speed,
            size_px: self.animation_size.unwrap_or(default.size_px),
            colour: self.animation_colour.unwrap_or(default.colour),
        };
        WalkOutputs {
            motion: self.output.as_ref().map(|path| match self.prints_motion() {
                true => MotionOutput::StandardOutput,
                false => MotionOutput::File(path.clone()),
            }),
            format: self.format,
            fps: None,
            animation: self.animation.clone().map(|path| (path, options)),
            paths: self.paths.clone(),
            force: self.force,
        }
    }

    /// Prints a summary, as JSON or as text.
    pub fn tell(&self, report: &WalkReport, json: bool, common: &Common) -> anyhow::Result<()> {
        if json {
            return self.say(serde_json::to_string_pretty(report)?);
        }
        if common.quiet {
            return Ok(());
        }
        let people = &report.people;
        let one = if people.entered == 1 { "person" } else { "people" };
        let mut text = format!("{} {one} walked, {} arrived", people.entered, people.arrived);
        for (count, what) in [(people.stuck, "got stuck"), (report.walking, "were still on their way at the end")] {
            if count > 0 {
                text.push_str(&format!(", {count} {what}"));
            }
        }
        let speed = report.mean_speed_m_s;
        text.push_str(&format!("; {} in all, {speed:.2} m/s in the mean", duration(report.duration_s)));
        self.say(text)?;
        if let (Some(path), Some(motion)) = (&self.output, &report.motion) {
            let name = if self.prints_motion() { "the motion".to_string() } else { path.display().to_string() };
            let (fps, size) = (motion.fps, size(motion.bytes));
            self.say(format!("  {name:<28}  {} frames, {fps} in a second, {size}", motion.frames))?;
        }
        if let (Some(path), Some(animation)) = (&self.animation, &report.animation) {
            let bytes = std::fs::metadata(path).map_or(0, |file| file.len());
            let (seconds, speed, size) = (animation.seconds, animation.speed, size(bytes));
            self.say(format!("  {:<28}  {seconds:.1} s at {speed} times the speed, {size}", path.display()))?;
        }
        if let Some(path) = &self.paths {
            self.say(format!("  {:<28}  the ways that people took", path.display()))?;
        }
        let total = report.seconds.get("total").copied().unwrap_or_default();
        let memory = match report.peak_memory_mib {
            Some(mib) if common.verbose => format!(", {mib:.0} MiB"),
            _ => String::new(),
        };
        self.say(format!("done in {total:.1} s{memory}"))
    }

    pub fn any(&self) -> bool {
        self.output.is_some() || self.animation.is_some() || self.paths.is_some()
    }

    /// Prints a line to standard output, or to standard error if the motion uses that.
    pub fn say(&self, text: String) -> anyhow::Result<()> {
        if self.prints_motion() {
            print::to_stderr(&format!("{text}\n"));
            return Ok(());
        }
        print::line(text)
    }
}

/// File name for standard output.
pub const STANDARD_OUTPUT: &str = "-";

/// Minutes and seconds.
fn duration(seconds: f64) -> String {
    let whole = seconds.round() as u64;
    if whole < 60 { format!("{whole} s") } else { format!("{} min {} s", whole / 60, whole % 60) }
}

fn size(bytes: u64) -> String {
    let kilobytes = bytes as f64 / 1e3;
    if kilobytes < 1000.0 { format!("{kilobytes:.0} kB") } else { format!("{:.1} MB", kilobytes / 1e3) }
}

fn animation_file(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    AnimationFormat::of(&path).map(|_| path).map_err(|_| "known endings are .gif, .png or .apng".to_string())
}

pub fn recording_format() -> impl TypedValueParser<Value = RecordingFormat> {
    one_of(RecordingFormat::ALL, RecordingFormat::name)
}

/// Parses a frame rate, frames per second.
pub fn frame_rate(text: &str) -> Result<f64, String> {
    number_within(text, FRAME_RATES)
}

fn speed(text: &str) -> Result<f64, String> {
    number_within(text, AnimationOptions::SPEEDS)
}

fn colour() -> impl TypedValueParser<Value = AnimationColour> {
    PossibleValuesParser::new(["speed", "route"]).map(|name| match name.as_str() {
        "route" => AnimationColour::Route,
        _ => AnimationColour::Speed,
    })
}
