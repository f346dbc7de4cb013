//! Input of all motion tools: a recording, its format and its place.

use std::path::PathBuf;

use clap::Args;
use clap::builder::TypedValueParser;
use trodden::recordings::{LengthUnit, Recording, RecordingFormat, RecordingOptions};
use trodden::{Error, Progress};

use super::super::arguments::{listed, number_within, one_of, recording_format};
use super::super::standard_input::{self, Spool};

/// A recording and the options of reading it.
#[derive(Args)]
pub struct RecordingInput {
    /// The motion: Juelich text, JuPedSim database, Vadere, crowd:it, Viswalk, Pathfinder, obsmat, or CSV with names; -
    /// reads standard input
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// A copy of the motion, if it came on standard input.
    #[arg(skip)]
    spool: Spool,
    #[command(flatten)]
    pub reading: Reading,
    #[command(flatten)]
    pub alignment: Alignment,
}

impl RecordingInput {
    /// Opens the recording and prints its warnings.
    pub fn open(&self, progress: &dyn Progress) -> anyhow::Result<Recording> {
        let file = match standard_input::is_meant(&self.file) {
            true => &self.spool.fill()?,
            false => &self.file,
        };
        let options = self.alignment.over(self.reading.options());
        open(file, &options, progress).map_err(|error| self.spool.explain(error))
    }
}

/// Opens a recording and reports its warnings.
pub fn open(file: &std::path::Path, options: &RecordingOptions, progress: &dyn Progress) -> Result<Recording, Error> {
    let recording = Recording::open_watched(file, options, progress)?;
    recording.survey().warnings.iter().for_each(|warning| progress.warn(warning));
    Ok(recording)
}

/// Format options of a recording; missing ones are detected in the file.
#[derive(Args)]
#[command(next_help_heading = "Recording")]
pub struct Reading {
    /// How the recording is written [default: found]
    #[arg(long, value_name = "NAME", value_parser = recording_format())]
    pub format: Option<RecordingFormat>,
    /// Unit of its lengths [default: found]
    #[arg(long, value_name = "UNIT", value_parser = unit())]
    pub unit: Option<LengthUnit>,
    /// Its frames per second, where it counts frames [default: found]
    #[arg(long, value_name = "N", value_parser = rate, allow_negative_numbers = true)]
    pub fps: Option<f64>,
    /// What its columns mean, in order, as id,frame,x,y; - for one of no use [default: found]
    #[arg(long, value_name = "NAMES")]
    pub columns: Option<String>,
}

impl Reading {
    pub fn options(&self) -> RecordingOptions {
        RecordingOptions {
            format: self.format,
            unit: self.unit,
            fps: self.fps,
            columns: self.columns.clone(),
            ..RecordingOptions::default()
        }
    }
}

/// Position of a recording on the plan.
#[derive(Args)]
#[command(next_help_heading = "Recording")]
pub struct Alignment {
    /// Point of the recording that stays where it is when it is turned, metres [default: 0,0]
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    pub origin: Option<[f64; 2]>,
    /// How far the recording is moved, metres
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    pub shift: Option<[f64; 2]>,
    /// How far it is turned, degrees counter-clockwise
    #[arg(long, value_name = "DEGREES", value_parser = angle, allow_negative_numbers = true)]
    pub rotation: Option<f64>,
}

impl Alignment {
    /// Overrides options by this alignment.
    pub fn over(&self, options: RecordingOptions) -> RecordingOptions {
        RecordingOptions {
            origin: self.origin.unwrap_or(options.origin),
            shift: self.shift.unwrap_or(options.shift),
            rotation_deg: self.rotation.unwrap_or(options.rotation_deg),
            ..options
        }
    }
}

/// Parses a point `x,y`.
pub fn point(text: &str) -> Result<[f64; 2], String> {
    match listed::<f64, 2>(text) {
        Some([x, y]) if x.is_finite() && y.is_finite() => Ok([x, y]),
        _ => Err("write two numbers of metres, as 12.5,-3".to_string()),
    }
}

/// Parses a span of time `from,to`, seconds.
pub fn span(text: &str) -> Result<[f64; 2], String> {
    let [from_s, to_s] = point(text).map_err(|_| "write two times in seconds, as 2,20".to_string())?;
    if from_s >= 0.0 && to_s > from_s { Ok([from_s, to_s]) } else { Err("the end comes after the start".to_string()) }
}

/// Parses an angle, degrees from -360 to 360.
pub fn angle(text: &str) -> Result<f64, String> {
    number_within(text, [-360.0, 360.0])
}

/// Parses a frame rate, frames per second.
pub fn rate(text: &str) -> Result<f64, String> {
    number_within(text, [0.01, 1000.0])
}

pub fn unit() -> impl TypedValueParser<Value = LengthUnit> {
    one_of(LengthUnit::ALL, LengthUnit::name)
}

/// Parses a time, seconds from 0 on.
pub fn seconds(text: &str) -> Result<f64, String> {
    let allowed = |seconds: &f64| (0.0..=1e9).contains(seconds);
    text.parse().ok().filter(allowed).ok_or_else(|| "seconds from 0 on".to_string())
}
