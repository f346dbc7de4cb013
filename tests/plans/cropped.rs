//! Pictures that are cropped near the walls, of buildings with wide doors.

use image::RgbImage;
use trodden::plan::{FloorPlan, PlanError, PlanOptions, read};

use super::canvas::{Canvas, Point, Polygon, rectangle};

const PX_PER_M: f64 = 20.0;

/// What is read of black shapes on a picture of the given size.
fn read_shapes(name: &str, size_m: Point, origin: Point, shapes: &[Polygon]) -> Result<FloorPlan, PlanError> {
    let mut canvas = Canvas::new(size_m, origin, PX_PER_M, 0.0, [255; 3]);
    canvas.fill(shapes, [0; 3]);
    let path = std::env::temp_dir().join(format!("trodden-cropped-{}-{name}.png", std::process::id()));
    let rgb: Vec<u8> = canvas.pixels.iter().flatten().map(|v| v.round() as u8).collect();
    RgbImage::from_vec(canvas.width as u32, canvas.height as u32, rgb).unwrap().save(&path).unwrap();
    let options = PlanOptions { metres_per_pixel: Some(1.0 / PX_PER_M), ..PlanOptions::default() };
    let plan = read(&path, &options);
    let _ = std::fs::remove_file(&path);
    plan
}

/// The floor that is read, square metres.
fn floor_m2(name: &str, size_m: Point, origin: Point, shapes: &[Polygon]) -> f64 {
    let plan = read_shapes(name, size_m, origin, shapes);
    plan.unwrap().floor.iter().filter(|&&floor| floor != 0).count() as f64 / (PX_PER_M * PX_PER_M)
}

/// A hall of 30 by 18 m inside walls of 0.3 m, with a door in its lower wall.
fn hall(door_m: f64) -> Vec<Polygon> {
    vec![
        rectangle([0.0, 0.0], [30.6, 0.3]),
        rectangle([0.0, 0.0], [0.3, 18.6]),
        rectangle([30.3, 0.0], [30.6, 18.6]),
        rectangle([0.0, 18.3], [12.0, 18.6]),
        rectangle([12.0 + door_m, 18.3], [30.6, 18.6]),
    ]
}

#[test]
fn paper_is_no_floor_however_near_the_walls_the_picture_is_cropped() {
    for margin in [0.3, 0.8, 1.5, 4.0] {
        for door_m in [1.4, 2.4, 4.0] {
            let size = [30.6 + 2.0 * margin, 18.6 + 2.0 * margin];
            let floor = floor_m2(&format!("{margin}-{door_m}"), size, [-margin; 2], &hall(door_m));
            // The door's disc bulges a little into the hall or out of it.
            assert!((floor - 540.0).abs() < 8.0, "{floor} m2 of 540, margin {margin} m, door {door_m} m");
        }
    }
}

#[test]
fn a_place_between_pillars_stays_floor_to_the_sides_of_the_picture() {
    let pillar = |k: usize| [1.5 + 3.5 * (k % 8) as f64, 1.5 + 3.5 * (k / 8) as f64];
    let pillars: Vec<Polygon> =
        (0..40).map(|k| rectangle(pillar(k), [pillar(k)[0] + 0.6, pillar(k)[1] + 0.6])).collect();
    let floor = floor_m2("pillars", [28.0, 17.5], [0.0; 2], &pillars);
    assert!(floor > 0.98 * (28.0 * 17.5 - 40.0 * 0.36), "{floor} m2");
}

/// Strips that are narrower than the rim in which shadows of scanners lie have little to read, but end with an answer.
#[test]
fn slender_strips_of_a_building_are_read_or_refused() {
    for width_m in [0.2, 0.4, 0.6, 1.0] {
        for at in (-2..31).map(f64::from) {
            let strip = read_shapes("strip", [width_m, 22.0], [at * 1.01, -1.0], &hall(1.4));
            assert!(strip.is_ok() || strip.is_err_and(|error| error.hint().is_some()), "{width_m} m at {at} m");
        }
    }
}
