//! Periodic noise tiles in texels; each print reads them at a separate offset.
//!
//! Not imageproc's filters: they do not wrap around.

use super::lanes::{LANES, Lanes};
use super::window::WINDOW;
use crate::math::SplitMix64;

/// Fixed-point value of 1 in noise tiles.
pub(super) const NOISE_ONE: f32 = 16_384.0;

/// A periodic square of noise. Prints shift it by whole [`Lanes`], in step with the texels of a window.
#[derive(Debug)]
pub(super) struct NoiseTile {
    /// Texels a side, a power of two.
    size: usize,
    lanes: Vec<Lanes<u16>>,
}

/// View of a tile for reading single texels.
#[derive(Clone, Copy, Debug)]
pub(super) struct NoiseRaster<'a> {
    values: &'a [u16],
    bits: u32,
    mask: u32,
}

impl NoiseRaster<'_> {
    /// Index of the value at a column and row; both wrap around.
    #[inline]
    pub(super) fn place(&self, i: u32, j: u32) -> u32 {
        (j & self.mask) << self.bits | i & self.mask
    }

    /// The fixed-point value at an index.
    #[inline]
    pub(super) fn at(&self, place: u32) -> u16 {
        self.values.get(place as usize).copied().unwrap_or(0)
    }

    /// Copies values of a row, starting at a column.
    #[inline]
    pub(super) fn copy_row(&self, i: u32, j: u32, mut out: &mut [u16]) {
        let row = &self.values[self.place(0, j) as usize..][..=self.mask as usize];
        let mut from = (i & self.mask) as usize;
        while !out.is_empty() {
            let count = out.len().min(row.len() - from);
            let (now, later) = out.split_at_mut(count);
            now.copy_from_slice(&row[from..from + count]);
            (out, from) = (later, 0);
        }
    }
}

/// A row of a tile.
#[derive(Clone, Copy, Debug)]
pub(super) struct NoiseRow<'a> {
    lanes: &'a [Lanes<u16>],
    first: usize,
}

/// Seed of all tiles; the scenario's seed does not change it.
const SEED: u64 = 0x6e6f_6973_6521;

impl NoiseTile {
    /// Noise of mean 1 at 25, 8 and 2 mm; the tile's side is about a sole's length.
    pub(super) fn grain(texels_per_metre: f64, deviation: f64, seed: u64) -> NoiseTile {
        NoiseTile::of_scales(tile_size(texels_per_metre), texels_per_metre, &[0.025, 0.008, 0.002], deviation, seed)
    }

    /// Noise of mean 1 and the given standard deviation, clamped at 2.5 deviations. `size`: texels, a power of two.
    ///
    /// Each scale, in metres, adds an octave of blurred white noise; all have equal variance. Octaves below a texel are
    /// attenuated like the mean over a texel.
    pub(super) fn of_scales(
        size: usize,
        texels_per_metre: f64,
        scales_m: &[f64],
        deviation: f64,
        seed: u64,
    ) -> NoiseTile {
        let mut sum = vec![0.0; size * size];
        for (octave, scale_m) in scales_m.iter().enumerate() {
            let scale = scale_m * texels_per_metre;
            let mut white = white(size, seed.wrapping_add(octave as u64));
            let share = if scale < 1.0 {
                scale
            } else {
                blur_periodic(&mut white, size, scale * 0.5);
                1.0
            };
            let factor = share / (deviation_of(&white) * (scales_m.len() as f64).sqrt());
            for (total, value) in sum.iter_mut().zip(&white) {
                *total += *value * factor;
            }
        }
        let mut values: Vec<f64> = sum.iter().map(|z| (1.0 + deviation * z.clamp(-2.5, 2.5)).max(0.05)).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        for value in &mut values {
            *value *= f64::from(NOISE_ONE) / mean;
        }
        NoiseTile::new(size, &values)
    }

    /// Dither: uniform in `0..65536`, independent per texel, for unbiased rounding.
    pub(super) fn dither(texels_per_metre: f64) -> NoiseTile {
        let size = tile_size(texels_per_metre);
        let rng = &mut SplitMix64::new(SEED ^ 0xd17e);
        let values: Vec<f64> = (0..size * size).map(|_| (rng.next_u64() >> 48) as f64).collect();
        NoiseTile::new(size, &values)
    }

    fn new(size: usize, values: &[f64]) -> NoiseTile {
        let lanes = values.chunks_exact(LANES).map(|v| std::array::from_fn(|k| v[k].round() as u16)).collect();
        NoiseTile { size, lanes }
    }

    /// Returns the view for reading single texels.
    pub(super) fn raster(&self) -> NoiseRaster<'_> {
        NoiseRaster { values: self.lanes.as_flattened(), bits: self.size.trailing_zeros(), mask: self.size as u32 - 1 }
    }

    /// Row `j` of the floor from texel `LANES * lanes` on, for a print with noise offset `at`.
    #[inline]
    pub(super) fn row(&self, at: [u32; 2], lanes: u32, j: u32) -> NoiseRow<'_> {
        let row = j.wrapping_add(at[1]) as usize & (self.size - 1);
        let count = self.size / LANES;
        NoiseRow { lanes: &self.lanes[row * count..][..count], first: lanes.wrapping_add(at[0]) as usize }
    }

    /// Largest value, in units of [`NOISE_ONE`].
    pub(super) fn peak(&self) -> f32 {
        f32::from(self.lanes.iter().flatten().fold(0, |a, &b| a.max(b))) / NOISE_ONE
    }
}

impl<'a> NoiseRow<'a> {
    /// Copies the first `count` texels of the row.
    #[inline]
    pub(super) fn to_row(self, count: usize) -> [u16; WINDOW] {
        let mut row = [0; WINDOW];
        let (lanes, _) = row.as_chunks_mut::<LANES>();
        lanes.iter_mut().take(count.div_ceil(LANES)).zip(self.iter()).for_each(|(lane, noise)| *lane = *noise);
        row
    }

    /// Iterates over the lanes of the row.
    #[inline]
    pub(super) fn iter(self) -> impl Iterator<Item = &'a Lanes<u16>> {
        let mask = self.lanes.len() - 1;
        (self.first..).map(move |k| &self.lanes[k & mask])
    }
}

/// Side of a tile in texels: a power of two, about a sole's length.
fn tile_size(texels_per_metre: f64) -> usize {
    ((0.3 * texels_per_metre) as usize).clamp(64, 512).next_power_of_two()
}

fn white(size: usize, seed: u64) -> Vec<f64> {
    let rng = &mut SplitMix64::new(SEED ^ seed.wrapping_mul(0x9e37_79b9));
    (0..size * size).map(|_| f64::from(rng.normal())).collect()
}

/// Approximates a Gaussian by three periodic box filters along each axis.
fn blur_periodic(values: &mut [f64], size: usize, deviation: f64) {
    // Three boxes of width 2 r + 1 have the variance ((2 r + 1)^2 - 1) / 4.
    let radius = (((4.0 * deviation * deviation + 1.0).sqrt() - 1.0) * 0.5).round() as usize;
    if radius == 0 {
        return;
    }
    let radius = radius.min(size / 2 - 1);
    let width = (2 * radius + 1) as f64;
    let mut line = vec![0.0; size];
    for _ in 0..3 {
        for (step, stride) in [(1, size), (size, 1)] {
            for k in 0..size {
                for (n, value) in line.iter_mut().enumerate() {
                    *value = values[k * stride + n * step];
                }
                let mut sum: f64 = (0..=2 * radius).map(|n| line[(n + size - radius) % size]).sum();
                for n in 0..size {
                    values[k * stride + n * step] = sum / width;
                    sum += line[(n + radius + 1) % size] - line[(n + size - radius) % size];
                }
            }
        }
    }
}

fn deviation_of(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let variance = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / values.len() as f64;
    variance.sqrt().max(1e-9)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grain_is_one_in_the_mean_and_varies_as_asked() {
        for texels_per_metre in [25.0, 100.0, 400.0] {
            let tile = NoiseTile::grain(texels_per_metre, 0.35, 1);
            let all: Vec<f64> = tile.lanes.iter().flatten().map(|&v| f64::from(v) / f64::from(NOISE_ONE)).collect();
            assert_eq!(all.len(), tile.size * tile.size);
            assert!((all.iter().sum::<f64>() / all.len() as f64 - 1.0).abs() < 1e-4);
            let deviation = deviation_of(&all);
            assert!(deviation > 0.12 && deviation < 0.36, "{deviation} at {texels_per_metre}");
            assert!(tile.peak() < 2.0);
        }
    }

    #[test]
    fn rows_repeat() {
        let tile = NoiseTile::dither(100.0);
        let row = |at, lanes, j| tile.row(at, lanes, j).iter().take(20).flatten().copied().collect::<Vec<u16>>();
        let size = tile.size as u32;
        assert_eq!(row([3, 5], 0, 0), row([3, 5], size / LANES as u32, size));
        assert_eq!(row([3, 5], 1, 2), row([4, 7], 0, 0));
        assert_ne!(row([3, 5], 0, 0), row([4, 5], 0, 0));
    }
}
