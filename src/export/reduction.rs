//! Reduces images: colours are averaged in linear light, other numbers as they are.

use image::{ImageBuffer, Pixel, RgbImage};

use crate::math::srgb::{Srgb8, from_linear, to_linear};

/// A sum of linear light in integers, independent of the order of adding.
///
/// It holds up to 65 536 white texels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct LightSum {
    light: [u32; 3],
    count: u32,
}

impl LightSum {
    #[inline]
    pub(crate) fn add(&mut self, colour: Srgb8) {
        let [red, green, blue] = colour;
        self.add_linear([to_linear(red), to_linear(green), to_linear(blue)]);
    }

    /// Adds linear light, 0 to 65 535.
    #[inline]
    pub(crate) fn add_linear(&mut self, light: [u16; 3]) {
        for (sum, value) in self.light.iter_mut().zip(&light) {
            *sum += u32::from(*value);
        }
        self.count += 1;
    }

    pub(crate) fn merge(&mut self, other: LightSum) {
        self.light = std::array::from_fn(|k| self.light[k] + other.light[k]);
        self.count += other.count;
    }

    /// Number of texels; `None` for an empty sum.
    pub(crate) fn count(&self) -> Option<u32> {
        (self.count > 0).then_some(self.count)
    }

    /// Returns the colour of the mean light; `None` for an empty sum.
    pub(crate) fn mean(&self) -> Option<Srgb8> {
        let mean = |sum: u32| from_linear(rounded_mean(sum, self.count) as u16);
        (self.count > 0).then(|| self.light.map(mean))
    }
}

/// The mean of `count` whole numbers, rounded to the nearest; halves go up.
#[inline]
pub(crate) fn rounded_mean(sum: u32, count: u32) -> u32 {
    ((u64::from(sum) + u64::from(count) / 2) / u64::from(count)) as u32
}

/// Halves a colour image, rounding its size up: each pixel is the mean light of four.
pub(crate) fn halved_colours(image: &RgbImage) -> RgbImage {
    halved(image, |four| {
        let mut sum = LightSum::default();
        four.iter().for_each(|pixel| sum.add(pixel.0));
        image::Rgb(sum.mean().unwrap_or_default())
    })
}

/// Halves an image, rounding its size up: each channel is the mean of four.
pub(crate) fn halved_numbers<P: Pixel<Subpixel = u8>>(image: &ImageBuffer<P, Vec<u8>>) -> ImageBuffer<P, Vec<u8>> {
    halved(image, |four| {
        let mut mean = four[0];
        for (k, channel) in mean.channels_mut().iter_mut().enumerate() {
            *channel = rounded_mean(four.iter().map(|pixel| u32::from(pixel.channels()[k])).sum(), 4) as u8;
        }
        mean
    })
}

/// Halves an image; its last column or row counts twice if the size is odd.
fn halved<P: Pixel<Subpixel = u8>>(
    image: &ImageBuffer<P, Vec<u8>>,
    mean: impl Fn([P; 4]) -> P,
) -> ImageBuffer<P, Vec<u8>> {
    let (width, height) = image.dimensions();
    let at = |x: u32, y: u32| *image.get_pixel(x.min(width - 1), y.min(height - 1));
    ImageBuffer::from_fn(width.div_ceil(2), height.div_ceil(2), |x, y| {
        mean([(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| at(2 * x + dx, 2 * y + dy)))
    })
}
