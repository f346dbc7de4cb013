//! What the README shows is what the program does.

use std::fs;
use std::path::Path;

use trodden::scenario::{Overrides, Scenario};

use super::sandbox::Sandbox;

fn readme() -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).unwrap()
}

/// The blocks of code in one language.
fn blocks(language: &str) -> Vec<String> {
    let text = readme();
    let fence = format!("```{language}\n");
    text.split(&fence).skip(1).map(|rest| rest.split("```").next().unwrap().to_string()).collect()
}

#[test]
fn its_scenario_is_one() {
    // The others show what may be added to the first.
    let text = blocks("toml").concat();
    assert_eq!(blocks("toml").len(), 3);
    Scenario::parse(&text, Path::new("station.toml"), &Overrides::default()).unwrap_or_else(|error| panic!("{error}"));
}

/// As they stand, pasted into a shell in a folder with a plan.
#[cfg(unix)]
#[test]
fn its_commands_work_one_after_the_other() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let pasted: Vec<String> = blocks("sh").into_iter().filter(|block| block.starts_with("trodden ")).collect();
    assert!(pasted.len() >= 2 && pasted.concat().lines().count() >= 10);
    let program = Path::new(env!("CARGO_BIN_EXE_trodden")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    for block in pasted {
        let mut shell = std::process::Command::new("sh");
        shell.args(["-e", "-c", &block]).current_dir(sandbox.path("")).env("PATH", &path).env_remove("NO_COLOR");
        sandbox.run_command(&mut shell).succeeds();
    }
    for file in
        ["understood.png", "out/quick/manifest.json", "out/plan/preview/floor.png", "from_above.png", "crowd.gif"]
    {
        assert!(sandbox.path(file).is_file(), "{file}");
    }
}

#[test]
fn its_mistake_is_shown_as_it_says() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.write(
        "plan.toml",
        "[plan]\nimage = \"plan.png\"\nmetres_per_pixel = 0.05\n\n[crowd]\nseed = 1\npeple = 1500\n",
    );
    let shown = sandbox.run(&["bake", "plan.toml"]).fails(1, &[]).err;
    assert!(blocks("text").contains(&shown), "{shown}");
}

#[test]
fn every_file_that_it_names_is_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for name in ["floorplans/station.toml", "docs/draw_images", "docs/scenario.toml", "examples/draw_floorplans"] {
        assert!(readme().contains(name.trim_start_matches("examples/")), "{name}");
        assert!(root.join(name).exists(), "{name}");
    }
}

/// The reference of all keys: what `init` writes for the museum.
#[test]
fn docs_scenario_is_what_init_writes() {
    let sandbox = Sandbox::new();
    let plan = Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans/museum.png");
    sandbox.write("museum.png", fs::read(plan).unwrap());
    sandbox.run(&["init", "museum.png", "--metres-per-pixel", "0.05"]).succeeds();
    let written = fs::read_to_string(sandbox.path("museum.toml")).unwrap();
    snapbox::assert_data_eq!(written, snapbox::file!["../../docs/scenario.toml"].raw());
}

/// What editors read, beside it.
#[test]
fn init_prints_the_schema_of_the_docs() {
    let sandbox = Sandbox::new();
    let schema = sandbox.run(&["init", "--schema"]).succeeds().out;
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/scenario.schema.json");
    assert_eq!(schema, fs::read_to_string(docs).unwrap());
}
