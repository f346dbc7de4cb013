//! Finds openings: where the floor meets the image's sides.

use super::{FloorPlan, NARROWEST_OPENING_M, Opening, Side};

/// Finds all openings, in the order west, south, east, north, each side by growing x or y.
pub(super) fn find(plan: &FloorPlan) -> Vec<Opening> {
    let mut openings = Vec::new();
    for side in [Side::West, Side::South, Side::East, Side::North] {
        let found = on_side(plan, side);
        let many = found.len() > 1;
        let name = format!("{side:?}").to_lowercase();
        for (number, [from, to]) in found.into_iter().enumerate() {
            let name = if many { format!("{name} {}", number + 1) } else { name.clone() };
            let [from_m, to_m] = [from, to].map(|px| plan.px_to_m(end_on_side(plan, side, px)));
            openings.push(Opening { name, side, from_m, to_m });
        }
    }
    openings
}

/// Returns the runs of floor along a side that are wide enough, as pixel edges along +x or +y.
fn on_side(plan: &FloorPlan, side: Side) -> Vec<[u32; 2]> {
    let (width, height) = (plan.width_px, plan.height_px);
    let length = match side {
        Side::West | Side::East => height,
        Side::South | Side::North => width,
    };
    let is_floor = |k: u32| {
        let (x, y) = match side {
            Side::West => (0, height - 1 - k),
            Side::East => (width - 1, height - 1 - k),
            Side::South => (k, height - 1),
            Side::North => (k, 0),
        };
        plan.floor[y as usize * width as usize + x as usize] != 0
    };
    let mut runs = Vec::new();
    let mut start = None;
    for k in 0..=length {
        let floor = k < length && is_floor(k);
        match (floor, start) {
            (true, None) => start = Some(k),
            (false, Some(from)) => {
                // Tolerance for rounding: 12 pixels of 0.05 m are 0.6 m.
                if f64::from(k - from) * plan.metres_per_pixel >= NARROWEST_OPENING_M - 1e-9 {
                    runs.push([from, k]);
                }
                start = None;
            }
            _ => {}
        }
    }
    runs
}

/// Returns the point `k` pixels along a side, in pixels from the top left, y down.
fn end_on_side(plan: &FloorPlan, side: Side, k: u32) -> [f64; 2] {
    let (width, height, k) = (f64::from(plan.width_px), f64::from(plan.height_px), f64::from(k));
    match side {
        Side::West => [0.0, height - k],
        Side::East => [width, height - k],
        Side::South => [k, height],
        Side::North => [k, 0.0],
    }
}
