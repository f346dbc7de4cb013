use image::{Rgb, RgbImage};

use crate::math::ln;

/// Greatest width and height of a heat map, pixels.
const LARGEST: usize = 2048;

/// A heat map of two images: per pixel, the largest difference divided by the tolerance.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap {
    /// Texels per pixel, along each axis.
    factor: usize,
    texels: [usize; 2],
    width: usize,
    height: usize,
    /// Row by row from above.
    values: Vec<f32>,
}

impl HeatMap {
    /// Creates a map of zeros for an image of this size in texels.
    pub(super) fn new(width: usize, height: usize) -> HeatMap {
        let factor = width.max(height).div_ceil(LARGEST).max(1);
        let texels = [width, height];
        let (width, height) = (width.div_ceil(factor), height.div_ceil(factor));
        HeatMap { factor, texels, width, height, values: vec![0.0; width * height] }
    }

    /// Records the difference at a texel, counted from the upper left.
    pub(super) fn note(&mut self, x: usize, y: usize, times_tolerance: f64) {
        let value = &mut self.values[y / self.factor * self.width + x / self.factor];
        *value = value.max(times_tolerance as f32);
    }

    /// Merges another map, scaled to a rectangle: upper-left texel, width and height in texels.
    pub(super) fn lay(&mut self, other: &HeatMap, [left, top]: [usize; 2], [width, height]: [usize; 2]) {
        let within = |texel: usize, size: usize, most: usize| texel * most / size.max(1);
        for y in top / self.factor..(top + height).div_ceil(self.factor).min(self.height) {
            for x in left / self.factor..(left + width).div_ceil(self.factor).min(self.width) {
                let [u, v] = [(x * self.factor).max(left) - left, (y * self.factor).max(top) - top];
                let [u, v] = [within(u, width, other.width), within(v, height, other.height)];
                if let Some(&value) = other.values.get(v * other.width + u) {
                    let here = &mut self.values[y * self.width + x];
                    *here = here.max(value);
                }
            }
        }
    }

    /// Size of the compared image, texels.
    pub(super) fn texels(&self) -> [usize; 2] {
        self.texels
    }

    /// Draws the map in false colours.
    ///
    /// Black: equal. Blue: up to the tolerance. Red to yellow: up to a hundred times the tolerance. White: beyond.
    pub fn picture(&self) -> RgbImage {
        RgbImage::from_fn(self.width as u32, self.height as u32, |x, y| {
            Rgb(colour(self.values[y as usize * self.width + x as usize]))
        })
    }
}

fn colour(times_tolerance: f32) -> [u8; 3] {
    let t = f64::from(times_tolerance);
    if t == 0.0 {
        [0; 3]
    } else if t <= 1.0 {
        [20, 40, (90.0 + 165.0 * t) as u8]
    } else if t <= 100.0 {
        [255, (ln(t) / ln(100.0) * 255.0) as u8, 0]
    } else {
        [255; 3]
    }
}
