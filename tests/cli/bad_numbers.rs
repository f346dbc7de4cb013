//! Numbers that are none, or make no sense.

use super::sandbox::Sandbox;

#[test]
fn options_refuse_absurd_numbers() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    for option in ["--people", "--seed", "--texels-per-metre", "--metres-per-pixel", "--threads"] {
        sandbox.run(&["bake", "plan.png", option, "-inf"]).fails(2, &[]);
        for value in ["nan", "inf", "-1", "-0.5", "1e300", "1e-300", "99999999999999999999", "many", "", "0x10"] {
            sandbox.run(&["bake", "plan.png", option, value]).fails(2, &[option]);
        }
        if option != "--seed" {
            sandbox.run(&["bake", "plan.png", option, "0"]).fails(2, &[option]);
        }
    }
    sandbox.run(&["bake", "plan.png", "--people", "2.5"]).fails(2, &["whole number"]);
    sandbox.run(&["bake", "plan.png", "--texels-per-metre", "1001"]).fails(2, &["1 to 1000"]);
    sandbox.run(&["bake", "plan.png", "--preset", "papper"]).fails(2, &["'paper'"]);
}

#[test]
fn options_that_contradict_each_other_are_refused() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.run(&["bake", "plan.png", "--quick", "--texels-per-metre", "50"]).fails(2, &["--quick"]);
    sandbox.run(&["bake", "plan.png", "-q", "-v"]).fails(2, &["--quiet"]);
    sandbox.run(&["resolve", "out", "--look", "a.toml", "--preset", "wet"]).fails(2, &["--preset"]);
    sandbox.run(&["resolve", "out"]).fails(2, &["--look"]);
    sandbox.run(&["bake"]).fails(2, &["SCENARIO"]);
    sandbox.run(&["bakee", "plan.png"]).fails(2, &["bake"]);
    sandbox.run(&["bake", "plan.png", "--peopl", "3"]).fails(2, &["--people"]);
}

#[test]
fn scenarios_refuse_absurd_numbers_and_show_where_they_stand() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let keys = [
        ("plan", "metres_per_pixel"),
        ("plan", "wall_height"),
        ("plan", "speck_m"),
        ("plan", "narrowest_m"),
        ("walls", "tolerance_px"),
        ("texture", "floor_texels_per_metre"),
        ("texture", "wall_texels_per_metre"),
        ("texture", "tile"),
        ("crowd", "people"),
        ("crowd", "speed"),
        ("crowd", "exclusion"),
        ("crowd", "entry_rate"),
        ("crowd", "time_step"),
        ("bodies", "stature_men"),
        ("marks.soil", "median_density"),
        ("marks.heel", "per_metre"),
        ("stamps", "noise"),
        ("look", "total_passes"),
        ("look.film", "density"),
    ];
    for (section, key) in keys {
        for value in ["nan", "inf", "-inf", "-1", "-1e300", "1e300"] {
            let text = match section {
                "plan" => format!("[plan]\nimage = \"plan.png\"\n{key} = {value}\n"),
                section => format!("[plan]\nimage = \"plan.png\"\n[{section}]\n{key} = {value}\n"),
            };
            sandbox.write("plan.toml", text);
            let place = if section == "plan" { " --> plan.toml:3:" } else { " --> plan.toml:4:" };
            sandbox
                .run(&["bake", "plan.toml"])
                .fails(1, &[key, value, place].map(|part| if part == "nan" { "^" } else { part }));
        }
    }
}

#[test]
fn wall_heights_are_those_of_the_building_law() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let text = |height: &str| format!("[plan]\nimage = \"plan.png\"\nmetres_per_pixel = 0.1\nwall_height = {height}\n");
    for height in ["2.09", "3.5", "0", "-2.6", "nan", "1e9"] {
        sandbox.write("plan.toml", text(height));
        sandbox
            .run(&["bake", "plan.toml"])
            .fails(1, &["wall_height", "at least 2.1", "less than 3.5", "plan.toml:4:15"]);
    }
    for height in ["2.1", "3.499"] {
        sandbox.write("plan.toml", text(height));
        sandbox.run(&["inspect", "plan.toml"]).succeeds();
    }
}
