//! What is written comes back.

use std::path::Path;

use trodden::math::{sin_cos, vec2};
use trodden::motion::{
    BodyOptions, Frame, People, RecordedWorld, Recorder, Recording, RecordingFormat, RecordingOptions, Walker,
};
use trodden::plan::FloorPlan;
use trodden::walls::{Walls, WallsOptions};

use super::frames_of;

/// Forty people on circles, who come and go; two of them are there all the time.
fn motion() -> Vec<Frame> {
    let frame = |k: u32| {
        let time_s = f64::from(k) * 0.1;
        let present = |id: &u32| id % 20 == 3 || (2 * id..2 * id + 60).contains(&k);
        let walker = |id: u32| {
            let (sin, cos) = sin_cos(0.2 * time_s + f64::from(id));
            let radius = 3.0 + 0.1 * f64::from(id);
            Walker {
                id,
                position_m: vec2(10.0 + radius * cos, 10.0 + radius * sin),
                velocity_m_s: vec2(-sin, cos) * (0.2 * radius),
                heading: Some(vec2(-sin, cos)),
            }
        };
        Frame { time_s, walkers: (0..40).filter(present).map(walker).collect() }
    };
    (0..150).map(frame).collect()
}

fn written(path: &Path) -> Vec<Frame> {
    let plan = FloorPlan::from_mask(20, 20, 1.0, vec![1; 400]);
    let walls = Walls::trace(&plan, &WallsOptions::default()).unwrap();
    let people = People::new(1, BodyOptions::default());
    let world = RecordedWorld { plan: &plan, walls: &walls, people: &people };
    let mut recorder = Recorder::create(path, false, 10.0, world).unwrap();
    let motion = motion();
    motion.iter().for_each(|frame| recorder.push(frame).unwrap());
    recorder.finish().unwrap();
    motion
}

#[test]
fn what_the_recorder_writes_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    for (name, format) in [("a.txt", RecordingFormat::Juelich), ("a.sqlite", RecordingFormat::Jupedsim)] {
        let path = folder.path().join(name);
        let motion = written(&path);
        let recording = Recording::open(&path, &RecordingOptions::default()).unwrap();
        let survey = recording.survey();
        assert_eq!((survey.format, survey.fps, survey.people, survey.largest_id), (format, 10.0, 40, 39));
        assert!(survey.in_order && survey.warnings.is_empty(), "{survey:?}");
        let again = frames_of(&recording);
        assert_eq!(again.len(), motion.len());
        for (a, b) in motion.iter().zip(&again) {
            assert!((a.time_s - b.time_s).abs() < 1e-9);
            assert_eq!(a.walkers.len(), b.walkers.len(), "{}", a.time_s);
            for (a, b) in a.walkers.iter().zip(&b.walkers) {
                assert_eq!(a.id, b.id);
                assert!((a.position_m - b.position_m).length() < 0.8e-4, "{a:?} {b:?}");
                assert!((a.velocity_m_s - b.velocity_m_s).length() < 0.02, "{a:?} {b:?}");
                let turned = b.heading.map(|heading| heading.dot(a.heading.unwrap()));
                assert!(turned.map_or(format == RecordingFormat::Juelich, |cos| cos > 1.0 - 1e-6), "{a:?} {b:?}");
            }
        }
    }
}

#[test]
fn a_recording_can_be_read_again_and_gives_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    written(&path);
    let recording = Recording::open(&path, &RecordingOptions::default()).unwrap();
    assert_eq!(frames_of(&recording), frames_of(&recording.clone()));
    let ensemble = recording.ensemble(None, [0.0, 14.0]).unwrap();
    assert_eq!((ensemble.ids.as_slice(), ensemble.moments(), ensemble.fps), ([3, 23].as_slice(), 141, 10.0));
}
