use std::fs;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use super::part_file::{self, Head, PartFile};
use super::site::Site;
use super::{OutputOptions, begin, check_look, finish, make_folder};
use crate::Error;
use crate::export::{self, ExportError, PeopleReport, Report};
use crate::files::{WholeFile, files_in};
use crate::progress::{Progress, Stage, Stopwatch};
use crate::scenario::{Scenario, ScenarioError};

/// Ending of the files of parts.
const ENDING: &str = "part";

/// A part of a bake: the exact sums of some of its days, in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Its file, `days_00017-00032.part`.
    pub file: PathBuf,
    /// Counts and timings; `None` if the part was there already.
    pub report: Option<Report>,
}

/// Bakes some days of a scenario, counted from 1, to a file in the folder `job`: [`merge`] makes a bake of all parts.
///
/// Parts may be baked in any order, on any machine, and twice: the file appears whole under its name, and a part that is
/// there is not baked again. `force` bakes it again, and replaces one of another scenario.
///
/// # Errors
/// Days that the scenario does not have; a recording or formation in the place of the crowd; a part of another scenario in
/// the way; errors of the stages up to the sums; [`Error::Interrupted`]. After an error no new files remain.
pub fn bake_part(
    scenario: &Scenario,
    days: RangeInclusive<u32>,
    job: &Path,
    force: bool,
    progress: &dyn Progress,
) -> Result<Part, Error> {
    let watch = Stopwatch::start();
    check_days(scenario, &days)?;
    check_look(scenario)?;
    let (first, last) = (*days.start(), *days.end());
    let file = job.join(format!("days_{first:05}-{last:05}.{ENDING}"));
    let head = Head::of(scenario, days)?;
    if file.is_file() && !force {
        let found = PartFile::open(&file)?;
        if let Some(problem) = found.head.difference(&head) {
            let hint = "choose another folder; the option `force` replaces the part".into();
            return Err(ExportError::Part { path: file, problem, hint }.into());
        }
        // A copy that was cut short is replaced.
        if found.check().is_ok() {
            return Ok(Part { file, report: None });
        }
    }
    let site = Site::find(scenario, None, &watch, progress)?;
    let walk = || {
        make_folder(job)?;
        let whole = WholeFile::begin(&file, true)?;
        let trodden = site.walk(first - 1..last, &watch, progress)?;
        watch.busy(Stage::Sums, || part_file::write(&whole, &head, &trodden, progress))?;
        whole.publish()?;
        Ok::<_, Error>(trodden)
    };
    // A folder with other files in it stays.
    let trodden = walk().inspect_err(|_| drop(fs::remove_dir(job)))?;
    let report = Report {
        people: PeopleReport::of(&trodden.walked.tally, &site.routes),
        warnings: Vec::new(),
        life: trodden.life,
        footfalls: trodden.walked.footfalls,
        contacts: trodden.walked.contacts,
        seconds: watch.seconds(),
        peak_memory_mib: export::peak_memory_mib(),
    };
    Ok(Part { file, report: Some(report) })
}

fn check_days(scenario: &Scenario, days: &RangeInclusive<u32>) -> Result<(), ScenarioError> {
    let wrong = |message: String, hint: String| Err(ScenarioError::Value { message, hint: Some(hint) });
    if scenario.motion_file.is_some() || scenario.formation.is_some() {
        let message = "a recording or a formation is walked once: it has no days to bake apart".to_string();
        return wrong(message, "bake it whole".to_string());
    }
    let (first, last, all) = (days.start(), days.end(), scenario.days);
    if *first == 0 || first > last || *last > all {
        let message = format!("the scenario has no days {first} to {last}: it has {all}");
        return wrong(message, format!("give days from 1 to {all}, or set [crowd] days"));
    }
    Ok(())
}

/// Adds the parts of a bake up, and writes what a bake of all days at once would: the same bytes in every file but
/// `report.json`.
///
/// `parts` are files, or folders of them. The scenario is that of the parts; what it reads must be where it was, or in
/// `inputs`, a folder that its paths then start from. `any_size` is as in [`crate::export::TextureOptions`].
///
/// # Errors
/// Days that no part has, or two; parts of unlike scenarios, inputs or versions; damaged files; errors as of
/// [`super::bake`]. After an error no new files remain and an earlier result is unchanged.
pub fn merge(
    parts: &[PathBuf],
    inputs: Option<&Path>,
    output: &OutputOptions,
    any_size: bool,
    progress: &dyn Progress,
) -> Result<Report, Error> {
    let watch = Stopwatch::start();
    let files = files_of(parts)?;
    let mut parts = files.iter().map(|file| PartFile::open(file)).collect::<Result<Vec<_>, _>>()?;
    parts.sort_by_key(|part| part.head.days);
    check_together(&parts)?;
    let (path, head) = (parts[0].path.clone(), parts[0].head.clone());
    let mut scenario = head.scenario(inputs)?;
    scenario.texture.any_size = any_size;
    if let Some(problem) = head.difference(&Head::of(&scenario, 1..=head.of)?) {
        let hint = "bake the parts again, or bring the file back; the option `inputs` names another folder".into();
        return Err(ExportError::Part { path, problem, hint }.into());
    }
    let folder = begin(&scenario, output)?;
    folder.check_not_inputs(&files)?;
    let site = Site::find(&scenario, Some(&folder), &watch, progress)?;
    let mut trodden = site.untrodden();
    let count = parts.len() as f64;
    for (number, part) in parts.into_iter().enumerate() {
        progress.keep_on()?;
        progress.advance(Stage::Sums, number as f64 / count);
        watch.busy(Stage::Sums, || part.add_to(&mut trodden))?;
    }
    progress.advance(Stage::Sums, 1.0);
    finish(&site, &trodden, folder, output, &watch, progress)
}

/// The files of parts, those of a folder by their ending.
fn files_of(parts: &[PathBuf]) -> Result<Vec<PathBuf>, ExportError> {
    let mut files = Vec::new();
    for path in parts {
        if path.is_dir() {
            let is_part = |file: &PathBuf| {
                let hidden = file.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
                !hidden && file.extension().is_some_and(|ending| ending == ENDING)
            };
            files.extend(files_in(path).into_iter().filter(is_part));
        } else if path.exists() {
            files.push(path.clone());
        } else {
            return Err(ExportError::PartsMissing { path: path.clone(), days: "any day".into() });
        }
    }
    if files.is_empty() {
        let path = parts.first().cloned().unwrap_or_default();
        return Err(ExportError::PartsMissing { path, days: "any day".into() });
    }
    Ok(files)
}

/// Checks that parts, sorted by their days, are of one bake and have each of its days once.
fn check_together(parts: &[PartFile]) -> Result<(), ExportError> {
    let wrong = |part: &PartFile, problem: String, hint: &str| {
        Err(ExportError::Part { path: part.path.clone(), problem, hint: hint.to_string() })
    };
    let (first, mut next, mut missing) = (&parts[0], 1, Vec::new());
    let all = first.head.of;
    for (number, part) in parts.iter().enumerate() {
        if let Some(difference) = part.head.difference(&first.head) {
            let problem = format!("{difference}, as in {}", first.path.display());
            return wrong(part, problem, "bake it again as the others were, or remove it");
        }
        let [from, to] = part.head.days;
        if from < next {
            let before = &parts[number - 1];
            let problem = format!("day {from} is in {} too", before.path.display());
            return wrong(part, problem, "remove one of the two: each day counts once");
        }
        if from > next {
            missing.push([next, from - 1]);
        }
        next = to.saturating_add(1);
    }
    if next <= all {
        missing.push([next, all]);
    }
    if missing.is_empty() {
        return Ok(());
    }
    let days: Vec<String> = missing.iter().map(|[from, to]| format!("{from}..{to}")).collect();
    let path = first.path.parent().unwrap_or(Path::new("")).to_path_buf();
    Err(ExportError::PartsMissing { path, days: format!("the days {} of {all}", days.join(", ")) })
}
