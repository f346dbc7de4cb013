//! From key formation to key formation, in a crowd of any size.

use super::basis::relative_to_centroid;
use super::hierarchy::angles;
use super::request::{CrowdSection, ExampleKind, Pace, Stays};
use super::{AdjacencyEdit, Carry, Ease, FormationOptions, KeyFormation, default_sigma_m, interpolate};
use crate::formation::FormationError;
use crate::math::{Vec2, sin_cos, vec2};
use crate::motion::Ensemble;
use crate::progress::Progress;

/// At how many moments an example is decomposed whose people change places among themselves. Where they keep a formation,
/// those of the keys are better still; see [`FormationOptions::following_s`].
const DECOMPOSITIONS: usize = 100;
/// An example takes up key formations itself whose people are on the mean no farther from their own places than this share of
/// the distance to which neighbours feel each other.
const OWN: f64 = 0.25;

/// Everybody's places at a moment, and how far the whole has been wheeled until then.
#[derive(Clone, Debug)]
pub(super) struct KeyPlaces {
    pub moment: usize,
    pub places_m: Vec<Vec2>,
    pub wheel_rad: f64,
}

/// The individuals of a crowd over time: those of the example, led from key formation to key formation. The first is at
/// the first moment, the last at the last; without any, the example is left as it is.
pub(super) fn between(
    example: &Ensemble,
    keys: &[KeyPlaces],
    section: CrowdSection<'_>,
    progress: &dyn Progress,
) -> Result<Ensemble, FormationError> {
    if keys.len() < 2 {
        return Ok(example.clone());
    }
    let wheels = keys.iter().any(|key| key.wheel_rad != 0.0);
    let formations: Vec<KeyFormation> = keys
        .iter()
        .map(|key| KeyFormation {
            time_s: example.time_s(key.moment),
            places_m: if wheels { wheeled(&key.places_m, -key.wheel_rad) } else { key.places_m.clone() },
        })
        .collect();
    let mut tracks = match example.people() {
        1 => alone(example, &formations, section),
        _ => {
            let mut options = options(section);
            if takes_up(example, &formations) {
                options.decompositions = None;
            }
            interpolate(example, &formations, &options, progress)?
        }
    };
    if wheels {
        let given: Vec<(usize, f64)> = keys.iter().map(|key| (key.moment, key.wheel_rad)).collect();
        for (moment, angle_rad) in angles(&given, tracks.moments()).into_iter().enumerate() {
            let turned = wheeled(tracks.places_at(moment), angle_rad);
            tracks.places_at_mut(moment).copy_from_slice(&turned);
        }
    }
    Ok(tracks)
}

/// Whether an example takes up key formations itself: then it changes from one to the next as the new crowd does.
fn takes_up(example: &Ensemble, keys: &[KeyFormation]) -> bool {
    keys.iter().all(|key| {
        let moment = ((key.time_s - example.start_s) * example.fps).round() as usize;
        let own_m = relative_to_centroid(example.places_at(moment));
        let pairs = relative_to_centroid(&key.places_m).into_iter().zip(own_m);
        let off_m = pairs.map(|(place, own)| place.distance(own)).sum::<f64>() / key.places_m.len() as f64;
        off_m <= OWN * default_sigma_m(&key.places_m)
    })
}

/// Places turned around their middle.
fn wheeled(places_m: &[Vec2], angle_rad: f64) -> Vec<Vec2> {
    let middle = super::places::centroid(places_m);
    let (sin, cos) = sin_cos(angle_rad);
    places_m.iter().map(|&place| middle + (place - middle).rotated(vec2(cos, sin))).collect()
}

fn ease(section: CrowdSection<'_>) -> Ease {
    match section.pace.unwrap_or_default() {
        Pace::Gentle => Ease::Rest,
        Pace::Even => Ease::Even,
    }
}

fn options(section: CrowdSection<'_>) -> FormationOptions {
    let members = |members: &[u32]| members.iter().map(|&member| member as usize).collect();
    let together = section.together.iter().map(|group| AdjacencyEdit { members: members(group), weight: 1.0 });
    let edits =
        section.adjacency.iter().map(|edit| AdjacencyEdit { members: members(&edit.members), weight: edit.weight });
    let changes = section.example.file.is_some() || section.example.kind == Some(ExampleKind::Wander);
    FormationOptions {
        sigma_m: section.sigma_m,
        adjacency: together.chain(edits).collect(),
        decompositions: changes.then_some(DECOMPOSITIONS),
        fluctuation: section.fluctuation.unwrap_or(1.0),
        carry: match section.stays_with.unwrap_or_default() {
            Stays::Shapes => Carry::Shapes,
            Stays::People => Carry::People,
        },
        ease: ease(section),
        ..FormationOptions::default()
    }
}

/// Somebody alone has no neighbours: from place to place, with the example's deviations from its own line.
fn alone(example: &Ensemble, keys: &[KeyFormation], section: CrowdSection<'_>) -> Ensemble {
    let (ease, keep) = (ease(section), section.fluctuation.unwrap_or(1.0));
    let mut track = example.clone();
    for pair in keys.windows(2) {
        let moment = |key: &KeyFormation| ((key.time_s - example.start_s) * example.fps).round() as usize;
        let (from, to) = (moment(&pair[0]), moment(&pair[1]));
        let ends = [from, to].map(|moment| example.places_at(moment)[0]);
        for moment in from..=to {
            let time = (moment - from) as f64 / (to - from).max(1) as f64;
            let own = (example.places_at(moment)[0] - ends[0].lerp(ends[1], time)) * keep;
            track.places_at_mut(moment)[0] = pair[0].places_m[0].lerp(pair[1].places_m[0], ease.share(time)) + own;
        }
    }
    track
}
