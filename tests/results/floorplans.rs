//! The sample plans: drawn by the example, readable, and every scenario leads where it says.

use std::fs;
use std::path::{Path, PathBuf};

use trodden::plan;
use trodden::routes;
use trodden::scenario::{Overrides, Scenario};
use trodden::walls::Walls;

#[path = "../../examples/draw_floorplans/main.rs"]
mod draw_floorplans;

/// Samples whose floor is open ground around a motion that they make.
const WITHOUT_A_PLAN: [&str; 2] = ["cavalry.toml", "swimming.toml"];
/// Samples on the plan of another.
const ON_ANOTHERS_PLAN: [&str; 1] = ["paper"];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans")
}

#[test]
fn the_images_are_what_the_example_draws() {
    for (name, draw) in draw_floorplans::PLANS {
        let drawn = draw_floorplans::png_bytes(&draw()).unwrap();
        let kept = fs::read(folder().join(name).with_extension("png")).unwrap();
        // Another version of the encoder may pack the same pixels into other bytes.
        let pixels = |png: &[u8]| image::load_from_memory(png).unwrap().into_luma8();
        let same = pixels(&drawn) == pixels(&kept);
        assert!(same, "floorplans/{name}.png differs: run `cargo run --example draw_floorplans`");
        assert!(kept.len() < 64 << 10, "floorplans/{name}.png has {} bytes", kept.len());
    }
}

#[test]
fn every_image_has_a_scenario_and_none_is_left_over() {
    let mut names: Vec<String> =
        fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    // The folder of crowd units.
    names.retain(|name| name != "units");
    names.sort();
    let mut expected: Vec<String> =
        draw_floorplans::PLANS.iter().flat_map(|(name, _)| [format!("{name}.png"), format!("{name}.toml")]).collect();
    expected.extend(WITHOUT_A_PLAN.map(str::to_string));
    expected.extend(ON_ANOTHERS_PLAN.map(|name| format!("{name}.toml")));
    expected.sort();
    assert_eq!(names, expected);
}

#[test]
fn every_route_of_every_scenario_is_found() {
    for name in draw_floorplans::PLANS.map(|(name, _)| name).into_iter().chain(ON_ANOTHERS_PLAN) {
        let path = folder().join(name).with_extension("toml");
        let scenario = Scenario::open(&path, &Overrides::default()).unwrap_or_else(|error| panic!("{error}"));
        let plan = plan::read(&scenario.plan_path().unwrap(), &scenario.plan_options())
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(plan.warnings.is_empty(), "{name}: {:?}", plan.warnings);
        let walls = Walls::trace(&plan, &scenario.walls);
        let found = routes::find(&plan, &walls, &scenario.routes).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(found.len(), scenario.routes.routes.len());
        assert!(found.iter().all(|route| route.length_m > 5.0), "{name}");
    }
}

/// What a user gets who gives the image alone.
#[test]
fn every_image_alone_has_openings_and_default_routes() {
    for (name, openings) in [("corridors", 8), ("station", 6), ("school", 2), ("museum", 2), ("plaza", 4)] {
        let path = folder().join(name).with_extension("png");
        let scenario = Scenario::open(&path, &Overrides::default()).unwrap();
        let plan = plan::read(&path, &scenario.plan_options()).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(plan.openings.len(), openings, "{name}: {:?}", plan.openings);
        let walls = Walls::trace(&plan, &scenario.walls);
        assert!(!routes::find(&plan, &walls, &scenario.routes).unwrap().is_empty(), "{name}");
    }
}
