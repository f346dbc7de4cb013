//! Floating-point images of patterns: reduction, padding and Gaussian blur.

use crate::math::exp;
use crate::patterns::Pattern;

/// Truncation radius of filters, standard deviations.
pub(super) const FILTER_REACH: f64 = 2.5;

/// A floating-point image with square pixels.
#[derive(Clone, Debug)]
pub(super) struct FloatImage {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Side of a pixel, metres.
    pub(super) pixel_m: f64,
    pub(super) values: Vec<f32>,
}

impl FloatImage {
    pub(super) fn of(pattern: &Pattern) -> FloatImage {
        let (width, height) = (pattern.width_px as usize, pattern.height_px as usize);
        let mut values: Vec<f32> = pattern.coverage.iter().map(|&c| f32::from(c)).collect();
        values.resize(width * height, 0.0);
        FloatImage { width, height, pixel_m: pattern.length_cm / 100.0 / width.max(1) as f64, values }
    }

    /// Bilinear sample; pixel centres are at half-integers; 0 outside the image.
    pub(super) fn at(&self, x: f64, y: f64) -> f32 {
        let (x, y) = (x - 0.5, y - 0.5);
        let (column, row) = (x.floor(), y.floor());
        let (fx, fy) = ((x - column) as f32, (y - row) as f32);
        let pixel = |dx: f64, dy: f64| {
            let (column, row) = (column + dx, row + dy);
            let inside = column >= 0.0 && row >= 0.0 && column < self.width as f64 && row < self.height as f64;
            if inside { self.values[row as usize * self.width + column as usize] } else { 0.0 }
        };
        let lower = pixel(0.0, 0.0) * (1.0 - fx) + pixel(1.0, 0.0) * fx;
        let upper = pixel(0.0, 1.0) * (1.0 - fx) + pixel(1.0, 1.0) * fx;
        lower * (1.0 - fy) + upper * fy
    }

    /// Averages squares of pixels that are small against the blur that follows.
    pub(super) fn reduced_for(&self, deviation_m: f64) -> FloatImage {
        let factor = ((deviation_m / self.pixel_m / 2.0) as usize).max(1);
        let (width, height) = (self.width.div_ceil(factor), self.height.div_ceil(factor));
        // Padding to whole squares is split evenly, so that the centre stays.
        let (left, top) = ((width * factor - self.width) / 2, (height * factor - self.height) / 2);
        let mut values = vec![0.0; width * height];
        for (row, line) in self.values.chunks_exact(self.width.max(1)).enumerate() {
            for (column, value) in line.iter().enumerate() {
                values[(row + top) / factor * width + (column + left) / factor] += value / (factor * factor) as f32;
            }
        }
        FloatImage { width, height, pixel_m: self.pixel_m * factor as f64, values }
    }

    pub(super) fn padded(&self, margin: usize) -> FloatImage {
        let (width, height) = (self.width + 2 * margin, self.height + 2 * margin);
        let mut values = vec![0.0; width * height];
        for (row, line) in self.values.chunks_exact(self.width.max(1)).enumerate() {
            let start = (row + margin) * width + margin;
            values[start..start + self.width].copy_from_slice(line);
        }
        FloatImage { width, height, pixel_m: self.pixel_m, values }
    }

    /// Gaussian blur; the deviation is in pixels. The image needs a margin as wide as the filter.
    pub(super) fn blur(&mut self, deviation: f64) {
        self.blur_axes([deviation; 2]);
    }

    /// Gaussian blur with standard deviations along rows and columns, pixels.
    pub(super) fn blur_axes(&mut self, deviations: [f64; 2]) {
        let (width, height) = (self.width, self.height);
        let kernel = gaussian(deviations[0]);
        let mut blurred = vec![0.0f32; width * height];
        for (out, line) in blurred.chunks_exact_mut(width).zip(self.values.chunks_exact(width)) {
            for (k, &weight) in kernel.iter().enumerate() {
                add_scaled(&mut out[k..], &line[..width - k.min(width)], weight);
                if k > 0 {
                    add_scaled(&mut out[..width - k.min(width)], &line[k..], weight);
                }
            }
        }
        self.values.fill(0.0);
        let kernel = gaussian(deviations[1]);
        for row in 0..height {
            let line = &blurred[row * width..][..width];
            for (k, &weight) in kernel.iter().enumerate() {
                for target in [row.checked_sub(k), (k > 0).then_some(row + k)].into_iter().flatten() {
                    if target < height {
                        add_scaled(&mut self.values[target * width..][..width], line, weight);
                    }
                }
            }
        }
    }

    /// Integral of coverage, square metres; centroid as shares of length and width from the centre.
    pub(super) fn mass_and_centroid(&self) -> (f64, [f64; 2]) {
        let (mut mass, mut x_sum, mut y_sum) = (0.0, 0.0, 0.0);
        for (row, line) in self.values.chunks_exact(self.width.max(1)).enumerate() {
            for (column, &value) in line.iter().enumerate() {
                let value = f64::from(value) / 255.0;
                mass += value;
                x_sum += value * (column as f64 + 0.5);
                y_sum += value * (row as f64 + 0.5);
            }
        }
        if mass <= 0.0 {
            return (0.0, [0.0; 2]);
        }
        let middle = [x_sum / mass / self.width as f64 - 0.5, y_sum / mass / self.height as f64 - 0.5];
        (mass * self.pixel_m * self.pixel_m, middle)
    }
}

/// Right half of a Gaussian kernel with sum 1.
fn gaussian(deviation: f64) -> Vec<f32> {
    let radius = (FILTER_REACH * deviation).ceil() as usize;
    let weight = |k: usize| exp(-0.5 * (k * k) as f64 / (deviation * deviation).max(1e-12));
    let sum = weight(0) + 2.0 * (1..=radius).map(weight).sum::<f64>();
    (0..=radius).map(|k| (weight(k) / sum) as f32).collect()
}

fn add_scaled(out: &mut [f32], line: &[f32], weight: f32) {
    for (o, v) in out.iter_mut().zip(line) {
        *o += v * weight;
    }
}
