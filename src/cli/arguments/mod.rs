//! Arguments that several subcommands take.

use std::path::PathBuf;

use clap::Args;
use clap::builder::TypedValueParser;
use trodden::export::Target;
use trodden::plan::VectorFormat;
use trodden::rooms::Use;
use trodden::scenario::{Overrides, Preset, Scenario, allowed_range};

use super::print::Refused;
use super::standard_input::{self, Spool};

mod motion_files;
mod usage;
mod values;

pub use motion_files::{MotionFiles, STANDARD_OUTPUT, frame_rate, recording_format};
pub use usage::WrongUsage;
pub use values::{listed, number_within, one_of, within};

/// A scenario and its overrides.
#[derive(Args)]
pub struct ScenarioArguments {
    /// A scenario (TOML), or a plan alone: PNG, JPEG, BMP, PGM, TIFF, GIF, SVG, PDF, DXF, VTT, or YAML of ROS or Open-RMF; - reads standard input
    #[arg(value_name = "SCENARIO|PLAN", required = true)]
    pub path: Option<PathBuf>,
    /// Side of a pixel of the plan in metres
    #[arg(long, help_heading = "Scenario", value_name = "M", value_parser = within("plan.metres_per_pixel"))]
    #[arg(alias = "meters-per-pixel", allow_negative_numbers = true)]
    pub metres_per_pixel: Option<f64>,
    /// Page of a PDF, level of an Open-RMF building, or storey of a building model [default: 1]
    #[arg(long, help_heading = "Scenario", value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub page: Option<u32>,
    /// Or how wide the building is in metres, from its westernmost to its easternmost wall as drawn
    #[arg(long, help_heading = "Scenario", value_name = "M", value_parser = within("plan.width_m"))]
    #[arg(conflicts_with = "metres_per_pixel", allow_negative_numbers = true)]
    pub width_m: Option<f64>,
    /// Lightness at which walls end and floor begins, 1 to 255 [default: found]
    #[arg(long, help_heading = "Scenario", value_name = "L", allow_negative_numbers = true)]
    #[arg(value_parser = clap::value_parser!(u8).range(1..))]
    pub threshold: Option<u8>,
    /// Walls are light on a dark ground [default: found]
    #[arg(long, help_heading = "Scenario")]
    pub invert: bool,
    /// How many people walk
    #[arg(long, help_heading = "Scenario", value_name = "N", value_parser = people, allow_negative_numbers = true)]
    pub people: Option<u32>,
    /// What the building is for: which rooms draw people, and how long they stay [default: guessed from the plan]
    #[arg(long = "use", help_heading = "Scenario", value_name = "USE", value_parser = building())]
    pub r#use: Option<Use>,
    /// Another number, another crowd
    #[arg(long, help_heading = "Scenario", value_name = "N", allow_negative_numbers = true)]
    #[arg(value_parser = clap::value_parser!(u64).range(..=i64::MAX as u64))]
    pub seed: Option<u64>,
    /// What the scenario's keys start from
    #[arg(long, help_heading = "Scenario", value_name = "NAME", value_parser = preset())]
    pub preset: Option<Preset>,
    /// Texels per metre of floor, 1 to 1000 [default: 100]
    #[arg(long, help_heading = "Scenario", value_name = "T", value_parser = within("texture.floor_texels_per_metre"))]
    #[arg(allow_negative_numbers = true)]
    pub texels_per_metre: Option<f64>,
    /// A first look: 25 texels per metre, 400 people if nothing says how many, no layers
    #[arg(long, help_heading = "Scenario", conflicts_with = "texels_per_metre")]
    pub quick: bool,
    /// A copy of the plan, if it came on standard input.
    #[arg(skip)]
    spool: Spool,
}

impl ScenarioArguments {
    /// Reads the scenario and applies the overrides.
    pub fn scenario(&self) -> anyhow::Result<Scenario> {
        self.with(&self.overrides())
    }

    /// Reads the scenario and applies overrides. Without a file it is open ground for a motion.
    pub fn with(&self, overrides: &Overrides) -> anyhow::Result<Scenario> {
        let scenario = match &self.path {
            Some(path) if standard_input::is_meant(path) => return self.read(overrides),
            Some(path) => Scenario::open(path, overrides),
            None => Scenario::of_motion(overrides),
        };
        Ok(scenario.map_err(trodden::Error::from)?)
    }

    /// Reads standard input: a scenario with paths from the working directory, or a plan.
    fn read(&self, overrides: &Overrides) -> anyhow::Result<Scenario> {
        let bytes = standard_input::read()?;
        let scenario = match std::str::from_utf8(&bytes) {
            Ok(text) if standard_input::is_ros_map(text) => {
                let message = "standard input holds the YAML of a ROS map, which names an image beside it".to_string();
                let hint = Some("give the path of the YAML file instead of -".into());
                return Err(Refused { message, hint }.into());
            }
            Ok(text) if image::guess_format(&bytes).is_err() && VectorFormat::of(&bytes, "").is_none() => {
                Scenario::parse(text, standard_input::shown(), overrides)
            }
            _ => Scenario::from_plan(&self.spool.keep(&bytes)?, overrides),
        };
        Ok(scenario.map_err(trodden::Error::from)?)
    }

    /// Whether the scenario comes from standard input.
    pub fn is_standard_input(&self) -> bool {
        self.path.as_deref().is_some_and(standard_input::is_meant)
    }

    /// Replaces the path of the copy of standard input in an error.
    pub fn explain(&self, error: trodden::Error) -> anyhow::Error {
        self.spool.explain(error)
    }

    pub fn overrides(&self) -> Overrides {
        Overrides {
            preset: self.preset,
            people: self.people,
            r#use: self.r#use,
            seed: self.seed,
            texels_per_metre: self.texels_per_metre,
            quick: self.quick,
            metres_per_pixel: self.metres_per_pixel,
            page: self.page,
            width_m: self.width_m,
            threshold: self.threshold,
            invert: self.invert.then_some(true),
            ..Overrides::default()
        }
    }
}

pub fn target() -> impl TypedValueParser<Value = Target> {
    one_of(Target::ALL, Target::name)
}

pub fn bits() -> impl TypedValueParser<Value = u32> {
    one_of([8, 16], |bits| if bits == 16 { "16" } else { "8" })
}

pub fn png() -> impl TypedValueParser<Value = bool> {
    one_of([true, false], |small| if small { "small" } else { "fast" })
}

pub fn building() -> impl TypedValueParser<Value = Use> {
    one_of(Use::ALL, Use::name)
}

pub fn preset() -> impl TypedValueParser<Value = Preset> {
    one_of(Preset::ALL, Preset::name)
}

fn people(text: &str) -> Result<u32, String> {
    let [low, high] = allowed_range("crowd.people").unwrap_or([1.0, 1e6]);
    let range = format!("allowed are whole numbers from {low} to {high}");
    let people: u32 = text.parse().map_err(|_| range.clone())?;
    if f64::from(people) >= low && f64::from(people) <= high { Ok(people) } else { Err(range) }
}
