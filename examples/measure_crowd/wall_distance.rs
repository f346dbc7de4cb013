//! How near the middles of bodies come to walls, beside recordings.

use super::Measured;
use super::measures::percentile;
use super::scene::{Scene, area, endless, opening, route};
use super::svg::{Axis, BLUE, Corner, GREEN, Mark, Plot, Series, VERMILION};

const LENGTH_M: f64 = 26.0;
/// Seconds until the crowd has settled, and until the end.
const SETTLED_S: f64 = 10.0;
const END_S: f64 = 60.0;

/// A corridor of the Juelich archive (doi 10.34735/ped.2018.1).
struct Recording {
    name: &'static str,
    colour: &'static str,
    width_m: f64,
    /// Persons per square metre.
    density: f64,
    /// The distance that 5 % of positions fall below, in the stretch of the corridor where it is least and in the one
    /// where it is most, and the least of all, metres.
    nearest_m: [f64; 2],
    least_m: f64,
}

const RECORDINGS: [Recording; 3] = [
    Recording { name: "1.8 m, free", colour: BLUE, width_m: 1.8, density: 0.5, nearest_m: [0.33, 0.38], least_m: 0.25 },
    Recording {
        name: "1.8 m, congested",
        colour: VERMILION,
        width_m: 1.8,
        density: 2.1,
        nearest_m: [0.23, 0.27],
        least_m: 0.10,
    },
    Recording { name: "5 m, free", colour: GREEN, width_m: 5.0, density: 0.37, nearest_m: [0.47, 0.87], least_m: 0.29 },
];

pub fn measure() -> Measured {
    let mut table = "| corridor | persons/m² | 5 % within, measured | recorded | minimum, measured | recorded |\n\
                     |---|---|---|---|---|---|\n"
        .to_string();
    let mut series = Vec::new();
    for recording in &RECORDINGS {
        let Recording { name, colour, width_m, density, nearest_m, least_m } = *recording;
        let mut distances = distances(width_m, density);
        let (nearest, least) = (percentile(&mut distances, 0.05), percentile(&mut distances, 0.0));
        let [low, high] = nearest_m;
        table += &format!(
            "| {name} | {density} | {nearest:.2} m | {low:.2} to {high:.2} m | {least:.2} m | {least_m:.2} m |\n"
        );
        let curve = (0..=200).map(|k| f64::from(k) / 200.0);
        let curve = curve.map(|share| [percentile(&mut distances, share), 100.0 * share]).collect();
        series.push(Series::new(format!("{name}: trodden"), Mark::Line, colour, curve));
        series.push(Series::new(
            format!("{name}: recorded, 5 %"),
            Mark::Drops,
            colour,
            nearest_m.map(|m| [m, 5.0]).to_vec(),
        ));
    }
    let plot = Plot {
        x: Axis { name: "distance of a body's middle from the nearer wall, m", from: 0.0, to: 1.2, every: 0.2 },
        y: Axis { name: "share of positions that are nearer, %", from: 0.0, to: 50.0, every: 10.0 },
        series,
        legend: Corner::UpperRight,
    };
    Measured { name: "wall_distance", table, plot }
}

/// Distances of everybody from the nearer wall over time, metres, in a corridor without ends.
fn distances(width_m: f64, density: f64) -> Vec<f64> {
    let all = area([0.0, LENGTH_M], [0.0, width_m + 0.4]);
    let scene = Scene::corridor(LENGTH_M, width_m, vec![route(all, opening("east"))]);
    let people = (density * LENGTH_M * width_m).round() as u32;
    let mut distances = Vec::new();
    scene.walk(&endless(people, LENGTH_M, END_S), 1, |frame| {
        if frame.time_s > SETTLED_S {
            let from_wall = |y: f64| (y - 0.2).min(width_m + 0.2 - y);
            distances.extend(frame.walkers.iter().map(|walker| from_wall(walker.position_m.y)));
        }
    });
    distances
}
