//! Dirty line along the skirting, where no mop reaches: uneven, denser in corners.

use super::lattice::TexelWindow;
use super::noise::{self, Channel};
use super::segment::{LocalSegment, SQUARE, SegmentNoise, TexelRow};
use super::settings::EdgeLook;
use crate::math::{Vec2, exp_f32};
use crate::walls::{Segment, Walls};

/// Sizes of the line's noise, length along the wall and width across, metres: long stretches mopped better or worse,
/// clumps, and streaks of the mop.
const SPOTS_M: [[f64; 2]; 3] = [[0.55, 0.30], [0.11, 0.05], [0.26, 0.013]];

/// The joint between floor and skirting, which no mop cleans: additional share of the density at the wall, and the
/// distance over which it falls to 1/e, metres.
const JOINT_SHARE: f32 = 0.6;
const JOINT_M: f32 = 0.010;

/// Distance over which walls' patterns blend into each other, and end of the blend, metres.
const BLEND_M: f32 = 0.015;
const BLEND_END_M: f64 = 0.10;

/// The skirting line of one look.
pub(super) struct Skirting<'a> {
    walls: &'a Walls,
    edge: EdgeLook,
    keys: [u32; 3],
    /// Distance beyond which the line is zero, metres.
    reach_m: f32,
}

/// Walls around one square of texels.
struct NearbyWalls {
    /// Segments that form corners.
    faces: Vec<LocalSegment>,
    /// Segments near enough to show their pattern.
    patterned: Vec<(LocalSegment, [SegmentNoise; 3])>,
    texel_m: f32,
}

impl<'a> Skirting<'a> {
    pub fn new(walls: &'a Walls, edge: EdgeLook, seed: u64) -> Skirting<'a> {
        let keys = [Channel::EdgeStretch, Channel::EdgeClump, Channel::EdgeStreak].map(|c| noise::key(seed, c));
        let reach_m = (5.0 * edge.reach_m).max(0.04);
        Skirting { walls, edge, keys, reach_m }
    }

    /// Computes the line's optical density over a window, at least at `wanted` texels. 0 elsewhere; returns `false` if
    /// there is none.
    ///
    /// Works in squares at multiples of [`SQUARE`] on the whole floor, so that a texel's value does not depend on the
    /// window.
    pub fn lay_out(&self, window: &TexelWindow, wanted: Option<&[bool]>, density: &mut Vec<f32>) -> bool {
        density.clear();
        // Corners have an effect slightly beyond the line.
        let felt_m = f64::from(self.reach_m.max(2.0 * self.edge.corner_radius_m));
        let mut near = Vec::new();
        if self.edge.density > 0.0 {
            self.walls.segments_to_floor(window.area_m().grown(felt_m), &mut near);
        }
        if near.is_empty() {
            return false;
        }
        density.resize(window.texels(), 0.0);
        let side = SQUARE as i64;
        let squares = |from: i64, count: usize| from.div_euclid(side)..=(from + count as i64 - 1).div_euclid(side);
        for square_j in squares(window.j0, window.height) {
            for square_i in squares(window.i0, window.width) {
                let square =
                    TexelWindow { i0: square_i * side, j0: square_j * side, width: SQUARE, height: SQUARE, ..*window };
                if !wanted.is_none_or(|wanted| window.any_in(&square, wanted)) {
                    continue;
                }
                if let Some(around) = self.surroundings(&square, &near, felt_m) {
                    self.square(&square, &around, window, density);
                }
            }
        }
        true
    }

    fn surroundings(&self, square: &TexelWindow, near: &[Segment], felt_m: f64) -> Option<NearbyWalls> {
        let area = square.area_m();
        let (centre, half_diagonal) = (area.centre(), 0.5 * area.min.distance(area.max));
        let distances: Vec<f64> = near.iter().map(|segment| distance_squared(segment, centre).sqrt()).collect();
        let nearest = distances.iter().copied().fold(f64::INFINITY, f64::min);
        if nearest > f64::from(self.reach_m) + half_diagonal {
            return None;
        }
        let within = |limit: f64| near.iter().zip(&distances).filter(move |(_, d)| **d <= limit).map(|(s, _)| s);
        let side_m = area.width() as f32;
        let reach_m = self.reach_m + 2.0 * half_diagonal as f32;
        let patterned = within(nearest + 2.0 * half_diagonal + BLEND_END_M).map(|segment| {
            let face = LocalSegment::seen_from(segment, area.min);
            let spots = std::array::from_fn(|n| SegmentNoise::over(&face, SPOTS_M[n], side_m, reach_m, self.keys[n]));
            (face, spots)
        });
        Some(NearbyWalls {
            patterned: patterned.collect(),
            faces: within(felt_m + half_diagonal).map(|segment| LocalSegment::seen_from(segment, area.min)).collect(),
            texel_m: (1.0 / square.texels_per_metre) as f32,
        })
    }

    fn square(&self, square: &TexelWindow, around: &NearbyWalls, window: &TexelWindow, density: &mut [f32]) {
        let first = (square.i0 - window.i0).clamp(0, window.width as i64) as usize;
        let end = (square.i0 + SQUARE as i64 - window.i0).clamp(0, window.width as i64) as usize;
        let skipped = (window.i0 - square.i0).max(0) as usize;
        for row in 0..SQUARE {
            let j = square.j0 + row as i64 - window.j0;
            if (0..window.height as i64).contains(&j) {
                let values = self.row(around, (row as f32 + 0.5) * around.texel_m);
                let start = j as usize * window.width;
                density[start + first..start + end].copy_from_slice(&values[skipped..skipped + end - first]);
            }
        }
    }

    /// Computes one row of a square, `y` metres above its lower side.
    fn row(&self, around: &NearbyWalls, y: f32) -> TexelRow {
        let texel_m = around.texel_m;
        let places: Vec<_> = around.patterned.iter().map(|(face, _)| face.places(y, texel_m)).collect();
        let mut least = [f32::INFINITY; SQUARE];
        for places in &places {
            for (least, distance) in least.iter_mut().zip(places.distance) {
                *least = least.min(distance);
            }
        }
        if least.iter().all(|&distance| distance > self.reach_m + texel_m) {
            return [0.0; SQUARE];
        }
        let mut total = [0.0f32; SQUARE];
        let mut spots = [[0.0f32; SQUARE]; 3];
        for ((face, patterns), places) in around.patterned.iter().zip(&places) {
            let mut weights = [0.0; SQUARE];
            for k in 0..SQUARE {
                weights[k] = exp_f32((least[k] - places.distance[k]) / BLEND_M);
                total[k] += weights[k];
            }
            for (pattern, spots) in patterns.iter().zip(&mut spots) {
                pattern.add(face, places, &weights, spots);
            }
        }
        for spots in &mut spots {
            for (spots, total) in spots.iter_mut().zip(total) {
                *spots /= total;
            }
        }
        self.law(&least, &self.turns(around, y, &least), &spots, texel_m)
    }

    /// Blocked horizon relative to a straight wall: 1 at a straight wall, 1.5 in a right-angled inner corner, 0.5 at an
    /// outer one.
    fn turns(&self, around: &NearbyWalls, y: f32, least: &TexelRow) -> TexelRow {
        // A lone segment extends beyond the reach: a straight wall.
        if around.faces.len() < 2 {
            return [1.0; SQUARE];
        }
        let radius = self.edge.corner_radius_m;
        let mut turns = [0.0; SQUARE];
        for face in &around.faces {
            face.add_blocked(&face.places(y, around.texel_m), radius, around.texel_m, &mut turns);
        }
        for (turn, least) in turns.iter_mut().zip(least) {
            let straight = std::f32::consts::PI * (1.0 - least / (least * least + radius * radius).sqrt());
            *turn = (*turn / straight.max(1e-3)).clamp(0.3, 2.2);
        }
        turns
    }

    /// The line's density from wall distance, corner turn, and patterns (deviation 1 each).
    fn law(
        &self,
        distance: &TexelRow,
        turns: &TexelRow,
        [stretch, clump, streak]: &[TexelRow; 3],
        texel_m: f32,
    ) -> TexelRow {
        let edge = &self.edge;
        let sd = edge.unevenness;
        let mut density = [0.0; SQUARE];
        for k in 0..SQUARE {
            let turn = turns[k];
            let inner = turn.max(1.0) - 1.0;
            let outer = turn.min(1.0);
            // Around an outer corner the small patterns would draw arcs.
            let (clump, streak) = (clump[k] * outer * outer, streak[k] * outer * outer);
            let corner = (1.0 + 2.0 * (edge.corner - 1.0) * inner) * (0.6 + 0.4 * outer);
            // A denser line is also wider.
            let wide = exp_f32(sd * (0.6 * stretch[k] + 0.35 * clump)) * (1.0 + 0.75 * inner);
            let uneven = exp_f32(sd * (0.7 * stretch[k] + 0.5 * clump + 0.5 * streak) - 0.5 * sd * sd);
            // Means over a texel: the line may be thinner.
            let (near, far) = ((distance[k] - 0.5 * texel_m).max(0.0), distance[k] + 0.5 * texel_m);
            let mean = |reach: f32| reach * (exp_f32(-near / reach) - exp_f32(-far / reach)) / (far - near);
            let reach = edge.reach_m * wide;
            let line = (mean(reach) - exp_f32(-self.reach_m / reach)).max(0.0);
            density[k] = edge.density * corner * uneven * (line + JOINT_SHARE * mean(JOINT_M));
        }
        density
    }
}

/// Squared distance from a point to a wall segment.
pub(super) fn distance_squared(segment: &Segment, p: Vec2) -> f64 {
    let way = segment.b - segment.a;
    let t = ((p - segment.a).dot(way) / way.length_squared().max(1e-18)).clamp(0.0, 1.0);
    (p - segment.a - way * t).length_squared()
}
