//! Lays the fewest gates across a ribbon that describe it.

use super::Gate;
use super::ribbon::{STEP_M, Station};

/// Largest distance between two gates, metres.
const SPACING_M: f64 = 3.5;
/// Largest distance by which the straight border between two gates leaves the ribbon, metres.
const TOLERANCE_M: f64 = 0.12;
/// Cosine of the largest turn between two gates.
const LEAST_COS: f64 = 0.906; // 25 degrees

/// Returns gates for the ribbon and their station indices. The first, last and `fixed` stations get a gate.
pub(super) fn lay(stations: &[Station], fixed: &[usize]) -> (Vec<Gate>, Vec<usize>) {
    let mut at = vec![0];
    let mut from = 0;
    while from + 1 < stations.len() {
        let farthest = (from + (SPACING_M / STEP_M) as usize).min(stations.len() - 1);
        let farthest = fixed.iter().copied().filter(|&f| f > from).min().map_or(farthest, |f| f.min(farthest));
        let to = (from + 1..=farthest).rev().find(|&to| describes(stations, from, to)).unwrap_or(from + 1);
        at.push(to);
        from = to;
    }
    drop_crossing(stations, fixed, &mut at);
    let gates = at.iter().map(|&k| Gate { left_m: stations[k].end(0), right_m: stations[k].end(1) }).collect();
    (gates, at)
}

/// Whether the border between two stations stays in the ribbon and the path hardly turns.
fn describes(stations: &[Station], from: usize, to: usize) -> bool {
    if to == from + 1 {
        return true;
    }
    let (a, b) = (&stations[from], &stations[to]);
    if a.ahead.dot(b.ahead) < LEAST_COS {
        return false;
    }
    (from + 1..to).all(|k| {
        let s = &stations[k];
        let across = s.ahead.left();
        (0..2).all(|side| {
            let (p, q) = (a.end(side), b.end(side));
            // Intersection of the border p..q with this station's line across the path.
            let along = (q - p).dot(s.ahead);
            if along.abs() < 1e-6 {
                return false;
            }
            let share = ((s.middle_m - p).dot(s.ahead) / along).clamp(0.0, 1.0);
            let sign = if side == 0 { 1.0 } else { -1.0 };
            let out = (p.lerp(q, share) - s.middle_m).dot(across) * sign;
            out <= s.extent_m[side] + TOLERANCE_M
        })
    })
}

/// Removes gates that cross the previous one, at the inner side of sharp bends in the open.
fn drop_crossing(stations: &[Station], fixed: &[usize], at: &mut Vec<usize>) {
    let crosses = |i: usize, j: usize| {
        let (a, b) = (&stations[i], &stations[j]);
        let side = |p: crate::math::Vec2| (p - a.middle_m).dot(a.ahead);
        // A gate behind lies entirely on the far side.
        a.ahead.dot(b.ahead) > 0.0 && (side(b.end(0)) < -0.05 || side(b.end(1)) < -0.05)
    };
    let mut kept: Vec<usize> = Vec::with_capacity(at.len());
    for (n, &k) in at.iter().enumerate() {
        let must_stay = n == 0 || n + 1 == at.len() || fixed.contains(&k);
        if !must_stay && kept.last().is_some_and(|&last| crosses(last, k)) {
            continue;
        }
        kept.push(k);
    }
    *at = kept;
}
