//! `trodden batch`: many bakes of one scenario.

use std::fs;

use serde_json::Value;

use super::sandbox::{Ran, Sandbox};

const SCENARIO: &str = "[plan]\nimage = \"plan.png\"\nmetres_per_pixel = 0.1\n[crowd]\npeople = 12\n";
const QUICK: [&str; 4] = ["--texels-per-metre", "12", "-o", "many"];

fn run(sandbox: &Sandbox, arguments: &[&str]) -> Ran {
    sandbox.run(&[&["batch", "plan.toml"], &QUICK[..], arguments].concat())
}

#[test]
fn every_bake_of_a_batch_is_that_of_its_own_and_an_interrupted_batch_goes_on() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.write("plan.toml", SCENARIO);
    sandbox.write("dark.toml", "total_passes = 1000\n[floor]\nmaterial = \"dark\"\n");
    let all = ["--seeds", "1,4", "--look", "heavy", "--look", "dark.toml", "--passes", "1e3,1e5"];
    let told = run(&sandbox, &all).succeeds().out;
    assert!(told.starts_with("8 of 8 bakes are new"), "{told}");

    let list: Value = serde_json::from_slice(&fs::read(sandbox.path("many/batch.json")).unwrap()).unwrap();
    let told: Vec<String> = list["bakes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|bake| {
            format!("{} {} {} {}", bake["folder"].as_str().unwrap(), bake["seed"], bake["look"], bake["total_passes"])
        })
        .collect();
    assert_eq!((told.len(), told[0].as_str()), (8, "00001 1 \"heavy\" 1000"));
    assert_eq!(told[6..], ["00007 4 \"dark\" 1000", "00008 4 \"dark\" 100000"]);
    let floor = |number: u32, file: &str| fs::read(sandbox.path(&format!("many/0000{number}/{file}"))).unwrap();
    let (sums, colour) = ("sums/floor_sums.1001.exr", "floor/floor_basecolor.1001.png");
    assert!(floor(5, sums) == floor(8, sums) && floor(1, sums) != floor(5, sums), "sums are those of a seed");
    let colours: Vec<_> = (1..=8).map(|number| floor(number, colour)).collect();
    assert!((1..8).all(|k| !colours[..k].contains(&colours[k])), "each floor is another one");

    // By itself, on one thread.
    sandbox.write("one.toml", format!("{SCENARIO}[look]\nfile = \"dark.toml\"\n"));
    let one = ["-q", "bake", "one.toml", "--seed", "4", "--texels-per-metre", "12", "--threads", "1", "-o", "one"];
    sandbox.run(&one).succeeds();
    sandbox.run(&["diff", "one", "many/00007"]).succeeds();

    // What is missing is baked again, and nothing else.
    fs::remove_dir_all(sandbox.path("many/00006")).unwrap();
    let before = sandbox.contents();
    let ran = run(&sandbox, &all).succeeds();
    assert!(ran.out.starts_with("1 of 8 bakes are new"), "{}", ran.out);
    assert!(ran.made().iter().all(|path| path.starts_with(sandbox.path("many/00006"))), "{:?}", ran.made());
    let after = sandbox.contents();
    assert!(before.iter().all(|(path, bytes)| after[path] == *bytes), "a bake that was there has changed");
    assert!(floor(6, colour) == colours[5]);

    // Another batch does not mix with it.
    run(&sandbox, &["--seeds", "1..3"]).fails(1, &["another batch", "`bakes[0].look`", "hint: choose another folder"]);
    sandbox.write("dark.toml", "total_passes = 1000\n[floor]\nmaterial = \"wood\"\n");
    run(&sandbox, &all).fails(1, &["another batch", "looks[1].look.floor.material"]);
}

/// With another preset, a bake resolved again and a bake of a batch are what a bake of the scenario with it is: its wood stays.
#[test]
fn another_preset_keeps_what_the_scenario_changes() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.write("plan.toml", format!("{SCENARIO}[look]\ntotal_passes = 3000\nfloor = {{ material = \"wood\" }}\n"));
    let bake = |folder: &str, more: &[&str]| {
        let all = ["-q", "bake", "plan.toml", "--texels-per-metre", "12", "-o", folder];
        sandbox.run(&[&all[..], more].concat()).succeeds();
    };
    bake("dry", &[]);
    bake("heavy", &["--preset", "heavy"]);
    sandbox.run(&["resolve", "dry", "--preset", "heavy", "-o", "again", "-q"]).succeeds();
    run(&sandbox, &["--look", "heavy"]).succeeds();
    let colours = |folder: &str| {
        ["floor/floor", "walls/wall"]
            .map(|name| fs::read(sandbox.path(&format!("{folder}/{name}_basecolor.1001.png"))).unwrap())
    };
    let heavy = colours("heavy");
    assert!(heavy == colours("again") && heavy == colours("many/00001") && heavy != colours("dry"));
}

#[test]
fn what_makes_no_batch_is_refused_before_any_bake() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.write("plan.toml", SCENARIO);
    sandbox.write("wet.toml", "preset = \"wet\"\n[film]\ndensity = 0.1\n");
    run(&sandbox, &["--seeds", "3,1..4"]).fails(2, &["each once"]);
    run(&sandbox, &["--seeds", "4..3"]).fails(2, &["1..100"]);
    run(&sandbox, &["--passes", "1e3,1000"]).fails(2, &["--passes has a number twice"]);
    run(&sandbox, &["--seeds", "1..90000", "--passes", "1e3,1e4"]).fails(2, &["180000 bakes", "99999"]);
    run(&sandbox, &["--look", "wet", "--look", "wet.toml"]).fails(1, &["the name \"wet\"", "hint: rename"]);
    run(&sandbox, &["--look", "none.toml"]).fails(1, &["none.toml"]);
}
