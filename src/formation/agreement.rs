//! How nearly the eigenvectors of people in a recording turn as a rotation turns them (figure 3 of the paper).

use std::collections::BTreeSet;
use std::ops::Range;

use super::{FormationError, default_sigma_m, sphere_tracks};
use crate::math::Vec2;
use crate::motion::Ensemble;
use crate::progress::Progress;
use crate::recordings::Recording;

/// Neighbours are looked for in every so many seconds, and kept from so many on.
const WINDOW_S: f64 = 5.0;
const LEAST_S: f64 = 2.0;
/// Sigmas at which the weight is one half.
const HALF: f64 = 1.18;
/// Mean angle up to which three people count as an illustration, degrees.
const AGREES_DEG: f64 = 5.0;

/// Angles between recorded eigenvectors of three neighbours and those that an even rotation from the first to the last formation
/// gives: means over time, degrees, of `e_1` and `e_2` of every three, ascending.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Agreement {
    /// Over at least 2 s with one pattern of adjacency, with no, one, two or three pairs of neighbours.
    pub one_pattern_deg: [Vec<f64>; 4],
    /// Over 5 s, whatever the adjacency does.
    pub any_deg: Vec<f64>,
    /// The three whose eigenvectors turn farthest while both agree.
    pub turned_farthest: Option<Ensemble>,
}

impl Agreement {
    /// Compares all people of a recording with their two nearest neighbours, in windows of 5 s.
    ///
    /// # Errors
    /// [`FormationError::Interrupted`]; numbers that are not finite.
    pub fn of(recording: &Recording, progress: &dyn Progress) -> Result<Agreement, FormationError> {
        let [from_s, to_s] = recording.survey().span_s;
        let (mut found, mut farthest_deg) = (Agreement::default(), 0.0);
        for window in 0..((to_s - from_s + 1e-6) / WINDOW_S) as u32 {
            progress.keep_on()?;
            let start_s = from_s + f64::from(window) * WINDOW_S;
            // Windows in which nobody is there throughout are passed over.
            let Ok(ensemble) = recording.ensemble(None, [start_s, start_s + WINDOW_S]) else { continue };
            for people in threes(&ensemble) {
                let whole = part(&ensemble, people, 0..ensemble.moments());
                found.any_deg.extend(degrees(&whole)?.0);
                let reach_m = HALF * default_sigma_m(whole.places_at(whole.moments() / 2));
                for stretch in Agreement::one_pattern(&whole, reach_m) {
                    if (stretch.len() as f64) < LEAST_S * whole.fps {
                        continue;
                    }
                    let stretch = part(&ensemble, people, stretch);
                    let (degrees, turn_deg) = degrees(&stretch)?;
                    found.one_pattern_deg[pairs(&stretch, reach_m)].extend(degrees);
                    if degrees[0] < AGREES_DEG && turn_deg > farthest_deg {
                        farthest_deg = turn_deg;
                        found.turned_farthest = Some(stretch);
                    }
                }
            }
        }
        found.one_pattern_deg.iter_mut().chain([&mut found.any_deg]).for_each(|all| all.sort_by(f64::total_cmp));
        Ok(found)
    }

    /// The ranges of frames with one pattern of adjacency: the same pairs of people within `reach_m`.
    ///
    /// At `reach_m` = 1.18 sigma the Gaussian weight is one half.
    pub fn one_pattern(example: &Ensemble, reach_m: f64) -> Vec<Range<usize>> {
        let pattern = |moment: usize| -> Vec<bool> {
            let places_m = example.places_at(moment);
            let near = |(k, place): (usize, &Vec2)| {
                let place = *place;
                places_m[..k].iter().map(move |other| other.distance(place) < reach_m).collect::<Vec<bool>>()
            };
            places_m.iter().enumerate().flat_map(near).collect()
        };
        let mut stretches = Vec::new();
        let mut start = 0;
        let mut now = if example.moments() > 0 { pattern(0) } else { return stretches };
        for moment in 1..example.moments() {
            let next = pattern(moment);
            if next != now {
                stretches.push(start..moment);
                (start, now) = (moment, next);
            }
        }
        stretches.push(start..example.moments());
        stretches
    }
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

/// Mean angles between rotation and recording, and the angle by which `e_1` turns on the whole, degrees.
fn degrees(example: &Ensemble) -> Result<([f64; 2], f64), FormationError> {
    let tracks = sphere_tracks(example, None)?;
    let ends = [&tracks.turned[0][0], &tracks.turned[tracks.turned.len() - 1][0]];
    let cosine = ends[0].iter().zip(ends[1]).map(|(a, b)| a * b).sum::<f64>();
    Ok((tracks.mean_angles_rad().map(f64::to_degrees), libm::acos(cosine.clamp(-1.0, 1.0)).to_degrees()))
}
