//! Light on the floor and on walls, on a coarse raster: from the lamps, from outside through the openings, and what
//! the surfaces throw back.

use std::collections::HashMap;

use image::RgbaImage;

use super::field::CellGrid;
use super::lamps::Lamp;
use crate::math::{Vec2, vec2};
use crate::walls::Walls;

/// Cells at least so large, metres, and how many at most along a side.
const LEAST_CELL_M: f64 = 0.25;
const MOST_CELLS: f64 = 512.0;
/// Lamps farther away count no more, metres.
const REACH_M: f64 = 8.0;
/// A lamp's intensity straight down, so that a floor under an ordinary row of them has an irradiance of about 1.
const INTENSITY: f64 = 3.4;
/// Radiance of the openings: a bright day, toned down as eyes do.
const DAYLIGHT: f64 = 1.1;
/// Share of the light around that surfaces throw back, and how far it goes, metres.
const THROWN_BACK: f64 = 0.70;
const THROWN_M: f64 = 2.0;
/// The irradiance that eight bits hold at most; kept as a square root, finer where it is dark.
pub(super) const MOST: f64 = 4.0;

/// Heights above the floor at which walls are lit, as shares of the ceiling's.
pub(super) const WALL_HEIGHTS: [f64; 2] = [0.2, 0.75];

/// Irradiance of the floor, of the nearest wall at two heights, and what comes from everywhere.
#[derive(Clone, Debug)]
pub(super) struct LightGrid {
    pub raster: CellGrid,
    /// `None` away from floor.
    values: Vec<Option<[f64; 4]>>,
}

impl LightGrid {
    pub fn of(walls: &Walls, lamps: &[Lamp], height_m: f64) -> LightGrid {
        let raster = CellGrid::covering(walls.bounds_m().grown(1.0), LEAST_CELL_M, MOST_CELLS);
        let near = LightSources::new(lamps, windows(walls), height_m);
        let values = raster.map(|p| walls.is_inside(p).then(|| near.light(walls, p)));
        let mut light = LightGrid { raster, values };
        light.throw_back();
        // Cells under a wall take from their neighbours, so that filters find light there.
        for _ in 0..3 {
            light.spread();
        }
        light
    }

    /// Light from everywhere: the floor's own, evened out over a few metres.
    fn throw_back(&mut self) {
        let reach = ((THROWN_M / self.raster.cell_m).round() as usize).max(1);
        let (width, height) = (self.raster.width as usize, self.raster.height as usize);
        let mut sums: Vec<[f64; 2]> =
            self.values.iter().map(|value| value.map_or([0.0; 2], |value| [value[0], 1.0])).collect();
        for (lines, length, along, across) in [(height, width, 1, width), (width, height, width, 1)] {
            for line in 0..lines {
                evened(&mut sums, line * across, along, length, reach);
            }
        }
        for (value, [sum, weight]) in self.values.iter_mut().zip(sums) {
            if let Some(value) = value {
                value[3] = THROWN_BACK * sum / weight.max(1e-9);
            }
        }
    }

    fn spread(&mut self) {
        let (width, height) = (i64::from(self.raster.width), i64::from(self.raster.height));
        let before = self.values.clone();
        for j in 0..height {
            for i in 0..width {
                let here = (j * width + i) as usize;
                if before[here].is_some() {
                    continue;
                }
                let beside = (-1..=1).flat_map(|dj| (-1..=1).map(move |di| (i + di, j + dj)));
                let lit: Vec<[f64; 4]> = beside
                    .filter(|&(i, j)| (0..width).contains(&i) && (0..height).contains(&j))
                    .filter_map(|(i, j)| before[(j * width + i) as usize])
                    .collect();
                if !lit.is_empty() {
                    let mean = |n: usize| lit.iter().map(|value| value[n]).sum::<f64>() / lit.len() as f64;
                    self.values[here] = Some([mean(0), mean(1), mean(2), mean(3)]);
                }
            }
        }
    }

    /// Square roots of irradiance over [`MOST`]; row 0 is the southernmost.
    pub fn image(&self) -> RgbaImage {
        let byte = |value: f64| (255.0 * (value / MOST).clamp(0.0, 1.0).sqrt()).round() as u8;
        let bytes = self.values.iter().flat_map(|value| value.unwrap_or_default().map(byte)).collect();
        RgbaImage::from_raw(self.raster.width, self.raster.height, bytes).unwrap_or_default()
    }
}

/// Sums along a line of cells within `reach` to both sides, in place.
fn evened(sums: &mut [[f64; 2]], first: usize, step: usize, length: usize, reach: usize) {
    let mut before = Vec::with_capacity(length + 1);
    before.push([0.0; 2]);
    for k in 0..length {
        let [sum, weight] = before[k];
        let [value, one] = sums[first + k * step];
        before.push([sum + value, weight + one]);
    }
    for k in 0..length {
        let (low, high) = (before[k.saturating_sub(reach)], before[(k + reach + 1).min(length)]);
        sums[first + k * step] = [high[0] - low[0], high[1] - low[1]];
    }
}

/// A piece of an opening.
struct OpeningPiece {
    centre_m: Vec2,
    width_m: f64,
    /// Unit vector into the plan.
    inward: Vec2,
}

fn windows(walls: &Walls) -> Vec<OpeningPiece> {
    const PIECE_M: f64 = 1.0;
    let mut windows = Vec::new();
    for outline in walls.outlines() {
        for &(edge, _) in &outline.openings {
            let [a, b] = outline.edge(edge);
            let Some(along) = (b - a).normalized() else { continue };
            let pieces = (a.distance(b) / PIECE_M).ceil().clamp(1.0, 200.0);
            windows.extend((0..pieces as u32).map(|k| OpeningPiece {
                centre_m: a.lerp(b, (f64::from(k) + 0.5) / pieces),
                width_m: a.distance(b) / pieces,
                // The floor lies on the right.
                inward: vec2(along.y, -along.x),
            }));
        }
    }
    windows
}

/// Lamps and openings by place.
struct LightSources<'a> {
    lamps: SourceBuckets<&'a Lamp>,
    windows: SourceBuckets<OpeningPiece>,
    height_m: f64,
}

type SourceBuckets<T> = HashMap<(i64, i64), Vec<T>>;

impl<'a> LightSources<'a> {
    fn new(lamps: &'a [Lamp], windows: Vec<OpeningPiece>, height_m: f64) -> LightSources<'a> {
        let mut near = LightSources { lamps: HashMap::new(), windows: HashMap::new(), height_m };
        for lamp in lamps {
            near.lamps.entry(bucket(lamp.centre_m)).or_default().push(lamp);
        }
        for window in windows {
            near.windows.entry(bucket(window.centre_m)).or_default().push(window);
        }
        near
    }

    /// Irradiance at a place: E = I cos(at the source) cos(at the surface) / d^2, summed over the sources in sight.
    fn light(&self, walls: &Walls, p: Vec2) -> [f64; 4] {
        let away = walls.nearest(p, 2.0).and_then(|wall| (p - wall.point_m).normalized());
        let facing = |to: Vec2| away.map_or(to.length(), |away| away.dot(to).max(0.0)).max(0.05);
        let reached = |q: Vec2| (q - p).length_squared() < REACH_M * REACH_M && walls.sight(p, q);
        let mut sum = [0.0; 4];
        for lamp in around(&self.lamps, p).filter(|lamp| reached(lamp.centre_m)) {
            let to = lamp.centre_m - p;
            // A lamp is not a point: nearer than its size its light does not grow on.
            let distance2 = |up: f64| to.length_squared() + up * up + 0.25;
            sum[0] += INTENSITY * squared(self.height_m) / squared(distance2(self.height_m));
            for (value, share) in sum[1..3].iter_mut().zip(WALL_HEIGHTS) {
                let up = self.height_m * (1.0 - share);
                *value += INTENSITY * up * facing(to) / squared(distance2(up));
            }
        }
        // Just inside, so that the opening itself is in sight.
        for window in around(&self.windows, p).filter(|window| reached(window.centre_m + window.inward * 0.02)) {
            let to = window.centre_m - p;
            let ahead = (-to.dot(window.inward)).max(0.0);
            let up = 0.5 * self.height_m;
            let area = DAYLIGHT * window.width_m * self.height_m / std::f64::consts::PI;
            sum[0] += area * ahead * up / squared(to.length_squared() + up * up + 0.5);
            for value in &mut sum[1..3] {
                *value += area * ahead * facing(to) / squared(to.length_squared() + 1.0);
            }
        }
        sum
    }
}

fn squared(value: f64) -> f64 {
    value * value
}

fn bucket(p: Vec2) -> (i64, i64) {
    ((p.x / REACH_M).floor() as i64, (p.y / REACH_M).floor() as i64)
}

/// Sources in the buckets around a place, in a fixed order: sums stay the same.
fn around<T>(buckets: &SourceBuckets<T>, p: Vec2) -> impl Iterator<Item = &T> {
    let (column, row) = bucket(p);
    let keys = (-1..=1).flat_map(move |dx| (-1..=1).map(move |dy| (column + dx, row + dy)));
    keys.filter_map(|key| buckets.get(&key)).flatten()
}

/// A lamp's four corners, metres.
pub(super) fn corners(lamp: &Lamp) -> [Vec2; 4] {
    let (along, across) = (lamp.along * 0.6, lamp.along.left() * 0.3);
    [vec2(-1.0, -1.0), vec2(1.0, -1.0), vec2(1.0, 1.0), vec2(-1.0, 1.0)]
        .map(|corner| lamp.centre_m + along * corner.x + across * corner.y)
}
