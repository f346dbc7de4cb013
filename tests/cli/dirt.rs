//! Dirt over a clean surface gives the colours of the bake: as an image of its own, and as the shaders lay the masks.

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

/// A surface under masks, by the law of the shaders in `shaders/`.
fn under_masks(clean: [f64; 3], masks: [u8; 4], colours: [[u8; 3]; 4]) -> [f64; 3] {
    let density = masks.map(|mask| -libm::log((1.0 - f64::from(mask) / 255.0).max(0.002)));
    let total: f64 = density.iter().sum();
    let through = libm::exp(-total);
    [0, 1, 2].map(|k| {
        let dirt: f64 = density.iter().zip(colours).map(|(density, colour)| density * light(colour[k])).sum();
        dirt / total.max(1e-6) * (1.0 - through) + clean[k] * through
    })
}

/// How far lightness is off: in the mean, and what 99 % are below.
fn mean_and_most(mut off: Vec<f64>) -> (f64, f64) {
    off.sort_by(f64::total_cmp);
    (off.iter().sum::<f64>() / off.len() as f64, off[off.len() * 99 / 100])
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
        let soil = [100, 89, 70];
        let floor = (&manifest["floor"]["tiles"][0], "wear", 1, [soil, soil, soil, [38, 39, 43]]);
        let colours = [[121, 103, 74], [112, 106, 99], [38, 39, 43], [80, 69, 52]];
        let wall = (&manifest["walls"]["sheets"][0], "splash", 0, colours);
        for (texture, fourth, channel, colours) in [floor, wall] {
            let path = |kind: &str| sandbox.path("out").join(texture[kind].as_str().unwrap());
            let rgb = |path: &Path| -> RgbImage { image::open(path).unwrap().into_rgb8() };
            let dirt: RgbaImage = image::open(path("dirt")).unwrap().into_rgba8();
            let (shown, clean) = (rgb(&path("basecolor")), rgb(&path("clean")));
            let (three, fourth) = (rgb(&path("mask")), rgb(&path(fourth)));
            let (mut off, mut off_by_masks) = (Vec::new(), Vec::new());
            let mut changed = 0;
            let pixels = shown.pixels().zip(clean.pixels()).zip(dirt.pixels()).zip(three.pixels().zip(fourth.pixels()));
            for (((shown, clean), dirt), (three, fourth)) in pixels {
                let (shown, clean) = (shown.0.map(light), clean.0.map(light));
                let [a, b, c] = three.0;
                let by_masks = under_masks(clean, [a, b, c, fourth.0[channel]], colours);
                off.push((lightness(over(clean, dirt.0)) - lightness(shown)).abs());
                off_by_masks.push((lightness(by_masks) - lightness(shown)).abs());
                changed += usize::from(lightness(clean) - lightness(shown) > 2.0);
            }
            let texels = off.len();
            let ((mean, most), (mean_of_law, most_of_law)) = (mean_and_most(off), mean_and_most(off_by_masks));
            println!("{material}, {}: {mean:.3} L* off, 99 % below {most:.2}, {changed} soiled", texture["dirt"]);
            println!("  by masks: {mean_of_law:.3} L* off, 99 % below {most_of_law:.2}");
            assert!(changed > texels / 100, "only {changed} texels of {texels} are soiled");
            assert!(mean < 0.3 && most < 1.0, "{mean} L*, {most} L*");
            assert!(mean_of_law < 0.4 && most_of_law < 2.0, "by masks: {mean_of_law} L*, {most_of_law} L*");
        }
        // Another look and another target keep them.
        sandbox.run(&["resolve", "out", "--target", "unity", "-o", "unity", "--force", "-q"]).succeeds();
        assert!(sandbox.path("unity/floor/Floor_Dirt_1001.png").is_file());
        assert!(sandbox.path("unity/walls/Wall_Clean_1001.png").is_file());
    }
}
