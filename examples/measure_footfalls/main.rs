//! Measures the footfalls that recorded people leave: how long steps are at a speed, beside what was measured on people,
//! at the recording's own rate and at others.
//!
//! ```sh
//! cargo run --release --example measure_footfalls -- RECORDING...
//! ```
//!
//! Prints a table for each recording: a row for each speed, a column for each rate with the mean step and how much longer
//! it is than on the line `L = 0.247 + 0.344 v`, which holds from 0.4 m/s on. `cargo test --test marks gait` holds footfalls to
//! the same.

use std::collections::BTreeMap;

use trodden::Error;
use trodden::motion::{Frame, Walker};
use trodden::recordings::{Recording, RecordingOptions};

#[path = "../../tests/marks/gait/measure.rs"]
#[allow(dead_code, clippy::unwrap_used, reason = "shared with the tests of gait")]
mod measure;
#[path = "../../tests/marks/gait/strides.rs"]
#[allow(dead_code, clippy::unwrap_used, reason = "shared with the tests of gait")]
mod strides;

use measure::{Floor, Path};
use strides::{by_speed, strides};

/// Frames per second that recordings are thinned or filled to.
const RATES: [f64; 4] = [2.5, 5.0, 10.0, 60.0];
/// Fewer steps say little.
const LEAST_STEPS: usize = 20;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for file in std::env::args_os().skip(1) {
        let recording = Recording::open(file.as_ref(), &RecordingOptions::default())?;
        let paths = paths(&recording)?;
        let fps = recording.survey().fps;
        println!(
            "{}: {} people at {fps} Hz; {} Hz",
            recording.path().display(),
            paths.len(),
            RATES.map(|r| r.to_string()).join(", ")
        );
        measure(&paths);
    }
    Ok(())
}

/// Everybody's path, numbered from 0 on.
fn paths(recording: &Recording) -> Result<Vec<Path>, Error> {
    let mut paths: BTreeMap<u32, Path> = BTreeMap::new();
    let (mut motion, mut frame) = (recording.motion()?, Frame::default());
    while motion.next_frame(&mut frame)? {
        for &walker in &frame.walkers {
            let number = paths.len() as u32;
            let path = paths.entry(walker.id).or_insert_with(|| Path { id: number, at: Vec::new() });
            path.at.push((frame.time_s, walker));
        }
    }
    Ok(paths.into_values().collect())
}

fn measure(paths: &[Path]) {
    let floor = Floor::hall();
    let of_rate = |rate: Option<f64>| {
        let of_person = |path: &Path| match rate {
            Some(rate) => strides(&floor, &at_rate(path, rate), path),
            None => strides(&floor, path, path),
        };
        by_speed(&paths.iter().flat_map(of_person).collect::<Vec<_>>())
    };
    let columns: Vec<_> = std::iter::once(None).chain(RATES.map(Some)).map(of_rate).collect();
    for (row, own) in columns[0].iter().enumerate().filter(|(_, bin)| bin.count >= LEAST_STEPS) {
        print!("  {:.2} m/s {:>5} steps", own.speed_m_s, own.count);
        for bin in columns.iter().map(|column| column[row]) {
            print!("  {:.3} m {:+5.1} %", bin.step_m, 100.0 * bin.off());
        }
        println!();
    }
}

/// The same path at a rate.
fn at_rate(path: &Path, rate: f64) -> Path {
    let Some((&(first_s, first), &(last_s, _))) = path.at.first().zip(path.at.last()) else { return path.clone() };
    if path.at.len() < 2 {
        return path.clone();
    }
    let times = ((first_s * rate).ceil() as u64..=(last_s * rate).floor() as u64).map(|k| k as f64 / rate);
    let walker = |time_s: f64| Walker { position_m: path.place(time_s), ..first };
    Path { id: path.id, at: times.map(|time_s| (time_s, walker(time_s))).collect() }
}
