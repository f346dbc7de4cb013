use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use clap::builder::TypedValueParser;
use serde::Serialize;
use trodden::features::{
    self, FeatureComponent, FeaturesOptions, Method, Mix, MixOptions, MixSource, Modulation, NEIGHBOUR_DISTANCES_M,
    PresenceSpan, Rule,
};
use trodden::formation::AvoidRequest;
use trodden::motion::Ensemble;
use trodden::recordings::Recording;
use trodden::source::{CoordinateFrame, Given};
use trodden::walk::WalkReport;
use trodden::{Error, Progress};

use super::super::arguments::{frame_rate, number_within, one_of, within};
use super::super::progress::Watch;
use super::Common;
use super::input::{RecordingInput, seconds};
use super::mixing::{self, Mixing};
use super::output::Outputs;

const FEATURES: &str = "Features";
/// Most rows of the printed table.
const MOST_ROWS: usize = 20;
/// Share of the motion at which the printed table ends.
const NEARLY_ALL: f64 = 0.999;

/// What a crowd moves like, as a few components; make new motion of them, or mix two crowds
///
/// Everybody's way relative to the crowd's middle is taken apart into a mean place and components that move people around
/// it, the most important first. A table says how much of the motion each is. Built up again with fewer of them, with
/// changed coefficients, or with those of another crowd, it is a new motion.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden motion features paths.txt                                 what is there: a table
  trodden motion features paths.txt --components 5 -o smooth.txt    the motion of the first five alone
  trodden motion features paths.txt --scale all=2 -o wild.txt       twice the velocity around the middle
  trodden motion features paths.txt --scale '1=sin(2*pi*t/5)' -o to-and-fro.txt
  trodden motion features paths.txt --scale 1=2 --scale 2..5=0.5 --scale 6..=0 -o mine.txt
  trodden motion features across.txt --mix inward.txt --components 6 -o both.txt --paths both.png
  trodden motion features a.txt --unit cm --fps 16 --mix b.txt --mix-unit cm --mix-fps 16 --mix-rotation 90 -o both.txt

Expressions know + - * / % ^, brackets, sin cos tan asin acos atan sinh cosh tanh exp ln sqrt abs sign floor ceil round
min max clamp, the constants pi tau e, and
  t         seconds since the start          i    number of the component, from 1 on
  duration  seconds from start to end        c    its coefficient at the moment, metres
                                             sd   standard deviation of its coefficient, metres

In a new motion people step aside who would come nearer to each other than bodies do; where it is too crowded for that, a
warning says where and when. Only people who are there throughout can be worked on. Without --from and --to it is the time that holds most places of
such people. The new motion begins at 0 s.")]
pub struct Features {
    #[command(flatten)]
    input: RecordingInput,
    /// What components are: principal components of all coordinates, or eigenvectors of who comes near whom
    #[arg(long, help_heading = FEATURES, value_name = "NAME", default_value = "pca", value_parser = method())]
    method: Method,
    /// People are neighbours within this distance, metres; for --method laplacian [default: 2]
    #[arg(long, help_heading = FEATURES, value_name = "M", value_parser = neighbour_distance, allow_negative_numbers = true)]
    neighbour_distance: Option<f64>,
    /// Build the motion of the first K components alone [default: all]
    #[arg(short = 'k', long, help_heading = FEATURES, value_name = "K")]
    components: Option<usize>,
    /// Multiply coefficients: all=2.0, 1=sin(2*pi*t/5), 2..5=0 (both included); the last that names a component counts
    #[arg(long, help_heading = FEATURES, value_name = "WHICH=FACTOR", value_parser = scale)]
    scale: Vec<Rule>,
    /// Replace coefficients, metres: 1=sd*sqrt(2)*sin(2*pi*t/5)
    #[arg(long, help_heading = FEATURES, value_name = "WHICH=METRES", value_parser = set)]
    set: Vec<Rule>,
    /// Begin here, seconds [default: such that most people are there for longest]
    #[arg(long, help_heading = FEATURES, value_name = "S", value_parser = seconds, allow_negative_numbers = true)]
    from: Option<f64>,
    /// End here, seconds
    #[arg(long, help_heading = FEATURES, value_name = "S", value_parser = seconds, allow_negative_numbers = true)]
    to: Option<f64>,
    /// Moments per second that are worked on [default: the recording's own]
    #[arg(long, help_heading = FEATURES, value_name = "N", value_parser = frame_rate, allow_negative_numbers = true)]
    rate: Option<f64>,
    /// Let people come as near to each other as the new motion leads them
    #[arg(long, help_heading = FEATURES)]
    no_avoid: bool,
    /// How near bodies' middles may come to each other in a new motion, metres [default: 0.36]
    #[arg(long, help_heading = FEATURES, value_name = "M", value_parser = within("formation.avoid.distance_m"))]
    #[arg(allow_negative_numbers = true, conflicts_with = "no_avoid")]
    distance: Option<f64>,
    #[command(flatten)]
    mixing: Mixing,
    #[command(flatten, next_help_heading = "Output")]
    outputs: Outputs,
}

/// Result of the analysis, as JSON.
#[derive(Serialize)]
struct Summary {
    method: Method,
    span: PresenceSpan,
    #[serde(skip_serializing_if = "Option::is_none")]
    other_span: Option<PresenceSpan>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    mean_neighbours: Vec<f64>,
    kept: usize,
    /// Root mean square error of positions rebuilt from the kept, unchanged components, metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    error_m: Option<f64>,
    components: Vec<Row>,
}

/// One component in the table.
#[derive(Serialize)]
struct Row {
    #[serde(skip_serializing_if = "Option::is_none")]
    whose: Option<MixSource>,
    #[serde(flatten)]
    component: FeatureComponent,
    /// Share of its crowd's motion that this and all earlier components explain.
    cumulated: f64,
    /// Root mean square error of positions rebuilt from the components up to this one, metres.
    error_m: f64,
}

#[derive(Serialize)]
struct Everything<'a> {
    features: &'a Summary,
    #[serde(skip_serializing_if = "Option::is_none")]
    written: Option<&'a WalkReport>,
}

impl Features {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        let (files, json) = (&self.outputs.files, self.outputs.json);
        files.check(&["motion", "features"], json)?;
        files.probe()?;
        let watch = Watch::new(common);
        let (summary, mut made) = self.make(&watch)?;
        made.start_s = 0.0;
        if files.any() && self.changes() && !self.no_avoid {
            let avoid = AvoidRequest { distance_m: self.distance, ..AvoidRequest::default() };
            made = avoid.keep_apart(made, &watch).map_err(Error::from)?;
        }
        if !json && !common.quiet {
            self.table(&summary).into_iter().try_for_each(|line| files.say(line))?;
        }
        let report = if files.any() {
            let given = Given::ensemble(made, CoordinateFrame::Map);
            let inputs: Vec<PathBuf> = self.mixing.mix.iter().chain([&self.input.file]).cloned().collect();
            Some(self.outputs.write(&given, &inputs, &watch)?)
        } else {
            None
        };
        match &report {
            _ if json => {
                let everything = Everything { features: &summary, written: report.as_ref() };
                files.say(serde_json::to_string_pretty(&everything)?)?;
            }
            Some(report) => files.tell(report, false, common)?,
            None if self.changes() => {
                watch.warn("nothing is written: name a file with --output, --paths or --animation")
            }
            None => {}
        }
        Ok(ExitCode::SUCCESS)
    }

    /// Whether the options request a motion, not only a table.
    fn changes(&self) -> bool {
        self.components.is_some() || !self.scale.is_empty() || !self.set.is_empty() || self.mixing.mix.is_some()
    }

    fn make(&self, watch: &dyn Progress) -> anyhow::Result<(Summary, Ensemble)> {
        let recording = self.input.open(watch)?;
        let (ensemble, span) = self.people(&recording, [self.from, self.to], watch)?;
        let rules = self.scale.iter().chain(&self.set).cloned().collect();
        let modulation = Modulation { rules };
        let Some(other) = self.mixing.open(watch)? else {
            return Ok(self.decompose(&ensemble, span, &modulation, watch)?);
        };
        let of_other = self.people(&other, [self.mixing.mix_from, self.mixing.mix_to], watch);
        let (other, other_span) = of_other.map_err(mixing::of_other)?;
        Ok(self.mix([&ensemble, &other], [span, other_span], &modulation, watch)?)
    }

    /// Selects the people present during the whole span, and warns of the number of others.
    fn people(
        &self,
        recording: &Recording,
        within: [Option<f64>; 2],
        watch: &dyn Progress,
    ) -> Result<(Ensemble, PresenceSpan), Error> {
        let (ensemble, span) = features::present_throughout(recording, self.rate, within, watch)?;
        let missing = recording.survey().people.saturating_sub(span.people);
        if missing > 0 {
            let (people, from_s, to_s) = (span.people, span.from_s, span.to_s);
            watch.warn(&format!(
                "{}: {people} people are there throughout, from {from_s:.2} to {to_s:.2} s; {missing} others are left out",
                recording.path().display()
            ));
        }
        Ok((ensemble, span))
    }

    fn options(&self) -> FeaturesOptions {
        let default = FeaturesOptions::default();
        FeaturesOptions {
            method: self.method,
            neighbour_distance_m: self.neighbour_distance.unwrap_or(default.neighbour_distance_m),
        }
    }

    fn decompose(
        &self,
        ensemble: &Ensemble,
        span: PresenceSpan,
        modulation: &Modulation,
        watch: &dyn Progress,
    ) -> Result<(Summary, Ensemble), Error> {
        let found = features::Features::find(ensemble, &self.options(), watch)?;
        let components = found.components();
        let kept = self.components.unwrap_or(components.len());
        let made = found.modulated(kept, modulation)?;
        if components.iter().all(|component| component.eigenvalue == 0.0) {
            watch.warn("nobody's neighbours ever change: components are ordered by motion alone; try another --neighbour-distance");
        }
        let mut cumulated = 0.0;
        let rows = (1..).zip(components).map(|(number, &component)| {
            cumulated += component.share;
            Row { whose: None, component, cumulated, error_m: found.rebuild_error_m(number) }
        });
        let summary = Summary {
            method: self.method,
            span,
            other_span: None,
            mean_neighbours: found.mean_neighbours().into_iter().collect(),
            kept,
            error_m: Some(found.rebuild_error_m(kept)),
            components: rows.collect(),
        };
        Ok((summary, made))
    }

    fn mix(
        &self,
        [first, other]: [&Ensemble; 2],
        [span, other_span]: [PresenceSpan; 2],
        modulation: &Modulation,
        watch: &dyn Progress,
    ) -> Result<(Summary, Ensemble), Error> {
        let mixed = Mix::find(first, other, &self.options(), MixOptions { centroid: self.mixing.middle }, watch)?;
        for (left_out, name) in mixed.left_out().into_iter().zip(["first", "other"]) {
            if left_out > 0 {
                watch.warn(&format!("{left_out} people of the {name} crowd have no counterpart and are left out"));
            }
        }
        let features = [MixSource::First, MixSource::Other].map(|whose| mixed.features(whose));
        let kept = self.components.unwrap_or(mixed.components().len());
        let made = mixed.modulated(kept, modulation)?;
        let mut sums = [(0, 0.0); 2];
        let rows = mixed.components().map(|(whose, component)| {
            let (number, cumulated) = &mut sums[whose as usize];
            *number += 1;
            *cumulated += component.share;
            let error_m = features[whose as usize].rebuild_error_m(*number);
            Row { whose: Some(whose), component, cumulated: *cumulated, error_m }
        });
        let summary = Summary {
            method: self.method,
            components: rows.collect(),
            span: PresenceSpan { people: made.people(), moments: made.moments(), ..span },
            other_span: Some(other_span),
            mean_neighbours: features.iter().filter_map(|features| features.mean_neighbours()).collect(),
            kept,
            error_m: None,
        };
        Ok((summary, made))
    }

    fn table(&self, summary: &Summary) -> Vec<String> {
        let Summary { span, components, .. } = summary;
        let (name, neighbours) = match (summary.method, summary.mean_neighbours.as_slice()) {
            (Method::Pca, _) => ("principal components", String::new()),
            (Method::Laplacian, of) => {
                let counts: Vec<String> = of.iter().map(|mean| format!("{mean:.1}")).collect();
                ("Laplacian components", format!(", {} neighbours in the mean", counts.join(" and ")))
            }
        };
        let mut lines = vec![format!(
            "{} people at {} moments from {:.2} s on: {} {name}{neighbours}",
            span.people,
            span.moments,
            span.from_s,
            components.len()
        )];
        let whose = |row: &Row| match row.whose {
            None => "",
            Some(MixSource::First) => "  first",
            Some(MixSource::Other) => "  other",
        };
        let heading = if self.mixing.mix.is_some() { "  crowd" } else { "" };
        lines.push(format!("component{heading}    share   in all   left over"));
        let mut reached = [0.0f64; 2];
        for (number, row) in (1..).zip(components).take(MOST_ROWS) {
            let Row { component, cumulated, error_m, .. } = row;
            let (share, all) = (100.0 * component.share, 100.0 * cumulated);
            lines.push(format!("{number:>9}{}  {share:>5.1} %  {all:>5.1} %  {error_m:>7.3} m", whose(row)));
            reached[row.whose.map_or(0, |whose| whose as usize)] = *cumulated;
            let crowds = if row.whose.is_some() { 2 } else { 1 };
            if reached[..crowds].iter().all(|share| *share >= NEARLY_ALL) {
                break;
            }
        }
        let more = components.len() + 2 - lines.len();
        if more > 0 {
            lines.push(format!("{:>9} and {more} more", "..."));
        }
        if let (Some(error_m), true) = (summary.error_m, summary.kept < components.len()) {
            lines.push(format!("with the first {} places are missed by {error_m:.3} m in the mean", summary.kept));
        }
        lines
    }
}

fn method() -> impl TypedValueParser<Value = Method> {
    one_of(Method::ALL, Method::name)
}

fn neighbour_distance(text: &str) -> Result<f64, String> {
    number_within(text, NEIGHBOUR_DISTANCES_M)
}

fn scale(text: &str) -> Result<Rule, String> {
    Rule::scale(text).map_err(|error| said(&error))
}

fn set(text: &str) -> Result<Rule, String> {
    Rule::set(text).map_err(|error| said(&error))
}

/// Formats the error of a rule, with its hint.
fn said(error: &features::FeaturesError) -> String {
    match error.hint() {
        Some(hint) => format!("{error}\n{hint}"),
        None => error.to_string(),
    }
}
