//! What is said about what is wrong.

use std::fs;

use image::GrayImage;

use super::super::sandbox::Sandbox;

fn scenario(rest: &str) -> String {
    format!("[plan]\nimage = \"plan.png\"\nmetres_per_pixel = 0.1\n{rest}")
}

#[test]
fn a_map_that_does_not_exist_hints_at_the_nearest_map_only() {
    let sandbox = Sandbox::new();
    for name in ["berlin", "columbia"] {
        GrayImage::new(4, 4).save(sandbox.path(&format!("{name}.png"))).unwrap();
        sandbox.write(&format!("{name}.yaml"), format!("image: {name}.png\nresolution: 0.05\norigin: [0, 0, 0]\n"));
    }
    let ran = sandbox.run(&["inspect", "porto.yaml"]).fails(1, &["porto.yaml"]);
    assert!(!ran.err.contains("berlin") && !ran.err.contains("columbia"), "{}", ran.err);
    sandbox.run(&["inspect", "berlim.yaml"]).fails(1, &["did you mean berlin.yaml?"]);
    sandbox.write("porto.yaml", "image: porto.png\nresolution: 0.05\norigin: [0, 0, 0]\n");
    let ran = sandbox.run(&["inspect", "porto.yaml"]).fails(1, &["porto.png, which does not exist"]);
    assert!(!ran.err.contains("berlin") && !ran.err.contains("columbia"), "{}", ran.err);
    sandbox.write("porto.yaml", "image: colombia.png\nresolution: 0.05\norigin: [0, 0, 0]\n");
    sandbox.run(&["inspect", "porto.yaml"]).fails(1, &["columbia.png lies beside it"]);
}

#[test]
fn a_coordinate_out_of_range_is_told_with_its_range() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    for (rest, parts) in [
        ("[[door]]\nat = [1e9, 2]\n", ["`at` is 1000000000", "allowed is -10000000 to 10000000"]),
        ("[[fixture]]\nkind = \"bin\"\nat = [1, -1e9]\n", ["`at` is -1000000000", "allowed is -10000000 to 10000000"]),
        (
            "[[route]]\nfrom = [[1e9, 2], [1e9, 3]]\nto = \"east\"\n",
            ["coordinate 1000000000 m", "allowed is -10000000 to 10000000"],
        ),
        ("[bodies]\nstature_men = { mean = 1.7, sd = 1e308 }\n", ["`stature_men`", "allowed is 0.5 to 2.5"]),
    ] {
        sandbox.write("far.toml", scenario(rest));
        let ran = sandbox.run(&["bake", "far.toml", "--people", "1"]);
        let told = parts.iter().all(|part| ran.err.contains(part)) && !ran.err.contains("finite");
        assert!(ran.code == Some(1) && told, "{rest}: {}", ran.err);
    }
}

#[test]
fn control_characters_in_names_do_not_reach_the_terminal() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let names = "[[route]]\nname = \"a\\u001b[2Jb\\u202ec\"\nfrom = \"west\"\nto = \"east\"\n";
    sandbox.write("route.toml", scenario(names));
    let ran = sandbox.run(&["inspect", "route.toml"]).succeeds();
    assert!(ran.out.contains("a\\u{1b}[2Jb\\u{202e}c"), "{}", ran.out);
    sandbox.write("lost.toml", scenario(&names.replace("\"east\"", "\"nowhere\"")));
    let ran = sandbox.run(&["inspect", "lost.toml"]).fails(1, &["\\u{1b}[2J"]);
    assert!(!ran.err.contains('\u{1b}'));
    let ran = sandbox.run(&["inspect", "no\u{1b}[2J\u{7}.png"]).fails(1, &["no\\u{1b}[2J\\u{7}.png"]);
    assert!(!ran.err.contains('\u{1b}') && !ran.err.contains('\u{7}'));
}

#[test]
fn an_output_past_a_folder_that_is_not_there_makes_no_such_folder() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let quick =
        ["bake", "plan.png", "--metres-per-pixel", "0.1", "--texels-per-metre", "5", "--people", "1", "--floor-only"];
    sandbox.run(&[&quick[..], &["-o", "nope/../c"]].concat()).succeeds();
    assert!(sandbox.path("c/manifest.json").is_file() && !sandbox.path("nope").exists());
    fs::remove_dir_all(sandbox.path("c")).unwrap();
    // Nor where nothing comes of it.
    sandbox.run(&["bake", "none.png", "-o", "nope/../c"]).fails(1, &[]);
}

#[test]
fn the_manifest_says_what_the_masks_of_walls_hold() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let quick =
        ["bake", "plan.png", "--metres-per-pixel", "0.1", "--texels-per-metre", "5", "--people", "1", "-o", "out"];
    sandbox.run(&quick).succeeds();
    let json: serde_json::Value =
        serde_json::from_slice(&fs::read(sandbox.path("out/manifest.json")).unwrap()).unwrap();
    let holds = |channel: &str| {
        let all = json["walls"]["channels"].as_array().unwrap();
        let image = if channel == "Y" { "splash" } else { "mask" };
        let found = all.iter().find(|entry| entry["image"] == image && entry["channel"] == channel);
        found.unwrap()["holds"].as_str().unwrap().to_string()
    };
    assert!(holds("R").contains("hands") && !holds("R").contains("shoulders"), "{}", holds("R"));
    assert!(["arms", "shoulders", "bags"].iter().all(|part| holds("G").contains(part)), "{}", holds("G"));
    assert!(holds("B").contains("shoes"), "{}", holds("B"));
    assert!(["splash", "dust"].iter().all(|part| holds("Y").contains(part)), "{}", holds("Y"));
}
