//! How near people come to walls, and how they pass doors.

use trodden::crowd::CrowdOptions;

use super::measures::percentile;
use super::scene::{Scene, across, area, commuters, endless, opening, route};

/// Distances of body middles from the nearer wall in an endless corridor, metres, after ten seconds.
fn wall_distances(width_m: f64, density: f64) -> Vec<f64> {
    let length_m = 26.0;
    let scene =
        Scene::corridor(length_m, width_m, vec![route(area([0.0, length_m], [0.0, width_m + 0.4]), opening("east"))]);
    let people = (density * length_m * width_m).round() as u32;
    let mut distances = Vec::new();
    scene.walk(&endless(people, length_m, 60.0), 1, |frame| {
        if frame.time_s > 10.0 {
            distances.extend(frame.walkers.iter().map(|w| (w.position_m.y - 0.2).min(width_m + 0.2 - w.position_m.y)));
        }
    });
    distances
}

/// Recordings of the Juelich archive (doi 10.34735/ped.2018.1): width, persons per square metre, and the distances from
/// the wall that 5 % of positions fall below, in the least and the most favourable stretch.
const RECORDED: [(&str, f64, f64, [f64; 2]); 3] = [
    ("1.8 m, free", 1.8, 0.5, [0.33, 0.38]),
    ("1.8 m, congested", 1.8, 2.1, [0.23, 0.27]),
    ("5 m, free", 5.0, 0.37, [0.65, 0.87]),
];

#[test]
fn people_keep_off_walls_as_recorded() {
    for (name, width_m, density, [low_m, high_m]) in RECORDED {
        let mut distances = wall_distances(width_m, density);
        let nearest_m = percentile(&mut distances, 0.05);
        let least_m = distances[0];
        println!(
            "{name}: 5 % within {nearest_m:.2} m of the wall, recorded {low_m} to {high_m} m; least {least_m:.2} m"
        );
        assert!(nearest_m > low_m - 0.10 && nearest_m < high_m + 0.10, "{name}: {nearest_m} m");
    }
}

#[test]
fn a_door_of_120_cm_carries_what_doors_carry() {
    // 100 people who all want out of a room through one door.
    let scene = Scene::rooms(1.2, vec![route(area([0.3, 7.5], [0.4, 6.0]), opening("east"))]);
    for seed in 1..=3 {
        let mut passed: Vec<f64> = Vec::new();
        let mut beyond = [false; 100];
        let options = CrowdOptions { entry_seconds: Some(0.0), ..commuters(100) };
        let tally = scene.walk(&options, seed, |frame| {
            for walker in frame.walkers.iter().filter(|w| w.position_m.x > 8.0) {
                if !std::mem::replace(&mut beyond[walker.id as usize], true) {
                    passed.push(frame.time_s);
                }
            }
        });
        assert_eq!(tally.arrived, 100, "{:?}", tally.stuck);
        // The first and the last tenth come one by one.
        let flow = 80.0 / (passed[90] - passed[10]) / 1.2;
        let longest_s = passed.windows(2).map(|w| w[1] - w[0]).fold(0.0, f64::max);
        println!("door of 1.2 m, seed {seed}: {flow:.2} persons/(m s), longest pause {longest_s:.1} s");
        // Seyfried et al. 2009 measured 1.9, building codes assume 1.3.
        assert!((1.2..=1.9).contains(&flow), "seed {seed}: {flow} persons/(m s)");
        assert!(longest_s < 5.0, "seed {seed}: an arch stood for {longest_s} s");
    }
}

#[test]
fn everybody_arrives_through_a_door_of_80_cm_both_ways() {
    let scene = Scene::rooms(0.8, vec![across("west"), across("east")]);
    for seed in 1..4 {
        let mut in_wall = 0;
        let tally = scene.walk(&commuters(200), seed, |frame| {
            in_wall += frame.walkers.iter().filter(|w| scene.is_in_wall(w.position_m)).count();
        });
        assert_eq!((tally.entered, tally.arrived, in_wall), (200, 200, 0), "seed {seed}: {:?}", tally.stuck);
    }
}

#[test]
fn the_paper_s_wide_bodies_pass_a_door_of_80_cm_too() {
    let scene = Scene::rooms(0.8, vec![across("west"), across("east")]);
    let tally = scene.walk(&CrowdOptions { people: 60, ..CrowdOptions::paper() }, 1, |_| {});
    assert_eq!((tally.entered, tally.arrived), (60, 60), "{:?}", tally.stuck);
}
