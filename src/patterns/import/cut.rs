//! Cuts a stain out of its density: rotated, at 10 px/cm, denoised, with a soft edge.

use image::{GrayImage, Luma};
use rayon::prelude::*;

use super::photo::Photo;
use super::raster::{PixelRaster, quantile};
use super::stain::StainMask;
use super::surface::WallSurface;
use super::{ImportError, ImportOptions, ImportedPattern, PhotoScale};
use crate::math::{Vec2, sin_cos, vec2};
use crate::patterns::{Cause, PATTERN_PX_PER_CM};

/// Width of the empty margin, pixels of the pattern.
const MARGIN_PX: usize = 3;
/// Share of the peak density from which a pixel belongs to the stain.
const FAINTEST: f64 = 0.04;
/// Share of a stain's pixels that may be denser than its peak.
const BEYOND_PEAK: f64 = 0.005;
/// Pixels of the photograph per pixel of the pattern from which the photograph counts as finer.
const FINER: f64 = 1.5;
/// Limit on the samples along a side of a pixel.
const MOST_SAMPLES: usize = 16;

/// The pattern's raster in the photograph.
struct PatternFrame {
    /// Middle of the frame, pixels of [`Photo`].
    middle: Vec2,
    /// Direction of the pattern's x axis in the photograph, whose y runs down.
    along: Vec2,
    /// Pixels of [`Photo`] per pixel of the pattern.
    step: f64,
    width: usize,
    height: usize,
}

/// The density of a photograph and the place of the stain in it.
struct CutSource<'a> {
    density: &'a PixelRaster,
    stain: &'a StainMask,
    /// Pixels of the density per pixel of the stain's raster.
    factor: usize,
    /// Extent of the stain.
    core: StainExtent,
    /// Direction of the pattern's x axis.
    along: Vec2,
    cause: Cause,
}

/// Cuts the stain out at the scale that the options give or imply.
pub(super) fn cut_out(
    photo: Photo,
    density: &PixelRaster,
    stain: &StainMask,
    surface: &WallSurface,
    options: &ImportOptions,
) -> Result<ImportedPattern, ImportError> {
    // Rows run down, so a counter-clockwise rotation takes the direction (c, s) to the pattern's +x.
    let (s, c) = sin_cos(options.rotate_deg.to_radians());
    let along = vec2(c, s);
    let core = extent(stain, surface.factor, along);
    let source = CutSource { density, stain, factor: surface.factor, core, along, cause: options.cause };
    let per_pixel = photo.factor as f64;
    let (px_per_cm, cut) = match options.size {
        PhotoScale::PxPerCm(scale) => (scale, source.cut(scale / per_pixel)?),
        PhotoScale::LengthCm(length_cm) => {
            let checked = |length_px: f64| {
                let px_per_cm = length_px / length_cm;
                let fits = (4.0..=200.0).contains(&px_per_cm);
                fits.then_some(px_per_cm).ok_or(ImportError::Scale { length_px, length_cm, px_per_cm })
            };
            // The exact length of the stain is known only after a first cut.
            let guess = checked(source.core.length * per_pixel)?;
            let measured = source.cut(guess / per_pixel)?.stain_cm[0];
            let px_per_cm = checked(measured * guess)?;
            (px_per_cm, source.cut(px_per_cm / per_pixel)?)
        }
    };
    let (width, height) = cut.coverage.dimensions();
    let [length_cm, breadth_cm] = [width, height].map(|px| f64::from(px) / PATTERN_PX_PER_CM);
    check_extent(options.cause, length_cm, breadth_cm)?;
    Ok(ImportedPattern {
        cause: options.cause,
        form: options.form,
        coverage: cut.coverage,
        stain_cm: cut.stain_cm,
        peak_density: cut.peak_density,
        wall_noise: cut.wall_noise,
        lighter: surface.lighter,
        px_per_cm,
        middle_px: [
            cut.middle.x * per_pixel + f64::from(photo.corner_px[0]),
            cut.middle.y * per_pixel + f64::from(photo.corner_px[1]),
        ],
        cropped: photo.cropped,
        densities: density.map(|value| value / cut.peak_density as f32),
    })
}

/// A stain, cut out at one scale.
struct CutStain {
    coverage: GrayImage,
    stain_cm: [f64; 2],
    peak_density: f64,
    wall_noise: f64,
    /// Middle of the image, pixels of [`Photo`].
    middle: Vec2,
}

impl CutSource<'_> {
    /// Cuts the stain out; `px_per_cm` is the resolution of [`Photo`].
    fn cut(&self, px_per_cm: f64) -> Result<CutStain, ImportError> {
        let (core, window) = (&self.core, &self.stain.window);
        check_extent(self.cause, core.length / px_per_cm, core.breadth / px_per_cm)?;
        let step = px_per_cm / PATTERN_PX_PER_CM;
        // With room for the window's soft edge.
        let edge = 2.5 * (self.factor * window.width.max(window.height) / 40) as f64 + 4.0 * step;
        let size = |extent: f64| ((extent + 2.0 * edge) / step).ceil() as usize;
        let (width, height) = (size(core.length), size(core.breadth));
        let frame = PatternFrame { middle: core.middle, along: self.along, step, width, height }.on_grid();

        let raw = frame.sampled(self.density);
        let shown = frame.sampled_at(1, |p| {
            let p = p * (1.0 / self.factor as f64);
            let is_inside = p.x >= 0.0 && p.y >= 0.0 && p.x <= window.width as f64 && p.y <= window.height as f64;
            if is_inside { window.sample(p.x, p.y) } else { 0.0 }
        });
        let wall_noise = noise(self.density, self.stain, self.factor, step);
        let mut soft = denoised(&raw, wall_noise);
        soft.values.iter_mut().zip(&shown.values).for_each(|(value, shown)| *value = value.max(0.0) * shown);
        let peak_density = peak(&soft);
        if peak_density < 3.0 * wall_noise || peak_density <= 0.0 {
            return Err(ImportError::NoStain { noise: wall_noise });
        }
        let covered = soft.map(|value| (value / peak_density as f32).min(1.0));
        let bounds = bounds(&covered);
        let [across, down] = [bounds.width, bounds.height].map(|px| px as f64);
        let middle = frame.at(bounds.left as f64 + 0.5 * across, bounds.top as f64 + 0.5 * down);
        let stain_cm = [across, down].map(|px| px / PATTERN_PX_PER_CM);
        Ok(CutStain { coverage: cropped(&covered, &bounds), stain_cm, peak_density, wall_noise, middle })
    }
}

/// Middle and size of the stain along and across the rotated axes, pixels of [`Photo`].
struct StainExtent {
    middle: Vec2,
    length: f64,
    breadth: f64,
}

fn extent(stain: &StainMask, factor: usize, along: Vec2) -> StainExtent {
    let (mut low, mut high) = (vec2(f64::MAX, f64::MAX), vec2(f64::MIN, f64::MIN));
    for n in (0..stain.core.len()).filter(|&n| stain.core[n]) {
        let p = vec2((n % stain.window.width) as f64 + 0.5, (n / stain.window.width) as f64 + 0.5) * factor as f64;
        let p = vec2(p.dot(along), along.cross(p));
        low = vec2(low.x.min(p.x), low.y.min(p.y));
        high = vec2(high.x.max(p.x), high.y.max(p.y));
    }
    let size = high - low + vec2(1.0, 1.0) * factor as f64;
    let middle = (low + high) * 0.5;
    StainExtent { middle: along * middle.x + vec2(-along.y, along.x) * middle.y, length: size.x, breadth: size.y }
}

fn check_extent(cause: Cause, length_cm: f64, breadth_cm: f64) -> Result<(), ImportError> {
    let (lengths, [least, most_aspect]) = (cause.lengths_cm(), cause.aspects());
    let aspect = breadth_cm / length_cm;
    if (lengths[0]..=lengths[1]).contains(&length_cm) && (least..=most_aspect).contains(&aspect) {
        return Ok(());
    }
    Err(ImportError::Extent { cause, length_cm, breadth_cm, lengths_cm: lengths, most_aspect })
}

impl PatternFrame {
    /// Point of the photograph under a point of the pattern (pixels from its upper left).
    fn at(&self, x: f64, y: f64) -> Vec2 {
        let (x, y) = (x - 0.5 * self.width as f64, y - 0.5 * self.height as f64);
        self.middle + (self.along * x + vec2(-self.along.y, self.along.x) * y) * self.step
    }

    /// Moves the frame by less than a pixel onto the pixel grid of a photograph of the same resolution.
    fn on_grid(mut self) -> PatternFrame {
        let down = vec2(-self.along.y, self.along.x);
        let corner = self.at(0.0, 0.0);
        let off = |axis: Vec2| (corner.dot(axis) / self.step).round() * self.step - corner.dot(axis);
        self.middle = self.middle + self.along * off(self.along) + down * off(down);
        self
    }

    /// Means of a raster over the pattern's pixels; zero outside the raster.
    fn sampled(&self, raster: &PixelRaster) -> PixelRaster {
        let (width, height) = (raster.width as f64, raster.height as f64);
        let is_inside = |p: Vec2| p.x >= 0.0 && p.y >= 0.0 && p.x < width && p.y < height;
        if self.step < FINER {
            let samples = self.step.ceil() as usize;
            return self.sampled_at(samples, |p| if is_inside(p) { raster.sample(p.x, p.y) } else { 0.0 });
        }
        // Many nearest samples give the mean over an area; interpolated samples would blur as well.
        let samples = ((4.0 * self.step).ceil() as usize).min(MOST_SAMPLES);
        let at = |p: Vec2| raster.values[p.y as usize * raster.width + p.x as usize];
        self.sampled_at(samples, |p| if is_inside(p) { at(p) } else { 0.0 })
    }

    /// Means of a function over the pattern's pixels, of `samples` x `samples` points each.
    fn sampled_at(&self, samples: usize, value: impl Fn(Vec2) -> f32 + Sync) -> PixelRaster {
        let part = |k: usize| (k as f64 + 0.5) / samples as f64;
        let mean = |i: usize, j: usize| {
            let at = |n: usize| self.at(i as f64 + part(n % samples), j as f64 + part(n / samples));
            (0..samples * samples).map(|n| value(at(n))).sum::<f32>() / (samples * samples) as f32
        };
        let mut values = vec![0.0f32; self.width * self.height];
        values.par_chunks_exact_mut(self.width).enumerate().for_each(|(j, row)| {
            row.iter_mut().enumerate().for_each(|(i, value)| *value = mean(i, j));
        });
        PixelRaster { width: self.width, height: self.height, values }
    }
}

/// Standard deviation of the clean wall's density at the resolution of the pattern.
fn noise(density: &PixelRaster, stain: &StainMask, factor: usize, step: f64) -> f64 {
    let side = (step.round() as usize).max(1);
    let reduced = density.reduced(side);
    let per_coarse = factor as f64 / side as f64;
    let is_clean = |n: usize| {
        let (i, j) = ((n % reduced.width) as f64 + 0.5, (n / reduced.width) as f64 + 0.5);
        let at = |t: f64, count: usize| ((t / per_coarse) as usize).min(count - 1);
        stain.clean[at(j, stain.window.height) * stain.window.width + at(i, stain.window.width)]
    };
    let clean = reduced.values.iter().enumerate().filter(|(n, _)| is_clean(*n)).map(|(_, value)| value.abs());
    1.4826 * quantile(clean, 0.5)
}

/// Lee filter: moves each value towards its local mean by the share of the local variance that is noise.
///
/// Source: Lee 1980, doi 10.1109/TPAMI.1980.4766994.
fn denoised(raw: &PixelRaster, noise: f64) -> PixelRaster {
    const RADIUS: usize = 2;
    let mean = raw.blurred(RADIUS, 1);
    let square = raw.map(|value| value * value).blurred(RADIUS, 1);
    let variance_of_noise = (noise * noise) as f32;
    PixelRaster::from_fn(raw.width, raw.height, |i, j| {
        let n = j * raw.width + i;
        let variance = (square.values[n] - mean.values[n] * mean.values[n]).max(0.0);
        let signal = (variance - variance_of_noise).max(0.0) / variance.max(1e-12);
        mean.values[n] + signal * (raw.values[n] - mean.values[n])
    })
}

/// Peak density of a stain: the quantile that [`BEYOND_PEAK`] of its pixels exceed.
fn peak(soft: &PixelRaster) -> f64 {
    let highest = f64::from(soft.values.iter().copied().fold(0.0, f32::max));
    let on_it = soft.values.iter().copied().filter(|&value| f64::from(value) > FAINTEST * highest);
    quantile(on_it, 1.0 - BEYOND_PEAK)
}

/// Bounding box of the stain in its frame, pixels.
struct StainBounds {
    left: usize,
    top: usize,
    width: usize,
    height: usize,
}

fn bounds(covered: &PixelRaster) -> StainBounds {
    let smooth = covered.blurred(1, 1);
    let (mut low, mut high) = ([usize::MAX; 2], [0; 2]);
    for (n, _) in smooth.values.iter().enumerate().filter(|(_, value)| f64::from(**value) > FAINTEST) {
        for (axis, place) in [n % covered.width, n / covered.width].into_iter().enumerate() {
            low[axis] = low[axis].min(place);
            high[axis] = high[axis].max(place);
        }
    }
    // No pixel is above the threshold if the smoothing spread out a tiny peak.
    let [left, top] = low.map(|low| if low == usize::MAX { 0 } else { low });
    StainBounds {
        left,
        top,
        width: (high[0] + 1).saturating_sub(left).max(1),
        height: (high[1] + 1).saturating_sub(top).max(1),
    }
}

/// Crops the stain with a margin over which its coverage falls to zero.
fn cropped(covered: &PixelRaster, bounds: &StainBounds) -> GrayImage {
    let (width, height) = (bounds.width + 2 * MARGIN_PX, bounds.height + 2 * MARGIN_PX);
    let at = |column: u32, row: u32| {
        let (column, row) = (column as usize, row as usize);
        let (i, j) = ((bounds.left + column).checked_sub(MARGIN_PX), (bounds.top + row).checked_sub(MARGIN_PX));
        let value = match (i, j) {
            (Some(i), Some(j)) if i < covered.width && j < covered.height => covered.values[j * covered.width + i],
            _ => 0.0,
        };
        let inset = column.min(row).min(width - 1 - column).min(height - 1 - row);
        value * (inset as f32 / MARGIN_PX as f32).min(1.0)
    };
    GrayImage::from_fn(width as u32, height as u32, |column, row| Luma([(at(column, row) * 255.0).round() as u8]))
}
