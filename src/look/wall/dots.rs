//! Small round spots at random positions: pores of concrete, droplets.

use super::strip::FaceStrip;
use crate::look::lattice::TexelWindow;
use crate::look::noise;
use crate::math::{SplitMix64, exp, exp_f32};

/// Side of the squares in which spots are drawn, metres.
const SIDE_M: f64 = 0.10;

/// Number, radius and depth of spots, least to largest; small ones are more frequent.
#[derive(Clone, Copy, Debug)]
pub(super) struct DotSettings {
    pub per_m2: f64,
    pub radius_m: [f32; 2],
    pub depth: [f32; 2],
}

/// Random spots: the number per square has a Poisson distribution.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dots {
    key: u32,
    spread: DotSettings,
}

impl Dots {
    pub fn new(key: u32, spread: DotSettings) -> Dots {
        Dots { key, spread }
    }

    /// Depth of the spots over a window, as a mean over each texel.
    pub fn over(&self, window: &TexelWindow, strip: &FaceStrip) -> Vec<f32> {
        let mut out = vec![0.0; window.texels()];
        let density = strip.texels_per_metre;
        // A whole number of squares fits the strip.
        let around = (f64::from(strip.width) / (SIDE_M * density)).round().max(1.0);
        let (across, up) = (f64::from(strip.width) / around, SIDE_M * density);
        let margin = (3.0 * f64::from(self.spread.radius_m[1]) * density) + 2.0;
        let range = |first: i64, count: usize, side: f64| {
            let low = ((first as f64 - margin) / side).floor() as i64;
            low..=(((first + count as i64) as f64 + margin) / side).floor() as i64
        };
        let mean = self.spread.per_m2 * (across / density) * SIDE_M;
        for row in range(window.j0, window.height, up) {
            for column in range(window.i0, window.width, across) {
                let drawn = if strip.closed { column.rem_euclid(around as i64) } else { column };
                let word = u64::from(noise::hash(self.key ^ strip.salt, drawn as i32, row as i32));
                let mut rng = SplitMix64::new(word);
                for _ in 0..poisson(mean, &mut rng) {
                    let place =
                        [(column as f64 + f64::from(rng.unit())) * across, (row as f64 + f64::from(rng.unit())) * up];
                    let [least, largest] = self.spread.radius_m;
                    let size = rng.unit();
                    let radius = (least + (largest - least) * size * size * size) * density as f32;
                    let depth = rng.range(self.spread.depth[0], self.spread.depth[1]);
                    splat(&mut out, window, place, radius, depth);
                }
            }
        }
        out
    }
}

/// Draws a Poisson number of the given mean, at most a few hundred.
pub(super) fn poisson(mean: f64, rng: &mut SplitMix64) -> usize {
    let (limit, mut product, mut count) = (exp(-mean.min(500.0)), 1.0, 0);
    loop {
        product *= f64::from(rng.unit());
        if product <= limit || count > 1000 {
            return count;
        }
        count += 1;
    }
}

/// Applies a Gaussian spot by maximum, at a position in texels of the strip. A spot smaller than texels keeps its
/// volume.
pub(super) fn splat(out: &mut [f32], window: &TexelWindow, [x, y]: [f64; 2], radius: f32, depth: f32) {
    // Variance of a disc, and of a texel.
    let variance = radius * radius / 4.0 + 1.0 / 12.0;
    let depth = depth * (radius * radius / 4.0) / variance;
    let reach = f64::from(3.0 * variance.sqrt());
    let range = |at: f64, first: i64, count: usize| {
        let within = |texel: f64| texel.clamp(first as f64, (first + count as i64) as f64) as i64;
        within((at - reach).floor())..within((at + reach).ceil())
    };
    for j in range(y, window.j0, window.height) {
        let row = (j - window.j0) as usize * window.width;
        for i in range(x, window.i0, window.width) {
            let (dx, dy) = ((i as f64 + 0.5 - x) as f32, (j as f64 + 0.5 - y) as f32);
            let value = depth * exp_f32(-0.5 * (dx * dx + dy * dy) / variance);
            let out = &mut out[row + (i - window.i0) as usize];
            *out = out.max(value);
        }
    }
}
