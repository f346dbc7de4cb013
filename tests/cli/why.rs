//! `trodden why`: what made a place of a finished bake.

use image::{GrayImage, Luma};
use serde_json::Value;

use super::sandbox::Sandbox;

/// A corridor of 8 x 2.5 m in walls of 1.5 m and more, with a desk in the north that everybody stops at, on a wet day.
fn baked() -> Sandbox {
    let sandbox = Sandbox::new();
    let plan = GrayImage::from_fn(80, 60, |_, y| Luma([if (20..45).contains(&y) { 255 } else { 0 }]));
    plan.save(sandbox.path("plan.png")).unwrap();
    let scenario = "[plan]\nimage = \"plan.png\"\nmetres_per_pixel = 0.1\n[crowd]\npeople = 40\npreset = \"wet\"\n\
        [[stop]]\nname = \"desk\"\nkind = \"machine\"\nat = [2.0, 3.6]\n\
        [[route]]\nname = \"by the desk\"\nfrom = \"west\"\nto = \"east\"\nshare = 0.75\nvia = [\"desk\"]\n\
        [[route]]\nname = \"back\"\nfrom = \"east\"\nto = \"west\"\nshare = 0.25\n";
    sandbox.write("plan.toml", scenario);
    sandbox.run(&["-q", "bake", "plan.toml", "--texels-per-metre", "25", "-o", "out"]).succeeds();
    sandbox
}

fn why(sandbox: &Sandbox, bake: &str, at: &str) -> Value {
    let ran = sandbox.run(&["why", bake, "--at", at, "--json"]).succeeds();
    assert!(ran.made().is_empty() && ran.err.is_empty(), "{ran:?}");
    serde_json::from_str(&ran.out).unwrap()
}

/// The density of a cause; 0 if it is not told.
fn of(reasons: &Value, cause: &str) -> f64 {
    let found = reasons.as_array().unwrap().iter().find(|reason| reason["cause"] == cause);
    found.map_or(0.0, |reason| reason["density"].as_f64().unwrap())
}

#[test]
fn a_place_is_told_by_its_causes_routes_and_what_is_near() {
    let sandbox = baked();
    let middle = why(&sandbox, "out", "6,2.75");
    let by_the_wall = why(&sandbox, "out", "6,1.55");
    let desk = why(&sandbox, "out", "2,3.4");
    let sum = |place: &Value, name: &str| place["sums"][name].as_f64().unwrap_or_default();

    // Where people walk: many passes, and their film. Where nobody can: the dirt along the skirting. Where they come in:
    // the dirt of wet shoes.
    let passes = |place: &Value| place["passes"].as_f64().unwrap();
    assert!(passes(&middle) > 5.0 * passes(&by_the_wall), "{middle:#} {by_the_wall:#}");
    assert_eq!(middle["floor"][0]["cause"], "film of all passes", "{middle:#}");
    let (entrance, wet) = (why(&sandbox, "out", "0.5,2.75"), "wet shoes");
    assert!(of(&entrance["floor"], wet) > 5.0 * of(&middle["floor"], wet).max(1e-3), "{entrance:#}");
    assert_eq!(entrance["near"][0][0], "opening west");
    let edge = "edge at the skirting";
    assert!(of(&by_the_wall["floor"], edge) > 0.02 && of(&middle["floor"], edge) == 0.0, "{by_the_wall:#}");
    assert!(middle["wall"].is_null(), "{middle:#}");
    let wall = &by_the_wall["wall"];
    assert!((wall["distance_m"].as_f64().unwrap() - 0.05).abs() < 0.02, "{wall:#}");

    // At the desk people stand, and turn.
    assert!(sum(&desk, "dwell") > 20.0 && sum(&desk, "grind") > 2.0 * sum(&middle, "grind"), "{desk:#} {middle:#}");
    assert!(of(&desk["floor"], "standing") > 0.02, "{desk:#}");
    assert_eq!(desk["near"][0][0], "stop desk");

    // Both ways lead over the middle, three people to one.
    let routes = middle["routes"].as_array().unwrap();
    assert_eq!((routes[0]["name"].as_str(), routes.len()), (Some("by the desk"), 2), "{middle:#}");
    assert!((0.6..0.9).contains(&routes[0]["share"].as_f64().unwrap()), "{middle:#}");

    // A look without film has none, and so the share of all others grows.
    sandbox.write("bare.toml", "preset = \"wet\"\n[film]\ndensity = 0.0\n");
    sandbox.run(&["-q", "resolve", "out", "--look", "bare.toml", "-o", "bare"]).succeeds();
    let bare = why(&sandbox, "bare", "6,2.75");
    assert_eq!((of(&bare["floor"], "film of all passes"), &bare["sums"]), (0.0, &middle["sums"]));

    let told = sandbox.run(&["why", "out", "--at", "2,3.6", "--within", "0.4"]).succeeds().out;
    for part in
        ["[2.00, 3.60] and 0.4 m around it", "film of all passes", "by the desk", "near: stop desk", "near: wall "]
    {
        assert!(told.contains(part), "no {part:?} in:\n{told}");
    }
}

#[test]
fn places_without_floor_or_wall_are_refused() {
    let sandbox = baked();
    let refused = |at: &str, code: i32, says: &[&str]| {
        sandbox.run(&["why", "out", "--at", at]).fails(code, says);
    };
    refused("4,0.3", 1, &["[4.00, 0.30] is neither on the floor nor near a wall", "hint: ", "[4.00, 1.50]"]);
    refused("-1,2", 1, &["[-1.00, 2.00] lies beyond the plan", "0 to 8.00 and 0 to 6.00 m", "hint: "]);
    refused("4", 2, &["two numbers"]);
    refused("4,nan", 2, &["two numbers"]);
    sandbox.run(&["why", "plan.png", "--at", "4,2"]).fails(1, &["manifest.json"]);
    sandbox.run(&["why", "out", "--at", "4,2", "--within", "9"]).fails(2, &["0.01 to 2"]);
}
