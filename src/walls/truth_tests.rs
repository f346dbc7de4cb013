//! Traces drawn shapes whose true outline is known.

use super::*;
use crate::math::{SplitMix64, sin_cos};
use crate::plan::{self, PlanOptions};
use proptest::prelude::*;

/// Largest allowed distance of a traced face from the drawn edge, pixels.
const TRUTH: f64 = 0.5;

/// A drawing read as a plan of 0.05 m per pixel. A pixel's darkness is the share of `fine` x `fine` samples with
/// `is_wall` (1: not anti-aliased). Coordinates are pixels, y down.
fn draw(width: usize, height: usize, fine: usize, is_wall: impl Fn(f64, f64) -> bool) -> FloorPlan {
    let mut lightness = vec![0u8; width * height];
    for y in 0..height {
        for x in 0..width {
            let place = |k: usize| (k as f64 + 0.5) / fine as f64;
            let dark =
                (0..fine * fine).filter(|k| is_wall(x as f64 + place(k % fine), y as f64 + place(k / fine))).count();
            lightness[y * width + x] = (255.0 * (1.0 - dark as f64 / (fine * fine) as f64)).round() as u8;
        }
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plan.png");
    image::GrayImage::from_vec(width as u32, height as u32, lightness).unwrap().save(&path).unwrap();
    let options = PlanOptions { metres_per_pixel: Some(0.05), ..PlanOptions::default() };
    plan::read(&path, &options).unwrap()
}

fn trace(plan: &FloorPlan) -> Walls {
    Walls::trace(plan, &WallsOptions::default())
}

/// The only shape in a drawing with a white border.
fn only_closed(walls: &Walls) -> &Face {
    let closed: Vec<&Face> = walls.faces.iter().filter(|f| f.closed).collect();
    assert_eq!(closed.len(), 1);
    closed[0]
}

/// Largest distance of a face from the truth, pixels. `distance` takes pixels, y down.
fn worst(plan: &FloorPlan, face: &Face, distance: impl Fn(f64, f64) -> f64) -> f64 {
    let n = face.points_m.len();
    let mut worst: f64 = 0.0;
    for k in 0..if face.closed { n } else { n - 1 } {
        let (a, b) = (face.points_m[k], face.points_m[(k + 1) % n]);
        let steps = (a.distance(b) / 0.005).ceil();
        for step in 0..steps as usize {
            let [x, y] = plan.m_to_px(a.lerp(b, step as f64 / steps));
            worst = worst.max(distance(x, y).abs());
        }
    }
    worst
}

#[test]
fn a_drawn_circle_is_traced_within_half_a_pixel() {
    for (fine, radius, [dx, dy]) in [
        (1, 6.0, [0.0, 0.0]),
        (1, 12.7, [0.3, 0.1]),
        (1, 20.0, [0.13, 0.77]),
        (1, 35.5, [0.5, 0.5]),
        (1, 60.0, [0.3, 0.1]),
        (1, 100.2, [0.13, 0.77]),
        (1, 240.0, [0.5, 0.5]),
        (8, 5.3, [0.5, 0.5]),
        (8, 20.0, [0.3, 0.1]),
        (8, 100.2, [0.13, 0.77]),
    ] {
        let size = (2.0 * radius) as usize + 12;
        let (cx, cy) = (size as f64 / 2.0 + dx, size as f64 / 2.0 + dy);
        let from_centre = |x: f64, y: f64| ((x - cx) * (x - cx) + (y - cy) * (y - cy)).sqrt();
        let plan = draw(size, size, fine, |x, y| from_centre(x, y) <= radius);
        let walls = trace(&plan);
        let error = worst(&plan, only_closed(&walls), |x, y| from_centre(x, y) - radius);
        assert!(error <= if fine == 1 { TRUTH } else { TRUTH / 2.0 }, "radius {radius}, {fine}: {error}");
    }
}

#[test]
fn a_turned_rectangle_has_four_corners_within_half_a_pixel() {
    for fine in [1, 8] {
        for degrees in [4.0, 7.3, 10.0, 17.3, 22.5, 26.57, 33.3, 44.0, 45.0, 61.0, 80.0f64] {
            for (w, h) in [(60.0, 30.0), (150.0, 110.0), (33.3, 24.0)] {
                let (s, c) = sin_cos(degrees.to_radians());
                let size = (w + h) as usize + 20;
                let (cx, cy) = (size as f64 / 2.0 + 0.3, size as f64 / 2.0 + 0.7);
                let beyond = |x: f64, y: f64| {
                    let (u, v) = ((x - cx) * c + (y - cy) * s, (y - cy) * c - (x - cx) * s);
                    let (a, b) = (u.abs() - w / 2.0, v.abs() - h / 2.0);
                    if a <= 0.0 || b <= 0.0 { a.max(b) } else { (a * a + b * b).sqrt() }
                };
                let plan = draw(size, size, fine, |x, y| beyond(x, y) <= 0.0);
                let walls = trace(&plan);
                let face = only_closed(&walls);
                let error = worst(&plan, face, beyond);
                assert_eq!(face.points_m.len(), 4, "{w} x {h} at {degrees} degrees, {fine}");
                assert!(error <= TRUTH, "{w} x {h} at {degrees} degrees, {fine}: {error}");
            }
        }
    }
}

#[test]
fn a_thin_oblique_line_has_two_straight_faces_within_half_a_pixel() {
    for kind in ["one pixel a column", "all pixels within half a pixel", "anti-aliased"] {
        for degrees in [1.0, 2.0, 5.0, 7.3, 10.0, 17.3, 26.57, 33.3, 40.0, 45.0f64] {
            let (s, c) = sin_cos(degrees.to_radians());
            let (cx, cy) = (80.0, 100.27);
            let apart = |x: f64, y: f64| (y - cy) * c - (x - cx) * s;
            let plan = match kind {
                "one pixel a column" => draw(160, 200, 1, |x, y| (cy + (x - cx) * s / c).floor() == y.floor()),
                "anti-aliased" => draw(160, 200, 16, |x, y| apart(x, y).abs() <= 0.5),
                _ => draw(160, 200, 1, |x, y| apart(x, y).abs() <= 0.5),
            };
            let walls = trace(&plan);
            assert_eq!(walls.faces.len(), 2, "{kind}, {degrees} degrees");
            for face in &walls.faces {
                let error = worst(&plan, face, |x, y| apart(x, y).abs() - 0.5);
                assert_eq!((face.closed, face.points_m.len()), (false, 2), "{kind}, {degrees} degrees");
                assert!(error <= TRUTH, "{kind}, {degrees} degrees: {error}");
            }
        }
    }
}

#[test]
fn the_end_of_a_thin_wall_is_square() {
    let plan = draw(40, 30, 1, |x, y| (15.0..16.0).contains(&y) && x < 20.0);
    let walls = trace(&plan);
    let points: Vec<[f64; 2]> = walls.faces[0].points_m.iter().map(|&p| plan.m_to_px(p)).collect();
    let rounded: Vec<[f64; 2]> = points.iter().map(|p| p.map(|v| (v * 1e6).round() / 1e6)).collect();
    assert_eq!(rounded, [[0.0, 16.0], [20.0, 16.0], [20.0, 15.0], [0.0, 15.0]]);
}

/// A mask of rectangles on a grid of `step` pixels.
fn rectangles(side: usize, step: usize, seed: u64) -> Vec<u8> {
    let mut random = SplitMix64::new(seed);
    let mut pick = |n: usize| (random.next_u64() >> 11) as usize % n;
    let mut floor = vec![0u8; side * side];
    for _ in 0..6 {
        let (x, y) = (pick(side), pick(side));
        let (right, top) = (x + step + pick(20), y + step + pick(20));
        let snap = |v: usize| (v / step * step).min(side);
        for row in floor.chunks_exact_mut(side).take(snap(top)).skip(snap(y)) {
            row[snap(x)..snap(right)].fill(1);
        }
    }
    floor
}

/// The pixel corners at which a mask's boundaries turn.
fn turns(plan: &FloorPlan) -> Vec<[i32; 2]> {
    let mut turns = Vec::new();
    for boundary in cracks::trace(&plan.floor, plan.width_px as usize) {
        let n = boundary.len();
        for k in 0..n {
            let ([x0, y0], [x1, y1], [x2, y2]) = (boundary[(k + n - 1) % n], boundary[k], boundary[(k + 1) % n]);
            if (x1 - x0, y1 - y0) != (x2 - x1, y2 - y1) {
                turns.push([x1, y1]);
            }
        }
    }
    turns.sort_unstable();
    turns
}

proptest! {
    #[test]
    fn walls_along_pixels_are_exact(seed: u64, step in 3usize..7, scale in prop::sample::select(vec![0.05, 0.25, 1.0])) {
        let plan = FloorPlan::from_mask(48, 48, scale, rectangles(48, step, seed));
        prop_assume!(plan.floor.contains(&1));
        let walls = trace(&plan);
        let mut corners = Vec::new();
        for p in walls.outlines().iter().flat_map(|o| &o.points_m) {
            let px = plan.m_to_px(*p);
            prop_assert!(px.iter().all(|v| (v - v.round()).abs() < 1e-9), "{:?} is no pixel corner", px);
            corners.push(px.map(|v| v.round() as i32));
        }
        corners.sort_unstable();
        prop_assert_eq!(corners, turns(&plan));
    }
}
