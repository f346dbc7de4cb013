//! Speed against density, one way round a corridor without ends.

use super::Measured;
use super::measures::{mean_speed_m_s, weidmann_m_s};
use super::scene::{Scene, area, endless, opening, route};
use super::svg::{Axis, BLACK, BLUE, Corner, Mark, Plot, Series};

const LENGTH_M: f64 = 26.0;
const WIDTH_M: f64 = 2.0;
/// One crowd each: where it is nearly empty, chance alone makes one faster than another.
const SEEDS: [u64; 4] = [1, 2, 3, 4];
/// Densities, persons per square metre, at which the crowd is held to Weidmann's curve.
const HELD: [f64; 6] = [0.5, 1.0, 1.5, 2.0, 3.0, 4.0];
/// More of them, for the plot.
const BETWEEN: [f64; 4] = [0.25, 1.25, 2.5, 5.0];

pub fn measure() -> Measured {
    let all = area([0.0, LENGTH_M], [0.0, WIDTH_M + 0.4]);
    let scene = Scene::corridor(LENGTH_M, WIDTH_M, vec![route(all, opening("east"))]);
    let speed = |density: f64| {
        let people = (density * LENGTH_M * WIDTH_M).round() as u32;
        let speeds = SEEDS.map(|seed| mean_speed_m_s(&scene, &endless(people, LENGTH_M, 70.0), seed));
        speeds.iter().sum::<f64>() / SEEDS.len() as f64
    };
    let measured: Vec<[f64; 2]> = HELD.map(|density| [density, speed(density)]).to_vec();
    let mut table = "| persons/m² | measured m/s | Weidmann m/s | difference |\n|---|---|---|---|\n".to_string();
    for &[density, speed] in &measured {
        let published = weidmann_m_s(density);
        table += &format!("| {density} | {speed:.2} | {published:.2} | {:+.2} |\n", speed - published);
    }
    let squares: f64 = measured.iter().map(|[density, speed]| (speed - weidmann_m_s(*density)).powi(2)).sum();
    let error = (squares / HELD.len() as f64).sqrt();
    table += &format!("\nRoot mean square error {error:.3} m/s.\n");

    let mut points = measured;
    points.extend(BETWEEN.map(|density| [density, speed(density)]));
    let curve = (2..=54).map(|k| 0.1 * f64::from(k)).map(|density| [density, weidmann_m_s(density)]).collect();
    let plot = Plot {
        x: Axis { name: "density, persons/m²", from: 0.0, to: 5.5, every: 1.0 },
        y: Axis { name: "mean speed, m/s", from: 0.0, to: 1.6, every: 0.2 },
        series: vec![
            Series::new("Weidmann 1993", Mark::Line, BLACK, curve),
            Series::new("trodden, commuters", Mark::Discs, BLUE, points),
        ],
        legend: Corner::UpperRight,
    };
    Measured { name: "speed_density", table, plot }
}
