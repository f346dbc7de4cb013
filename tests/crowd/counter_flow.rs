//! People who come from two sides.

use trodden::crowd::CrowdOptions;

use super::measures::mean_speed_m_s;
use super::scene::{Scene, across, area, commuters, endless, opening, route};

const LENGTH_M: f64 = 26.0;
const WIDTH_M: f64 = 4.0;
/// Whoever's line lies within this of the own one is in the same lane, metres.
const LANE_M: f64 = 0.3;

/// Both ways through an endless corridor.
fn both_ways() -> Scene {
    let everywhere = area([0.0, LENGTH_M], [0.0, WIDTH_M + 0.4]);
    Scene::corridor(
        LENGTH_M,
        WIDTH_M,
        vec![route(everywhere.clone(), opening("east")), route(everywhere, opening("west"))],
    )
}

fn people(density: f64) -> u32 {
    (density * LENGTH_M * WIDTH_M).round() as u32
}

/// Order of lanes between 20 and 60 s: the mean over people of `((same - against) / (same + against))^2`, counted over
/// everybody else whose line lies within [`LANE_M`] (Rex and Loewen 2007, doi 10.1103/PhysRevE.75.051402): 1 with perfect
/// lanes, about 1 / (people in a lane) for people at random.
fn lane_order(scene: &Scene, options: &CrowdOptions, seed: u64) -> f64 {
    let (mut order, mut count) = (0.0, 0.0);
    scene.walk(options, seed, |frame| {
        if frame.time_s < 20.0 || !((frame.time_s * 10.0).round() as u64).is_multiple_of(10) {
            return;
        }
        for a in &frame.walkers {
            let (mut same, mut against) = (0.0, 0.0);
            for b in frame.walkers.iter().filter(|b| b.id != a.id) {
                if (a.position_m.y - b.position_m.y).abs() < LANE_M {
                    let facing = |w: &trodden::motion::Walker| w.heading.unwrap().x;
                    *if facing(a) * facing(b) > 0.0 { &mut same } else { &mut against } += 1.0;
                }
            }
            if same + against > 0.0 {
                let share = (same - against) / (same + against);
                order += share * share;
                count += 1.0;
            }
        }
    });
    order / count
}

#[test]
fn counter_flow_forms_lanes_and_alignment_helps() {
    let scene = both_ways();
    let options = endless(people(0.5), LENGTH_M, 60.0);
    let without = CrowdOptions { alignment: 0.0, ..options.clone() };
    let mean = |options: &CrowdOptions| (1..=6).map(|seed| lane_order(&scene, options, seed)).sum::<f64>() / 6.0;
    let (with, without) = (mean(&options), mean(&without));
    println!("order of lanes at 0.5 persons/m2: {with:.3}, without alignment {without:.3}");
    assert!(with > 0.6 && with > without, "{with} {without}");
}

#[test]
fn counter_flow_does_not_lock_up() {
    let scene = both_ways();
    for (density, least_m_s) in [(0.5, 1.0), (1.0, 0.8), (1.5, 0.4)] {
        let options = endless(people(density), LENGTH_M, 90.0);
        for seed in 1..=3 {
            let speed = mean_speed_m_s(&scene, &options, seed);
            println!("counter flow at {density} persons/m2, seed {seed}: {speed:.2} m/s");
            assert!(speed > least_m_s, "{density} persons/m2, seed {seed}: {speed} m/s");
        }
    }
}

#[test]
fn crossing_flows_do_not_lock_up() {
    // Two corridors of 4 m that cross; all four ways.
    let scene = Scene::new(
        [24.0, 24.0],
        |p| (p.y - 12.0).abs() < 2.0 || (p.x - 12.0).abs() < 2.0,
        ["west", "east", "south", "north"].map(across).into(),
    );
    for seed in 1..=3 {
        let options = CrowdOptions { entry_seconds: Some(150.0), ..commuters(400) };
        let mut last_s = 0.0;
        let tally = scene.walk(&options, seed, |frame| last_s = frame.time_s);
        println!("crossing flows, seed {seed}: {} of 400 arrived after {last_s:.0} s", tally.arrived);
        assert_eq!(tally.arrived, 400, "seed {seed}: {:?}", tally.stuck);
        // A free way takes 20 s.
        assert!(last_s < 230.0, "seed {seed}: {last_s} s");
    }
}
