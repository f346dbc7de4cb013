//! Mistakes that are known at the start are told before anybody walks.

use std::time::{Duration, Instant};

use super::super::sandbox::{Ran, Sandbox};

/// A crowd that takes minutes.
const MANY: [&str; 4] = ["--people", "200000", "--metres-per-pixel", "0.1"];
/// Far less than that crowd needs.
const AT_ONCE: Duration = Duration::from_secs(5);

/// Runs a command with a large crowd, which has to fail before it walks.
#[track_caller]
fn fails_at_once(sandbox: &Sandbox, arguments: &[&str], parts: &[&str]) -> Ran {
    let start = Instant::now();
    let ran = sandbox.run(&[arguments, &MANY[..]].concat()).fails(1, parts);
    assert!(start.elapsed() < AT_ONCE, "{:?}", start.elapsed());
    ran
}

#[test]
fn a_tile_too_small_for_a_strip_of_wall_is_told_at_once() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.write("small.toml", "[plan]\nimage = \"plan.png\"\n[texture]\ntile = 256\n");
    fails_at_once(&sandbox, &["bake", "small.toml"], &["a wall of 2.6 m", "256 px", "hint: set texture.tile to 1024"]);
}

#[test]
fn images_of_a_look_are_read_before_anybody_walks() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let png = std::fs::read(sandbox.path("plan.png")).unwrap();
    sandbox.write("half.png", &png[..png.len() / 2]);
    for (section, image) in [("look.floor", "missing.png"), ("look.floor", "half.png"), ("look.wall", "half.png")] {
        let text = format!("[plan]\nimage = \"plan.png\"\n[{section}]\nimage = \"{image}\"\n");
        sandbox.write("look.toml", text);
        fails_at_once(&sandbox, &["bake", "look.toml"], &["cannot use the image", image]);
    }
    sandbox.write("look.toml", "[plan]\nimage = \"plan.png\"\n[look]\nfile = \"nothing.toml\"\n");
    fails_at_once(&sandbox, &["bake", "look.toml"], &["cannot read the look file nothing.toml"]);
}

#[test]
fn outputs_that_cannot_be_made_are_told_at_once() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.write("file", "no folder");
    let long = "x".repeat(300);
    fails_at_once(&sandbox, &["bake", "plan.png", "-o", "file/out"], &["file/out"]);
    fails_at_once(&sandbox, &["bake", "plan.png", "-o", &long], &["too long"]);
    let files = [["-o", "file/a.txt"], ["--paths", "file/a.png"], ["--animation", "nowhere/a.gif"]];
    for output in files {
        fails_at_once(&sandbox, &[&["crowd", "plan.png"][..], &output[..]].concat(), &["cannot write", output[1]]);
    }
}

/// The place of a file is looked at even before the plan is.
#[test]
fn an_output_is_checked_before_any_input_is_read() {
    let sandbox = Sandbox::new();
    sandbox.write("plan.png", "no image");
    sandbox.write("file", "no folder");
    sandbox.run(&["crowd", "plan.png", "-o", "file/a.txt"]).fails(1, &["cannot write file/a.txt"]);
    sandbox.run(&["crowd", "plan.png", "--paths", "file/a.png"]).fails(1, &["cannot write file/a.png"]);
    sandbox.run(&["motion", "convert", "plan.png", "-o", "file/a.txt"]).fails(1, &["cannot write file/a.txt"]);
    sandbox.run(&["bake", "plan.png", "-o", "file/out"]).fails(1, &["file/out"]);
    sandbox.run(&["inspect", "plan.png", "--picture", "file/a.png"]).fails(1, &["cannot write file/a.png"]);
}

/// What another look or target cannot be is told before the sums are read: here they are damaged.
#[test]
fn resolve_checks_what_is_asked_before_it_reads_sums() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let bake =
        ["bake", "plan.png", "--metres-per-pixel", "0.1", "--people", "10", "--quick", "--floor-only", "-o", "out"];
    sandbox.run(&bake).succeeds();
    sandbox.write("out/sums/floor_sums.1001.exr", "damaged");
    sandbox.write("look.toml", "[floor]\nimage = \"missing.png\"\n");
    sandbox.run(&["resolve", "out", "--look", "look.toml"]).fails(1, &["cannot use the image missing.png"]);
    sandbox.run(&["resolve", "out", "--preset", "wet"]).fails(1, &["floor_sums.1001.exr"]);
}

/// A floor smaller than the least tile could not be resolved again.
#[test]
fn a_small_floor_can_be_resolved_again() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let bake =
        ["bake", "plan.png", "--metres-per-pixel", "0.1", "--people", "10", "--texels-per-metre", "5", "-o", "out"];
    sandbox.run(&[&bake[..], &["--floor-only"]].concat()).succeeds();
    sandbox.run(&["resolve", "out", "--preset", "wet"]).succeeds();
}
