//! Files of the user are never lost, and results appear whole or not at all.

use std::fs;
use std::path::Path;

use super::sandbox::Sandbox;

mod folders;
mod signals;
mod single;

/// A bake of a few people that takes next to no time.
const QUICK: [&str; 9] = ["-q", "bake", "plan.png", "--metres-per-pixel", "0.1", "--people", "3", "--quick", "-o"];
/// The same without walls, scene and page.
const FLOOR: [&str; 2] = ["out", "--floor-only"];

fn quick<'a>(more: &[&'a str]) -> Vec<&'a str> {
    QUICK.iter().chain(more).copied().collect()
}

/// A folder with a plan and a bake of it without walls, in `out`.
fn baked() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.run(&quick(&FLOOR)).succeeds();
    sandbox
}

/// Changes the text of a file.
fn edit(file: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(file).unwrap();
    assert!(text.contains(from), "no {from} in {}", file.display());
    fs::write(file, text.replace(from, to)).unwrap();
}
