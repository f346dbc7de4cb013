//! Plans that are put right: the page, the paint, doors that are opened, the crop.

use image::{GrayImage, Luma, Rgba, RgbaImage};

use super::sandbox::Sandbox;

const SCALE: &str = "[plan]\nimage = \"plan.png\"\nmetres_per_pixel = 0.1\n";

/// The floor that `inspect` reports, square metres.
fn floor_m2(sandbox: &Sandbox, scenario: &str) -> f64 {
    let ran = sandbox.run(&["inspect", scenario, "--json"]).succeeds();
    let json: serde_json::Value = serde_json::from_str(&ran.out).unwrap();
    let regions = json["regions"].as_array().unwrap();
    regions.iter().filter(|region| region["role"] == "floor").map(|region| region["area_m2"].as_f64().unwrap()).sum()
}

#[test]
fn the_page_is_one_file_without_network() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let ran = sandbox.run(&["edit", "plan.png", "--metres-per-pixel", "0.1"]).succeeds();
    assert_eq!(ran.out, "wrote plan-edit.html: open it in a browser\n");
    let page = std::fs::read_to_string(sandbox.path("plan-edit.html")).unwrap();
    assert!(page.contains("\"metresPerPixel\":0.1") && page.contains("plan-paint.png"));
    assert!(!page.contains("http://") && !page.contains("https://") && !page.contains("{{"));
    sandbox.run(&["edit", "plan.png"]).fails(1, &["plan-edit.html", "--force"]);
    sandbox.run(&["edit", "-"]).fails(1, &["save the plan to a file first"]);
}

#[test]
fn a_plan_that_cannot_be_baked_has_a_page_too() {
    let sandbox = Sandbox::new();
    GrayImage::from_pixel(80, 40, Luma([255])).save(sandbox.path("plan.png")).unwrap();
    sandbox.run(&["inspect", "plan.png"]).fails(1, &["has no walls"]);
    sandbox.run(&["edit", "plan.png", "-q"]).succeeds();
}

#[test]
fn paint_is_written_read_back_and_changes_the_floor() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.write("plain.toml", SCALE);
    sandbox.write("painted.toml", format!("{SCALE}paint = \"over.png\"\n"));
    let ran = sandbox.run(&["inspect", "plain.toml", "--paint", "over.png"]).succeeds();
    assert!(ran.out.contains("paint     over.png: outside #bebebe, floor #ffffff, wall #000000"), "{}", ran.out);
    let before = floor_m2(&sandbox, "plain.toml");
    assert_eq!(floor_m2(&sandbox, "painted.toml"), before);
    let mut over = image::open(sandbox.path("over.png")).unwrap().into_rgba8();
    for (x, y) in (0..10).flat_map(|x| (0..10).map(move |y| (30 + x, 15 + y))) {
        over.put_pixel(x, y, Rgba([220, 110, 30, 255]));
    }
    over.save(sandbox.path("over.png")).unwrap();
    assert!((before - floor_m2(&sandbox, "painted.toml") - 1.0).abs() < 1e-9);
}

#[test]
fn wrong_paint_says_what_and_where() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.write("plan.toml", format!("{SCALE}paint = \"over.png\"\n"));
    sandbox.run(&["inspect", "plan.toml"]).fails(1, &["over.png cannot be read"]);
    RgbaImage::new(81, 40).save(sandbox.path("over.png")).unwrap();
    sandbox.run(&["inspect", "plan.toml"]).fails(1, &["81 x 40 pixels, the plan has 80 x 40"]);
    let mut over = RgbaImage::new(80, 40);
    over.put_pixel(7, 9, Rgba([10, 90, 60, 255]));
    over.save(sandbox.path("over.png")).unwrap();
    sandbox.run(&["inspect", "plan.toml"]).fails(1, &["#0a5a3c at pixel [7, 9]", "the nearest is"]);
}

#[test]
fn a_closed_door_is_opened_and_the_sheet_is_cut() {
    let sandbox = Sandbox::new();
    // A corridor with a wall across, on a sheet with a frame.
    let is_wall = |x: u32, y: u32| !(25..55).contains(&y) || (60..62).contains(&x);
    GrayImage::from_fn(120, 80, |x, y| Luma([if is_wall(x, y) { 0 } else { 255 }]))
        .save(sandbox.path("plan.png"))
        .unwrap();
    sandbox.write("closed.toml", format!("{SCALE}floor = [[1, 4]]\n"));
    sandbox.write("open.toml", format!("{SCALE}floor = [[1, 4]]\n[[door]]\nat = [6.1, 4.0]\nwidth = 1.0\n"));
    sandbox.write("cut.toml", format!("{SCALE}crop = [{{ px = [0, 20] }}, {{ px = [50, 60] }}]\n"));
    let [closed, open, cut] = ["closed.toml", "open.toml", "cut.toml"].map(|name| floor_m2(&sandbox, name));
    assert!((closed - 18.0).abs() < 1e-9, "{closed} m2");
    // The second half, and the door's 1.0 x 0.2 m.
    assert!((open - (18.0 + 17.4 + 0.2)).abs() < 1e-9, "{open} m2");
    assert!((cut - 15.0).abs() < 1e-9, "{cut} m2");
    sandbox.write("cut.toml", format!("{SCALE}crop = [{{ px = [0, 20] }}, {{ px = [0.2, 60] }}]\n"));
    sandbox.run(&["inspect", "cut.toml"]).fails(1, &["plan.crop keeps less than 2 x 2 pixels"]);
}
