//! The middle line of a route and the room on both sides of it.

use super::field::Field;
use super::ground::Ground;
use crate::math::Vec2;

/// Distance between the places at which the ribbon is measured, metres.
pub(super) const STEP_M: f64 = 0.25;
/// Bodies' middles keep this far off the walls at least, metres; less in narrow gaps.
const WALL_MARGIN_M: f64 = 0.16;
/// Half width of the ribbon where no wall limits it, metres.
const SPREAD_M: f64 = 5.0;
/// How much wider, on either side, the used way grows per metre walked: people fan out behind a door, they do not
/// line up along the wall beside it.
const FANNING: f64 = 0.4;
/// Directions are taken over this distance before and behind, metres.
const SMOOTHING_M: f64 = 0.75;

/// One place along a route.
#[derive(Clone, Copy, Debug)]
pub(super) struct Station {
    /// On the middle line, metres.
    pub(super) middle_m: Vec2,
    /// Unit vector along the way.
    pub(super) ahead: Vec2,
    /// Usable distance to the left and right of the middle line, metres.
    pub(super) extent_m: [f64; 2],
}

impl Station {
    /// RibbonEnd of the usable way on the left (0) or right (1).
    pub(super) fn end(&self, side: usize) -> Vec2 {
        let sign = if side == 0 { 1.0 } else { -1.0 };
        self.middle_m + self.ahead.left() * (sign * self.extent_m[side])
    }
}

/// Width of a route where it begins or ends, metres.
#[derive(Clone, Copy, Debug)]
pub(super) enum RibbonEnd {
    /// Everybody comes in or goes out over the whole width.
    Opening(f64),
    /// People come from or gather at a place in the open.
    Area(f64),
}

impl RibbonEnd {
    /// How far to either side people spread at this distance from the end, who would otherwise spread that far.
    fn limit(self, otherwise_m: f64, distance_m: f64) -> f64 {
        match self {
            RibbonEnd::Opening(width_m) => otherwise_m.max(0.5 * width_m - FANNING * distance_m),
            RibbonEnd::Area(width_m) => otherwise_m.min(0.5 * width_m + FANNING * distance_m),
        }
    }
}

/// Follows the shortest way from `start` down the field to its goal. `None` if it does not lead there.
pub(super) fn trace(ground: &Ground, field: &Field, start: Vec2) -> Option<Vec<Vec2>> {
    let cell_m = ground.lattice.cell_m();
    let mut p = start;
    let mut distance = field.at(ground, p);
    if !distance.is_finite() {
        return None;
    }
    let mut path = vec![p];
    // Every step comes nearer, so the way cannot be much longer than its distance.
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
            // On a ridge or against a wall: to the best of the cells around.
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

/// The same line with points every [`STEP_M`] metres; both ends are kept.
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

/// Measures the room beside a middle line whose points lie [`STEP_M`] apart.
///
/// `ends` says how wide start and goal are, `pinches` which stations are places in the open that people pass within a
/// stated distance.
pub(super) fn measure(ground: &Ground, line: &[Vec2], ends: [RibbonEnd; 2], pinches: &[(usize, f64)]) -> Vec<Station> {
    let reach = (SMOOTHING_M / STEP_M) as usize;
    let count = line.len();
    let smooth: Vec<Vec2> = (0..count)
        .map(|k| {
            // The same number of points on both sides, so that the ends stay where they are.
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

/// Distance to the side that is free of walls, metres.
fn room_beside(ground: &Ground, from: Vec2, direction: Vec2, limit_m: f64) -> f64 {
    // In a gap too narrow for the margin, half of what there is.
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

/// Lets the extents grow by no more than [`FANNING`] per metre, from both ends.
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
