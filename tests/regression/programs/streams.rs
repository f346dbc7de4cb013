//! Standard input and output in the place of files, and what recordings carry.

use std::collections::BTreeMap;
use std::fs::{self, File};

use super::super::sandbox::{Ran, Sandbox};

/// Runs a command with a file on its standard input.
fn run_with(sandbox: &Sandbox, arguments: &[&str], input: &str) -> Ran {
    let file = File::open(sandbox.path(input)).unwrap();
    sandbox.run_command(sandbox.command(arguments).stdin(file))
}

/// Body heights by id in a text of the Juelich archive, as they are written.
fn heights(text: &str) -> BTreeMap<String, String> {
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    rows.map(|row| (row.split(' ').next().unwrap().to_string(), row.split(' ').next_back().unwrap().to_string()))
        .collect()
}

/// Whatever a recording was, converting it gave people the heights of another crowd.
#[test]
fn heights_of_people_survive_conversion() {
    let sandbox = Sandbox::new();
    let row = |frame: u32| format!("3 {frame} {}.5 1 1.27\n8 {frame} {}.25 2 1.9312\n", frame, frame);
    let text: String = (0..20).map(row).collect();
    sandbox.write("a.txt", format!("# framerate: 10\n# id frame x/m y/m z/m\n{text}"));
    let told = heights(&text);
    assert_eq!(told.len(), 2);
    for through in ["b.sqlite", "b.csv", "b.csv.gz", "b.txt"] {
        sandbox.run(&["motion", "convert", "a.txt", "-o", through, "--quiet"]).succeeds();
        sandbox.run(&["motion", "convert", through, "-o", "c.txt", "--force", "--quiet"]).succeeds();
        let back = heights(&fs::read_to_string(sandbox.path("c.txt")).unwrap());
        let metres = |heights: &BTreeMap<String, String>| -> Vec<(String, f64)> {
            heights.iter().map(|(id, height)| (id.clone(), height.parse().unwrap())).collect()
        };
        assert_eq!(metres(&back), metres(&told), "{through}");
    }
}

/// Centimetres are told by the heights themselves; a height that is missing or no number stops nothing.
#[test]
fn heights_need_not_be_there_in_every_row() {
    let sandbox = Sandbox::new();
    let row = |frame: u32| match frame {
        2 => format!("3 {frame} {}50 100\n", frame),
        3 => format!("3 {frame} {}50 100 none\n", frame),
        _ => format!("3 {frame} {}50 100 127\n", frame),
    };
    let text: String = (0..20).map(row).collect();
    sandbox.write("a.txt", format!("# framerate: 10\n{text}"));
    sandbox.run(&["motion", "convert", "a.txt", "-o", "b.txt", "--quiet"]).succeeds();
    assert_eq!(heights(&fs::read_to_string(sandbox.path("b.txt")).unwrap())["3"], "1.2700");
}

#[test]
fn init_prints_a_scenario() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let printed = sandbox.run(&["init", "plan.png", "--metres-per-pixel", "0.1", "-o", "-"]).succeeds();
    assert!(printed.made().is_empty());
    sandbox.run(&["init", "plan.png", "--metres-per-pixel", "0.1"]).succeeds();
    assert_eq!(printed.out, fs::read_to_string(sandbox.path("plan.toml")).unwrap());
}

#[test]
fn a_plan_or_a_scenario_is_read_from_standard_input() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.write("plan.toml", "[plan]\nimage = \"plan.png\"\nmetres_per_pixel = 0.1\n[crowd]\npeople = 5\n");
    let options = ["--metres-per-pixel", "0.1", "--people", "5", "--quick", "--floor-only"];
    run_with(&sandbox, &[&["bake", "-"][..], &options[..]].concat(), "plan.png").succeeds();
    run_with(&sandbox, &["bake", "-", "-o", "b", "--quick", "--floor-only"], "plan.toml").succeeds();
    let floor = |bake: &str| fs::read(sandbox.path(bake).join("floor/floor_basecolor.1001.png")).unwrap();
    assert!(floor("out/stdin") == floor("b"));
    run_with(&sandbox, &["init", "-"], "plan.png").fails(1, &["standard input has no name", "hint: save the plan"]);
    sandbox.write("wrong.toml", "[plan]\nimage = \"plan.png\"\npeple = 3\n");
    run_with(&sandbox, &["bake", "-", "-o", "c"], "wrong.toml").fails(1, &["--> standard input:3:1"]);
    sandbox.write("nothing", "");
    run_with(&sandbox, &["bake", "-", "-o", "c"], "nothing").fails(1, &["standard input is empty"]);
    sandbox.write("noise", [0xff, 0xfe, 0x01]);
    let told = run_with(&sandbox, &["bake", "-", "-o", "c"], "noise").fails(1, &["standard input"]).err;
    assert!(!told.contains("/stdin"), "{told}");
}

#[test]
fn motion_tools_read_standard_input() {
    let sandbox = Sandbox::new();
    let text: String = (0..20).map(|frame| format!("3 {frame} {frame}.5 1 1.7\n")).collect();
    sandbox.write("a.txt", format!("# framerate: 10\n{text}"));
    run_with(&sandbox, &["motion", "convert", "-", "-o", "b.sqlite"], "a.txt").succeeds();
    let printed = run_with(&sandbox, &["motion", "convert", "-", "-o", "-"], "b.sqlite").succeeds();
    assert_eq!(printed.out.lines().filter(|line| !line.starts_with('#')).count(), 20);
    run_with(&sandbox, &["motion", "info", "-"], "b.sqlite").succeeds();
    sandbox.write("wrong.txt", "# framerate: 10\n3 0 1 1 1\n3 1 x 1 1\n");
    let told =
        run_with(&sandbox, &["motion", "convert", "-", "-o", "c.txt"], "wrong.txt").fails(1, &["standard input"]);
    assert!(!told.err.contains("/stdin"), "{}", told.err);
}

#[test]
fn a_bake_reads_its_motion_from_standard_input() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let text: String =
        (0..40).map(|frame| format!("3 {frame} {:.1} 1.5 1.7\n", 0.5 + 0.15 * f64::from(frame))).collect();
    sandbox.write("a.txt", format!("# framerate: 10\n{text}"));
    let options = ["--quick", "--floor-only"];
    run_with(&sandbox, &[&["bake", "--motion", "-"][..], &options].concat(), "a.txt").succeeds();
    sandbox.run(&[&["bake", "--motion", "a.txt", "-o", "b"][..], &options].concat()).succeeds();
    let floor = |bake: &str| fs::read(sandbox.path(bake).join("floor/floor_basecolor.1001.png")).unwrap();
    assert!(floor("out/stdin") == floor("b"));
    let both = ["bake", "-", "--motion", "-", "-o", "c"];
    run_with(&sandbox, &both, "plan.png").fails(1, &["cannot both be read from standard input", "hint: "]);
    sandbox.write("wrong.txt", "# framerate: 10\n3 0 1 1 1\n3 1 x 1 1\n");
    let wrong = run_with(&sandbox, &["bake", "--motion", "-", "-o", "c"], "wrong.txt");
    assert!(!wrong.fails(1, &["standard input"]).err.contains("/stdin"));
}

/// It was taken for a scenario with mistakes.
#[test]
fn a_ros_map_on_standard_input_is_told_from_a_scenario() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.write("map.yaml", "image: plan.png\nresolution: 0.1\norigin: [0, 0, 0]\n");
    run_with(&sandbox, &["bake", "-", "-o", "c"], "map.yaml")
        .fails(1, &["the YAML of a ROS map", "hint: give the path"]);
}

/// The warning about the scale of `--plan` names an option: it is there.
#[test]
fn convert_has_the_options_that_its_messages_name() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let text: String = (0..20).map(|frame| format!("3 {frame} {}.5 1.5 1.7\n", frame % 4)).collect();
    sandbox.write("a.txt", format!("# framerate: 1\n{text}"));
    let convert = ["motion", "convert", "a.txt", "--plan", "plan.png", "-o", "b.txt", "--force"];
    let told = sandbox.run(&convert).succeeds().err;
    assert!(told.contains("give the scale in metres per pixel") && !told.contains("--"), "{told}");
    let quiet = sandbox.run(&[&convert[..], &["--plan-metres-per-pixel", "0.1"]].concat()).succeeds().err;
    assert_eq!(quiet, "");
}
