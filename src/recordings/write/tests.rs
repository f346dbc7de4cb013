use std::fs;

use rusqlite::Connection;

use super::*;
use crate::math::vec2;
use crate::motion::{BodyOptions, People};
use crate::plan::{FloorPlan, Pose};

use crate::walls::{Walls, WallsOptions};

/// A corridor of 6 x 2 m.
fn world() -> (FloorPlan, Walls, People) {
    let mask = (0..4 * 6).map(|k| u8::from((6..18).contains(&k))).collect();
    let plan = FloorPlan::from_mask(6, 4, 1.0, mask);
    let walls = Walls::trace(&plan, &WallsOptions::default());
    (plan, walls, People::new(7, BodyOptions::default()))
}

fn walker(id: u32, x: f64) -> Walker {
    Walker { id, position_m: vec2(x, 1.5), velocity_m_s: vec2(2.0, 0.0), heading: Some(vec2(0.0, 1.0)) }
}

/// Person 4 walks 2 m/s from 0.1 to 0.4 s, person 9 from 0.2 to 0.3 s.
fn motion() -> Vec<Frame> {
    let frame = |time_s: f64, ids: &[u32]| Frame {
        time_s,
        walkers: ids.iter().map(|&id| walker(id, f64::from(id) + 2.0 * time_s)).collect(),
    };
    vec![frame(0.1, &[4]), frame(0.2, &[4, 9]), frame(0.3, &[4, 9]), frame(0.4, &[4]), frame(0.5, &[])]
}

fn text_at(fps: f64) -> (String, Recorded) {
    let (plan, walls, people) = world();
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("paths.txt");
    let mut recorder =
        Recorder::create(&path, false, fps, RecordedWorld { plan: &plan, walls: &walls, people: &people }).unwrap();
    motion().iter().for_each(|frame| recorder.push(frame).unwrap());
    assert!(!path.exists());
    let recorded = recorder.finish().unwrap();
    (fs::read_to_string(path).unwrap(), recorded)
}

/// Lines of text without the header: id, frame, x.
fn places(text: &str) -> Vec<(u32, u64, f64)> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines
        .map(|line| {
            let columns: Vec<&str> = line.split(' ').collect();
            assert_eq!((columns.len(), columns[3]), (5, "1.5000"), "{line}");
            (columns[0].parse().unwrap(), columns[1].parse().unwrap(), columns[2].parse().unwrap())
        })
        .collect()
}

#[test]
fn at_the_motions_own_rate_every_frame_is_written_as_it_is() {
    let (text, recorded) = text_at(10.0);
    let expected = [(4, 1, 4.2), (4, 2, 4.4), (9, 2, 9.4), (4, 3, 4.6), (9, 3, 9.6), (4, 4, 4.8)];
    assert_eq!(places(&text), expected);
    let bytes = text.len() as u64;
    assert_eq!(recorded, Recorded { format: RecordingFormat::Juelich, fps: 10.0, frames: 6, places: 6, bytes });
    assert!(text.contains("\n# framerate: 10.00\n# id frame x/m y/m z/m\n"), "{text}");
    let height: f64 = text.lines().last().unwrap().rsplit(' ').next().unwrap().parse().unwrap();
    assert!((height - world().2.person(4).stature_m).abs() < 1e-4);
}

#[test]
fn other_rates_thin_out_or_interpolate() {
    assert_eq!(places(&text_at(5.0).0), [(4, 1, 4.4), (9, 1, 9.4), (4, 2, 4.8)]);
    // A person is interpolated if present in the frames before and after.
    let (text, recorded) = text_at(20.0);
    let of_4: Vec<_> = places(&text).into_iter().filter(|place| place.0 == 4).collect();
    assert_eq!(of_4, [2, 3, 4, 5, 6, 7, 8].map(|k| (4, k, 4.0 + 0.1 * k as f64)));
    assert_eq!(places(&text).iter().filter(|place| place.0 == 9).map(|p| p.1).collect::<Vec<_>>(), [4, 5, 6]);
    assert_eq!(recorded.frames, 11);
}

#[test]
fn who_is_put_elsewhere_does_not_run_there() {
    let mut resampler = Resampler::new(50.0);
    let mut seen = Vec::new();
    for (time_s, x) in [(0.1, 25.9), (0.2, 0.1)] {
        resampler.push(&Frame { time_s, walkers: vec![walker(0, x)] });
        while let Some((_, walkers)) = resampler.next() {
            seen.extend(walkers.iter().map(|walker| walker.position_m.x));
        }
    }
    assert_eq!(seen, [25.9, 25.9, 25.9, 0.1, 0.1, 0.1]);
}

#[test]
fn a_database_holds_the_same_places_with_headings_and_floor() {
    let (mut plan, walls, people) = world();
    // A quarter turn: the plan's x is the map's y.
    plan.map_from_plan = Pose { origin_m: vec2(10.0, 20.0), yaw_rad: std::f64::consts::FRAC_PI_2 };
    let world = RecordedWorld { plan: &plan, walls: &walls, people: &people };
    let dir = tempfile::tempdir().unwrap();
    let record = |name: &str| {
        let path = dir.path().join(name);
        let mut recorder = Recorder::create(&path, false, 10.0, world).unwrap();
        motion().iter().for_each(|frame| recorder.push(frame).unwrap());
        assert_eq!(recorder.finish().unwrap().bytes, fs::metadata(&path).unwrap().len());
        path
    };
    let path = record("paths.sqlite");
    assert!(fs::read(&path).unwrap() == fs::read(record("again.DB")).unwrap(), "the same bytes");

    let database = Connection::open(&path).unwrap();
    let number = |sql: &str| database.query_row(sql, [], |row| row.get::<_, f64>(0)).unwrap();
    assert_eq!(number("SELECT count(*) FROM trajectory_data"), 6.0);
    assert_eq!(number("SELECT count(*) FROM frame_data"), 6.0);
    assert_eq!(number("SELECT pos_x FROM trajectory_data WHERE frame = 1"), 8.5);
    assert_eq!(number("SELECT pos_y FROM trajectory_data WHERE frame = 1"), 24.2);
    assert_eq!(number("SELECT ori_x FROM trajectory_data WHERE frame = 1"), -1.0);
    assert_eq!(number("SELECT CAST(value AS REAL) FROM metadata WHERE key = 'fps'"), 10.0);
    assert_eq!(number("SELECT CAST(value AS REAL) FROM metadata WHERE key = 'version'"), 2.0);
    // The plan's x from -3 to 9 with the aprons.
    assert_eq!(number("SELECT CAST(value AS REAL) FROM metadata WHERE key = 'ymin'"), 17.0);
    assert_eq!(number("SELECT CAST(value AS REAL) FROM metadata WHERE key = 'ymax'"), 29.0);
    assert_eq!(number("SELECT count(*) FROM frame_data f JOIN geometry g ON g.hash = f.geometry_hash"), 6.0);
    let wkt: String = database.query_row("SELECT wkt FROM geometry", [], |row| row.get(0)).unwrap();
    assert!(wkt.starts_with("POLYGON ((") && wkt.contains("9.0000 17.0000"), "{wkt}");
}

#[test]
fn unknown_endings_and_absurd_rates_are_refused_and_leave_nothing() {
    let (plan, walls, people) = world();
    let world = RecordedWorld { plan: &plan, walls: &walls, people: &people };
    let dir = tempfile::tempdir().unwrap();
    for name in ["paths", "paths.cvs", ".txt", "paths.sqlite.gz"] {
        let Err(error) = Recorder::create(&dir.path().join(name), false, 10.0, world) else { panic!("{name}") };
        assert!(error.to_string().contains(".txt, .csv, .traj, .sqlite, .sqlite3 or .db"), "{error}");
    }
    for fps in [0.0, -1.0, 1001.0, f64::NAN, f64::INFINITY] {
        assert!(Recorder::create(&dir.path().join("a.txt"), false, fps, world).is_err(), "{fps}");
    }
    for name in ["a.txt", "a.sqlite"] {
        let mut recorder = Recorder::create(&dir.path().join(name), false, 10.0, world).unwrap();
        recorder.push(&motion()[0]).unwrap();
        drop(recorder);
    }
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 0);
}
