//! Traced walls that cross, or that are no more than a line there and back.

use trodden::math::{SplitMix64, Vec2, sin_cos, vec2};
use trodden::plan::FloorPlan;
use trodden::walls::{Walls, WallsOptions};

/// A plan drawn with characters: `.` floor, anything else wall.
fn drawn(rows: &[&str]) -> FloorPlan {
    let floor = rows.iter().flat_map(|row| row.bytes()).map(|byte| u8::from(byte == b'.')).collect();
    FloorPlan::from_mask(rows[0].len() as u32, rows.len() as u32, 0.1, floor)
}

/// Random dark pixels, some of them smoothed to blots as on the maps that robots make; every other plan has a rim.
fn noisy(number: u64) -> FloorPlan {
    let mut random = SplitMix64::new(number);
    let mut unit = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    let (width, height) = (4 + (28.0 * unit()) as usize, 4 + (28.0 * unit()) as usize);
    let share = 0.2 + 0.7 * unit();
    let mut floor: Vec<u8> = (0..width * height).map(|_| u8::from(unit() < share)).collect();
    let is_rim = |k: usize| {
        let (x, y) = (k % width, k / width);
        x == 0 || y == 0 || x + 1 == width || y + 1 == height
    };
    if number.is_multiple_of(3) {
        let sharp = floor.clone();
        for k in (0..floor.len()).filter(|&k| !is_rim(k)) {
            let around = (0..9).map(|n| u32::from(sharp[k + (n / 3) * width + n % 3 - width - 1]));
            floor[k] = u8::from(around.sum::<u32>() > 4);
        }
    }
    if number.is_multiple_of(2) {
        (0..floor.len()).filter(|&k| is_rim(k)).for_each(|k| floor[k] = 0);
    }
    FloorPlan::from_mask(width as u32, height as u32, [0.05, 0.3, 1.0][number as usize % 3], floor)
}

/// Asserts that no two edges cross, that each outline encloses an area, and that rays from the floor meet the fronts of
/// walls.
#[track_caller]
fn assert_sound(walls: &Walls, name: &str) {
    let mut edges: Vec<[Vec2; 2]> = Vec::new();
    for outline in walls.outlines() {
        assert!(outline.points_m.len() >= 3, "{name}: an outline of {:?}", outline.points_m);
        edges.extend((0..outline.points_m.len()).map(|k| outline.edge(k)));
    }
    for face in &walls.faces {
        assert!(face.points_m.len() >= if face.closed { 3 } else { 2 }, "{name}: a face of {:?}", face.points_m);
    }
    for (k, &[a, b]) in edges.iter().enumerate() {
        assert!(a != b, "{name}: an edge without length at {a:?}");
        for &[c, d] in &edges[k + 1..] {
            assert!(!cross([a, b], [c, d]), "{name}: {a:?} to {b:?} crosses {c:?} to {d:?}");
        }
    }
}

/// Looks from places on the floor in all directions: the first wall that is met shows its front.
fn assert_fronts(plan: &FloorPlan, walls: &Walls, name: &str) {
    let outlines = walls.outlines().iter();
    let edges: Vec<_> = outlines.flat_map(|outline| (0..outline.points_m.len()).map(|k| outline.edge(k))).collect();
    let mut random = SplitMix64::new(1);
    let mut unit = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    for _ in 0..40 {
        let from = vec2(unit() * plan.width_m(), unit() * plan.height_m());
        let (sin, cos) = sin_cos(unit() * std::f64::consts::TAU);
        if plan.is_floor(from) && walls.is_inside(from) {
            let off_m = walls.nearest(from, 1.0).map(|nearest| nearest.distance_m);
            assert!(
                sees_a_front(&edges, from, vec2(cos, sin)),
                "{name}: a wall's back is seen from {from:?}, {off_m:?} m off a wall"
            );
        }
    }
}

fn cross([a, b]: [Vec2; 2], [c, d]: [Vec2; 2]) -> bool {
    const HAIR: f64 = 1e-12;
    let between = |a: Vec2, b: Vec2, c: Vec2, d: Vec2| {
        let (left, right) = ((b - a).cross(c - a), (b - a).cross(d - a));
        left.min(right) < -HAIR && left.max(right) > HAIR
    };
    between(a, b, c, d) && between(c, d, a, b)
}

/// Whether a ray meets the nearest edge on its right side, where the floor is. Rays that pass an end are let off.
fn sees_a_front(edges: &[[Vec2; 2]], from: Vec2, toward: Vec2) -> bool {
    let mut nearest = (f64::INFINITY, true);
    for &[a, b] in edges {
        let along = b - a;
        let against = toward.cross(along);
        let (way, share) = ((a - from).cross(along) / against, (a - from).cross(toward) / against);
        if way > 0.0 && (-1e-9..=1.0 + 1e-9).contains(&share) && way < nearest.0 {
            nearest = (way, against < 0.0 || !(1e-6..=1.0 - 1e-6).contains(&share));
        }
    }
    nearest.1
}

fn assert_traced(plan: &FloorPlan, tolerance_px: f64, name: &str) {
    assert_sound(&Walls::trace(plan, &WallsOptions { tolerance_px }), name);
}

/// Walls a pixel thick and gaps a pixel wide: outlines crossed each other.
#[test]
fn outlines_do_not_cross() {
    assert_traced(&drawn(&["##.#", "...#", ".#..", "##.#", "#..#"]), 0.5, "crossing");
}

/// A floor of a pixel had an outline of two points.
#[test]
fn outlines_have_three_points() {
    assert_traced(&drawn(&[".#.#", "..#.", "#.#.", "#.#."]), 0.5, "flat");
}

#[test]
fn outlines_of_noisy_plans_are_sound() {
    for_noisy_plans(assert_traced);
}

/// A corner of two loosely fitted walls lay beyond the image, and its outline went round another one.
#[test]
fn rays_from_the_floor_of_noisy_plans_meet_no_back() {
    for_noisy_plans(|plan, tolerance_px, name| {
        assert_fronts(plan, &Walls::trace(plan, &WallsOptions { tolerance_px }), name);
    });
}

fn for_noisy_plans(check: impl Fn(&FloorPlan, f64, &str)) {
    for number in 0..1000 {
        let tolerance_px = if number % 5 == 0 { 2.0 } else { 0.5 };
        let plan = noisy(number);
        if plan.floor.contains(&1) {
            check(&plan, tolerance_px, &format!("noisy plan {number}"));
        }
    }
}
