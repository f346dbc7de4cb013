//! Many bakes of one scenario, for domain randomisation: seeds x looks x passes, one walk for each seed.

use std::path::PathBuf;

use rayon::prelude::*;
use serde_json::{Value, json};

use super::part_file::{Head, difference};
use super::series::aged;
use super::site::Site;
use super::{OutputOptions, begin, check_look, finish, make_folder};
use crate::Error;
use crate::export::{ExportError, GENERATOR, Manifest};
use crate::files::{read_input, write_whole};
use crate::look::Look;
use crate::progress::{Progress, Stopwatch};
use crate::scenario::{Scenario, ScenarioError};

/// The list of all bakes of a batch, in its folder.
const LIST: &str = "batch.json";
/// Largest list that is read, bytes.
const LARGEST_BYTES: u64 = 512 << 20;
/// Version of the list's structure.
const FORMAT: u32 = 1;

/// What the bakes of a batch differ in: every seed with every look with every number of passes, in this order.
#[derive(Clone, Debug, PartialEq)]
pub struct Batch {
    /// Seeds; none is the scenario's own.
    pub seeds: Vec<u64>,
    /// Looks with their names; none is the scenario's own.
    pub looks: Vec<(String, Look)>,
    /// Numbers of people whom the floors have seen; none is each look's own. Walls age with the floor.
    pub passes: Vec<u64>,
    /// Folder of the numbered folders.
    pub folder: PathBuf,
    /// Whether to bake again what is there.
    pub force: bool,
}

/// A bake of a batch.
struct Variant {
    number: usize,
    seed: u64,
    look: String,
    scenario: Scenario,
}

impl Variant {
    /// Name of its folder, such as `00001`.
    fn name(&self) -> String {
        format!("{:05}", self.number)
    }
}

/// Bakes a scenario in many variants, to the folders `00001` and so on in `batch.folder`, and lists them in `batch.json`
/// there. Returns the folders that were baked now: those that are there already stay.
///
/// Each bake has the bytes of a bake of its own with that seed and look. The crowd of a seed walks once for all looks.
///
/// # Errors
/// Two looks of one name; a batch of another scenario, or another list, in the folder; errors as of [`super::bake`]. Bakes
/// that were done before an error stay, and the same batch goes on after them.
pub fn batch(scenario: &Scenario, batch: &Batch, progress: &dyn Progress) -> Result<Vec<PathBuf>, Error> {
    let variants = variants(scenario, batch)?;
    variants.iter().try_for_each(|variant| check_look(&variant.scenario))?;
    let list = list(&variants)?;
    keep_list(&list, batch)?;
    let seeds: Vec<&[Variant]> = variants.chunk_by(|a, b| a.seed == b.seed).collect();
    // One seed's crowd walks while the floors of another are written.
    let baked = seeds.par_iter().map(|variants| bake_seed(variants, batch, progress));
    Ok(baked.collect::<Result<Vec<_>, Error>>()?.concat())
}

fn variants(scenario: &Scenario, batch: &Batch) -> Result<Vec<Variant>, Error> {
    let own = |list: &[u64], own: u64| if list.is_empty() { vec![own] } else { list.to_vec() };
    let looks = match &batch.looks[..] {
        [] => vec![(scenario.look.preset.clone(), scenario.look.clone())],
        looks => looks.to_vec(),
    };
    let mut variants = Vec::new();
    for seed in own(&batch.seeds, scenario.seed) {
        for (name, look) in &looks {
            for passes in own(&batch.passes, look.total_passes) {
                let look = if passes == look.total_passes { look.clone() } else { aged(look, passes)? };
                let scenario = Scenario { seed, look, ..scenario.clone() };
                variants.push(Variant { number: variants.len() + 1, seed, look: name.clone(), scenario });
            }
        }
    }
    Ok(variants)
}

/// Bakes what is not there yet of one seed.
fn bake_seed(variants: &[Variant], batch: &Batch, progress: &dyn Progress) -> Result<Vec<PathBuf>, Error> {
    let place = |variant: &Variant| batch.folder.join(variant.name());
    // A bake appears whole, so one that is there is done.
    let is_missing = |variant: &&Variant| batch.force || Manifest::read(&place(variant)).is_err();
    let missing: Vec<&Variant> = variants.iter().filter(is_missing).collect();
    let Some(first) = missing.first() else { return Ok(Vec::new()) };
    let watch = Stopwatch::start();
    let output = |variant: &Variant| OutputOptions { folder: place(variant), force: batch.force };
    let mut begun = Some(begin(&first.scenario, &output(first))?);
    let mut site = Site::find(&first.scenario, begun.as_ref(), &watch, progress)?;
    let trodden = site.walk(0..site.days, &watch, progress)?;
    for variant in &missing {
        let output = output(variant);
        let folder = match begun.take() {
            Some(folder) => folder,
            None => begin(&variant.scenario, &output)?,
        };
        site.look_as(&variant.scenario)?;
        finish(&site, &trodden, folder, &output, &watch, progress)?;
    }
    Ok(missing.into_iter().map(place).collect())
}

/// The list of all bakes, and what decides them: it tells a batch that goes on from another one.
fn list(variants: &[Variant]) -> Result<Value, Error> {
    let bakes = variants.iter().map(|variant| {
        let look = &variant.scenario.look;
        json!({ "folder": variant.name(), "seed": variant.seed, "look": variant.look, "total_passes": look.total_passes })
    });
    let mut looks: Vec<Value> = Vec::new();
    let mut settings = Value::Null;
    let of_first = variants.iter().take_while(|variant| variant.seed == variants[0].seed);
    for variant in of_first {
        let mut head = Head::of(&variant.scenario, 1..=1)?;
        let mut look = head.settings["look"].take();
        look["total_passes"].take();
        look["wall"]["total_passes"].take();
        let listed = json!({ "name": variant.look, "look": look, "inputs": head.inputs });
        match looks.iter().find(|other| other["name"] == listed["name"]) {
            Some(same) if *same == listed => {}
            Some(_) => {
                let message = format!("two looks of the batch have the name {:?}", variant.look);
                let hint = Some("rename one of the look files".to_string());
                return Err(ScenarioError::Value { message, hint }.into());
            }
            None => looks.push(listed),
        }
        head.settings["crowd"]["seed"].take();
        settings = head.settings;
    }
    Ok(json!({
        "generator": GENERATOR,
        "format": FORMAT,
        "version": env!("CARGO_PKG_VERSION"),
        "bakes": bakes.collect::<Vec<_>>(),
        "looks": looks,
        "settings": settings,
    }))
}

/// Writes the list, or checks that the one that is there is the same.
fn keep_list(list: &Value, batch: &Batch) -> Result<(), Error> {
    let path = batch.folder.join(LIST);
    if path.is_file() && !batch.force {
        let json = read_input(&path, LARGEST_BYTES);
        let json = json.map_err(|source| ExportError::Read { path: path.clone(), source })?;
        let there: Value = serde_json::from_slice(&json)
            .map_err(|error| ExportError::Damaged { path: path.clone(), problem: error.to_string() })?;
        let Some(problem) = difference(&there, list, "") else { return Ok(()) };
        let problem = format!("it is of another batch: {problem}");
        let hint = "choose another folder; the option `force` bakes all again".to_string();
        return Err(ExportError::Part { path, problem, hint }.into());
    }
    make_folder(&batch.folder)?;
    let mut json = serde_json::to_vec_pretty(list).unwrap_or_default();
    json.push(b'\n');
    write_whole(&path, &json, true)?;
    Ok(())
}
