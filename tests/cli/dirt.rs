//! Dirt as images of its own: laid over the clean surface it gives the colours of the bake.

use std::path::Path;

use image::{RgbImage, RgbaImage};

use super::sandbox::Sandbox;

fn light(byte: u8) -> f64 {
    let s = f64::from(byte) / 255.0;
    if s <= 0.04045 { s / 12.92 } else { libm::pow((s + 0.055) / 1.055, 2.4) }
}

fn lightness(rgb: [f64; 3]) -> f64 {
    let y = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    if y > 216.0 / 24389.0 { 116.0 * y.cbrt() - 16.0 } else { y * 24389.0 / 27.0 }
}

/// Over another surface: a colour between that and the dirt's.
fn over(clean: [f64; 3], dirt: [u8; 4]) -> [f64; 3] {
    let opacity = f64::from(dirt[3]) / 255.0;
    [0, 1, 2].map(|k| clean[k] + (light(dirt[k]) - clean[k]) * opacity)
}

#[test]
fn dirt_over_the_clean_surface_gives_the_bake() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    // A light floor, and one with joints and gloss; heavy dirt on both.
    for (material, target) in [("vinyl", "unreal"), ("tile", "godot")] {
        sandbox.write(
            "plan.toml",
            format!(
                "[plan]\nimage = \"plan.png\"\nmetres_per_pixel = 0.1\n[crowd]\npeople = 60\n\
                 [texture]\nfloor_texels_per_metre = 40\nwall_texels_per_metre = 40\ndirt = true\n\
                 [look]\npreset = \"heavy\"\nfloor = {{ material = \"{material}\" }}\n"
            ),
        );
        sandbox.run(&["bake", "plan.toml", "-o", "out", "--target", target, "--force", "-q"]).succeeds();
        let manifest: serde_json::Value =
            serde_json::from_str(&std::fs::read_to_string(sandbox.path("out/manifest.json")).unwrap()).unwrap();
        for texture in [&manifest["floor"]["tiles"][0], &manifest["walls"]["sheets"][0]] {
            let path = |kind: &str| sandbox.path("out").join(texture[kind].as_str().unwrap());
            let rgb = |path: &Path| -> RgbImage { image::open(path).unwrap().into_rgb8() };
            let dirt: RgbaImage = image::open(path("dirt")).unwrap().into_rgba8();
            let (shown, clean) = (rgb(&path("basecolor")), rgb(&path("clean")));
            let mut off: Vec<f64> = Vec::new();
            let mut changed = 0;
            for ((shown, clean), dirt) in shown.pixels().zip(clean.pixels()).zip(dirt.pixels()) {
                let (shown, clean) = (shown.0.map(light), clean.0.map(light));
                off.push((lightness(over(clean, dirt.0)) - lightness(shown)).abs());
                changed += usize::from(lightness(clean) - lightness(shown) > 2.0);
            }
            off.sort_by(f64::total_cmp);
            let mean = off.iter().sum::<f64>() / off.len() as f64;
            let most = off[off.len() * 99 / 100];
            println!("{material}, {}: {mean:.3} L* off, 99 % below {most:.2}, {changed} soiled", texture["dirt"]);
            assert!(changed > off.len() / 100, "only {changed} texels of {} are soiled", off.len());
            assert!(mean < 0.3 && most < 1.0, "{mean} L*, {most} L*");
            // On a black floor it is lighter than that, and no darker than the floor where it is clear.
            let on_black = dirt.pixels().filter(|dirt| dirt.0[3] > 60).map(|dirt| lightness(over([0.02; 3], dirt.0)));
            assert!(on_black.clone().count() == 0 || on_black.fold(0.0, f64::max) > lightness([0.03; 3]));
        }
        // Another look and another target keep them.
        sandbox.run(&["resolve", "out", "--target", "unity", "-o", "unity", "--force", "-q"]).succeeds();
        assert!(sandbox.path("unity/floor/Floor_Dirt_1001.png").is_file());
        assert!(sandbox.path("unity/walls/Wall_Clean_1001.png").is_file());
    }
}
