//! The scripts that bring a bake into other programs.

use std::fs;
use std::path::Path;
use std::process::Command;

use super::super::sandbox::Sandbox;

fn bake(target: &str) -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let bake = ["bake", "plan.png", "--metres-per-pixel", "0.1", "--people", "10", "--quick", "--dirt", "-o", "out"];
    sandbox.run(&[&bake[..], &["--target", target]].concat()).succeeds();
    sandbox
}

/// Runs a Python program of this folder on a script of a bake; `None` where Python or a module that it needs is missing.
fn python(sandbox: &Sandbox, program: &str, module: &str, script: &str) -> Option<()> {
    let runs = |arguments: &[&str]| {
        let mut python = Command::new("python3");
        python.args(arguments).env("PYTHONDONTWRITEBYTECODE", "1").current_dir(sandbox.path("")).output().ok()
    };
    runs(&["-c", &format!("import {module}")]).filter(|output| output.status.success())?;
    let program = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/regression/programs").join(program);
    let output = runs(&[program.to_str().unwrap(), sandbox.path(script).to_str().unwrap()])?;
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && told.contains("ok"), "{told}\n{}", String::from_utf8_lossy(&output.stderr));
    Some(())
}

/// A second run deleted the function and made another: materials that used the first lost it.
#[test]
fn unreal_keeps_the_material_function_of_the_first_run() {
    let sandbox = bake("unreal");
    if python(&sandbox, "twice.py", "json", "out/shaders/trodden_unreal.py").is_none() {
        eprintln!("skipped: there is no python3 here");
    }
}

/// A second run imported the scene once more beside the first.
#[test]
fn blender_updates_what_the_first_run_made() {
    let sandbox = bake("blender");
    if python(&sandbox, "blender.py", "bpy", "out/shaders/trodden_blender.py").is_none() {
        eprintln!("skipped: there is no python3 with Blender's module bpy here");
    }
    // What can be said without Blender: masks come from colours alone, and nothing is made beside what is there.
    let script = fs::read_to_string(sandbox.path("out/shaders/trodden_blender.py")).unwrap();
    assert!(!script.contains("\"Alpha\"") && script.contains("import_scene(bake)"));
}

/// After a pause, as in a tab in the background, the walk of the page went on as if no time had passed, or jumped.
#[test]
fn no_step_of_the_page_is_longer_than_a_fifth_of_a_second() {
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/src/show/page/client/page.js");
    assert!(fs::read_to_string(page).unwrap().contains("Math.min((now - last) / 1000, 0.2)"));
}
