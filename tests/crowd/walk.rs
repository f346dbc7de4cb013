//! Whole walks: the same files on any number of threads, and all of them of the same crowd.

use std::fs;
use std::path::Path;

use trodden::Silent;
use trodden::scenario::{Overrides, Scenario};
use trodden::show::AnimationOptions;
use trodden::walk::{MotionOutput, WalkOutputs, WalkReport, walk};

fn school(people: u32) -> Scenario {
    sample("school.toml", people)
}

fn sample(name: &str, people: u32) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans").join(name);
    Scenario::open(&path, &Overrides { people: Some(people), ..Overrides::default() }).unwrap()
}

fn walk_on(threads: usize, scenario: &Scenario, outputs: &WalkOutputs) -> WalkReport {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| walk(scenario, outputs, &Silent)).unwrap()
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let scenario = school(150);
    let files_of = |threads: usize| {
        let dir = tempfile::tempdir().unwrap();
        let outputs = |motion: &str, animation: &str| WalkOutputs {
            motion: Some(MotionOutput::File(dir.path().join(motion))),
            fps: Some(8.0),
            format: None,
            animation: Some((
                dir.path().join(animation),
                AnimationOptions { size_px: 300, ..AnimationOptions::default() },
            )),
            paths: Some(dir.path().join("ways.png")),
            force: true,
        };
        let report = walk_on(threads, &scenario, &outputs("a.txt", "a.gif"));
        let again = walk_on(threads, &scenario, &outputs("a.sqlite", "a.png"));
        assert_eq!((report.people.entered, report.metres), (150, again.metres));
        let names = ["a.txt", "a.gif", "a.sqlite", "a.png", "ways.png"];
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), names.len());
        (report.mean_speed_m_s, names.map(|name| fs::read(dir.path().join(name)).unwrap()))
    };
    let one = files_of(1);
    assert!(one.0 > 0.8 && one.0 < 1.5, "{}", one.0);
    for threads in [2, 16] {
        assert!(files_of(threads) == one, "{threads} threads");
    }
}

#[test]
fn the_crowd_is_that_of_any_other_output() {
    let scenario = school(60);
    let nothing = walk_on(2, &scenario, &WalkOutputs::default());
    let dir = tempfile::tempdir().unwrap();
    let outputs = WalkOutputs { motion: Some(MotionOutput::File(dir.path().join("a.txt"))), ..WalkOutputs::default() };
    let written = walk_on(2, &scenario, &outputs);
    assert_eq!((&nothing.people, nothing.metres), (&written.people, written.metres));
    // Metres by the file alone: each line to the next of the same person.
    let text = fs::read_to_string(dir.path().join("a.txt")).unwrap();
    let mut last = std::collections::BTreeMap::new();
    let mut metres = 0.0;
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        let columns: Vec<f64> = line.split(' ').map(|column| column.parse().unwrap()).collect();
        let [id, _, x, y, _] = columns[..] else { panic!("{line}") };
        if let Some((before_x, before_y)) = last.insert(id as u32, (x, y)) {
            metres += f64::sqrt((x - before_x) * (x - before_x) + (y - before_y) * (y - before_y));
        }
    }
    assert_eq!(last.len(), 60);
    assert!((metres / written.metres - 1.0).abs() < 1e-3, "{metres} {}", written.metres);
}

#[test]
fn more_people_take_longer_and_stand_no_denser() {
    let walked = |people: u32| walk_on(2, &sample("station.toml", people), &WalkOutputs::default());
    let (day, crowded) = (walked(1500), walked(4000));
    for report in [&day, &crowded] {
        println!("{} arrived in {:.0} s, {:.2} m/s", report.people.arrived, report.duration_s, report.mean_speed_m_s);
    }
    assert_eq!(crowded.people.arrived, 4000);
    // Trains by share would bring three times as many at once, who stand before the gates for hours (0.22 m/s).
    assert!(crowded.mean_speed_m_s > 0.9 * day.mean_speed_m_s, "{} m/s", crowded.mean_speed_m_s);
}
