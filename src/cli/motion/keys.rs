use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::ensure;
use clap::Args;
use rayon::prelude::*;
use trodden::formation::{Ease, KeyFormation};
use trodden::motion::{Ensemble, Frame};
use trodden::recordings::Recording;
use trodden::show::draw_keys;
use trodden::{Error, Progress};

use super::super::arguments::number_within;
use super::super::print;
use super::super::progress::Watch;
use super::Common;

use super::input::{Alignment, Reading, span};

/// Find key formations in a recording: the few moments from which the rest follows
///
/// The first and the last moment are two. The next is the moment at which people are farthest from where the keys lead them,
/// and so on; then all move until they fit best. What is written is a scenario with a [formation] that gives the recording back:
/// move a place in it, or give it another example, and make it with `trodden motion formation`.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden motion formation keys march.txt --picture keys.png
  trodden motion formation keys march.txt --span 10,70 --most 6 -o march.toml
  trodden motion formation march.toml --animation again.gif")]
pub struct Keys {
    /// The recording; of its people those count who are there throughout
    #[arg(value_name = "RECORDING")]
    file: PathBuf,
    /// The part of it that is searched, seconds [default: when most people are there for longest]
    #[arg(long, value_name = "FROM,TO", value_parser = span)]
    span: Option<[f64; 2]>,
    /// The most key formations, with the first and the last
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u16).range(2..=100))]
    most: u16,
    /// Enough are found when people are nowhere farther off than this in the mean, metres
    #[arg(long, value_name = "M", default_value_t = 0.3, value_parser = distance, allow_negative_numbers = true)]
    off: f64,
    #[command(flatten)]
    reading: Reading,
    #[command(flatten)]
    alignment: Alignment,
    /// The scenario that is written; left out: they are only listed
    #[arg(short, long, help_heading = "Output", value_name = "FILE")]
    output: Option<PathBuf>,
    /// Draw them, with everybody's way, as a PNG
    #[arg(long, help_heading = "Output", value_name = "FILE")]
    picture: Option<PathBuf>,
    /// Replace files that are there
    #[arg(long, help_heading = "Output")]
    force: bool,
    /// Print the list as JSON
    #[arg(long, help_heading = "Output")]
    json: bool,
}

/// What was found for one pace: for two keys, for three and so on how far people are off, frame by frame, metres.
struct Found {
    ease: Ease,
    keys: Vec<KeyFormation>,
    off_m: Vec<Vec<f64>>,
}

impl Found {
    fn last_off_m(&self) -> &[f64] {
        self.off_m.last().map_or(&[], Vec::as_slice)
    }

    /// Whether fewer keys do, or as many do better.
    fn is_better_than(&self, other: &Found) -> bool {
        let rank = |found: &Found| (found.keys.len(), mean(found.last_off_m()));
        let ((own, off_m), (others, others_m)) = (rank(self), rank(other));
        own < others || (own == others && off_m < others_m)
    }
}

fn mean(off_m: &[f64]) -> f64 {
    off_m.iter().sum::<f64>() / off_m.len().max(1) as f64
}

/// What a scenario calls it.
fn pace(ease: Ease) -> &'static str {
    match ease {
        Ease::Even => "even",
        Ease::Rest => "gentle",
    }
}

/// When most people are there together for longest: the greatest product of people and seconds.
fn together_s(recording: &Recording) -> Result<[f64; 2], Error> {
    /// Ends of a span that are tried at most, and what a span is longer than the frames in it, seconds.
    const MOST_ENDS: usize = 1000;
    const BESIDE_S: f64 = 1e-6;
    let (mut motion, mut frame) = (recording.motion()?, Frame::default());
    let mut stays: BTreeMap<u32, [f64; 2]> = BTreeMap::new();
    while motion.next_frame(&mut frame)? {
        for walker in &frame.walkers {
            stays.entry(walker.id).or_insert([frame.time_s; 2])[1] = frame.time_s;
        }
    }
    let mut stays: Vec<[f64; 2]> = stays.into_values().collect();
    stays.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut ends: Vec<f64> = stays.iter().map(|stay| stay[1]).collect();
    ends.sort_by(|a, b| b.total_cmp(a));
    ends.dedup();
    let (mut best, mut most) = ([0.0, f64::INFINITY], 0.0);
    for &end_s in ends.iter().step_by(ends.len().div_ceil(MOST_ENDS).max(1)) {
        let there = stays.iter().filter(|[from_s, to_s]| *from_s < end_s && *to_s >= end_s);
        for (before, [from_s, _]) in there.enumerate() {
            let worth = (before + 1) as f64 * (end_s - from_s);
            if before > 0 && worth > most {
                (best, most) = ([from_s - BESIDE_S, end_s + BESIDE_S], worth);
            }
        }
    }
    Ok(best)
}

fn distance(text: &str) -> Result<f64, String> {
    number_within(text, [0.0, 1000.0])
}

impl Keys {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        let planned = |path: &PathBuf| print::plan_file(path, self.force, std::slice::from_ref(&self.file));
        let (output, picture) =
            (self.output.as_ref().map(planned).transpose()?, self.picture.as_ref().map(planned).transpose()?);
        let watch = Watch::new(common);
        let options = self.alignment.over(self.reading.options());
        let recording = super::input::open(&self.file, &options, &watch)?;
        let [from_s, to_s] = match self.span {
            Some(span) => span,
            None => together_s(&recording)?,
        };
        let motion = recording.ensemble(None, [from_s, to_s]).map_err(Error::from)?;
        let (led, all) = (motion.people(), recording.survey().people);
        ensure!(motion.moments() >= 2, "{}: there is one moment from {from_s} s on", self.file.display());
        if led < all {
            let [from_s, to_s] = [0, motion.moments() - 1].map(|moment| motion.time_s(moment));
            watch.warn(&format!(
                "{led} of {all} people are there from {from_s:.2} to {to_s:.2} s; the others are left out, as they come or go meanwhile"
            ));
        }
        let searched = |ease: Ease| -> Result<Found, Error> {
            let steps = KeyFormation::find(&motion, ease, usize::from(self.most), self.off, &watch)?;
            let off_m = |keys: &Vec<KeyFormation>| KeyFormation::distances_m(&motion, keys, ease, &watch);
            let off_m = steps.par_iter().map(off_m).collect::<Result<_, _>>()?;
            Ok(Found { ease, keys: steps.into_iter().next_back().unwrap_or_default(), off_m })
        };
        let (even, gentle) = rayon::join(|| searched(Ease::Even), || searched(Ease::Rest));
        let (even, gentle) = (even?, gentle?);
        let found = if gentle.is_better_than(&even) { gentle } else { even };
        if let Some(file) = picture {
            print::save_picture(&draw_keys(&motion, &found.keys, found.last_off_m()), file)?;
        }
        if let Some(file) = output {
            print::save(self.scenario(&motion, &found).as_bytes(), file)?;
        }
        drop(watch);
        self.tell(&found)?;
        Ok(ExitCode::SUCCESS)
    }

    fn tell(&self, Found { ease, keys, off_m }: &Found) -> anyhow::Result<()> {
        let most = |off_m: &[f64]| off_m.iter().copied().fold(0.0, f64::max);
        if self.json {
            let times_s: Vec<f64> = keys.iter().map(|key| key.time_s).collect();
            let step = |(k, off): (usize, &Vec<f64>)| serde_json::json!({ "keys": k + 2, "mean_m": mean(off), "most_m": most(off) });
            let off: Vec<_> = off_m.iter().enumerate().map(step).collect();
            return print::line(serde_json::to_string_pretty(
                &serde_json::json!({ "times_s": times_s, "pace": pace(*ease), "off": off }),
            )?);
        }
        let times = keys.iter().map(|key| format!("{:.2}", key.time_s)).collect::<Vec<_>>().join(", ");
        print::line(format!("{} key formations, at {times} s; the pace between them is {}", keys.len(), pace(*ease)))?;
        print::line("keys  people are off by, in the mean and at most:")?;
        for (k, off) in off_m.iter().enumerate() {
            print::line(format!("{:>4}  {:.2} m  {:.2} m", k + 2, mean(off), most(off)))?;
        }
        Ok(())
    }

    /// A scenario that makes the motion again.
    fn scenario(&self, motion: &Ensemble, Found { ease, keys, .. }: &Found) -> String {
        let file = std::path::absolute(&self.file).unwrap_or_else(|_| self.file.clone());
        let beside = self.output.as_deref().and_then(|path| std::path::absolute(path).ok());
        let beside = beside.as_deref().and_then(Path::parent);
        let shown = beside.and_then(|folder| file.strip_prefix(folder).ok()).unwrap_or(&file).to_string_lossy();
        let [start_s, end_s] = [0, motion.moments() - 1].map(|moment| motion.time_s(moment));
        let mut text = format!(
            "# Key formations of a recording. Its own way of moving comes back with them: `fluctuation = 0` leaves it out.\n\
             [formation]\nduration_s = {:?}\nfps = {:?}\nassign = \"order\"\npace = \"{}\"\n\
             # As near as they were recorded.\navoid = {{ distance_m = 0.0 }}\n\n\
             [formation.example]\nfile = {}\nfrom_s = {start_s:?}\nto_s = {end_s:?}\n",
            end_s - start_s,
            motion.fps,
            pace(*ease),
            toml::Value::from(shown.as_ref()),
        );
        let Reading { format, unit, fps, columns } = &self.reading;
        let Alignment { origin, shift, rotation } = &self.alignment;
        let point = |[x, y]: [f64; 2]| toml::Value::from(vec![x, y]);
        let given = [
            ("format", format.map(|format| format.name().into())),
            ("unit", unit.map(|unit| unit.name().into())),
            ("fps", fps.map(toml::Value::from)),
            ("columns", columns.clone().map(toml::Value::from)),
            ("origin", origin.map(point)),
            ("shift", shift.map(point)),
            ("rotation_deg", rotation.map(toml::Value::from)),
        ];
        let given: toml::Table = given.into_iter().filter_map(|(key, value)| Some((key.to_string(), value?))).collect();
        if !given.is_empty() {
            let _ = writeln!(text, "recording = {}", toml::Value::Table(given));
        }
        for key in keys {
            let places: Vec<String> = key.places_m.iter().map(|p| format!("[{:.3}, {:.3}]", p.x, p.y)).collect();
            let time_s = key.time_s - start_s;
            let _ = write!(text, "\n[[formation.key]]\ntime_s = {time_s:?}\npoints = [{}]\n", places.join(", "));
        }
        text
    }
}
