//! What is measured of a floor: the same of a photograph and of ours.

use rayon::prelude::*;

use super::photo::FloorPicture;
use crate::look::dirt::shown_over;
use crate::math::srgb::{self, lightness, luminance};
use crate::math::{ln, sin_cos, smoothstep_f32};
use crate::patterns::{PixelRaster, quantile};

/// Distance over which the floor is evened out to find lanes, metres.
const LANE_M: f64 = 0.25;
/// Texels nearer to a wall than this belong to its line.
pub(super) const LINE_M: f64 = 0.25;
/// Grain is what differs from its surroundings of this size, blotches what is between these sizes, metres.
const GRAIN_M: f64 = 0.02;
const BLOTCHES_M: [f64; 2] = [0.03, 0.12];
/// Coarser texels show no grain.
pub(super) const GRAIN_TEXELS_PER_M: f64 = 70.0;
/// Shares of the lane's density: more is lane, less is margin.
const LANE_SHARE: f64 = 0.7;
const MARGIN_SHARE: f64 = 0.12;
/// Below the first share nobody walked, beyond the second all density is the lane's.
const QUIET_SHARE: [f32; 2] = [0.08, 0.3];
/// A mark is a dark line: half its length, the distance to floor on both sides, metres, and how far it stands out.
const HALF_MARK_M: f64 = 0.02;
const BESIDE_MARK_M: f64 = 0.015;
const STANDS_OUT: f64 = 5.0;
/// Directions in which lines are looked for.
const DIRECTIONS: usize = 8;
/// Pieces nearer than this are one mark; what is longer is a seam, a joint or the border of a mop's pass, metres.
const JOINED_M: f64 = 0.02;
const LONGEST_MARK_M: f64 = 0.25;
/// Least difference of a mark, of 255.
const LEAST_MARK: f64 = 7.0;
/// Distances from a wall: its line, what lies beside it, and the floor that both are compared with, metres.
const BANDS_M: [[f64; 2]; 3] = [[0.0, 0.04], [0.04, 0.1], [0.18, 0.3]];

/// Optical density of soil that turns one luminance into another.
pub(super) fn density(soil: f64, clean: f64, shown: f64) -> f64 {
    let soil = f64::from(shown_over(clean as f32, soil as f32));
    -ln(((shown - soil) / (clean - soil)).clamp(0.02, 1.5))
}

/// Evens out over a standard deviation.
fn evened(raster: &PixelRaster, sd_m: f64, texels_per_metre: f64) -> PixelRaster {
    // Three boxes of 2 r + 1 texels have a variance of (2 r + 1)^2 / 4.
    raster.blurred((sd_m * texels_per_metre - 0.5).round().max(0.0) as usize, 3)
}

/// Parts of the floor, found in the photograph.
pub(super) struct Parts {
    pub lane: Vec<bool>,
    pub margin: Vec<bool>,
    /// Density of the evened floor relative to the lane's.
    pub share: PixelRaster,
    /// How much the lane differs from the margin, of 255.
    pub contrast: f64,
    /// Metres to the nearest wall, per texel.
    to_wall: Vec<f64>,
    pub has_walls: bool,
}

impl Parts {
    /// Finds lane and margin. `ignored` texels are neither.
    pub fn find(floor: &FloorPicture, soil: f64, is_darker: bool, walls: [bool; 4], ignored: Option<&[bool]>) -> Parts {
        let [width, height] = floor.size();
        let t = floor.texels_per_metre;
        let metres = |texels: usize| (texels as f64 + 0.5) / t;
        let distance = |x: usize, y: usize| {
            let sides = [metres(y), metres(width - 1 - x), metres(height - 1 - y), metres(x)];
            sides.into_iter().zip(walls).filter(|(_, wall)| *wall).map(|(d, _)| d).fold(f64::INFINITY, f64::min)
        };
        let to_wall: Vec<f64> = (0..width * height).map(|at| distance(at % width, at / width)).collect();
        // The line along a wall is no lane: the floor beside it stands there.
        let line = (LINE_M * t) as usize;
        let inside = |k: usize, count: usize, [low, high]: [bool; 2]| {
            let least = if low { line.min(count / 3) } else { 0 };
            let most = count - 1 - if high { line.min(count / 3) } else { 0 };
            k.clamp(least, most)
        };
        let tone = floor.tone();
        let moved = PixelRaster::from_fn(width, height, |x, y| {
            let (x, y) = (inside(x, width, [walls[3], walls[1]]), inside(y, height, [walls[0], walls[2]]));
            tone.values[y * width + x]
        });
        let even = evened(&moved, LANE_M, t);
        let usable = |at: usize| to_wall[at] > LINE_M && ignored.is_none_or(|ignored| !ignored[at]);
        let sign = if is_darker { 1.0f32 } else { -1.0 };
        let values = || (0..even.values.len()).filter(|&at| usable(at)).map(|at| sign * even.values[at]);
        let (quiet, trodden) = (quantile(values(), 0.97), quantile(values(), 0.05));
        let light = |signed: f64| srgb::decode((f64::from(sign) * signed).clamp(0.0, 255.0) / 255.0);
        let deepest = density(soil, light(quiet), light(trodden)).max(1e-6);
        let share = even.map(|tone| (density(soil, light(quiet), light(f64::from(sign * tone))) / deepest) as f32);
        let of = |within: &dyn Fn(f64) -> bool| -> Vec<bool> {
            (0..share.values.len()).map(|at| usable(at) && within(f64::from(share.values[at]))).collect()
        };
        let lane = of(&|share| share > LANE_SHARE);
        let margin = of(&|share| share < MARGIN_SHARE);
        let mut parts =
            Parts { lane, margin, share, contrast: quiet - trodden, has_walls: walls.contains(&true), to_wall };
        // Relative to the lane as it is in the mean, not at its deepest.
        let (mut sum, mut count) = (0.0, 0.0f64);
        for (share, _) in parts.share.values.iter().zip(&parts.lane).filter(|(_, lane)| **lane) {
            sum += f64::from(*share);
            count += 1.0;
        }
        let mean = (sum / count.max(1.0)).max(1e-3) as f32;
        // A margin that only looks trodden because it is uneven has seen nobody.
        let quiet = |share: f32| share * smoothstep_f32((share - QUIET_SHARE[0]) / (QUIET_SHARE[1] - QUIET_SHARE[0]));
        parts.share = parts.share.map(|share| quiet(share / mean).clamp(0.0, 1.6));
        parts
    }

    /// Area of lane and margin.
    pub fn area_m2(&self, texels_per_metre: f64) -> f64 {
        let texels = self.lane.iter().zip(&self.margin).filter(|(lane, margin)| **lane || **margin).count();
        texels.max(1) as f64 / (texels_per_metre * texels_per_metre)
    }
}

/// How much darker each texel's best line is than the floor on both of its sides.
fn lines(tone: &PixelRaster, texels_per_metre: f64) -> PixelRaster {
    let half = (HALF_MARK_M * texels_per_metre).max(1.0);
    let beside = (BESIDE_MARK_M * texels_per_metre).max(1.5);
    let (width, height) = (tone.width as i64, tone.height as i64);
    // Offsets of the line and of the lines on both sides, per direction.
    let steps = half.round() as i64;
    let offsets: Vec<[Vec<[i64; 2]>; 3]> = (0..DIRECTIONS)
        .map(|n| {
            let (sin, cos) = sin_cos(n as f64 * std::f64::consts::PI / DIRECTIONS as f64);
            [0.0, beside, -beside].map(|aside| {
                let place = |k: i64| {
                    let along = k as f64 * half / steps as f64;
                    [along * cos - aside * sin, along * sin + aside * cos].map(|d| d.round() as i64)
                };
                (-steps..=steps).map(place).collect()
            })
        })
        .collect();
    let reach = (half + beside).ceil() as i64 + 1;
    let at = |x: i64, y: i64| -> f32 {
        if x < reach || y < reach || x >= width - reach || y >= height - reach {
            return 0.0;
        }
        let mean = |line: &[[i64; 2]]| {
            let sum: f32 = line.iter().map(|[u, v]| tone.values[((y + v) * width + x + u) as usize]).sum();
            sum / line.len() as f32
        };
        let stands_out = |[line, left, right]: &[Vec<[i64; 2]>; 3]| mean(left).min(mean(right)) - mean(line);
        offsets.iter().map(stands_out).fold(0.0, f32::max)
    };
    let values = (0..tone.values.len()).into_par_iter().map(|k| at(k as i64 % width, k as i64 / width)).collect();
    PixelRaster { width: tone.width, height: tone.height, values }
}

fn difference(a: &PixelRaster, b: &PixelRaster) -> PixelRaster {
    PixelRaster::from_fn(a.width, a.height, |x, y| a.values[y * a.width + x] - b.values[y * a.width + x])
}

/// Values where a mask is set.
fn picked<'a>(raster: &'a PixelRaster, mask: &'a [bool]) -> impl Iterator<Item = f32> + 'a {
    raster.values.iter().zip(mask).filter(|(_, is)| **is).map(|(value, _)| *value)
}

/// Standard deviation, of what is not exceptional: half the distance between 16 and 84 percent.
fn spread(raster: &PixelRaster, mask: &[bool]) -> f64 {
    0.5 * (quantile(picked(raster, mask), 0.8413) - quantile(picked(raster, mask), 0.1587))
}

/// Median of each channel, linear.
pub(super) fn colour(floor: &FloorPicture, mask: &[bool]) -> [f64; 3] {
    floor.rgb.each_ref().map(|plane| quantile(picked(plane, mask), 0.5))
}

/// Variance of the tone at one scale, of 255 squared.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Uneven {
    /// On the lane.
    pub lane: f64,
    /// On the lane beyond the margin's: without the texture of the floor and the camera's noise.
    pub beyond: f64,
}

/// What was measured of a floor.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Measured {
    /// Linear colour of the margin, and of the lane.
    pub margin: [f64; 3],
    pub lane: [f64; 3],
    /// Grain and blotches.
    pub grain: Uneven,
    pub blotches: Uneven,
    /// How much the line at the wall and what is beside it differ from the floor, of 255; 0 without walls.
    pub edge: [f64; 2],
}

impl Measured {
    /// Colours and the line at the wall alone.
    pub fn of_colours(floor: &FloorPicture, parts: &Parts) -> Measured {
        let tone = parts.has_walls.then(|| floor.tone());
        Measured::without_unevenness(floor, tone.as_ref(), parts)
    }

    fn without_unevenness(floor: &FloorPicture, tone: Option<&PixelRaster>, parts: &Parts) -> Measured {
        Measured {
            margin: colour(floor, &parts.margin),
            lane: colour(floor, &parts.lane),
            edge: tone.filter(|_| parts.has_walls).map_or([0.0; 2], |tone| edge(tone, parts)),
            ..Measured::default()
        }
    }

    pub fn of(floor: &FloorPicture, parts: &Parts) -> Measured {
        let t = floor.texels_per_metre;
        let tone = floor.tone();
        let uneven = |raster: &PixelRaster| {
            let [lane, margin] = [&parts.lane, &parts.margin].map(|mask| spread(raster, mask));
            Uneven { lane: lane * lane, beyond: lane * lane - margin * margin }
        };
        let [small, large] = BLOTCHES_M.map(|sd_m| evened(&tone, sd_m, t));
        Measured {
            grain: uneven(&difference(&tone, &evened(&tone, GRAIN_M, t))),
            blotches: uneven(&difference(&small, &large)),
            ..Measured::without_unevenness(floor, Some(&tone), parts)
        }
    }

    /// The mean of several floors.
    pub fn mean(all: &[Measured]) -> Measured {
        let of = |part: &dyn Fn(&Measured) -> f64| all.iter().map(part).sum::<f64>() / all.len().max(1) as f64;
        Measured {
            margin: [0, 1, 2].map(|k| of(&|m| m.margin[k])),
            lane: [0, 1, 2].map(|k| of(&|m| m.lane[k])),
            grain: Uneven { lane: of(&|m| m.grain.lane), beyond: of(&|m| m.grain.beyond) },
            blotches: Uneven { lane: of(&|m| m.blotches.lane), beyond: of(&|m| m.blotches.beyond) },
            edge: [0, 1].map(|k| of(&|m| m.edge[k])),
        }
    }

    pub fn contrast(&self) -> f64 {
        lightness(luminance(self.lane)) - lightness(luminance(self.margin))
    }
}

fn edge(tone: &PixelRaster, parts: &Parts) -> [f64; 2] {
    let mut sums = [[0.0f64; 2]; 3];
    for (&tone, distance) in tone.values.iter().zip(&parts.to_wall) {
        for (sum, [from, to]) in sums.iter_mut().zip(BANDS_M) {
            if (from..to).contains(distance) {
                sum[0] += f64::from(tone);
                sum[1] += 1.0;
            }
        }
    }
    let [line, beside, floor] = sums.map(|[sum, count]| sum / count.max(1.0));
    [floor - line, floor - beside]
}

/// Counts dark lines of two texels at least on lane and margin, per square metre.
pub(super) fn marks_per_m2(floor: &FloorPicture, parts: &Parts) -> f64 {
    let Parts { lane, margin, .. } = parts;
    let lines = lines(&floor.tone(), floor.texels_per_metre);
    // Against the grain of this floor, so that chance is taken for a mark as often on any.
    let [on_lane, on_margin] = [lane, margin].map(|mask| {
        let at = |rank| quantile(picked(&lines, mask), rank);
        (at(0.5) + STANDS_OUT * (at(0.8413) - at(0.5))).max(LEAST_MARK) as f32
    });
    let (width, height) = (lines.width, lines.height);
    let is_dark = |at: usize| {
        let least = if lane[at] { on_lane } else { on_margin };
        (lane[at] || margin[at]) && lines.values[at] > least
    };
    let mut dark: Vec<bool> = (0..lines.values.len()).map(is_dark).collect();
    let (mut count, mut open) = (0u32, Vec::new());
    let reach = (JOINED_M * floor.texels_per_metre).round().max(1.0) as usize;
    for first in 0..dark.len() {
        if !std::mem::take(&mut dark[first]) {
            continue;
        }
        open.push(first);
        let mut texels = 0;
        let (mut low, mut high) = ([usize::MAX; 2], [0; 2]);
        while let Some(at) = open.pop() {
            texels += 1;
            let place = [at % width, at / width];
            for axis in 0..2 {
                low[axis] = low[axis].min(place[axis]);
                high[axis] = high[axis].max(place[axis]);
            }
            for v in place[1].saturating_sub(reach)..(place[1] + reach + 1).min(height) {
                for u in place[0].saturating_sub(reach)..(place[0] + reach + 1).min(width) {
                    if std::mem::take(&mut dark[v * width + u]) {
                        open.push(v * width + u);
                    }
                }
            }
        }
        let longest = (high[0] - low[0]).max(high[1] - low[1]) as f64 / floor.texels_per_metre;
        count += u32::from(texels >= 2 && longest <= LONGEST_MARK_M);
    }
    f64::from(count) / parts.area_m2(floor.texels_per_metre)
}
