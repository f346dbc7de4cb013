//! The second recording of `trodden motion features --mix`, and its options.

use std::path::PathBuf;

use clap::Args;
use clap::builder::TypedValueParser;
use trodden::features::CentroidPath;
use trodden::recordings::{LengthUnit, Recording, RecordingFormat, RecordingOptions};
use trodden::{Error, Progress, Stage};

use super::super::arguments::{one_of, recording_format};
use super::super::print::{OPTION, Refused};
use super::input;

/// Options of the first recording that the second has too, as `--mix-NAME`.
const OPTIONS: [&str; 6] = ["format", "unit", "fps", "columns", "from", "to"];

/// Options of a second crowd whose features are added.
#[derive(Args)]
#[command(next_help_heading = "Mixing")]
pub struct Mixing {
    /// Add the features of this crowd: both crowds' components take turns, the most important first
    #[arg(long, value_name = "OTHER")]
    pub mix: Option<PathBuf>,
    /// Begin here in the other recording, seconds
    #[arg(long, value_name = "S", value_parser = input::seconds, requires = "mix", allow_negative_numbers = true)]
    pub mix_from: Option<f64>,
    /// End here in the other recording, seconds
    #[arg(long, value_name = "S", value_parser = input::seconds, requires = "mix", allow_negative_numbers = true)]
    pub mix_to: Option<f64>,
    /// Where the middle of the crowd goes
    #[arg(long, value_name = "WHOSE", value_parser = middle(), requires = "mix", default_value = "first")]
    pub middle: CentroidPath,
    /// How the other recording is written; --format, --unit, --fps and --columns are about the first alone [default: found]
    #[arg(long, value_name = "NAME", value_parser = recording_format(), requires = "mix")]
    mix_format: Option<RecordingFormat>,
    /// Unit of its lengths [default: found]
    #[arg(long, value_name = "UNIT", value_parser = input::unit(), requires = "mix")]
    mix_unit: Option<LengthUnit>,
    /// Its frames per second, where it counts frames [default: found]
    #[arg(long, value_name = "N", value_parser = input::rate, requires = "mix", allow_negative_numbers = true)]
    mix_fps: Option<f64>,
    /// What its columns mean, in order [default: found]
    #[arg(long, value_name = "NAMES", requires = "mix")]
    mix_columns: Option<String>,
    /// How far the other crowd's motion is turned, degrees counter-clockwise [default: 0]
    #[arg(long, value_name = "DEGREES", value_parser = input::angle, requires = "mix", allow_negative_numbers = true)]
    mix_rotation: Option<f64>,
}

impl Mixing {
    /// Opens the second recording, if any. Error messages refer to the `--mix-*` options.
    pub fn open(&self, progress: &dyn Progress) -> anyhow::Result<Option<Recording>> {
        let Some(file) = &self.mix else { return Ok(None) };
        let options = RecordingOptions {
            format: self.mix_format,
            unit: self.mix_unit,
            fps: self.mix_fps,
            columns: self.mix_columns.clone(),
            rotation_deg: self.mix_rotation.unwrap_or(0.0),
            ..RecordingOptions::default()
        };
        input::open(file, &options, &OfOther(progress)).map(Some).map_err(of_other)
    }
}

/// Passes warnings on, with the names of the `--mix-*` options.
struct OfOther<'a>(&'a dyn Progress);

impl Progress for OfOther<'_> {
    fn advance(&self, stage: Stage, share: f64) {
        self.0.advance(stage, share);
    }

    fn warn(&self, message: &str) {
        self.0.warn(&renamed(message));
    }

    fn interrupted(&self) -> bool {
        self.0.interrupted()
    }
}

/// Replaces option names in an error of the second recording by `--mix-*`.
pub fn of_other(error: Error) -> anyhow::Error {
    match error {
        Error::Interrupted(_) => error.into(),
        error => {
            let hint = error.hint().map(|hint| renamed(&hint).into());
            Refused { message: renamed(&error.to_string()), hint }.into()
        }
    }
}

fn renamed(message: &str) -> String {
    let rename =
        |message: String, name: &&str| message.replace(&format!("{OPTION}{name}"), &format!("{OPTION}mix_{name}"));
    OPTIONS.iter().fold(message.to_string(), rename)
}

fn middle() -> impl TypedValueParser<Value = CentroidPath> {
    one_of(CentroidPath::ALL, CentroidPath::name)
}
