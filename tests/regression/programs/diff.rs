//! `trodden diff` looks at all files and says by its exit code whether it could.

use std::fs;
use std::path::Path;

use super::super::sandbox::Sandbox;

/// Two bakes that are the same.
fn twins() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let bake = ["bake", "plan.png", "--metres-per-pixel", "0.1", "--people", "10", "--quick", "-o", "a"];
    sandbox.run(&bake).succeeds();
    copy(&sandbox.path("a"), &sandbox.path("b"));
    sandbox
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() { copy(&path, &target) } else { fs::copy(&path, &target).map(drop).unwrap() }
    }
}

/// Any file that is missing, changed or added makes two bakes different; only the report may differ.
#[test]
fn diff_looks_at_every_file_of_a_bake() {
    let sandbox = twins();
    let diff = |code: i32, part: &str| {
        let ran = sandbox.run(&["diff", "a", "b"]);
        assert_eq!((ran.code, ran.err.as_str()), (Some(code), ""), "{}", ran.out);
        assert!(ran.out.contains(part), "no {part:?} in {}", ran.out);
    };
    sandbox.write("b/report.json", "{}");
    diff(0, "the same");
    let put_back = |file: &str| fs::copy(sandbox.path("a").join(file), sandbox.path("b").join(file)).map(drop).unwrap();
    for file in ["index.html", "shaders/trodden_masks.glsl", "preview/floor.png"] {
        fs::remove_file(sandbox.path("b").join(file)).unwrap();
        diff(1, &format!("{file}: only in a"));
        put_back(file);
    }
    for file in ["scene.glb", "index.html", "manifest.json"] {
        let mut bytes = fs::read(sandbox.path("b").join(file)).unwrap();
        bytes.push(b'\n');
        sandbox.write(&format!("b/{file}"), bytes);
        diff(1, &format!("{file}: different"));
        put_back(file);
    }
    sandbox.write("b/preview/notes.txt", "mine");
    diff(1, "preview/notes.txt: only in b");
    fs::remove_file(sandbox.path("b/preview/notes.txt")).unwrap();
    for bake in ["a", "b"] {
        fs::remove_file(sandbox.path(bake).join("scene.glb")).unwrap();
    }
    diff(1, "scene.glb: missing in both");
}

/// 1 means different: what cannot be read is no answer.
#[test]
fn diff_ends_with_2_where_it_cannot_compare() {
    let sandbox = Sandbox::new();
    let plan = sandbox.plan();
    sandbox.write("damaged.png", &fs::read(plan).unwrap()[..60]);
    fs::create_dir(sandbox.path("empty")).unwrap();
    sandbox.run(&["diff", "plan.png", "plan.png"]).succeeds();
    let cases = [
        ["plan.png", "missing.png"],
        ["plan.png", "damaged.png"],
        ["plan.png", "empty"],
        ["empty", "empty"],
        ["a", "b"],
    ];
    for [a, b] in cases {
        sandbox.run(&["diff", a, b]).fails(2, &[]);
    }
    sandbox.run(&["diff", "plan.png", "plan.png", "--picture", "nowhere/heat.png"]).fails(2, &["nowhere/heat.png"]);
}
