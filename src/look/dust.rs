//! Dust: settles beside the lanes, mostly along walls.

use super::lattice::{SplineAxis, SplineLattice, TexelWindow};
use super::settings::DustLook;
use super::skirting::distance_squared;
use crate::math::{Rect, exp, vec2};
use crate::walls::{Segment, Walls};

/// Spacing of the lattice of dust values, metres: dust varies slowly.
const SPACING_M: f64 = 0.05;

/// Side of the squares of lattice points that share a list of near walls.
const SIDE: i64 = 8;

/// Multiple of the reach beyond which there is no dust.
const END: f64 = 5.0;

/// Computes exp(-distance / reach) to the nearest wall over a window; `None` far from walls.
pub(super) fn over(window: &TexelWindow, walls: &Walls, dust: &DustLook) -> Option<SplineLattice> {
    // Coarse texels need no finer lattice.
    let spacing_m = SPACING_M.max(0.5 / window.texels_per_metre);
    let spacing = spacing_m * window.texels_per_metre;
    let square = |low: [i64; 2], high: [i64; 2]| square(low, high, spacing_m);
    let x = SplineAxis::new(window.i0, window.width, spacing, 0.0);
    let y = SplineAxis::new(window.j0, window.height, spacing, 0.0);
    let reach_m = f64::from(dust.reach_m);
    let (x_end, y_end) = (x.first + x.len as i64, y.first + y.len as i64);
    let mut near = Vec::new();
    walls.segments_to_floor(square([x.first, y.first], [x_end, y_end]).grown(END * reach_m), &mut near);
    if near.is_empty() {
        return None;
    }
    let end = exp(-END);
    let mut values = vec![0.0; x.len * y.len];
    let mut nearest = Vec::new();
    for j0 in (y.first..y_end).step_by(SIDE as usize) {
        for i0 in (x.first..x_end).step_by(SIDE as usize) {
            let last = [(i0 + SIDE).min(x_end), (j0 + SIDE).min(y_end)];
            if !can_be_nearest(&near, square([i0, j0], last), END * reach_m, &mut nearest) {
                continue;
            }
            for j in j0..last[1] {
                for i in i0..last[0] {
                    let p = vec2(i as f64, j as f64) * spacing_m;
                    let squared = nearest.iter().map(|s| distance_squared(s, p)).fold(f64::INFINITY, f64::min);
                    let value = (exp(-squared.sqrt() / reach_m) - end).max(0.0);
                    values[(j - y.first) as usize * x.len + (i - x.first) as usize] = value as f32;
                }
            }
        }
    }
    Some(SplineLattice::new(x, y, values))
}

fn square(low: [i64; 2], high: [i64; 2], spacing_m: f64) -> Rect {
    let point = |[i, j]: [i64; 2]| vec2(i as f64, j as f64) * spacing_m;
    Rect { min: point(low), max: point(high) }
}

/// Selects segments that may be nearest to a point of `area`. Returns whether any is in reach.
fn can_be_nearest(near: &[Segment], area: Rect, reach_m: f64, out: &mut Vec<Segment>) -> bool {
    let (centre, half_diagonal) = (area.centre(), 0.5 * area.min.distance(area.max));
    let distance = |segment: &Segment| distance_squared(segment, centre).sqrt();
    let least = near.iter().map(distance).fold(f64::INFINITY, f64::min);
    out.clear();
    out.extend(near.iter().filter(|segment| distance(segment) <= least + 2.0 * half_diagonal));
    least <= reach_m + half_diagonal
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::FloorPlan;
    use crate::walls::WallsOptions;

    #[test]
    fn falls_off_from_the_wall() {
        // A room of 6 x 6 m, with a wall below y = 1.
        let floor = (0..64).map(|n| u8::from((1..7).contains(&(n % 8)) && (1..7).contains(&(n / 8)))).collect();
        let walls = Walls::trace(&FloorPlan::from_mask(8, 8, 1.0, floor), &WallsOptions::default());
        let window = TexelWindow { texels_per_metre: 100.0, i0: 400, j0: 100, width: 1, height: 300 };
        let dust = DustLook { density: 0.1, reach_m: 0.3, ..DustLook::default() };
        let mut lattice = over(&window, &walls, &dust).unwrap();
        for (row, distance) in [(10, 0.105), (30, 0.305), (100, 1.005), (160, 1.605)] {
            let mut out = [0.0];
            lattice.begin_row(row);
            lattice.add_to(0, &mut out);
            let truth = (exp(-distance / 0.3) - exp(-5.0)).max(0.0);
            assert!((f64::from(out[0]) - truth).abs() < 0.01, "{} at {distance} m, not {truth}", out[0]);
        }
    }
}
