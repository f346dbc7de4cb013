use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, Subcommand};
use serde::Serialize;
use trodden::formation::{
    Agreement, Assign, AvoidRequest, ExampleRequest, FormationRequest, KeyRequest, form, is_picture,
};
use trodden::scenario::{Overrides, Scenario};
use trodden::source::{Given, Ground};
use trodden::walk::show;
use trodden::{Error, Progress, Stopwatch};

use super::super::arguments::within;
use super::super::progress::Watch;
use super::Common;
use super::input::{Alignment, Reading, span};
use super::output::Outputs;

/// Lead a crowd from formation to formation, while everybody keeps moving as in an example
///
/// What is wanted stands in the [formation] of a scenario, or is given by options: an example's motion, and formations at
/// chosen times, each a text of points, `x y` in metres, or a picture of dots.
#[derive(Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
#[command(after_help = "\
Examples:
  trodden motion formation floorplans/cavalry.toml --animation battle.gif
  trodden motion formation floorplans/swimming.toml -o routine.txt --paths ways.png
  trodden motion formation --example march.txt --first triangle.txt --last ring.png -o out.txt
  trodden motion formation --example march.txt --key 12.5=star.png --metres-per-pixel 0.05 --animation star.gif
  trodden motion formation --check paths.txt      how well the method describes your own recording")]
pub struct Formation {
    #[command(subcommand)]
    finder: Option<Finder>,
    /// A scenario with a [formation]
    #[arg(value_name = "SCENARIO", required_unless_present_any = ["example", "check"])]
    #[arg(conflicts_with_all = ["example", "check"])]
    scenario: Option<PathBuf>,
    /// Make nothing, but say how nearly people of this recording turn as an interpolation turns them
    #[arg(long, value_name = "RECORDING", conflicts_with_all = ["example", "output", "animation", "paths"])]
    check: Option<PathBuf>,
    #[command(flatten)]
    parts: Parts,
    #[command(flatten)]
    reading: Reading,
    #[command(flatten)]
    alignment: Alignment,
    #[command(flatten)]
    outputs: Outputs,
}

#[derive(Subcommand)]
enum Finder {
    Keys(super::keys::Keys),
}

/// Options of a formation without a scenario.
#[derive(Args)]
#[command(next_help_heading = "Without a scenario")]
struct Parts {
    /// The recording whose people are led; those who are there throughout
    #[arg(long, value_name = "FILE")]
    example: Option<PathBuf>,
    /// The part of it that is used, seconds
    #[arg(long, value_name = "FROM,TO", requires = "example", value_parser = span)]
    span: Option<[f64; 2]>,
    /// The formation at the start [default: the example's own]
    #[arg(long, value_name = "FILE", requires = "example")]
    first: Option<PathBuf>,
    /// The formation at the end [default: the example's own]
    #[arg(long, value_name = "FILE", requires = "example")]
    last: Option<PathBuf>,
    /// A formation at a time in seconds from the start; may come again
    #[arg(long, value_name = "TIME=FILE", requires = "example", value_parser = key)]
    key: Vec<(f64, PathBuf)>,
    /// Side of a picture's pixel in metres [default: 0.1]
    #[arg(long, value_name = "M", requires = "example", value_parser = within("formation.key.metres_per_pixel"))]
    #[arg(allow_negative_numbers = true)]
    metres_per_pixel: Option<f64>,
    /// Pictures show shapes that people fill evenly, not a dot for each
    #[arg(long, requires = "example")]
    filled: bool,
    /// The first goes to the first place and so on, instead of the shortest ways for all together
    #[arg(long, requires = "example")]
    in_order: bool,
    /// How far neighbours feel each other, metres [default: from how far apart they are]
    #[arg(long, value_name = "M", requires = "example", value_parser = within("formation.sigma_m"))]
    #[arg(allow_negative_numbers = true)]
    sigma: Option<f64>,
    /// How strongly the example's own way of moving is kept, 0 to 10 [default: 1]
    #[arg(long, value_name = "FACTOR", requires = "example", value_parser = within("formation.fluctuation"))]
    #[arg(allow_negative_numbers = true)]
    fluctuation: Option<f64>,
    /// How long it lasts, seconds; a shorter example is played to and fro [default: as long as the example]
    #[arg(long, value_name = "S", requires = "example", value_parser = within("formation.duration_s"))]
    #[arg(allow_negative_numbers = true)]
    duration: Option<f64>,
    /// Frames per second of the formation [default: 10]
    #[arg(long, value_name = "N", requires = "example", value_parser = within("formation.fps"))]
    #[arg(allow_negative_numbers = true)]
    rate: Option<f64>,
    /// Bodies' middles never come nearer to each other, metres; 0: they may [default: 0.36]
    #[arg(long, value_name = "M", requires = "example", value_parser = within("formation.avoid.distance_m"))]
    #[arg(allow_negative_numbers = true)]
    distance: Option<f64>,
}

impl Formation {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        if let Some(Finder::Keys(keys)) = &self.finder {
            return keys.run(common);
        }
        if let Some(path) = &self.check {
            return self.check_recording(path, common);
        }
        self.outputs.files.check(&["motion", "formation"], self.outputs.json)?;
        self.outputs.files.probe()?;
        let watch = Watch::new(common);
        let report = match &self.scenario {
            Some(path) => self.of_scenario(path, &watch)?,
            None => {
                let request = self.request(&watch)?;
                let keys = request.key.iter().filter_map(|key| key.file.clone());
                let inputs: Vec<PathBuf> = keys.chain(request.example.file.clone()).collect();
                let formed = form(&request, Path::new(""), &watch)?;
                self.outputs.write(&Given::formation(formed), &inputs, &watch)?
            }
        };
        self.outputs.files.tell(&report, self.outputs.json, common)?;
        Ok(ExitCode::SUCCESS)
    }

    fn check_recording(&self, path: &Path, common: &Common) -> anyhow::Result<ExitCode> {
        let (files, watch) = (&self.outputs.files, Watch::new(common));
        let recording = super::input::open(path, &self.alignment.over(self.reading.options()), &watch)?;
        let found = Agreement::of(&recording, &watch).map_err(Error::from)?;
        let whiles = ["no pair is near", "one pair is near", "two pairs are near", "all three pairs are near"];
        let rows: Vec<AngleRow> = whiles
            .into_iter()
            .zip(&found.one_pattern_deg)
            .chain([("anything goes", &found.any_deg)])
            .map(AngleRow::of)
            .collect();
        if self.outputs.json {
            files.say(serde_json::to_string_pretty(&serde_json::json!({ "angles": rows }))?)?;
            return Ok(ExitCode::SUCCESS);
        }
        if found.any_deg.is_empty() {
            watch.warn("nobody is there for 5 s together with two others: there is nothing to compare");
        }
        files.say(
            "angles between eigenvectors of three neighbours, as recorded and as turned evenly from start to end"
                .to_string(),
        )?;
        files.say(format!("{:<26}vectors    mean  median  nine tenths below", "while"))?;
        for row in rows {
            let degrees = |angle: Option<f64>| angle.map_or("-".to_string(), |angle| format!("{angle:.1}"));
            let [mean, median, most] = [row.mean_deg, row.median_deg, row.nine_tenths_deg].map(degrees);
            files.say(format!("{:<26}{:>7}  {mean:>6}  {median:>6}  {most:>6} degrees", row.pattern, row.vectors))?;
        }
        Ok(ExitCode::SUCCESS)
    }

    fn of_scenario(&self, path: &Path, watch: &Watch) -> anyhow::Result<trodden::walk::WalkReport> {
        let scenario = Scenario::open(path, &Overrides::default())?;
        let Some(request) = &scenario.formation else {
            anyhow::bail!("{}: the scenario has no [formation]", path.display());
        };
        let given = Given::formation(form(request, &scenario.folder, watch)?);
        if scenario.image.is_none() || self.outputs.plan.is_some() {
            return Ok(self.outputs.write(&given, &scenario.input_files(), watch)?);
        }
        self.outputs.outputs().check_not_inputs(&scenario.input_files()).map_err(Error::from)?;
        let ground = Ground::of_scenario(&scenario, Some(&given), &Stopwatch::start(), watch)?;
        let people = scenario.people_of_day(0);
        Ok(show(&given, &ground, &people, &self.outputs.outputs(), watch)?)
    }

    fn request(&self, watch: &Watch) -> anyhow::Result<FormationRequest> {
        let parts = &self.parts;
        let file = parts.example.clone().unwrap_or_default();
        let recording = self.alignment.over(self.reading.options());
        let [from_s, to_s] = parts.span.unwrap_or([0.0, f64::INFINITY]);
        let example = ExampleRequest {
            from_s,
            to_s: to_s.is_finite().then_some(to_s),
            recording: recording.clone(),
            file: Some(file.clone()),
            ..ExampleRequest::default()
        };
        let mut request = FormationRequest {
            duration_s: parts.duration,
            fps: parts.rate,
            example,
            sigma_m: parts.sigma,
            fluctuation: parts.fluctuation,
            assign: parts.in_order.then_some(Assign::Order),
            avoid: AvoidRequest { distance_m: parts.distance, ..AvoidRequest::default() },
            ..FormationRequest::default()
        };
        // The default duration is the example's, not the time of the last formation.
        if request.duration_s.is_none() {
            let survey = super::input::open(&file, &recording, watch)?;
            let [start_s, end_s] = survey.survey().span_s;
            request.duration_s = Some((to_s.min(end_s) - from_s.max(start_s)).max(0.1));
        }
        let end_s = request.duration_s.unwrap_or_default();
        let first = parts.first.iter().map(|file| (0.0, file));
        let last = parts.last.iter().map(|file| (end_s, file));
        let mut keys: Vec<(f64, &PathBuf)> =
            first.chain(parts.key.iter().map(|(time_s, file)| (*time_s, file))).chain(last).collect();
        keys.sort_by(|a, b| a.0.total_cmp(&b.0));
        request.key = keys.into_iter().map(|(time_s, file)| self.key_request(time_s, file)).collect();
        Ok(request)
    }

    fn key_request(&self, time_s: f64, file: &Path) -> KeyRequest {
        let picture = is_picture(file);
        KeyRequest {
            time_s,
            file: Some(file.to_path_buf()),
            metres_per_pixel: self.parts.metres_per_pixel.filter(|_| picture),
            filled: (self.parts.filled && picture).then_some(true),
            ..KeyRequest::default()
        }
    }
}

/// Angles of all threes with a pattern of adjacency, as JSON.
#[derive(Serialize)]
struct AngleRow {
    pattern: &'static str,
    vectors: usize,
    mean_deg: Option<f64>,
    median_deg: Option<f64>,
    nine_tenths_deg: Option<f64>,
}

impl AngleRow {
    fn of((pattern, degrees): (&'static str, &Vec<f64>)) -> AngleRow {
        let at = |share: f64| degrees.get((share * degrees.len() as f64) as usize).copied();
        let mean_deg = (!degrees.is_empty()).then(|| degrees.iter().sum::<f64>() / degrees.len() as f64);
        AngleRow { pattern, vectors: degrees.len(), mean_deg, median_deg: at(0.5), nine_tenths_deg: at(0.9) }
    }
}

fn key(text: &str) -> Result<(f64, PathBuf), String> {
    let wanted = || "write a time and a file, as 12.5=ring.png".to_string();
    let (time, file) = text.split_once('=').ok_or_else(wanted)?;
    let time_s: f64 = time.trim().parse().map_err(|_| wanted())?;
    if time_s.is_finite() && time_s >= 0.0 && !file.is_empty() {
        Ok((time_s, PathBuf::from(file)))
    } else {
        Err(wanted())
    }
}
