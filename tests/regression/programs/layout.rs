//! Where textures keep their data.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use super::super::sandbox::Sandbox;

/// Bakes the corridor coarsely.
fn bake(sandbox: &Sandbox, folder: &str, more: &[&str]) {
    sandbox.plan();
    let start = ["bake", "plan.png", "--metres-per-pixel", "0.1", "--people", "20", "-o", folder];
    // A quick bake leaves layers out.
    let coarse: &[&str] = if more.contains(&"--floor-only") { &["--texels-per-metre", "25"] } else { &["--quick"] };
    sandbox.run(&[&start[..], coarse, more].concat()).succeeds();
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = entries.collect();
    names.sort();
    names
}

fn manifest(bake: &Path) -> serde_json::Value {
    serde_json::from_slice(&fs::read(bake.join("manifest.json")).unwrap()).unwrap()
}

/// Many programs multiply colours by alpha: masks came out black where nothing lay on the edge.
#[test]
fn no_mask_has_its_data_in_alpha() {
    for target in ["gltf", "blender", "unreal", "unity", "godot"] {
        let sandbox = Sandbox::new();
        bake(&sandbox, "out", &["--target", target]);
        let out = sandbox.path("out");
        let manifest = manifest(&out);
        let tile = &manifest["floor"]["tiles"][0];
        let sheet = &manifest["walls"]["sheets"][0];
        let colour = |file: &serde_json::Value| image::open(out.join(file.as_str().unwrap())).unwrap().color();
        for (entry, lone) in [(tile, "passes"), (sheet, "splash")] {
            assert_eq!(colour(&entry["mask"]), image::ColorType::Rgb8, "{target}");
            assert_eq!(colour(&entry[lone]), image::ColorType::L8, "{target}");
        }
        let holds: BTreeMap<String, String> =
            manifest["floor"]["channels"].as_array().unwrap().iter().fold(BTreeMap::new(), |mut all, channel| {
                let text = |key: &str| channel[key].as_str().unwrap().to_string();
                all.insert(format!("{} {}", text("image"), text("channel")), text("holds"));
                all
            });
        assert!(holds["mask R"].starts_with("film") && holds["mask G"].contains("prints"), "{holds:?}");
        assert!(holds["mask B"].starts_with("edge") && holds["passes Y"].starts_with("passes"), "{holds:?}");
        assert!(!holds.contains_key("mask A"));
    }
}

/// Blender shows a file of layers black unless each channel belongs to a layer by its name.
#[test]
fn channels_of_layers_belong_to_layers() {
    let sandbox = Sandbox::new();
    bake(&sandbox, "out", &["--floor-only"]);
    let path = sandbox.path("out/floor/floor_layers.1001.exr");
    let image = exr::prelude::read_first_flat_layer_from_file(path).unwrap();
    let channels: Vec<String> = image.layer_data.channel_data.list.iter().map(|c| c.name.to_string()).collect();
    assert_eq!(
        channels,
        ["dust.V", "dwell.V", "edge.V", "film.V", "grind.V", "passes.V", "presence.V", "scuff.V", "soil.V", "wheels.V"]
    );
    let manifest = manifest(&sandbox.path("out"));
    let told: Vec<&str> = (manifest["floor"]["channels"].as_array().unwrap().iter())
        .filter(|channel| channel["image"] == "layers")
        .map(|channel| channel["channel"].as_str().unwrap())
        .collect();
    assert_eq!(told, channels);
}

/// Engines imported the largest images of a bake, which games do not use.
#[test]
fn game_engines_get_layers_only_if_asked() {
    let sandbox = Sandbox::new();
    bake(&sandbox, "out", &["--floor-only", "--target", "godot"]);
    let layers = |sandbox: &Sandbox| {
        let all = names(&sandbox.path("out/floor"));
        all.into_iter().filter(|name| name.ends_with(".exr")).count()
    };
    assert_eq!(layers(&sandbox), 0);
    sandbox.run(&["resolve", "out", "--layers"]).succeeds();
    // Nine channels, four to a file.
    assert_eq!(layers(&sandbox), 3);
    sandbox.run(&["resolve", "out", "--target", "gltf"]).succeeds();
    assert_eq!(layers(&sandbox), 1);
    // What was not asked for follows the target.
    sandbox.run(&["resolve", "out", "--target", "unity"]).succeeds();
    assert_eq!(layers(&sandbox), 0);
}

/// Godot imported sums and previews as textures.
#[test]
fn godot_passes_over_folders_without_assets() {
    let sandbox = Sandbox::new();
    bake(&sandbox, "out", &["--floor-only", "--target", "godot"]);
    for folder in ["sums", "preview"] {
        assert!(sandbox.path(&format!("out/{folder}/.gdignore")).is_file(), "{folder}");
    }
    assert!(!sandbox.path("out/shaders/.gdignore").exists());
    // Written again, not kept and written.
    sandbox.run(&["resolve", "out", "--preset", "wet"]).succeeds();
    assert!(sandbox.path("out/sums/.gdignore").is_file());
    sandbox.run(&["resolve", "out", "--target", "gltf"]).succeeds();
    assert!(!sandbox.path("out/sums/.gdignore").exists());
}
