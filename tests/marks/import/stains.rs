//! The stain that comes out is the one that was photographed.

use image::GrayImage;
use rayon::prelude::*;
use trodden::patterns::{Cause, ImportOptions, ImportedPattern, PhotoScale, import_picture};

use super::photograph::{Scene, blot, built_in, ring, streaks};

/// Least correlation with the truth, and by how much the density at the peak may be off.
const CORRELATION: f64 = 0.95;
const PEAK: f64 = 0.15;

/// How a photograph is taken.
type Condition = (&'static str, fn(Scene) -> Scene);

fn options(scene: &Scene) -> ImportOptions {
    ImportOptions {
        cause: Cause::Hand,
        form: None,
        size: PhotoScale::PxPerCm(scene.px_per_cm),
        crop: None,
        rotate_deg: -scene.turned_deg,
    }
}

/// Imports a scene; what is wrong with it, in words.
fn problems(name: &str, case: &str, scene: &Scene, options: &ImportOptions) -> Option<String> {
    let import = match ImportedPattern::from_photo(&scene.photograph(), options) {
        Ok(import) => import,
        Err(error) => return Some(format!("{name}, {case}: {error}")),
    };
    let correlation = scene.correlation(&import);
    let peak = import.peak_density / scene.density - 1.0;
    let fits = correlation >= CORRELATION && peak.abs() <= PEAK && import.lighter == scene.lighter;
    (!fits).then(|| {
        format!("{name}, {case}: correlation {correlation:.3}, peak {:+.0} %, lighter {}", 100.0 * peak, import.lighter)
    })
}

/// Every stain under every condition.
fn all_are_found(stains: Vec<(&str, GrayImage)>, conditions: &[Condition]) {
    let cases: Vec<_> = stains.iter().flat_map(|stain| conditions.iter().map(move |case| (stain, case))).collect();
    let wrong: Vec<String> = cases
        .into_par_iter()
        .filter_map(|((name, stain), (case, change))| {
            let scene = change(Scene::of(stain.clone()));
            problems(name, case, &scene, &options(&scene))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn own_stains() -> Vec<(&'static str, GrayImage)> {
    vec![("blot", blot()), ("ring", ring()), ("streaks", streaks())]
}

fn library_s(names: &[&'static str]) -> Vec<(&'static str, GrayImage)> {
    names.iter().map(|&name| (name, built_in(name))).collect()
}

#[test]
fn one_trouble_at_a_time() {
    let conditions: [Condition; 8] = [
        ("a clean photograph", |scene| scene),
        ("uneven light", |scene| Scene { slope: [0.6, -0.3], vignette: 0.35, ..scene }),
        ("noise", |scene| Scene { noise: 4.0, ..scene.at(20.0) }),
        ("a textured wall", |scene| Scene { texture: 0.05, ..scene.at(20.0) }),
        ("a tinted wall and stain", |scene| Scene { wall: [0.5, 0.35, 0.2], tint: [0.6, 1.0, 1.4], ..scene }),
        ("JPEG 80", |scene| Scene { jpeg: Some(80), ..scene }),
        ("few pixels", |scene| scene.at(6.0)),
        ("lighter than a dark wall", |scene| Scene { lighter: true, wall: [0.06, 0.06, 0.07], ..scene }),
    ];
    all_are_found(own_stains(), &conditions);
}

#[test]
fn all_troubles_together() {
    let conditions: [Condition; 4] = [
        ("at the pattern's own resolution", Scene::hard),
        ("at 24 px/cm, JPEG 90", |scene| Scene { jpeg: Some(90), ..scene.at(24.0).hard() }),
        ("faint", |scene| Scene { density: 0.25, ..scene.at(16.0).hard() }),
        ("nearly black", |scene| Scene { density: 1.8, ..scene.at(16.0).hard() }),
    ];
    all_are_found(own_stains(), &conditions);
}

#[test]
fn wall_patterns_come_back_from_their_photographs() {
    let names = [
        "hand_cloud",
        "hand_print",
        "hand_drag_two",
        "hand_tips_four",
        "arm_elbow_rub",
        "shoulder_brush",
        "bag_corner",
    ];
    let conditions: [Condition; 2] = [
        ("hard, at 10 px/cm", |scene| Scene { jpeg: Some(80), ..scene.hard() }),
        ("hard, at 20 px/cm", |scene| scene.at(20.0).hard()),
    ];
    all_are_found(library_s(&names), &conditions);
}

#[test]
fn fine_black_marks_and_treads_come_back_too() {
    let conditions: [Condition; 1] = [("hard, at 40 px/cm", |scene| Scene { density: 1.2, ..scene.at(40.0).hard() })];
    all_are_found(
        library_s(&["shoe_toe_scuff", "shoe_line_short", "bag_wheel", "heel_arc", "child_shoe"]),
        &conditions,
    );
}

#[test]
fn a_turned_photograph_is_turned_back() {
    for turned_deg in [-30.0, 90.0, 17.0] {
        let mut scene = Scene { turned_deg, ..Scene::of(streaks()).at(16.0).hard() };
        let side = scene.size[0].max(scene.size[1]);
        scene.size = [side; 2];
        scene.middle = [f64::from(side) / 2.0; 2];
        assert_eq!(problems("streaks", &format!("turned by {turned_deg}"), &scene, &options(&scene)), None);
    }
}

#[test]
fn the_length_of_the_stain_gives_the_scale() {
    let scene = Scene::of(built_in("hand_drag_two")).at(17.0).hard();
    let by_scale = ImportedPattern::from_photo(&scene.photograph(), &options(&scene)).unwrap();
    let length_cm = by_scale.stain_cm[0];
    let by_length = ImportOptions { size: PhotoScale::LengthCm(length_cm), ..options(&scene) };
    let import = ImportedPattern::from_photo(&scene.photograph(), &by_length).unwrap();
    assert!((import.px_per_cm / 17.0 - 1.0).abs() < 0.06, "{} px/cm", import.px_per_cm);
    assert!((import.stain_cm[0] / length_cm - 1.0).abs() < 0.08, "{:?} for {length_cm}", import.stain_cm);
}

#[test]
fn a_crop_leaves_out_what_is_beside_the_stain() {
    let mut scene = Scene::of(ring()).at(16.0).hard();
    // A skirting, black and as wide as the photograph, below the stain.
    scene.size[1] += 300;
    let mut picture = image::load_from_memory(&scene.photograph()).unwrap().into_rgb8();
    let (width, height) = picture.dimensions();
    for (x, y) in (0..width).flat_map(|x| (height - 200..height).map(move |y| (x, y))) {
        picture.put_pixel(x, y, image::Rgb([40, 38, 36]));
    }
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    let options = ImportOptions { crop: Some([10, 20, width - 20, height - 240]), ..options(&scene) };
    let import = ImportedPattern::from_photo(bytes.get_ref(), &options).unwrap();
    assert!(scene.correlation(&import) >= CORRELATION);
    let picture = import_picture(&import);
    assert!(picture.width() > import.coverage.width() + 300, "{:?}", picture.dimensions());
}

/// What is not stain is empty, not faintly grey, and the image's border is black.
#[test]
fn the_wall_leaves_nothing() {
    let scene = Scene::of(blot()).at(20.0).hard();
    let import = ImportedPattern::from_photo(&scene.photograph(), &options(&scene)).unwrap();
    let (width, height) = import.coverage.dimensions();
    for (x, y, value) in import.coverage.enumerate_pixels() {
        if x == 0 || y == 0 || x + 1 == width || y + 1 == height {
            assert_eq!(value.0[0], 0, "at the border {x}, {y}");
        }
    }
    let [length_cm, breadth_cm] = import.stain_cm;
    assert!((8.5..=12.5).contains(&length_cm) && (7.0..=10.5).contains(&breadth_cm), "{length_cm} x {breadth_cm}");
    assert!(import.wall_noise > 0.0 && import.wall_noise < 0.02, "{}", import.wall_noise);
    assert_eq!(f64::from(width) / 10.0, import.length_cm());
}
