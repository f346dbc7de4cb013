use super::super::track::{TrackSample, UnitTrack};
use super::super::unit::Member;
use super::*;
use crate::math::vec2;

const AWAY: Vec2 = vec2(0.0, 1.0);
const TOWARDS: Vec2 = vec2(0.0, -1.0);

/// A unit whose people walk straight on at 1 m/s for 2 s: group, start, direction of each.
fn unit(name: &str, people: &[(u32, Vec2, Vec2)]) -> Unit {
    let member = |&(group, place_m, heading): &(u32, Vec2, Vec2)| {
        let sample = |k: u32| TrackSample { time_s: f64::from(k), place_m: place_m + heading * f64::from(k), heading };
        Member { group, track: UnitTrack::new((0..=2).map(sample).collect()) }
    };
    Unit {
        name: name.into(),
        description: String::new(),
        viewer: UnitTrack::default(),
        area_m: [3.0, 5.0],
        duration_s: 2.0,
        members: people.iter().map(member).collect(),
    }
}

/// People of one group who walk at 1 m/s.
fn group(people: &[(u32, Vec2, Vec2)]) -> Party {
    let moment =
        |&(id, place_m, heading): &(u32, Vec2, Vec2)| (id, TrackState { place_m, velocity_m_s: heading, heading });
    Party::of(&Areas::default(), people.iter().map(moment).collect()).unwrap()
}

fn found(units: &[Unit], present: &[Party]) -> Ranking {
    rank(units, present, &Areas::default(), &MatchOptions::default(), |_| None)
}

#[test]
fn candidates_have_the_same_count_and_the_same_groups_in_front_and_behind() {
    let at = |x: f64, y: f64| vec2(x, y);
    let units = [
        unit("pair", &[(0, at(-0.4, 2.0), TOWARDS), (0, at(0.4, 2.0), TOWARDS)]),
        unit("two alone", &[(0, at(-0.4, 2.0), TOWARDS), (1, at(0.4, 2.0), TOWARDS)]),
        unit("one", &[(0, at(-0.4, 2.0), TOWARDS)]),
        unit("three", &[(0, at(-0.4, 2.0), TOWARDS), (0, at(0.4, 2.0), TOWARDS), (1, at(1.2, 2.0), TOWARDS)]),
        unit("one before, one behind", &[(0, at(-0.4, 2.0), TOWARDS), (1, at(0.4, -2.0), AWAY)]),
    ];
    let names = |present: &[Party]| -> Vec<&str> {
        let mut names: Vec<&str> =
            found(&units, present).candidates.iter().map(|c| units[c.unit].name.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        names
    };
    let [left, right] = [(7, at(-0.5, 2.1), TOWARDS), (9, at(0.5, 1.9), TOWARDS)];
    assert_eq!(names(&[group(&[left, right])]), ["pair"]);
    assert_eq!(names(&[group(&[left]), group(&[right])]), ["two alone"]);
    assert_eq!(names(&[group(&[left])]), ["one"]);
    let behind = group(&[(9, at(0.5, -1.9), AWAY)]);
    assert_eq!(names(&[group(&[left]), behind.clone()]), ["one", "one before, one behind"]);
    // The one that has everybody comes first; whoever comes on behind the viewer makes the other dearer.
    let ranked = found(&units, &[group(&[left]), behind.clone()]);
    assert_eq!(units[ranked.candidates[0].unit].name, "one before, one behind");
    assert!(ranked.candidates.last().unwrap().cost > 0.4, "{ranked:?}");
    // Nobody is left out in front, and units with somebody behind need somebody there.
    assert_eq!(names(&[behind]), [""; 0]);
    assert_eq!(names(&[group(&[left]), group(&[right]), group(&[(1, at(1.0, 2.0), TOWARDS)])]), [""; 0]);
    assert_eq!(names(&[]), [""; 0]);
    assert_eq!(found(&units, &[group(&[(9, at(1.4, 2.9), AWAY)])]), Ranking { candidates: vec![], alike: 1 });
}

#[test]
fn agreeing_headings_come_first() {
    let turned = |deg: f64| {
        let (sin, cos) = crate::math::sin_cos((deg - 90.0).to_radians());
        vec2(cos, sin)
    };
    let units = [40.0, 0.0, 20.0].map(|deg| unit(&format!("{deg}"), &[(0, vec2(0.0, 2.0), turned(deg))]));
    let ranked = found(&units, &[group(&[(3, vec2(0.0, 2.0), TOWARDS)])]);
    let order: Vec<usize> = ranked.candidates.iter().filter(|c| !c.mirrored).map(|c| c.unit).collect();
    assert_eq!(order, [1, 2, 0]);
    assert!(ranked.candidates[0].cost < 1e-6);
    // Beyond the largest turn there is none.
    assert!(found(&units, &[group(&[(3, vec2(0.0, 2.0), AWAY)])]).candidates.is_empty());
}

#[test]
fn near_places_come_first_and_the_mirrored_unit_serves_the_other_side() {
    let units = [unit("left", &[(0, vec2(-1.0, 2.0), TOWARDS)])];
    let ranked = found(&units, &[group(&[(3, vec2(0.9, 2.0), TOWARDS)])]);
    assert_eq!(ranked.candidates.len(), 1, "the other is too far off");
    assert!(ranked.candidates[0].mirrored);
    assert!((ranked.candidates[0].cost - 0.01).abs() < 1e-6);
}

#[test]
fn people_take_the_nearest_parts_and_groups_stay_together() {
    let at = vec2;
    let units = [unit(
        "3",
        &[
            (0, at(-1.0, 2.0), TOWARDS),
            (0, at(-0.3, 2.0), TOWARDS),
            (1, at(0.5, 2.0), TOWARDS),
            (2, at(1.2, 2.0), AWAY),
        ],
    )];
    let present = [
        group(&[(5, at(1.3, 2.2), AWAY)]),
        group(&[(8, at(-0.4, 2.1), TOWARDS), (4, at(-1.0, 2.1), TOWARDS)]),
        group(&[(6, at(0.4, 1.8), TOWARDS)]),
    ];
    assert_eq!(found(&units, &present).candidates[0].parts, [4, 8, 6, 5]);
}

#[test]
fn what_was_just_played_comes_later() {
    let units = ["a", "b"].map(|name| unit(name, &[(0, vec2(0.0, 2.0), TOWARDS)]));
    let present = [group(&[(3, vec2(0.0, 2.0), TOWARDS)])];
    let ranked = rank(&units, &present, &Areas::default(), &MatchOptions::default(), |unit| (unit == 0).then_some(1));
    assert_eq!(ranked.candidates[0].unit, 1);
}
