//! Counts and sizes that somebody asks for.

use std::fmt::Write;

use super::super::sandbox::Sandbox;
use super::watched;

#[test]
fn a_recording_with_a_gap_of_a_hundred_million_frames_costs_nothing_for_it() {
    let sandbox = Sandbox::new();
    let mut text = "# framerate: 10\n# id frame x/m y/m z/m\n".to_string();
    for frame in 0..20 {
        writeln!(text, "1 {frame} {} 2 0", 1.0 + 0.1 * f64::from(frame)).unwrap();
    }
    for frame in 0..20 {
        writeln!(text, "2 {} {} 2 0", 100_000_000 + frame, 1.0 + 0.1 * f64::from(frame)).unwrap();
    }
    sandbox.write("gap.txt", text);
    for output in ["out.txt", "out.csv", "out.traj", "out.sqlite"] {
        let ran = watched(&sandbox, &["motion", "convert", "gap.txt", "-o", output], 2);
        assert_eq!(ran.code, Some(0), "{}", ran.err);
        assert!(ran.peak_mib < 100.0, "{} MiB", ran.peak_mib);
    }
    let back = std::fs::read_to_string(sandbox.path("out.txt")).unwrap();
    assert!(back.contains("\n2 100000019 ") || back.contains("\n2\t100000019\t"), "{back}");
}

#[test]
fn formations_have_limits_of_people_keys_seconds_and_frames() {
    let sandbox = Sandbox::new();
    let refused = |text: &str, parts: &[&str]| {
        sandbox.write("crowd.toml", text);
        let ran = watched(&sandbox, &["motion", "formation", "crowd.toml"], 20);
        assert_eq!(ran.code, Some(1), "{}", ran.err);
        assert!(parts.iter().all(|part| ran.err.contains(part)), "{}", ran.err);
        assert!(ran.peak_mib < 1000.0, "{} MiB", ran.peak_mib);
    };
    refused(
        "[formation]\nduration_s = 36000\nfps = 1000\n[formation.example]\npeople = 2\n",
        &["36000001 frames are more than 20000000 positions"],
    );
    refused(
        "[formation]\nduration_s = 3600\nfps = 100\n[formation.example]\npeople = 100\n",
        &["100 people in 360001 frames are more than 20000000 positions", "hint: make it shorter"],
    );
    let mut keys = "[formation]\nduration_s = 100\n[formation.example]\npeople = 2000\n".to_string();
    for time_s in 0..20 {
        write!(keys, "[[formation.key]]\ntime_s = {time_s}\nshape = \"disc\"\n").unwrap();
    }
    refused(&keys, &["20 key formations of 2000 people, allowed are 16 for so many people"]);
}

#[test]
fn threads_are_at_most_256() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    for threads in ["257", "1024", "65536", "0"] {
        sandbox.run(&["inspect", "plan.png", "--threads", threads]).fails(2, &["--threads", "1..=256"]);
    }
    let ran = watched(&sandbox, &["inspect", "plan.png", "--metres-per-pixel", "0.1", "--threads", "256"], 10);
    assert_eq!(ran.code, Some(0), "{}", ran.err);
}

#[test]
fn a_bake_of_terabytes_is_refused_with_its_numbers_before_anybody_walks() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let arguments =
        ["bake", "plan.png", "--metres-per-pixel", "6.25", "--texels-per-metre", "1000", "--people", "1", "-o", "out"];
    sandbox.run(&arguments).fails(1, &["1922 floor tiles", "about ", " GB", "are free", "--yes"]);
    let ran = watched(&sandbox, &arguments, 10);
    assert_eq!(ran.code, Some(1));
}

#[test]
fn texel_densities_beyond_their_range_are_refused_wherever_they_are_given() {
    use trodden::scenario::{Overrides, Scenario};
    use trodden::stamps::TexelGrid;
    let sandbox = Sandbox::new();
    let plan = sandbox.plan();
    for density in [0.0, -1.0, 0.5, 1001.0, f64::NAN, f64::INFINITY] {
        let overrides = Overrides { texels_per_metre: Some(density), ..Overrides::default() };
        let error = Scenario::from_plan(&plan, &overrides).unwrap_err().to_string();
        assert!(error.contains("allowed is 1 to 1000"), "{error}");
        assert!(TexelGrid::covering(8.0, 4.0, density).is_err());
        let manifest = trodden::export::Manifest {
            floor: trodden::export::FloorEntry { texels_per_metre: density, ..Default::default() },
            ..Default::default()
        };
        assert!(trodden::export::read_sums(&sandbox.path("none"), &manifest).is_err());
        let shown = density.to_string().to_lowercase();
        sandbox.run(&["bake", "plan.png", "--texels-per-metre", &shown]).fails(2, &["allowed is 1 to 1000"]);
        sandbox.run(&["init", "plan.png", "-o", "new.toml", "--texels-per-metre", &shown]).fails(2, &[]);
        sandbox.write(
            "dense.toml",
            format!("[plan]\nimage = \"plan.png\"\n[texture]\nfloor_texels_per_metre = {shown}\n"),
        );
        for command in ["bake", "crowd", "inspect"] {
            sandbox.run(&[command, "dense.toml"]).fails(1, &["allowed is 1 to 1000", "dense.toml:4:"]);
        }
    }
}
