//! Step length against speed: the footfalls of people in corridors of several densities.

use trodden::crowd::CrowdOptions;
use trodden::marks::{Footfalls, MarksOptions};
use trodden::math::{Distribution, vec2};
use trodden::motion::{BodyOptions, Frame, People, Walker};
use trodden::patterns::{Cause, PatternLibrary};
use trodden::walls::Walls;

use super::Measured;
use super::measures::percentile;
use super::scene::{Scene, across, area, endless, opening, route};
use super::svg::{Axis, BLACK, BLUE, Corner, GREY, Mark, Plot, Series};

const LENGTH_M: f64 = 26.0;
const WIDTH_M: f64 = 2.0;
const SEED: u64 = 1;
/// Seconds until the crowd has settled, and until the end.
const SETTLED_S: f64 = 10.0;
const END_S: f64 = 60.0;
/// Persons per square metre: together they give all speeds.
const DENSITIES: [f64; 6] = [0.2, 0.6, 1.0, 1.5, 2.0, 2.8];
/// And people in a hurry, for the highest speeds: density, and speed with nobody around, m/s.
const HURRIED: (f64, Distribution) = (0.3, Distribution::Uniform([1.5, 2.1]));
/// Speed in m/s and step length in m, from the sway of heads in recordings of the Juelich archive (corridor of 1.8 m).
const RECORDED: [[f64; 2]; 5] = [[0.45, 0.39], [0.75, 0.51], [1.05, 0.62], [1.35, 0.72], [1.70, 0.82]];
/// People whose mean speed is within this of a recorded one are held against it, m/s.
const BESIDE_M_S: f64 = 0.15;

fn line_m(speed_m_s: f64) -> f64 {
    0.247 + 0.344 * speed_m_s
}

pub fn measure() -> Measured {
    let commuters = CrowdOptions::default().speed;
    let mut points: Vec<[f64; 2]> = DENSITIES.iter().flat_map(|&density| steps(density, commuters)).collect();
    points.extend(steps(HURRIED.0, HURRIED.1));
    let mut table =
        "| speed m/s | people | mean step m | recorded m | 5 % to 95 % of people m |\n|---|---|---|---|---|\n"
            .to_string();
    let mut means = Vec::new();
    for [speed, recorded] in RECORDED {
        let beside = points.iter().filter(|point| (point[0] - speed).abs() < BESIDE_M_S);
        // Moved along the line to the very speed, so that uneven numbers of slower and faster people do not matter.
        let mut lengths: Vec<f64> = beside.map(|point| point[1] * line_m(speed) / line_m(point[0])).collect();
        if lengths.is_empty() {
            table += &format!("| {speed:.2} | 0 | | {recorded:.2} | |\n");
            continue;
        }
        let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
        let (low, high) = (percentile(&mut lengths, 0.05), percentile(&mut lengths, 0.95));
        let people = lengths.len();
        table += &format!("| {speed:.2} | {people} | {mean:.2} | {recorded:.2} | {low:.2} to {high:.2} |\n");
        means.push([speed, mean]);
    }
    let plot = Plot {
        x: Axis { name: "mean speed, m/s", from: 0.0, to: 2.0, every: 0.2 },
        y: Axis { name: "mean step length, m", from: 0.0, to: 1.0, every: 0.2 },
        series: vec![
            Series::new("a person, trodden", Mark::Specks, BLUE, points),
            Series::new("mean of people, trodden", Mark::Discs, BLUE, means),
            Series::new("L = 0.247 m + 0.344 s · v", Mark::Line, BLACK, vec![[0.2, line_m(0.2)], [1.9, line_m(1.9)]]),
            Series::new("recorded", Mark::Drops, GREY, RECORDED.to_vec()),
        ],
        legend: Corner::LowerRight,
    };
    Measured { name: "step_length", table, plot }
}

/// Mean speed and mean step length of everybody in a corridor without ends.
fn steps(density: f64, speed: Distribution) -> Vec<[f64; 2]> {
    let all = area([0.0, LENGTH_M], [0.0, WIDTH_M + 0.4]);
    let round = Scene::corridor(LENGTH_M, WIDTH_M, vec![route(all, opening("east"))]);
    // The same corridor rolled out, for feet that never jump back.
    let rolled_out = Scene::corridor(8.0 * LENGTH_M, WIDTH_M, vec![across("west")]);
    let count = (density * LENGTH_M * WIDTH_M).round() as u32;
    let mut ways: Vec<Vec<(f64, Walker)>> = vec![Vec::new(); count as usize];
    let options = CrowdOptions { speed, ..endless(count, LENGTH_M, END_S) };
    round.walk(&options, SEED, |frame| {
        for walker in &frame.walkers {
            let way = &mut ways[walker.id as usize];
            let mut walker = *walker;
            if let Some((_, last)) = way.last() {
                let laps = ((last.position_m.x - walker.position_m.x) / LENGTH_M).round();
                walker.position_m += vec2(laps * LENGTH_M, 0.0);
            }
            way.push((frame.time_s, walker));
        }
    });
    let (people, library) = (People::new(SEED, BodyOptions::default()), PatternLibrary::open(None).unwrap());
    ways.iter().filter_map(|way| mean_step(way, &people, &rolled_out.walls, &library)).collect()
}

/// Mean speed and step length of one person, once the crowd has settled.
fn mean_step(way: &[(f64, Walker)], people: &People, walls: &Walls, library: &PatternLibrary) -> Option<[f64; 2]> {
    let mut footfalls = Footfalls::new(people, walls, library, &MarksOptions::default(), Vec::new()).unwrap();
    let mut marks = Vec::new();
    for &(time_s, walker) in way {
        footfalls.push(&Frame { time_s, walkers: vec![walker] }, &mut marks);
    }
    footfalls.finish(&mut marks);
    let settled = way.iter().find(|(time_s, _)| *time_s >= SETTLED_S)?;
    let last = way.last()?;
    let (from_m, to_m) = (settled.1.position_m.x, last.1.position_m.x);
    let feet: Vec<f64> = (marks.iter().filter(|mark| mark.cause == Cause::Sole))
        .map(|mark| mark.place_m.x)
        .filter(|x| (from_m..to_m).contains(x))
        .collect();
    let [first, .., end] = feet[..] else { return None };
    let speed = (to_m - from_m) / (last.0 - settled.0);
    Some([speed, (end - first) / (feet.len() - 1) as f64])
}
