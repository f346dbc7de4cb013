//! Gaps, corridors and crossings that many people want to pass in both directions: the crowd must keep moving.

use trodden::crowd::CrowdOptions;
use trodden::math::Vec2;
use trodden::routes::RouteRequest;

use super::scene::{Scene, across, area, commuters, opening, route};

/// Seconds over which people come.
const INFLOW_S: f64 = 150.0;

/// People per second who arrive while the middle six tenths of them do.
fn flow_of(scene: &Scene, options: &CrowdOptions, seed: u64) -> f64 {
    let people = options.people;
    let mut last_seen_s = vec![0.0; people as usize];
    let tally = scene.walk(options, seed, |frame| {
        for walker in &frame.walkers {
            last_seen_s[walker.id as usize] = frame.time_s;
        }
    });
    assert_eq!(tally.arrived, u64::from(people), "seed {seed}: not everybody arrived");
    last_seen_s.sort_by(f64::total_cmp);
    let [from, to] = [0.2, 0.8].map(|share| (share * f64::from(people)) as usize);
    (to - from) as f64 / (last_seen_s[to] - last_seen_s[from])
}

fn mean_flow_per_s(scene: &Scene, people_per_s: f64, seeds: u64) -> f64 {
    let people = (people_per_s * INFLOW_S).round() as u32;
    let options = CrowdOptions { entry_seconds: Some(INFLOW_S), ..commuters(people) };
    (1..=seeds).map(|seed| flow_of(scene, &options, seed)).sum::<f64>() / seeds as f64
}

fn one_way() -> Vec<RouteRequest> {
    vec![across("west")]
}

fn both_ways() -> Vec<RouteRequest> {
    ["west", "east"].map(across).into()
}

/// Two corridors of 4 m that cross; people come from all four sides.
fn crossing() -> Scene {
    let floor = |p: Vec2| (p.y - 12.0).abs() < 2.0 || (p.x - 12.0).abs() < 2.0;
    Scene::new([24.0, 24.0], floor, ["west", "east", "south", "north"].map(across).into())
}

/// Two-way flow at 1.3 people per metre and second, as a share of one-way flow.
fn two_way_share(what: &str, width_m: f64, scene: impl Fn(Vec<RouteRequest>) -> Scene, seeds: u64) -> f64 {
    let [one, both] = [one_way(), both_ways()].map(|routes| mean_flow_per_s(&scene(routes), 1.3 * width_m, seeds));
    println!("{what} {width_m} m: one way {one:.2}, both ways {both:.2} people/s");
    both / one
}

fn check(gaps_m: &[f64], corridors_m: &[f64], seeds: u64) {
    for &width_m in gaps_m {
        let share = two_way_share("gap", width_m, |routes| Scene::rooms(width_m, routes), seeds);
        assert!(share >= 0.85, "gap of {width_m} m: {share:.2} of the one-way flow");
    }
    for &width_m in corridors_m {
        let share = two_way_share("corridor", width_m, |routes| Scene::corridor(26.0, width_m, routes), seeds);
        assert!(share >= 0.85, "corridor of {width_m} m: {share:.2} of the one-way flow");
    }
    // 0.3 people per metre and second come out of each of the four arms.
    let crossed = mean_flow_per_s(&crossing(), 4.8, seeds) / 4.8;
    println!("crossing: {crossed:.2} of the inflow");
    assert!(crossed >= 0.85, "crossing: {crossed:.2} of the inflow");
    // More come than fit through: one-way capacity of a gap (Seyfried et al. 2009, Transp. Sci. 43: about 1.9).
    let capacity = mean_flow_per_s(&Scene::rooms(1.0, one_way()), 2.4, seeds);
    println!("gap 1 m, over-fed: {capacity:.2} people/s");
    assert!((1.6..=1.9).contains(&capacity), "a gap of 1 m lets {capacity:.2} people a second pass");
}

#[test]
fn counter_flow_and_crossings_keep_moving() {
    check(&[1.0, 2.0], &[4.0], 2);
}

#[test]
#[ignore = "a minute of CPU; the figures of docs/crowd.md"]
fn counter_flow_and_crossings_keep_moving_over_many_seeds() {
    check(&[0.8, 1.0, 1.5, 2.0], &[2.0, 4.0], 16);
}

#[test]
fn a_jam_before_a_narrow_gap_drains_as_recorded() {
    // 75 people before a gap of 0.5 m, recorded: 1.16 people a second (Juelich, doi 10.34735/ped.2018.1, run 040_c_56_h-).
    let scene = Scene::rooms(0.6, vec![route(area([0.3, 7.5], [0.4, 6.0]), opening("east"))]);
    for seed in 1..=3 {
        let flow = flow_of(&scene, &CrowdOptions { entry_seconds: Some(0.0), ..commuters(75) }, seed);
        println!("gap 0.6 m, 75 people, seed {seed}: {flow:.2} people/s");
        assert!((0.8..=1.5).contains(&flow), "seed {seed}: {flow:.2} people a second");
    }
}
