//! The ribbon of a route: its centre line and the usable width on both sides.

use super::field::Field;
use super::ground::Ground;
use crate::math::Vec2;

/// Distance between the stations of a ribbon, metres.
pub(super) const STEP_M: f64 = 0.25;
/// Least distance of persons' centres from walls, metres; less in narrow gaps.
const WALL_MARGIN_M: f64 = 0.16;
/// Half width of the ribbon without walls, metres.
const SPREAD_M: f64 = 5.0;
/// Growth of the used half width per metre walked: people fan out behind a door rather than line up along the wall
/// beside it.
const FANNING: f64 = 0.4;
/// Range over which directions are smoothed, before and behind, metres.
const SMOOTHING_M: f64 = 0.75;

/// A cross-section of a ribbon.
#[derive(Clone, Copy, Debug)]
pub(super) struct Station {
    /// Point on the centre line, metres.
    pub(super) middle_m: Vec2,
    /// Unit vector along the path.
    pub(super) ahead: Vec2,
    /// Usable distance to the left and right of the centre line, metres.
    pub(super) extent_m: [f64; 2],
}

impl Station {
    /// End of the usable width on the left (0) or right (1), metres.
    pub(super) fn end(&self, side: usize) -> Vec2 {
        let sign = if side == 0 { 1.0 } else { -1.0 };
        self.middle_m + self.ahead.left() * (sign * self.extent_m[side])
    }
}

/// Width of a ribbon at its start or end, metres.
#[derive(Clone, Copy, Debug)]
pub(super) enum RibbonEnd {
    /// People enter or leave over the whole width.
    Opening(f64),
    /// People come from, or gather at, a place in the open.
    Area(f64),
}

impl RibbonEnd {
    /// Half width at a distance from the end, given the half width without it.
    fn limit(self, otherwise_m: f64, distance_m: f64) -> f64 {
        match self {
            RibbonEnd::Opening(width_m) => otherwise_m.max(0.5 * width_m - FANNING * distance_m),
            RibbonEnd::Area(width_m) => otherwise_m.min(0.5 * width_m + FANNING * distance_m),
        }
    }
}

/// Traces the shortest path from `start` down the field; `None` if it does not reach the goal.
pub(super) fn trace(ground: &Ground, field: &Field, start: Vec2) -> Option<Vec<Vec2>> {
    let cell_m = ground.lattice.cell_m();
    let mut p = start;
    let mut distance = field.at(ground, p);
    if !distance.is_finite() {
        return None;
    }
    let mut path = vec![p];
    // Every step reduces the distance, which limits their number.
    let most_steps = (distance / (0.25 * cell_m)) as usize + 100;
    for _ in 0..most_steps {
        if distance <= 0.75 * cell_m {
            return Some(path);
        }
        let step = field.downhill(ground, p).map(|d| p + d * cell_m);
        let next = match step.filter(|&q| {
            ground.lattice.cell_at(q).is_some_and(|c| ground.is_walkable(c))
                && field.at(ground, q) < distance - 0.1 * cell_m
        }) {
            Some(next) => next,
            // On a ridge or against a wall: step to the best adjacent cell.
            None => {
                let here = ground.walkable_near(p, 0.5)?;
                let best = ground
                    .lattice
                    .around(here)
                    .into_iter()
                    .filter(|&c| c != usize::MAX)
                    .chain([here])
                    .min_by(|&a, &b| field.of_cell(a).total_cmp(&field.of_cell(b)).then(a.cmp(&b)))?;
                let centre = ground.lattice.centre(best);
                if best == here && centre.distance(p) < 0.1 * cell_m {
                    return (field.of_cell(here) <= 2.0 * cell_m).then_some(path);
                }
                centre
            }
        };
        p = next;
        distance = field.at(ground, p).min(distance);
        path.push(p);
    }
    None
}

/// Resamples a line at steps of [`STEP_M`] metres; keeps both ends.
pub(super) fn resample(path: &[Vec2]) -> Vec<Vec2> {
    let length: f64 = path.windows(2).map(|w| w[0].distance(w[1])).sum();
    let pieces = (length / STEP_M).round().max(1.0) as usize;
    let step = length / pieces as f64;
    let mut points = Vec::with_capacity(pieces + 1);
    let (mut walked, mut next) = (0.0, 0.0);
    for w in path.windows(2) {
        let piece = w[0].distance(w[1]);
        while piece > 0.0 && next <= walked + piece && points.len() < pieces {
            points.push(w[0].lerp(w[1], (next - walked) / piece));
            next += step;
        }
        walked += piece;
    }
    points.extend(path.last());
    points
}

/// Measures the usable width beside a centre line with points [`STEP_M`] apart.
///
/// `ends`: widths of start and goal. `pinches`: stations at places in the open, which people pass within the given
/// distance, metres.
pub(super) fn measure(ground: &Ground, line: &[Vec2], ends: [RibbonEnd; 2], pinches: &[(usize, f64)]) -> Vec<Station> {
    let reach = (SMOOTHING_M / STEP_M) as usize;
    let count = line.len();
    let smooth: Vec<Vec2> = (0..count)
        .map(|k| {
            // Equal numbers of points on both sides keep the ends in place.
            let reach = reach.min(k).min(count - 1 - k);
            let sum = line[k - reach..=k + reach].iter().fold(Vec2::ZERO, |sum, &p| sum + p);
            sum / (2 * reach + 1) as f64
        })
        .collect();
    let mut stations: Vec<Station> = Vec::with_capacity(count);
    for k in 0..count {
        let (before, behind) = (k.saturating_sub(reach), (k + reach).min(count - 1));
        let last = stations.last().map_or(Vec2 { x: 1.0, y: 0.0 }, |s| s.ahead);
        let ahead = (smooth[behind] - smooth[before]).normalized().unwrap_or(last);
        let along_m = k as f64 * STEP_M;
        let left_m = (count - 1 - k) as f64 * STEP_M;
        let mut limit = ends[0].limit(ends[1].limit(SPREAD_M, left_m), along_m);
        for &(_, within_m) in pinches.iter().filter(|p| p.0 == k) {
            limit = limit.min(within_m);
        }
        let middle_m = smooth[k];
        let extent_m = [1.0, -1.0].map(|sign| room_beside(ground, middle_m, ahead.left() * sign, limit));
        stations.push(Station { middle_m, ahead, extent_m });
    }
    limit_growth(&mut stations);
    stations
}

/// Free distance to one side, metres.
fn room_beside(ground: &Ground, from: Vec2, direction: Vec2, limit_m: f64) -> f64 {
    // In a gap too narrow for the margin, use half of the clearance.
    let margin = WALL_MARGIN_M.min(0.5 * ground.clearance_m(from));
    let mut done = 0.0;
    while done < limit_m {
        let free = ground.clearance_m(from + direction * done) - margin;
        if free < 0.02 {
            return done;
        }
        // Small steps, because aprons end without a wall.
        done += free.clamp(0.03, 0.4);
    }
    limit_m
}

/// Limits the growth of the half widths to [`FANNING`] per metre, from both ends.
fn limit_growth(stations: &mut [Station]) {
    let relax = |from: [f64; 2], to: &mut [f64; 2]| {
        for side in 0..2 {
            to[side] = to[side].min(from[side] + FANNING * STEP_M);
        }
    };
    for k in 1..stations.len() {
        let from = stations[k - 1].extent_m;
        relax(from, &mut stations[k].extent_m);
    }
    for k in (1..stations.len()).rev() {
        let from = stations[k].extent_m;
        relax(from, &mut stations[k - 1].extent_m);
    }
}
