//! What is played is a unit: chosen by who is there, placed at the viewer, for as long as it lasts.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use trodden::crowd::CrowdModel;
use trodden::math::{Vec2, sin_cos, vec2};
use trodden::units::{AreaSide, Areas, SpotFrame, Unit, UnitLibrary};

use super::scene::{Run, Scene, Seen};

const STEP_S: f64 = 0.1;

fn run() -> &'static Run {
    static RUN: OnceLock<Run> = OnceLock::new();
    RUN.get_or_init(|| {
        let scene = Scene::plaza();
        scene.run_with(scene.spot(), 120.0, 5)
    })
}

fn viewer() -> SpotFrame {
    let scene = Scene::plaza();
    let spot = scene.spot();
    let (sin, cos) = sin_cos(spot.heading_deg.unwrap().to_radians());
    SpotFrame { at_m: spot.at.to_m(&scene.plan), ahead: vec2(cos, sin) }
}

/// A splice: the moment before it, who takes part, and who plays on from before.
struct Splice {
    at: usize,
    ids: Vec<u32>,
}

fn splices() -> Vec<Splice> {
    let moments = &run().0;
    let led = |moment: &[Seen]| -> Vec<u32> { moment.iter().filter(|seen| seen.led).map(|seen| seen.id).collect() };
    let all: Vec<Vec<u32>> = moments.iter().map(|moment| led(moment)).collect();
    let begun = |at: usize| -> Vec<u32> {
        let before = if at == 0 { &[][..] } else { &all[at - 1] };
        all[at].iter().filter(|id| !before.contains(id)).copied().collect()
    };
    let begun = (0..all.len()).map(|at| Splice { at, ids: begun(at) });
    begun.filter(|splice| !splice.ids.is_empty()).collect()
}

fn find(moment: &[Seen], id: u32) -> Option<&Seen> {
    moment.iter().find(|seen| seen.id == id)
}

/// The sample is the paper's experiment: 72 people in groups, a viewer who stands still, at least 16 units of 3.0 by 3.5 to
/// 7.0 m.
#[test]
fn the_sample_is_the_papers_experiment() {
    let scene = Scene::plaza();
    assert_eq!((scene.scenario.crowd.people, scene.scenario.crowd.model), (72, CrowdModel::SocialForce));
    assert_eq!(scene.spot().areas(), Areas { front_m: [3.0; 2], rear_m: [3.0; 2], played_m: [3.0, 7.0] });
    assert!(scene.spot().play && scene.spot().folder.is_none());
    let moments = &run().0;
    let mut sizes: BTreeMap<u32, usize> = BTreeMap::new();
    moments.last().unwrap().iter().for_each(|seen| *sizes.entry(seen.group).or_default() += 1);
    assert!((1..=3).all(|size| sizes.values().any(|&count| count == size)), "alone and in groups: {sizes:?}");
    assert!(moments[200..].iter().all(|moment| moment.len() >= 70), "they are there all the time");
}

/// Whoever takes part was judged: their group's middle was in front or behind. Nobody in front who was free is left out.
#[test]
fn those_who_are_in_front_are_those_who_play() {
    let (areas, frame) = (Areas::default(), viewer());
    let moments = &run().0;
    let splices = splices();
    let mut counted = 0;
    for splice in splices.iter().filter(|splice| splice.at > 10) {
        let before = &moments[splice.at];
        let mut groups: BTreeMap<u32, Vec<&Seen>> = BTreeMap::new();
        // Those who play already, or did within the last second, are not counted.
        let busy = |id: u32, at: usize| find(&moments[at], id).is_some_and(|seen| seen.led);
        let idle = |id: u32| (splice.at - 10..splice.at).all(|at| !busy(id, at));
        for seen in before.iter().filter(|seen| idle(seen.id)) {
            groups.entry(seen.group).or_default().push(seen);
        }
        for group in groups.values() {
            let middle = group.iter().fold(Vec2::ZERO, |sum, seen| sum + seen.place_m) / group.len() as f64;
            let apart = group.iter().any(|seen| seen.place_m.distance(middle) > 2.4);
            let side = areas.side_of(frame.of_plan(middle));
            let taken = group.iter().filter(|seen| splice.ids.contains(&seen.id)).count();
            if apart {
                continue;
            }
            counted += 1;
            match side {
                Some(AreaSide::Front) => assert_eq!(taken, group.len(), "at {} s {group:?}", splice.at),
                Some(AreaSide::Rear) => assert!(taken == 0 || taken == group.len(), "at {} s {group:?}", splice.at),
                None => assert_eq!(taken, 0, "at {} s {group:?}", splice.at),
            }
        }
    }
    assert!(splices.len() > 15 && counted > 60, "{} {counted}", splices.len());
}

/// Everybody's place as a unit says, seen from the viewer; `None` if this is not the unit.
fn is_played(unit: &Unit, mirrored: bool, people: &[&Seen], time_s: f64, frame: &SpotFrame) -> bool {
    let places: Vec<Vec2> =
        (0..unit.members.len()).map(|member| frame.to_plan(unit.moment(member, time_s, mirrored).place_m)).collect();
    people.len() == places.len()
        && people.iter().all(|seen| places.iter().any(|place| place.distance(seen.place_m) < 0.005))
}

/// Once people have moved over they are where a unit says, relative to the viewer, with as many people in the same groups,
/// and they play it to its end.
#[test]
fn what_they_play_is_a_unit_placed_at_the_viewer() {
    let frame = viewer();
    let units = UnitLibrary::built_in().unwrap().units;
    let (moments, report) = run();
    let (mut found, mut names) = (0, BTreeMap::new());
    for splice in splices() {
        let ends = |unit: &Unit| {
            let last = (unit.duration_s / STEP_S + 1e-6) as usize;
            let moment = moments.get(splice.at + last)?;
            let people: Option<Vec<&Seen>> = splice.ids.iter().map(|&id| find(moment, id)).collect();
            Some((people?, last as f64 * STEP_S))
        };
        let fits = |unit: &&Unit| {
            ends(unit).is_some_and(|(people, time_s)| {
                [false, true].iter().any(|&mirrored| is_played(unit, mirrored, &people, time_s, &frame))
            })
        };
        let Some(unit) = units.iter().find(fits) else { continue };
        found += 1;
        *names.entry(unit.name.clone()).or_insert(0u64) += 1;
        let mut there: BTreeMap<u32, usize> = BTreeMap::new();
        splice.ids.iter().for_each(|&id| *there.entry(find(&moments[splice.at], id).unwrap().group).or_default() += 1);
        let mut sizes: Vec<usize> = there.into_values().collect();
        let mut wanted: Vec<usize> = unit.groups().iter().map(Vec::len).collect();
        sizes.sort_unstable();
        wanted.sort_unstable();
        assert_eq!(sizes, wanted, "{}", unit.name);
    }
    // Some are left early, some last beyond the two minutes.
    assert!(found as u64 * 10 >= report.splices * 7 && found > 12, "{found} of {}", report.splices);
    assert!(
        names.iter().all(|(name, count)| report.by_unit.get(name).is_some_and(|played| played >= count)),
        "{names:?}"
    );
}
