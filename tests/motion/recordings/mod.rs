//! Recordings of every format come in, and what is wrong with a file is said.
use std::path::PathBuf;

use tempfile::TempDir;
use trodden::motion::Frame;
use trodden::recordings::{Recording, RecordingError, RecordingOptions};

mod bad;
mod footfalls;
mod formats;
mod gaps;
mod info;
mod properties;
mod round_trip;
mod units;

/// A file with a content.
struct Given {
    _folder: TempDir,
    path: PathBuf,
}

fn given(content: impl AsRef<[u8]>) -> Given {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("recording");
    std::fs::write(&path, content).unwrap();
    Given { _folder: folder, path }
}

fn open_with(content: impl AsRef<[u8]>, options: &RecordingOptions) -> Result<Recording, RecordingError> {
    Recording::open(&given(content).path, options)
}

/// Everything that a recording shows.
fn frames(content: impl AsRef<[u8]>, options: &RecordingOptions) -> (Recording, Vec<Frame>) {
    let file = given(content);
    let recording = Recording::open(&file.path, options).unwrap();
    let frames = frames_of(&recording);
    (recording, frames)
}

fn frames_of(recording: &Recording) -> Vec<Frame> {
    let mut motion = recording.motion().unwrap();
    let (mut frames, mut frame) = (Vec::new(), Frame::default());
    while motion.next_frame(&mut frame).unwrap() {
        frames.push(frame.clone());
    }
    assert!(frames.windows(2).all(|pair| pair[0].time_s < pair[1].time_s), "times ascend");
    for frame in &frames {
        assert!(frame.walkers.windows(2).all(|pair| pair[0].id < pair[1].id), "ids ascend");
        assert!(frame.walkers.iter().all(|walker| walker.position_m.is_finite() && walker.velocity_m_s.is_finite()));
    }
    frames
}

/// Time, id, x, y of everybody.
fn places(frames: &[Frame]) -> Vec<(f64, u32, f64, f64)> {
    let of = |frame: &Frame| {
        let time_s = frame.time_s;
        let place =
            move |walker: &trodden::motion::Walker| (time_s, walker.id, walker.position_m.x, walker.position_m.y);
        frame.walkers.iter().map(place).collect::<Vec<_>>()
    };
    frames.iter().flat_map(of).collect()
}

fn options() -> RecordingOptions {
    RecordingOptions::default()
}
