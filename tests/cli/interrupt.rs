//! Ctrl-C.

#![cfg(unix)]

use std::os::unix::process::ExitStatusExt;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::sandbox::Sandbox;

const SIGINT: i32 = 2;

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
