//! Floors that recorded people trod, and floors of the crowd on the same ways: docs/against-reality.md.
//!
//! The recordings are no part of the project: without them, in `../shared`, or without Python nothing is measured.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// What a place may be off by.
struct Limits {
    name: &'static str,
    /// Least correlation of passes, as a share of the highest that so few people allow.
    correlation: f64,
    /// Share of positions that lie elsewhere across the width.
    elsewhere: f64,
    /// Mean distance from the wall, and that which 5 % are within, metres.
    wall_m: [f64; 2],
    /// Mean step, as a share of the recorded one.
    step: f64,
}

const PLACES: [Limits; 5] = [
    Limits { name: "Corridor 1.8 m, free", correlation: 0.85, elsewhere: 0.18, wall_m: [0.08, 0.10], step: 0.15 },
    Limits { name: "Corridor 1.8 m, congested", correlation: 0.7, elsewhere: 0.18, wall_m: [0.05, 0.05], step: 0.25 },
    Limits { name: "Corridor 5 m, free", correlation: 0.7, elsewhere: 0.18, wall_m: [0.10, 0.15], step: 0.15 },
    Limits { name: "Corner, 3 m", correlation: 0.8, elsewhere: 0.18, wall_m: [0.08, 0.08], step: 0.15 },
    Limits { name: "Bottleneck 0.5 m", correlation: 0.85, elsewhere: 0.12, wall_m: [0.10, 0.15], step: 0.15 },
];

/// What `docs/measure_reality` finds, with further keys of `[crowd]`; `None` where something that it needs is missing.
fn measured(keys: &str) -> Option<Vec<Value>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let recordings = root.join("../shared/data/trajectories");
    if !recordings.exists() || Command::new("python3").arg("--version").output().is_err() {
        eprintln!("skipped: there are no recordings in {}, or there is no python3", recordings.display());
        return None;
    }
    let output = Command::new("python3")
        .arg(root.join("docs/measure_reality"))
        .args([env!("CARGO_BIN_EXE_trodden"), "--json", "--crowd", keys, "--recordings"])
        .arg(recordings)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(serde_json::from_slice(&output.stdout).unwrap())
}

/// All that is beyond its limit.
fn faults(found: &[Value]) -> Vec<String> {
    assert_eq!(found.len(), PLACES.len());
    let mut faults = Vec::new();
    for (limits, place) in PLACES.iter().zip(found) {
        assert_eq!(place["place"], limits.name);
        let of = |key: &str| place[key].as_f64().unwrap();
        let off = |key: &str| (of(key) - of(&format!("recorded_{key}"))).abs();
        let mut hold = |what: &str, value: f64, limit: f64, kept: bool| {
            println!("{}: {what} {value:.3}, limit {limit}", limits.name);
            if !kept {
                faults.push(format!("{}: {what} {value:.3}, limit {limit}", limits.name));
            }
        };
        let share = of("correlation") / of("ceiling");
        hold("correlation over its ceiling", share, limits.correlation, share >= limits.correlation);
        let measures = [
            ("elsewhere across", of("profile"), limits.elsewhere),
            ("mean distance from the wall", off("wall_mean_m"), limits.wall_m[0]),
            ("5 % from the wall", off("wall_nearest_m"), limits.wall_m[1]),
            ("step", off("step_m") / of("recorded_step_m"), limits.step),
        ];
        for (what, value, limit) in measures {
            hold(what, value, limit, value <= limit);
        }
    }
    faults
}

#[test]
fn the_crowd_treads_the_floors_that_recorded_people_trod() {
    let Some(found) = measured("") else { return };
    assert_eq!(faults(&found), Vec::<String>::new());
}

#[test]
#[ignore = "three crowds in five places take most of a minute"]
fn crowds_that_walk_otherwise_tread_other_floors() {
    let others: [(&str, &[&str]); 3] = [
        ("wall_acceptable = 1.5", &["elsewhere across", "mean distance from the wall", "5 % from the wall"]),
        ("acceptable = [3.0, 4.0]", &["correlation"]),
        ("speed = { mean = 0.7, sd = 0.1 }", &["step"]),
    ];
    for (keys, wrong) in others {
        let Some(found) = measured(keys) else { return };
        let faults = faults(&found);
        for what in wrong {
            assert!(faults.iter().any(|fault| fault.contains(what)), "{keys}, {what}: {faults:?}");
        }
    }
}
