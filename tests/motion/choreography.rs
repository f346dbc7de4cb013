//! The sample routines that are made of formations: what they are said to be, and nobody in anybody's way.

use std::path::Path;

use trodden::Silent;
use trodden::formation::{FormedCrowd, form};
use trodden::scenario::{Overrides, Scenario};

fn sample(name: &str) -> FormedCrowd {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans").join(name);
    let scenario = Scenario::open(&path, &Overrides::default()).unwrap_or_else(|error| panic!("{error}"));
    form(&scenario.formation.unwrap(), &scenario.folder, &Silent).unwrap_or_else(|error| panic!("{error}"))
}

/// The least distance between two who touch the floor, metres.
fn nearest_m(formed: &FormedCrowd) -> f64 {
    let on_foot = formed.on_foot();
    let mut nearest_m = f64::MAX;
    for moment in 0..on_foot.moments() {
        let here = on_foot.places_at(moment);
        for a in 0..here.len() {
            nearest_m = here[..a].iter().map(|other| other.distance(here[a])).fold(nearest_m, f64::min);
        }
    }
    nearest_m
}

/// The fastest that anybody goes, m/s, and the hardest that anybody changes velocity, m/s2.
fn extremes(formed: &FormedCrowd) -> [f64; 2] {
    let ensemble = &formed.ensemble;
    let fps = ensemble.fps;
    let (mut fastest, mut hardest) = (0.0_f64, 0.0_f64);
    for moment in 2..ensemble.moments() {
        let [a, b, c] = [moment - 2, moment - 1, moment].map(|moment| ensemble.places_at(moment));
        for k in 0..ensemble.people() {
            fastest = fastest.max(b[k].distance(c[k]) * fps);
            hardest = hardest.max((a[k] - b[k] * 2.0 + c[k]).length() * fps * fps);
        }
    }
    [fastest, hardest]
}

#[test]
fn the_cavalry_fights_on_eighteen_horses_and_nobody_runs_into_anybody() {
    let battle = sample("cavalry.toml");
    assert_eq!((battle.ensemble.people(), battle.riders()), (2 * 9 * 4, 2 * 9));
    assert!((60.0..=90.0).contains(&battle.ensemble.time_s(battle.ensemble.moments() - 1)));
    // Army, horse, and within it three who carry and one who is carried.
    assert_eq!(
        (battle.people[0].address.as_slice(), battle.people[39].address.as_slice()),
        (&[0, 0, 0][..], &[1, 0, 3][..])
    );
    assert!(battle.people[39].rides);
    assert!(nearest_m(&battle) >= 0.36 - 1e-9, "{} m", nearest_m(&battle));
    let [fastest, hardest] = extremes(&battle);
    assert!(fastest < 4.0 && hardest < 12.0, "{fastest} m/s, {hardest} m/s2");
}

#[test]
fn the_swimmers_keep_clear_through_every_change() {
    let routine = sample("swimming.toml");
    assert_eq!((routine.ensemble.people(), routine.riders()), (24, 0));
    assert!((60.0..=90.0).contains(&routine.ensemble.time_s(routine.ensemble.moments() - 1)));
    assert!(nearest_m(&routine) >= 0.36 - 1e-9, "{} m", nearest_m(&routine));
    let [fastest, hardest] = extremes(&routine);
    assert!(fastest < 3.0 && hardest < 8.0, "{fastest} m/s, {hardest} m/s2");
}
