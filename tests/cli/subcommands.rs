//! Subcommands that do what they are asked.

use std::fs;
use std::process::Stdio;

use super::sandbox::Sandbox;

#[test]
fn inspect_prints_what_was_understood() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let ran = sandbox.run(&["inspect", "plan.png", "--metres-per-pixel", "0.1"]).succeeds();
    snapbox::assert_data_eq!(
        ran.out,
        snapbox::str![[r#"
size      8.00 x 4.00 m: 80 x 40 px at 0.1 m per pixel
scale     given
floor     24.0 m2 in 1 region
walls     16.0 m: 2 open and 0 closed faces
openings  west           3.00 m wide, around [0.00, 2.00]
          east           3.00 m wide, around [8.00, 2.00]
rooms     room 1         24.0 m2, room      vinyl     2 doors   around [0.05, 2.05]
routes    west to east                   13.4 m, 50 % of the people
          east to west                   13.5 m, 50 % of the people

"#]]
    );
    assert_eq!(ran.err, "");
}

#[test]
fn inspect_prints_json_in_metres_of_the_plan_frame() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let ran = sandbox.run(&["inspect", "plan.png", "--metres-per-pixel", "0.1", "--json"]).succeeds();
    let json: serde_json::Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(json["metres_per_pixel"], 0.1);
    let walls = json["walls"].as_array().unwrap();
    assert_eq!(walls.len(), 2);
    for wall in walls {
        assert_eq!(wall["closed"], false);
        let points: Vec<[f64; 2]> = serde_json::from_value(wall["points"].clone()).unwrap();
        let [a, b] = points[..] else { panic!("{points:?}") };
        // The corridor runs from y = 0.5 to y = 3.5, its floor on the right of both faces.
        let upper = (a[1] - 3.5).abs() < 1e-9;
        assert!(upper || (a[1] - 0.5).abs() < 1e-9, "{points:?}");
        assert_eq!([a[0], b[0]], if upper { [0.0, 8.0] } else { [8.0, 0.0] });
        assert_eq!(a[1], b[1]);
    }
    let names: Vec<&str> = json["openings"].as_array().unwrap().iter().map(|o| o["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["west", "east"]);
    assert_eq!(json["regions"][0]["role"], "floor");
    assert_eq!(json["routes"][0]["name"], "west to east");
}

#[test]
fn inspect_lists_what_a_drawing_shows() {
    let sandbox = Sandbox::new();
    sandbox.write("plan.png", fs::read("docs/images/plan-cad.png").unwrap());
    let ran = sandbox.run(&["inspect", "plan.png"]).succeeds();
    for part in
        ["\ndoors     13, 0.90 to 1.20 m wide\n", "\nwindows   11, ", "seat (0.45 m high)", "\nrooms     room 1 "]
    {
        assert!(ran.out.contains(part), "{part:?} is missing in\n{}", ran.out);
    }
    let ran = sandbox.run(&["inspect", "plan.png", "--json"]).succeeds();
    let json: serde_json::Value = serde_json::from_str(&ran.out).unwrap();
    let count = |key: &str| json[key].as_array().map_or(0, Vec::len);
    assert_eq!([count("doors"), count("windows"), count("rooms")], [13, 11, 12]);
    assert!(count("furniture") > 40 && json["doors"][0]["width_m"].as_f64().unwrap() > 0.8);
}

#[test]
fn a_backslash_that_became_a_tab_is_told() {
    let sandbox = Sandbox::new();
    sandbox.write("plan.toml", "[plan]\nimage = \"plans\\tables.png\"\n");
    sandbox.run(&["inspect", "plan.toml"]).fails(1, &["cannot read the plan", "\\t is a tab", "with slashes"]);
}

#[test]
fn inspect_draws_a_picture() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let arguments = ["-q", "inspect", "plan.png", "--metres-per-pixel", "0.1", "--picture", "seen.png"];
    let ran = sandbox.run(&arguments).succeeds();
    assert_eq!((ran.out.as_str(), ran.err.as_str()), ("", ""));
    let picture = image::open(sandbox.path("seen.png")).unwrap();
    assert!(picture.width() > picture.height() && picture.height() > 300, "{picture:?}");
}

#[test]
fn init_writes_a_scenario_that_says_what_would_be_done_anyway() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.run(&["init", "plan.png", "--metres-per-pixel", "0.1"]).succeeds();
    let alone = sandbox.run(&["inspect", "plan.png", "--metres-per-pixel", "0.1", "--json"]).succeeds();
    let written = sandbox.run(&["inspect", "plan.toml", "--json"]).succeeds();
    assert_eq!(alone.out, written.out);

    let text = fs::read_to_string(sandbox.path("plan.toml")).unwrap();
    assert!(
        text.contains("from = \"west\"") && text.contains("# Openings of the plan: \"west\" (3.0 m wide)"),
        "{text}"
    );
    sandbox.run(&["init", "plan.png"]).fails(1, &["plan.toml exists already", "--force"]);
    sandbox.run(&["init", "plan.png", "--force", "--people", "77", "--preset", "paper"]).succeeds();
    let text = fs::read_to_string(sandbox.path("plan.toml")).unwrap();
    assert!(text.contains("people = 77") && text.contains("preset = \"paper\""), "{text}");
}

/// The file is read back by the library: not one value may differ from what a plan alone gets.
#[test]
fn init_writes_exactly_the_defaults() {
    use trodden::scenario::{Overrides, Preset, Scenario};
    let sandbox = Sandbox::new();
    let plan = sandbox.plan();
    for preset in Preset::ALL {
        let name = format!("{}.toml", preset.name());
        sandbox
            .run(&["init", "plan.png", "--metres-per-pixel", "0.1", "--preset", preset.name(), "-o", &name])
            .succeeds();
        let overrides = Overrides { preset: Some(preset), metres_per_pixel: Some(0.1), ..Overrides::default() };
        let mut expected = Scenario::from_plan(&plan, &overrides).unwrap();
        let written = Scenario::read(&sandbox.path(&name), &Overrides::default()).unwrap();
        assert_eq!(written.routes.routes.len(), 2);
        expected.routes = written.routes.clone();
        expected.read_from = written.read_from.clone();
        assert_eq!(written, expected);
    }
}

#[test]
fn init_finds_its_way_back_to_the_plan() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.write("deeper/x", "");
    sandbox.run(&["init", "plan.png", "--metres-per-pixel", "0.1", "-o", "deeper/plan.toml"]).succeeds();
    sandbox.run(&["inspect", "deeper/plan.toml"]).succeeds();
}

#[test]
fn patterns_are_listed_and_drawn() {
    let sandbox = Sandbox::new();
    let ran = sandbox.run(&["patterns", "--picture", "sheet.png"]).succeeds();
    assert!(ran.out.lines().filter(|line| line.contains(" sole ")).count() >= 8, "{}", ran.out);
    assert!(image::open(sandbox.path("sheet.png")).unwrap().width() > 500);
}

/// `trodden patterns | head -1` closes the pipe early.
#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let sandbox = Sandbox::new();
    let mut child = sandbox.command(&["patterns"]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), String::from_utf8_lossy(&output.stderr).as_ref()), (Some(0), ""));
}

#[test]
fn a_scenario_s_warnings_can_be_silenced() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let loud = sandbox.run(&["inspect", "plan.png"]).succeeds();
    assert!(loud.err.starts_with("warning: "), "{}", loud.err);
    let quiet = sandbox.run(&["inspect", "plan.png", "-q"]).succeeds();
    assert_eq!((quiet.out.as_str(), quiet.err.as_str()), ("", ""));
}
