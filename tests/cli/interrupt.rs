//! Ctrl-C, and a program that is killed.

#![cfg(unix)]

use std::collections::BTreeMap;
use std::os::unix::process::ExitStatusExt;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::sandbox::Sandbox;

const SIGINT: i32 = 2;

/// What a bake left in the folder `out`, without its measured times.
fn baked(sandbox: &Sandbox) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = sandbox.contents();
    let out = sandbox.path("out");
    files.retain(|path, _| path.starts_with(&out) && !path.ends_with("report.json"));
    files
}

#[test]
fn a_killed_bake_leaves_the_earlier_one_or_its_own_and_the_next_cleans_up() {
    killed_at(8);
}

#[test]
#[ignore = "takes minutes"]
fn a_bake_killed_at_any_moment_leaves_the_earlier_one_or_its_own() {
    killed_at(50);
}

/// Kills a bake over an earlier one at so many moments, evenly over its time.
fn killed_at(moments: u32) {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let bake = ["bake", "plan.png", "--metres-per-pixel", "0.1", "--quick", "--force", "-o", "out", "--people", "5"];
    let run = |seed: &'static str| [&bake[..], &["--seed", seed]].concat();
    sandbox.run(&run("2")).succeeds();
    let new = baked(&sandbox);
    sandbox.run(&run("1")).succeeds();
    let (old, all) = (baked(&sandbox), sandbox.contents().len());
    assert_ne!(old, new);
    let begun = Instant::now();
    sandbox.run(&run("1")).succeeds();
    let took = begun.elapsed();
    for moment in 0..moments {
        let mut child = sandbox.command(&run("2")).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(took * (2 * moment + 1) / (2 * moments));
        child.kill().unwrap();
        child.wait().unwrap();
        let left = baked(&sandbox);
        assert!(left == old || left == new, "killed at {moment} of {moments}: neither the old bake nor the new one");
        sandbox.run(&run("1")).succeeds();
        assert!(baked(&sandbox) == old && sandbox.contents().len() == all, "the next bake left something behind");
    }
}

fn interrupted_after(wait: Duration) {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let before = sandbox.contents();
    let arguments = ["bake", "plan.png", "--metres-per-pixel", "0.1", "--people", "200000", "-o", "out"];
    let mut command = sandbox.command(&arguments);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(wait);
    assert!(child.try_wait().unwrap().is_none(), "the bake ended before it could be interrupted");
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let asked = Instant::now();
    let output = child.wait_with_output().unwrap();
    assert!(asked.elapsed() < Duration::from_secs(20), "took {:?} to stop", asked.elapsed());
    assert_eq!(output.status.signal(), Some(SIGINT), "a shell's loop must end too");
    sandbox.ran(before, output).fails(128 + SIGINT, &["interrupted"]);
}

#[test]
fn a_bake_stops_and_leaves_nothing() {
    interrupted_after(Duration::from_millis(1500));
}

#[test]
fn an_interrupted_bake_leaves_an_earlier_one_as_it_was() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let bake = ["bake", "plan.png", "--metres-per-pixel", "0.1", "--quick", "-o", "out"];
    sandbox.run(&[&bake[..], &["--people", "5"]].concat()).succeeds();
    let before = sandbox.contents();
    let mut command = sandbox.command(&[&bake[..], &["--people", "200000", "--force"]].concat());
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(Duration::from_millis(1000));
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    sandbox.ran(before, output).fails(128 + SIGINT, &["interrupted"]);
}
