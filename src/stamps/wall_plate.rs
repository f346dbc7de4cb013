//! Wall patterns, filtered for the texels of their stains.
//!
//! A contact stretches its pattern by different factors along and across, so a texel covers an ellipse of it. A plate
//! is the pattern filtered with a Gaussian with one standard deviation along and one across. Deviations are rounded up
//! to half octaves; each pair is filtered on first use.

use std::sync::OnceLock;

use super::float_image::{FILTER_REACH, FloatImage};
use crate::math::ln;
use crate::patterns::{Cause, Pattern};

/// Smallest standard deviation of a plate's filter, metres of the pattern: 1/4 pattern pixel.
const FINEST_M: f64 = 0.000_25;

/// Number of deviation levels along and across: up to 11 m, for a texel of 1 m on a pattern squeezed to 1/25.
const LEVELS: usize = 32;

/// Largest difference of the levels along and across, a ratio of 16: keeps the filter from growing far beyond the
/// image.
const MOST_APART: usize = 8;

/// Distance of a plate's samples, standard deviations.
const SAMPLE: f64 = 0.7;

/// Approximate largest number of samples of a plate along an axis.
const MOST_SAMPLES: f64 = 1000.0;

/// A wall pattern with its plates.
#[derive(Debug)]
pub(super) struct WallPattern {
    pub(super) cause: Cause,
    /// Length along +x, metres.
    pub(super) length_m: f64,
    /// Extent across, metres.
    pub(super) breadth_m: f64,
    /// Centroid of the coverage, as shares of length and breadth from the pattern's middle.
    pub(super) centroid: [f64; 2],
    mass_m2: f64,
    coverage: FloatImage,
    plates: Vec<OnceLock<Box<WallPlate>>>,
}

/// A filtered and sampled pattern.
#[derive(Debug)]
pub(super) struct WallPlate {
    columns: usize,
    rows: usize,
    /// Four bytes per sample, from the lowest: the sample, the next, and the two below, in units of `unit`. The
    /// outermost samples are empty.
    quads: Vec<u32>,
    /// Coverage of a sample value of 1.
    unit: f32,
    /// Distance of the samples along and across, metres of the pattern.
    pub(super) pitch_m: [f64; 2],
    /// Extent of the coverage from the pattern's middle, metres of the pattern.
    pub(super) half_extent_m: [f64; 2],
    /// Largest coverage.
    pub(super) peak: f32,
}

impl WallPattern {
    /// Prepares a pattern; `None` for a floor pattern or an empty one.
    pub(super) fn new(pattern: &Pattern) -> Option<WallPattern> {
        pattern.cause.on_wall()?;
        let coverage = FloatImage::of(pattern);
        let (mass_m2, centroid) = coverage.mass_and_centroid();
        let [length_m, breadth_m] = [coverage.width, coverage.height].map(|count| count as f64 * coverage.pixel_m);
        // NaN must be refused.
        let sound = mass_m2 > 0.0 && length_m > 0.0 && length_m.is_finite();
        sound.then(|| WallPattern {
            cause: pattern.cause,
            length_m,
            breadth_m,
            centroid,
            mass_m2,
            coverage,
            plates: (0..LEVELS * LEVELS).map(|_| OnceLock::new()).collect(),
        })
    }

    /// Returns the plate for at least these filter deviations, metres of the pattern.
    pub(super) fn plate(&self, deviations_m: [f64; 2]) -> &WallPlate {
        let [along, across] = deviations_m.map(level);
        let along = along.max(across.saturating_sub(MOST_APART));
        let across = across.max(along.saturating_sub(MOST_APART));
        self.plates[along * LEVELS + across].get_or_init(|| Box::new(self.filtered([along, across].map(deviation_m))))
    }

    fn filtered(&self, deviations_m: [f64; 2]) -> WallPlate {
        let [finer, coarser] = [deviations_m[0].min(deviations_m[1]), deviations_m[0].max(deviations_m[1])];
        let mut image = self.coverage.reduced_for(finer);
        image = image.padded((FILTER_REACH * coarser / image.pixel_m).ceil() as usize + 1);
        image.blur_axes(deviations_m.map(|m| m / image.pixel_m));
        let extent_m = [self.length_m, self.breadth_m];
        let reach_m = deviations_m.map(|m| ((FILTER_REACH * m / image.pixel_m).ceil() + 2.0) * image.pixel_m);
        let pitch_m: [f64; 2] = std::array::from_fn(|k| (SAMPLE * deviations_m[k]).max(extent_m[k] / MOST_SAMPLES));
        let [columns, rows] =
            std::array::from_fn(|k| ((extent_m[k] + 2.0 * reach_m[k]) / pitch_m[k]).ceil() as usize + 3);
        let middle = [image.width, image.height].map(|count| count as f64 * 0.5);
        let place = |k: usize, count: usize, axis: usize| {
            middle[axis] + (k as f64 + 0.5 - count as f64 * 0.5) * pitch_m[axis] / image.pixel_m
        };
        let mut values = Vec::with_capacity(columns * rows);
        for row in 0..rows {
            let y = place(row, rows, 1);
            values.extend((0..columns).map(|column| image.at(place(column, columns, 0), y)));
        }
        WallPlate::new([columns, rows], &values, pitch_m, self.mass_m2)
    }
}

impl WallPlate {
    fn new([columns, rows]: [usize; 2], values: &[f32], pitch_m: [f64; 2], mass_m2: f64) -> WallPlate {
        let peak = values.iter().fold(1e-6f32, |a, &b| a.max(b));
        let bytes: Vec<u8> = values.iter().map(|v| (v / peak * 255.0 + 0.5) as u8).collect();
        let byte = |k: usize| u32::from(bytes.get(k).copied().unwrap_or(0));
        let quad = |k| byte(k) | byte(k + 1) << 8 | byte(k + columns) << 16 | byte(k + columns + 1) << 24;
        // Restores the integral, which truncating the filter, sampling and rounding change slightly.
        let sum = bytes.iter().map(|&byte| f64::from(byte)).sum::<f64>() * pitch_m[0] * pitch_m[1];
        let unit = if sum > 0.0 { (mass_m2 / sum) as f32 } else { 0.0 };
        let mut plate =
            WallPlate { columns, rows, quads: Vec::new(), unit, pitch_m, half_extent_m: [0.0; 2], peak: 255.0 * unit };
        let middle = plate.middle();
        for k in (0..bytes.len()).filter(|&k| bytes[k] > 0) {
            // Interpolation extends a sample to the next one.
            for (axis, place) in [k % columns, k / columns].into_iter().enumerate() {
                let reach_m = ((place as f64 - middle[axis]).abs() + 1.0) * pitch_m[axis];
                plate.half_extent_m[axis] = plate.half_extent_m[axis].max(reach_m);
            }
        }
        plate.quads = (0..bytes.len()).map(quad).collect();
        plate
    }

    /// Position of the pattern's middle, in samples.
    pub(super) fn middle(&self) -> [f64; 2] {
        [self.columns, self.rows].map(|count| count as f64 * 0.5 - 0.5)
    }

    /// Finds the samples around positions in a row of texels; replaces the positions by fractions.
    #[inline]
    pub(super) fn find(&self, along: &mut [f32], across: &mut [f32], quads: &mut [u32]) {
        // The outermost samples are empty, so positions beyond are clamped to them.
        let [most_along, most_across] = [self.columns, self.rows].map(|count| (count - 2) as f32);
        let columns = self.columns as f32;
        for ((u, v), quad) in along.iter_mut().zip(across).zip(&mut *quads) {
            (*u, *v) = (u.max(0.0).min(most_along), v.max(0.0).min(most_across));
            let (column, row) = (whole(*u), whole(*v));
            (*u, *v) = (*u - column, *v - row);
            *quad = bits_of(row * columns + column);
        }
        for quad in quads {
            *quad = self.quads.get(*quad as usize).copied().unwrap_or(0);
        }
    }

    /// Interpolates coverage bilinearly between four samples.
    #[inline]
    pub(super) fn between(&self, quad: u32, along: f32, across: f32) -> f32 {
        let byte = |shift: u32| (quad >> shift & 0xff) as i32 as f32;
        let lower = byte(0) + (byte(8) - byte(0)) * along;
        let upper = byte(16) + (byte(24) - byte(16)) * along;
        (lower + (upper - lower) * across) * self.unit
    }
}

/// Adding this rounds to the nearest integer without a range check, so that loops vectorise.
const ROUND: f32 = 12_582_912.0;

/// Floor of a value up to 4 million; may be one less for integers.
#[inline]
pub(super) fn whole(value: f32) -> f32 {
    (value - 0.5 + ROUND) - ROUND
}

/// Bits of an integer from -4 to 4 million.
#[inline]
pub(super) fn bits_of(whole: f32) -> u32 {
    (whole + ROUND).to_bits().wrapping_sub(ROUND.to_bits())
}

/// Smallest level with at least this deviation, or the last one.
fn level(deviation_m: f64) -> usize {
    const LEVELS_PER_E: f64 = 2.0 / std::f64::consts::LN_2;
    (ln(deviation_m.max(FINEST_M) / FINEST_M) * LEVELS_PER_E).ceil().min((LEVELS - 1) as f64) as usize
}

fn deviation_m(level: usize) -> f64 {
    let half = if level % 2 == 1 { std::f64::consts::SQRT_2 } else { 1.0 };
    FINEST_M * half * (1u64 << (level / 2)) as f64
}
