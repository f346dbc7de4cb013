//! Finds three neighbours in a recording who keep one pattern of adjacency.

use std::collections::BTreeSet;
use std::error::Error;
use std::ops::Range;
use std::path::Path;

use trodden::formation::{default_sigma_m, one_pattern, sphere_tracks};
use trodden::motion::Ensemble;
use trodden::recordings::{Recording, RecordingOptions};

/// Neighbours are looked for in every so many seconds, and kept from so many on.
const WINDOW_S: f64 = 5.0;
const LEAST_S: f64 = 2.0;
/// Sigmas at which the weight is one half.
const HALF: f64 = 1.18;

/// The people of whom the eigenvectors turn farthest while rotation and recording agree; prints how far these differ in all.
pub fn with_one_pattern(path: &Path, fps: Option<f64>) -> Result<Ensemble, Box<dyn Error>> {
    let recording = Recording::open(path, &RecordingOptions { fps, ..RecordingOptions::default() })?;
    let [from_s, to_s] = recording.survey().span_s;
    let (mut one, mut any) = ([const { Vec::new() }; 4], Vec::new());
    let mut drawn: Option<(f64, Ensemble)> = None;
    let mut start_s = from_s;
    while start_s + WINDOW_S <= to_s {
        // Windows in which nobody is there throughout are passed over.
        if let Ok(ensemble) = recording.ensemble(None, [start_s, start_s + WINDOW_S]) {
            for people in threes(&ensemble) {
                let whole = part(&ensemble, people, 0..ensemble.moments());
                any.extend(degrees(&whole)?.0);
                let sigma_m = default_sigma_m(whole.places_at(whole.moments() / 2));
                for stretch in one_pattern(&whole, HALF * sigma_m) {
                    if (stretch.len() as f64) < LEAST_S * whole.fps {
                        continue;
                    }
                    let stretch = part(&ensemble, people, stretch);
                    let (degrees, turn) = degrees(&stretch)?;
                    one[pairs(&stretch, HALF * sigma_m)].extend(degrees);
                    if degrees[0] < 5.0 && drawn.as_ref().is_none_or(|(most, _)| turn > *most) {
                        drawn = Some((turn, stretch));
                    }
                }
            }
        }
        start_s += WINDOW_S;
    }
    for (pairs, degrees) in one.into_iter().enumerate() {
        print_differences(&format!("with one pattern of adjacency, {pairs} pairs of neighbours"), degrees);
    }
    print_differences("whatever the adjacency does", any);
    Ok(drawn.ok_or("no three people keep one pattern of adjacency")?.1)
}

/// Everybody with the two who are nearest in the middle of the time; each three once.
fn threes(ensemble: &Ensemble) -> BTreeSet<[usize; 3]> {
    let places_m = ensemble.places_at(ensemble.moments() / 2);
    let three = |k: usize| {
        let mut others: Vec<usize> = (0..places_m.len()).filter(|&l| l != k).collect();
        others.sort_by(|&a, &b| places_m[a].distance(places_m[k]).total_cmp(&places_m[b].distance(places_m[k])));
        let mut three = [k, *others.first()?, *others.get(1)?];
        three.sort_unstable();
        Some(three)
    };
    (0..places_m.len()).filter_map(three).collect()
}

/// How many pairs are neighbours at the first moment.
fn pairs(ensemble: &Ensemble, reach_m: f64) -> usize {
    let places_m = ensemble.places_at(0);
    let near = |&(a, b): &(usize, usize)| places_m[a].distance(places_m[b]) < reach_m;
    [(0, 1), (1, 2), (2, 0)].iter().filter(|pair| near(pair)).count()
}

/// Some people in some moments.
fn part(ensemble: &Ensemble, people: [usize; 3], moments: Range<usize>) -> Ensemble {
    let start_s = ensemble.time_s(moments.start);
    let places_m = moments.flat_map(|m| people.map(|k| ensemble.places_at(m)[k])).collect();
    Ensemble::new(ensemble.fps, start_s, people.map(|k| ensemble.ids[k]).to_vec(), places_m)
}

/// How far rotation and recording are apart on average, and how far `e_1` turns on the whole.
fn degrees(example: &Ensemble) -> Result<([f64; 2], f64), Box<dyn Error>> {
    let tracks = sphere_tracks(example, None)?;
    let ends = [&tracks.turned[0][0], &tracks.turned[tracks.turned.len() - 1][0]];
    let cosine = ends[0].iter().zip(ends[1]).map(|(a, b)| a * b).sum::<f64>();
    Ok((tracks.mean_angles_rad().map(f64::to_degrees), libm::acos(cosine.clamp(-1.0, 1.0)).to_degrees()))
}

fn print_differences(which: &str, mut degrees: Vec<f64>) {
    degrees.sort_by(f64::total_cmp);
    let at = |share: f64| degrees.get((share * degrees.len() as f64) as usize).copied().unwrap_or(f64::NAN);
    let below = degrees.iter().filter(|&&angle| angle < 5.0).count() as f64 / degrees.len().max(1) as f64;
    let mean = degrees.iter().sum::<f64>() / degrees.len().max(1) as f64;
    println!(
        "{which}: {} vectors, apart on average {mean:.2}, median {:.2}, nine tenths below {:.2} degrees; {:.0} % below 5",
        degrees.len(),
        at(0.5),
        at(0.9),
        100.0 * below
    );
}
