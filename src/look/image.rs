//! Repeated image of a floor or wall, resampled to the texel density.

use std::path::Path;

use super::error::LookError;
use crate::files::{LARGEST_IMAGE_BYTES, open_input_up_to};

/// Pixels kept per texel and axis; a texel shows their mean.
const PIXELS_PER_TEXEL: f64 = 3.0;

/// Largest side kept, pixels.
const LARGEST: usize = 4096;

/// Largest side read, pixels.
const LARGEST_READ: u32 = 16_384;

/// Reads an image of a known format with at least one pixel.
pub(super) fn decode(path: &Path) -> Result<image::RgbImage, LookError> {
    let wrong = |message: String| LookError::Image { path: path.to_path_buf(), message };
    let file = open_input_up_to(path, LARGEST_IMAGE_BYTES).map_err(|e| wrong(e.to_string()))?;
    let reader = image::ImageReader::new(std::io::BufReader::new(file));
    let mut reader = reader.with_guessed_format().map_err(|e| wrong(e.to_string()))?;
    let mut limits = image::Limits::default();
    limits.max_image_width = Some(LARGEST_READ);
    limits.max_image_height = Some(LARGEST_READ);
    limits.max_alloc = Some(LARGEST_IMAGE_BYTES);
    reader.limits(limits);
    let image = reader.decode().map_err(|e| wrong(e.to_string()))?.to_rgb8();
    if image.width() == 0 || image.height() == 0 {
        return Err(wrong("it has no pixels".to_string()));
    }
    Ok(image)
}

/// A repeated image with a summed-area table: the mean over a rectangle takes four look-ups.
pub(super) struct RepeatedImage {
    width: usize,
    height: usize,
    /// Pixels per texel along x and y.
    pixels_per_texel: [f64; 2],
    /// Linear light summed left of and above each pixel corner; a row and column more than pixels.
    sums: Vec<[f64; 3]>,
}

impl RepeatedImage {
    /// Opens an image that shows `size_m`; `value` tells what the bytes of a pixel mean.
    pub fn open(
        path: &Path,
        size_m: [f64; 2],
        texels_per_metre: f64,
        value: impl Fn([u8; 3]) -> [f32; 3],
    ) -> Result<RepeatedImage, LookError> {
        let image = decode(path)?;
        let (width, height) = (image.width() as usize, image.height() as usize);
        let rows = image.rows().map(|row| row.map(|p| value(p.0)).collect());
        Ok(RepeatedImage::new(rows, [width, height], size_m, texels_per_metre))
    }

    /// Builds the table from rows, top first. Each is reduced at once: full size would take much more memory.
    fn new(
        rows: impl Iterator<Item = Vec<[f32; 3]>>,
        size: [usize; 2],
        size_m: [f64; 2],
        texels_per_metre: f64,
    ) -> RepeatedImage {
        let wanted = |pixels: usize, metres: f64| {
            let enough = (metres * texels_per_metre * PIXELS_PER_TEXEL).ceil().max(1.0) as usize;
            pixels.min(enough).min(LARGEST)
        };
        let [width, height] = [wanted(size[0], size_m[0]), wanted(size[1], size_m[1])];
        let across: Vec<[f32; 3]> = rows.flat_map(|row| reduced(&row, width).collect::<Vec<_>>()).collect();
        let mut sums = vec![[0.0; 3]; (width + 1) * (height + 1)];
        for x in 0..width {
            let column: Vec<[f32; 3]> = across.iter().skip(x).step_by(width).copied().collect();
            for (y, pixel) in reduced(&column, height).enumerate() {
                let place = (y + 1) * (width + 1) + x + 1;
                for c in 0..3 {
                    // Own row first; the rows above are added below.
                    sums[place][c] = sums[place - 1][c] + f64::from(pixel[c]);
                }
            }
        }
        for place in width + 1..sums.len() {
            let above = sums[place - width - 1];
            for (sum, above) in sums[place].iter_mut().zip(above) {
                *sum += above;
            }
        }
        let per_texel = |pixels: usize, metres: f64| pixels as f64 / (metres * texels_per_metre);
        let pixels_per_texel = [per_texel(width, size_m[0]), per_texel(height, size_m[1])];
        RepeatedImage { width, height, pixels_per_texel, sums }
    }

    /// Mean colour, linear.
    pub fn mean(&self) -> [f32; 3] {
        let area = (self.width * self.height) as f64;
        self.sums[self.sums.len() - 1].map(|sum| (sum / area) as f32)
    }

    /// Mean colours of texels (i, j), (i + 1, j), ... The image's lower left corner is at the plan's origin.
    pub fn read_row(&self, i: i64, j: i64, rgb: &mut [Vec<f32>; 3]) {
        let [across, down] = self.pixels_per_texel;
        // Image rows run downward from the texel's top.
        let top = (-((j + 1) as f64) * down).rem_euclid(self.height as f64);
        let area = across * down;
        for k in 0..rgb[0].len() {
            let left = ((i + k as i64) as f64 * across).rem_euclid(self.width as f64);
            let [a, b] = [self.sum(left, top), self.sum(left + across, top)];
            let [c, d] = [self.sum(left, top + down), self.sum(left + across, top + down)];
            for (channel, plane) in rgb.iter_mut().enumerate() {
                plane[k] = (((d[channel] - c[channel]) - (b[channel] - a[channel])) / area) as f32;
            }
        }
    }

    /// Light left of `x` and above `y` in the repeated image, from its upper left corner.
    fn sum(&self, x: f64, y: f64) -> [f64; 3] {
        let split = |x: f64, size: usize| {
            let times = (x / size as f64).floor();
            (times, (x - times * size as f64).clamp(0.0, size as f64))
        };
        let ((columns, x), (rows, y)) = (split(x, self.width), split(y, self.height));
        let (width, height) = (self.width as f64, self.height as f64);
        let inner = self.within(x, y);
        if columns == 0.0 && rows == 0.0 {
            return inner;
        }
        let (right, below, whole) = (self.within(width, y), self.within(x, height), self.within(width, height));
        std::array::from_fn(|c| inner[c] + columns * right[c] + rows * below[c] + columns * rows * whole[c])
    }

    fn within(&self, x: f64, y: f64) -> [f64; 3] {
        let (i, j) = ((x as usize).min(self.width - 1), (y as usize).min(self.height - 1));
        let (f, g) = (x - i as f64, y - j as f64);
        let place = j * (self.width + 1) + i;
        let [a, b] = [self.sums[place], self.sums[place + 1]];
        let [c, d] = [self.sums[place + self.width + 1], self.sums[place + self.width + 2]];
        std::array::from_fn(|n| (1.0 - g) * (a[n] + f * (b[n] - a[n])) + g * (c[n] + f * (d[n] - c[n])))
    }
}

/// Reduces a line of pixels to `count` means over equal stretches.
fn reduced(line: &[[f32; 3]], count: usize) -> impl Iterator<Item = [f32; 3]> + '_ {
    let step = line.len() as f64 / count as f64;
    (0..count).map(move |k| {
        let (from, to) = (k as f64 * step, (k + 1) as f64 * step);
        let mut sum = [0.0f64; 3];
        for (n, pixel) in line.iter().enumerate().take((to.ceil() as usize).min(line.len())).skip(from as usize) {
            let share = (to.min((n + 1) as f64) - from.max(n as f64)).max(0.0);
            for (sum, value) in sum.iter_mut().zip(pixel) {
                *sum += share * f64::from(*value);
            }
        }
        sum.map(|sum| (sum / step) as f32)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(width: usize, height: usize) -> Vec<[f32; 3]> {
        (0..width * height).map(|n| [(n % width) as f32, (n / width) as f32, (n % 7) as f32]).collect()
    }

    fn rows(pixels: &[[f32; 3]], width: usize) -> impl Iterator<Item = Vec<[f32; 3]>> + '_ {
        pixels.chunks_exact(width).map(<[_]>::to_vec)
    }

    fn texel(image: &RepeatedImage, i: i64, j: i64) -> [f32; 3] {
        let mut rgb = [vec![0.0], vec![0.0], vec![0.0]];
        image.read_row(i, j, &mut rgb);
        rgb.map(|plane| plane[0])
    }

    #[test]
    fn a_texel_of_one_pixel_shows_that_pixel_in_every_repetition() {
        let pixels = image(4, 3);
        let repeated = RepeatedImage::new(rows(&pixels, 4), [4, 3], [0.04, 0.03], 100.0);
        for (i, j) in [(0, 0), (3, 2), (1, 1)] {
            let truth = pixels[((2 - j) * 4 + i) as usize];
            for (columns, rows) in [(0, 0), (5, -7), (-300, 1000)] {
                let found = texel(&repeated, i + 4 * columns, j + 3 * rows);
                for c in 0..3 {
                    assert!((found[c] - truth[c]).abs() < 1e-4, "{i} {j}: {found:?} {truth:?}");
                }
            }
        }
    }

    #[test]
    fn a_texel_shows_the_mean_of_what_it_covers() {
        let repeated = RepeatedImage::new(rows(&image(6, 6), 6), [6, 6], [0.06, 0.06], 50.0);
        assert!((texel(&repeated, 0, 0)[0] - 0.5).abs() < 1e-5);
        assert!((texel(&repeated, 2, 0)[0] - 4.5).abs() < 1e-5);
        assert!((texel(&repeated, 0, 0)[1] - 4.5).abs() < 1e-5);
        // A texel larger than the image shows its mean.
        let large = RepeatedImage::new(rows(&image(6, 6), 6), [6, 6], [0.06, 0.06], 1.0 / 0.6);
        assert!((texel(&large, 3, 3)[0] - 2.5).abs() < 1e-4);
    }
}
