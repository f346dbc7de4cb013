//! Speed against density in an endless corridor.

use trodden::crowd::{CrowdOptions, SpeedLaw};

use super::measures::{mean_speed_m_s, weidmann_m_s};
use super::scene::{Scene, area, endless, opening, route};

/// Persons per square metre at which speed is compared.
const DENSITIES: [f64; 6] = [0.5, 1.0, 1.5, 2.0, 3.0, 4.0];
const LENGTH_M: f64 = 26.0;
const WIDTH_M: f64 = 2.0;

fn one_way() -> Scene {
    Scene::corridor(LENGTH_M, WIDTH_M, vec![route(area([0.0, LENGTH_M], [0.0, WIDTH_M + 0.4]), opening("east"))])
}

fn people(density: f64) -> u32 {
    (density * LENGTH_M * WIDTH_M).round() as u32
}

#[test]
fn speed_falls_with_density_as_weidmann_measured() {
    let scene = one_way();
    let (mut squares, mut worst) = (0.0, 0.0f64);
    println!("persons/m2  measured  Weidmann  [m/s]");
    for density in DENSITIES {
        let measured = mean_speed_m_s(&scene, &endless(people(density), LENGTH_M, 70.0), 1);
        let published = weidmann_m_s(density);
        println!("{density:10.1} {measured:9.3} {published:9.3}");
        squares += (measured - published) * (measured - published);
        worst = worst.max((measured - published).abs());
    }
    let error = (squares / DENSITIES.len() as f64).sqrt();
    println!("root mean square error {error:.3} m/s, largest {worst:.3} m/s");
    assert!(error <= 0.10 && worst <= 0.2, "{error} {worst}");
}

#[test]
fn halving_the_time_step_moves_the_mean_speed_by_less_than_three_percent() {
    let scene = one_way();
    println!("persons/m2  dt 0.1  dt 0.05 s  [m/s]");
    for density in [0.5, 1.0, 2.0, 3.0] {
        let at = |time_step| {
            let options = CrowdOptions { time_step, ..endless(people(density), LENGTH_M, 60.0) };
            mean_speed_m_s(&scene, &options, 1)
        };
        let (whole, halved) = (at(CrowdOptions::default().time_step), at(0.5 * CrowdOptions::default().time_step));
        println!("{density:10.1} {whole:7.3} {halved:7.3}  {:+.1} %", 100.0 * (halved / whole - 1.0));
        assert!((halved / whole - 1.0).abs() < 0.03, "{density} persons/m2: {whole} and {halved} m/s");
    }
}

#[test]
fn the_linear_law_falls_in_a_straight_line() {
    let scene = one_way();
    let speeds = [0.5, 1.0, 1.5, 2.0].map(|density| {
        let options = CrowdOptions { speed_law: SpeedLaw::Linear, ..endless(people(density), LENGTH_M, 40.0) };
        mean_speed_m_s(&scene, &options, 1)
    });
    println!("linear law: {speeds:.3?} m/s at 0.5, 1, 1.5, 2 persons/m2");
    for (speed, density) in speeds.into_iter().zip([0.5, 1.0, 1.5, 2.0]) {
        let law = 1.34 * (1.0 - density / 4.0);
        assert!((speed - law).abs() < 0.12, "{density} persons/m2: {speed} m/s, the law has {law}");
    }
}
