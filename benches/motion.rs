//! How fast recordings are read: bytes per second of Juelich text, on one thread. Once in the order of frames, which
//! streams; once by person, which is sorted in memory; and the look through a file that comes before either. And how fast
//! formations are interpolated, by how often the example is decomposed: 120 people in 60 moments, a size that a bench can
//! repeat; `cargo run --release --example measure_formation -- 500 1000` has the full one.

use std::fmt::Write;
use std::hint::black_box;
use std::path::PathBuf;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use trodden::Silent;
use trodden::features::{Features, FeaturesOptions, Method};
use trodden::formation::{FormationOptions, KeyFormation, interpolate};
use trodden::math::{Vec2, sin_cos, vec2};
use trodden::motion::{Ensemble, Frame};
use trodden::recordings::{Recording, RecordingOptions};

const PEOPLE: u32 = 500;
const FRAMES: u32 = 1500;

/// Five hundred people present, of whom one leaves and one comes every ten frames.
fn text(by_person: bool) -> String {
    let present = |frame: u32| frame / 10..frame / 10 + PEOPLE;
    let mut rows: Vec<(u32, u32)> = (0..FRAMES).flat_map(|frame| present(frame).map(move |id| (frame, id))).collect();
    if by_person {
        rows.sort_by_key(|&(frame, id)| (id, frame));
    }
    let mut text = "# framerate: 25.00\n# id frame x/m y/m z/m\n".to_owned();
    for (frame, id) in rows {
        let (x, y) = (0.05 * f64::from(frame) + 0.01 * f64::from(id), 0.05 * f64::from(id * 7919 % 1000));
        let z = 1.6 + 0.01 * f64::from(id % 30);
        writeln!(text, "{id} {frame} {x:.4} {y:.4} {z:.4}").expect("a string takes all");
    }
    text
}

fn places(recording: &Recording) -> usize {
    let mut motion = recording.motion().expect("the file is still there");
    let (mut frame, mut places) = (Frame::default(), 0);
    while motion.next_frame(&mut frame).expect("the file is as it was") {
        places += frame.walkers.len();
    }
    places
}

fn motion(c: &mut Criterion) {
    let folder = tempfile::tempdir().expect("there is room for a folder");
    let written = |name: &str, text: &str| -> PathBuf {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("there is room for a file");
        path
    };
    let (by_frame, by_person) = (text(false), text(true));
    let mut group = c.benchmark_group("motion");
    group.throughput(Throughput::Bytes(by_frame.len() as u64));
    group.sample_size(10);
    for (name, text) in [("by frame", by_frame), ("by person", by_person)] {
        let path = written(name, &text);
        let open = || Recording::open(&path, &RecordingOptions::default()).expect("the file is sound");
        group.bench_function(format!("survey {name}"), |b| b.iter(|| black_box(open().survey().places)));
        let recording = open();
        assert_eq!(recording.survey().in_order, name == "by frame");
        group.bench_function(format!("frames {name}"), |b| b.iter(|| black_box(places(&recording))));
    }
    group.finish();
}

/// People who drift about a grid, each on a way of their own, and two formations: a grid, and a row.
fn crowd(people: usize, moments: usize) -> (Ensemble, [KeyFormation; 2]) {
    let grid: Vec<Vec2> = (0..people).map(|k| vec2((k % 10) as f64, (k / 10) as f64)).collect();
    let place = |moment: usize, k: usize| {
        let wave = |per_s: f64, phase: usize| sin_cos(per_s * moment as f64 / 10.0 + phase as f64).0;
        grid[k] + vec2(0.4 * wave(1.1, 7 * k), 0.4 * wave(1.3, 5 * k))
    };
    let places_m = (0..moments).flat_map(|moment| (0..people).map(move |k| (moment, k))).map(|(m, k)| place(m, k));
    let example = Ensemble::new(10.0, 0.0, (0..people as u32).collect(), places_m.collect());
    let row = (0..people).map(|k| vec2(k as f64, 0.0)).collect();
    let end_s = (moments - 1) as f64 / 10.0;
    (example, [(0.0, grid.clone()), (end_s, row)].map(|(time_s, places_m)| KeyFormation { time_s, places_m }))
}

fn formation(c: &mut Criterion) {
    let (example, keys) = crowd(120, 60);
    let mut group = c.benchmark_group("formation");
    group.throughput(Throughput::Elements(example.moments() as u64));
    group.sample_size(10);
    for (name, decompositions) in [("at the keys", None), ("at ten moments", Some(10)), ("at all moments", Some(60))] {
        let options = FormationOptions { decompositions, ..FormationOptions::default() };
        let led = || interpolate(&example, &keys, &options, &Silent).expect("the keys fit the example");
        group.bench_function(format!("decomposed {name}"), |b| b.iter(|| black_box(led())));
    }
    group.finish();
}

fn features(c: &mut Criterion) {
    let (example, _) = crowd(200, 800);
    let mut group = c.benchmark_group("features");
    group.throughput(Throughput::Elements(example.moments() as u64));
    group.sample_size(10);
    for method in Method::ALL {
        let options = FeaturesOptions { method, ..FeaturesOptions::default() };
        let found = || Features::find(&example, &options, &Silent).expect("people move");
        group.bench_function(format!("{method:?} of 200 people"), |b| b.iter(|| black_box(found())));
    }
    group.finish();
}

criterion_group!(benches, motion, formation, features);
criterion_main!(benches);
