//! How fast recordings are read: bytes per second of Juelich text, on one thread. Once in the order of frames, which
//! streams; once by person, which is sorted in memory; and the look through a file that comes before either.

use std::fmt::Write;
use std::hint::black_box;
use std::path::PathBuf;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use trodden::motion::{Frame, Recording, RecordingOptions};

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

criterion_group!(benches, motion);
criterion_main!(benches);
