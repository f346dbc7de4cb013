//! What is written comes back.

use std::path::Path;

use trodden::math::{sin_cos, vec2};
use trodden::motion::{BodyOptions, Frame, People, Walker};
use trodden::plan::FloorPlan;
use trodden::recordings::{RecordForm, RecordedWorld, Recorder, Recording, RecordingFormat, RecordingOptions};
use trodden::walls::{Walls, WallsOptions};

use super::frames_of;

/// Somebody who is there for one frame only.
const BLINK: u32 = 50;

/// Forty people on circles, who come and go; two of them are there all the time, one once.
fn motion(fps: f64) -> Vec<Frame> {
    let frame = |k: u32| {
        let time_s = f64::from(k) / fps;
        let present = |id: &u32| id % 20 == 3 || (2 * id..2 * id + 60).contains(&k) || (*id == BLINK && k == 30);
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
        let ids = (0..40).chain([BLINK]).filter(|id| *id != BLINK || k == 30).filter(present);
        Frame { time_s, walkers: ids.map(walker).collect() }
    };
    (0..150).map(frame).collect()
}

fn written(path: &Path, format: Option<RecordingFormat>, fps: f64) -> Vec<Frame> {
    let plan = FloorPlan::from_mask(20, 20, 1.0, vec![1; 400]);
    let walls = Walls::trace(&plan, &WallsOptions::default());
    let people = People::new(1, BodyOptions::default());
    let world = RecordedWorld { plan: &plan, walls: &walls, people: &people };
    let form = RecordForm::of(path, format).unwrap();
    let mut recorder = Recorder::create_as(form, path, true, fps, world).unwrap();
    let motion = motion(fps);
    motion.iter().for_each(|frame| recorder.push(frame).unwrap());
    recorder.finish().unwrap();
    motion
}

/// Every way in which a motion is written, by name or by format.
const WAYS: [(&str, Option<RecordingFormat>, RecordingFormat); 11] = [
    ("a.txt", None, RecordingFormat::Juelich),
    ("a.txt.gz", None, RecordingFormat::Juelich),
    ("a.sqlite", None, RecordingFormat::Jupedsim),
    ("a.traj", None, RecordingFormat::Vadere),
    ("a.traj.gz", None, RecordingFormat::Vadere),
    ("a.csv", None, RecordingFormat::Csv),
    ("a.csv.gz", None, RecordingFormat::Csv),
    ("crowdit.csv.gz", Some(RecordingFormat::Crowdit), RecordingFormat::Crowdit),
    ("viswalk", Some(RecordingFormat::Viswalk), RecordingFormat::Viswalk),
    ("a.txt", Some(RecordingFormat::Pathfinder), RecordingFormat::Pathfinder),
    ("obsmat.txt", Some(RecordingFormat::Obsmat), RecordingFormat::Obsmat),
];

#[test]
fn what_the_recorder_writes_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    for (name, asked, format) in WAYS {
        assert!(RecordingFormat::ALL.iter().all(|format| WAYS.iter().any(|way| way.2 == *format)));
        for fps in [10.0, 2.5, 30.0, 16.0, 29.97] {
            let path = folder.path().join(name);
            let motion = written(&path, asked, fps);
            let recording = Recording::open(&path, &RecordingOptions::default()).unwrap();
            let survey = recording.survey();
            let place = format!("{name} {format:?} at {fps}: {survey:?}");
            assert_eq!((survey.format, survey.people, survey.largest_id), (format, 41, BLINK), "{place}");
            assert!((survey.fps / fps - 1.0).abs() < 0.002, "{place}");
            assert!(survey.in_order && survey.warnings.is_empty(), "{place}");
            // Steps are shown at whole rates.
            if format == RecordingFormat::Vadere && fps == 29.97 {
                continue;
            }
            assert_same(&motion, &frames_of(&recording), format, &place);
        }
    }
}

fn assert_same(motion: &[Frame], again: &[Frame], format: RecordingFormat, place: &str) {
    let turns = [RecordingFormat::Jupedsim, RecordingFormat::Csv].contains(&format);
    assert_eq!(again.len(), motion.len(), "{place}");
    for (a, b) in motion.iter().zip(again) {
        assert!((a.time_s - b.time_s).abs() < 2e-6, "{} {} {place}", a.time_s, b.time_s);
        assert_eq!(a.walkers.len(), b.walkers.len(), "{} {place}", a.time_s);
        for (a, b) in a.walkers.iter().zip(&b.walkers) {
            assert_eq!(a.id, b.id, "{place}");
            assert!((a.position_m - b.position_m).length() < 0.8e-4, "{a:?} {b:?} {place}");
            let moves = a.id != BLINK;
            assert!(!moves || (a.velocity_m_s - b.velocity_m_s).length() < 0.06, "{a:?} {b:?} {place}");
            let turned = b.heading.map(|heading| heading.dot(a.heading.unwrap()));
            assert!(turned.map_or(!turns, |cos| cos > 1.0 - 1e-6), "{a:?} {b:?} {place}");
        }
    }
}

#[test]
fn the_same_motion_gives_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    for (name, asked, _) in WAYS {
        let path = folder.path().join(name);
        let [first, second] = [0, 1].map(|_| {
            written(&path, asked, 10.0);
            std::fs::read(&path).unwrap()
        });
        assert!(first == second, "{name}");
        // gzip's head: neither a time nor a name.
        let head: &[u8] = if name.ends_with(".gz") { &[0x1f, 0x8b, 8, 0, 0, 0, 0, 0] } else { &[] };
        assert!(first.starts_with(head), "{name}: {:?}", &first[..10]);
    }
}

#[test]
fn files_look_as_other_programs_expect_them() {
    let folder = tempfile::tempdir().unwrap();
    let lines = |name: &str, format: RecordingFormat| {
        let path = folder.path().join(name);
        written(&path, Some(format), 10.0);
        std::fs::read_to_string(path).unwrap().lines().map(str::to_owned).collect::<Vec<_>>()
    };
    let csv = lines("a", RecordingFormat::Csv);
    assert_eq!(csv[0], "id,time_s,x_m,y_m,heading_deg,speed_m_s,height_m");
    // At 3 rad on a circle of 3.3 m radius, counter-clockwise.
    let fields: Vec<&str> = csv[2].split(',').collect();
    assert_eq!(fields[..6], ["3", "0.00", "6.7330", "10.4657", "-98.11", "0.6600"]);
    assert!((1.4..2.1).contains(&fields[6].parse::<f64>().unwrap()), "{fields:?}");
    let vadere = lines("b", RecordingFormat::Vadere);
    assert_eq!(vadere[0], "pedestrianId simTime endTime-PID1 startX-PID1 startY-PID1 endX-PID1 endY-PID1");
    assert_eq!(vadere[2], "3 0.00 0.10 6.7330 10.4657 6.7244 10.4003");
    let blinks: Vec<&String> = vadere.iter().filter(|line| line.starts_with("50 ")).collect();
    assert_eq!(blinks.len(), 1);
    assert!(blinks[0].starts_with("50 3.00 3.05 "), "{blinks:?}");
    assert_eq!(
        lines("c", RecordingFormat::Crowdit)[..3],
        ["time,pedID,posX,posY", "0.00,0,13.0000,10.0000", "0.00,3,6.7330,10.4657"]
    );
    assert_eq!(lines("d", RecordingFormat::Pathfinder)[..3], ["id,t,x,y", ",s,m,m", "0,0.00,13.0000,10.0000"]);
    assert_eq!(
        lines("e", RecordingFormat::Viswalk)[2..4],
        ["$PEDESTRIAN:NO;SIMSEC;COORDCENTX;COORDCENTY", "0;0.00;13.0000;10.0000"]
    );
    let obsmat = lines("f", RecordingFormat::Obsmat);
    assert_eq!(obsmat[1..3], ["# frame id x z y vx vz vy", "0 0 13.0000 0.0000 10.0000 0.0000 0.0000 0.6000"]);
}

#[test]
fn headings_that_are_counted_otherwise_are_not_used() {
    // Clockwise from north, as a compass.
    let row = |k: u32| format!("1,{k},{},0,90\n", 1.3 * f64::from(k));
    let text: String = std::iter::once("id,time_s,x_m,y_m,yaw_deg\n".to_owned()).chain((0..20).map(row)).collect();
    let (recording, frames) = super::frames(&text, &RecordingOptions::default());
    assert!(recording.survey().warnings[0].contains("headings are not used"), "{:?}", recording.survey().warnings);
    assert!(frames.iter().all(|frame| frame.walkers[0].heading.is_none()));
    let (recording, frames) = super::frames(text.replace(",90", ",-360"), &RecordingOptions::default());
    assert!(recording.survey().warnings.is_empty());
    assert!(frames[3].walkers[0].heading.unwrap().distance(vec2(1.0, 0.0)) < 1e-12);
}

#[test]
fn a_recording_can_be_read_again_and_gives_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    written(&path, None, 10.0);
    let recording = Recording::open(&path, &RecordingOptions::default()).unwrap();
    assert_eq!(frames_of(&recording), frames_of(&recording.clone()));
    let ensemble = recording.ensemble(None, [0.0, 14.0]).unwrap();
    assert_eq!((ensemble.ids.as_slice(), ensemble.moments(), ensemble.fps), ([3, 23].as_slice(), 141, 10.0));
}
