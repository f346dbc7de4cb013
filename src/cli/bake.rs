use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use clap::error::ErrorKind;
use trodden::Error;
use trodden::bake::{OutputOptions, bake, bake_part};
use trodden::export::{ExportError, LifeReport, Report, Target};
use trodden::scenario::{Overrides, Scenario};

use super::arguments::{self, ScenarioArguments, WrongUsage};
use super::farm::{self, Days, Form};
use super::motion::{Alignment, Reading};
use super::print::Refused;
use super::progress::Watch;
use super::standard_input::{self, Spool};
use super::{Common, print};

/// Walk a crowd through a plan and write the floor that it leaves
///
/// Reads the plan, traces its walls, finds routes, walks people along them, stamps every footfall, and writes tiled
/// textures, previews and a manifest to a new folder.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden bake floorplans/station.toml               to out/station
  trodden bake plan.png --metres-per-pixel 0.05 -o floor
  trodden bake plan.toml --quick --people 300        a first look
  trodden bake plan.toml --target unreal             names, packing and shaders for Unreal Engine
  trodden bake plan.toml --preset wet --force        again, over the earlier bake
  trodden bake plan.toml --motion paths.txt          recorded people instead of a crowd
  trodden bake --motion paths.txt                    the same on open ground
  draw_plan | trodden bake - -o floor                a plan or a scenario from standard input
  simulate | trodden bake --motion -                 a recording from there

Of a scenario from standard input, paths start from the working directory.")]
#[command(mut_arg("path", |argument| argument.required(false).required_unless_present("motion")))]
pub struct Bake {
    #[command(flatten)]
    scenario: ScenarioArguments,
    /// Recorded people instead of a crowd; without a plan, on open ground: `trodden motion info` says what is found; -
    /// reads standard input
    #[arg(long, value_name = "FILE", help_heading = "Recording")]
    motion: Option<PathBuf>,
    /// The motion, where it came on standard input.
    #[arg(skip)]
    spool: Spool,
    #[command(flatten)]
    reading: Reading,
    #[command(flatten)]
    alignment: Alignment,
    /// Days that people walk, each with as many others at the same times: more prints, an evener floor [default: 1]
    ///
    /// With --part-of some of them: 17..32 of the scenario's, 17..32/160 of 160
    #[arg(long, help_heading = "Scenario", value_name = "N|A..B[/N]", value_parser = farm::days, allow_hyphen_values = true)]
    days: Option<Days>,
    /// Bake the sums of these days alone, to a file in this folder: `trodden merge` makes a bake of all parts. A part that
    /// is there is not baked again
    #[arg(long, value_name = "FOLDER", help_heading = "Parts", conflicts_with_all = ["output", "motion"])]
    part_of: Option<PathBuf>,
    /// Tell progress and failures of a part in this form too
    #[arg(long, value_name = "FORM", help_heading = "Parts", requires = "part_of", value_parser = farm::form())]
    messages: Option<Form>,
    /// The folder to make [default: out/ and the scenario's name]
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// The program that the textures are for: names, packing, axes, shaders [default: gltf]
    #[arg(long, value_name = "NAME", value_parser = arguments::target())]
    target: Option<Target>,
    /// Make the floor alone: no walls, no scene, no stills, no page
    #[arg(long)]
    floor_only: bool,
    /// Write every layer on its own too, as EXR: game engines get them only if asked for
    #[arg(long)]
    layers: bool,
    /// Bits per channel of masks, wear and height; 16 are not dithered [default: 8]
    #[arg(long, value_name = "8|16", value_parser = arguments::bits())]
    bits: Option<u32>,
    /// Write the clean surface and the dirt on it, with its opacity, as images of their own too: to lay it on another surface
    #[arg(long)]
    dirt: bool,
    /// How PNG textures are compressed: small takes a third off, and half as long again [default: fast]
    #[arg(long, value_name = "small|fast", value_parser = arguments::png())]
    png: Option<bool>,
    /// Put the textures, reduced, into scene.glb
    #[arg(long)]
    embed: bool,
    /// Put the lamps of the stills into scene.glb, to be lit like them
    #[arg(long)]
    lamps: bool,
    /// Close the rooms of the scene with a ceiling, to be lit inside
    #[arg(long, conflicts_with = "floor_only")]
    ceiling: bool,
    /// Write the scene as scene.usda too, for Omniverse, Isaac Sim and Houdini
    #[arg(long, conflicts_with = "floor_only")]
    usd: bool,
    /// Write scene.sdf too, a world for Gazebo: the scene, and what robots run into
    #[arg(long, conflicts_with = "floor_only")]
    sdf: bool,
    /// Bake even if the files will take more than 20 GB, or more than is free on the disk
    #[arg(long)]
    yes: bool,
    /// Replace an earlier bake; anything else is never replaced
    #[arg(long)]
    force: bool,
}

impl Bake {
    fn named_after(&self) -> Option<&Path> {
        match self.scenario.path.as_deref().or(self.motion.as_deref()) {
            Some(path) if standard_input::is_meant(path) => Some(Path::new("stdin")),
            path => path,
        }
    }

    /// The recording as a file.
    fn motion_file(&self) -> anyhow::Result<Option<PathBuf>> {
        match &self.motion {
            Some(path) if standard_input::is_meant(path) => {
                if self.scenario.is_standard_input() {
                    let message = "the plan and the motion cannot both be read from standard input".to_string();
                    return Err(Refused { message, hint: Some("give one of them as a file".into()) }.into());
                }
                self.spool.fill().map(Some)
            }
            path => Ok(path.clone()),
        }
    }

    /// An error that names standard input as such.
    fn explain(&self, error: Error) -> anyhow::Error {
        match &self.motion {
            Some(path) if standard_input::is_meant(path) => self.spool.explain(error),
            _ => self.scenario.explain(error),
        }
    }

    /// The scenario with what the command line says; `days` if it says nothing of them.
    pub fn read(&self, days: Option<u32>) -> anyhow::Result<Scenario> {
        let overrides = Overrides {
            days: self.days.map_or(days, |given| given.all),
            target: self.target,
            walls: self.floor_only.then_some(false),
            embed: self.embed.then_some(true),
            lamps: self.lamps.then_some(true),
            ceiling: self.ceiling.then_some(true),
            usd: self.usd.then_some(true),
            sdf: self.sdf.then_some(true),
            any_size: self.yes,
            layers: self.layers.then_some(true),
            bits: self.bits,
            dirt: self.dirt.then_some(true),
            small_png: self.png,
            motion_file: self.motion_file()?,
            recording: self.alignment.over(self.reading.options()),
            ..self.scenario.overrides()
        };
        self.scenario.with(&overrides)
    }

    /// Bakes a part.
    fn bake_part(&self, job: &Path, common: &Common) -> anyhow::Result<()> {
        let scenario = self.read(None)?;
        let days = self.days.and_then(|days| days.some).unwrap_or([1, scenario.days]);
        let watch = Watch::telling(common, self.messages);
        let part = bake_part(&scenario, days[0]..=days[1], job, self.force, &watch)?;
        if !common.quiet {
            let file = part.file.display();
            print::line(match &part.report {
                Some(report) => {
                    format!("{file}: {} people walked, {} footfalls", report.people.entered, report.footfalls)
                }
                None => format!("{file} is there already"),
            })?;
        }
        Ok(())
    }

    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        let usage = |message: &str| {
            let kind = ErrorKind::ArgumentConflict;
            Err(WrongUsage { command: &["bake"], kind, message: message.to_string() }.into())
        };
        if let Some(job) = &self.part_of {
            if self.scenario.is_standard_input() {
                return usage("a part needs a scenario or a plan that can be read again, not standard input");
            }
            return farm::attempt(common, self.messages, || self.bake_part(job, common));
        }
        if self.days.is_some_and(|days| days.some.is_some()) {
            return usage("some of the days are a part: say with --part-of in which folder");
        }
        let scenario = self.read(None)?;
        let folder = match &self.output {
            Some(folder) => folder.clone(),
            None => Path::new("out").join(self.named_after().and_then(Path::file_stem).unwrap_or_default()),
        };
        let output = OutputOptions { folder: folder.clone(), force: self.force };
        let report = bake(&scenario, &output, &Watch::new(common))
            .map_err(|error| with_remedy(error, |error| self.explain(error)))?;
        if !common.quiet {
            let people = &report.people;
            let (entered, arrived) = (people.entered, people.arrived);
            print::line(format!(
                "{entered} people walked, {arrived} arrived; {} footfalls, {} touches of walls",
                report.footfalls, report.contacts
            ))?;
            if let Some(life) = &report.life {
                print::line(tell_life(life))?;
            }
            summary(&folder, &report, common)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// How people used the building.
fn tell_life(life: &LifeReport) -> String {
    let used = life.rooms.iter().filter(|room| room.footfalls > 0).count();
    let (rooms, name) = (life.rooms.len(), life.r#use.name());
    let guessed = if life.guessed { ", by its rooms; --use says otherwise" } else { "" };
    format!("they used {used} of {rooms} rooms as those of a building for: {name}{guessed}")
}

/// Adds a hint at `--yes` to an error about the size of a bake.
fn with_remedy(error: Error, otherwise: impl Fn(Error) -> anyhow::Error) -> anyhow::Error {
    match error {
        Error::Export(ExportError::TooMuch { .. }) => {
            let hint = Some("lower --texels-per-metre and texture.wall_texels_per_metre, or say --yes".into());
            Refused { message: error.to_string(), hint }.into()
        }
        error => otherwise(error),
    }
}

/// Prints the run time and the files to look at first.
pub fn summary(folder: &Path, report: &Report, common: &Common) -> anyhow::Result<()> {
    let total = report.seconds.get("total").copied().unwrap_or_default();
    print::line(format!("{} is done in {total:.1} s", folder.display()))?;
    for (name, what) in [
        ("preview/floor.png", "the floor from above"),
        ("floor", "its textures"),
        ("manifest.json", "where they lie, what their channels hold"),
    ] {
        let path = folder.join(name);
        if path.exists() {
            print::line(format!("  {:<36}  {what}", path.display()))?;
        }
    }
    if common.verbose {
        print::line("busy seconds, all threads together:")?;
        for (stage, seconds) in report.seconds.iter().filter(|(stage, _)| *stage != "total") {
            print::line(format!("  {stage:<9} {seconds:8.3}"))?;
        }
        if let Some(mib) = report.peak_memory_mib {
            print::line(format!("memory: {mib:.0} MiB at most"))?;
        }
    }
    Ok(())
}
