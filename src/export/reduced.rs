use image::{Rgb, RgbImage, Rgba, RgbaImage};

use super::layout::BLOCK;
use crate::look::{Background, ResolvedBlock};
use crate::math::srgb::{from_linear, to_linear};

/// A tile's or a sheet's images, made small while its blocks go by: for pages and models that carry their textures.
#[derive(Clone, Debug, PartialEq)]
pub struct Reduced {
    /// Texels of the full image under a pixel, each way: a power of two.
    pub factor: u32,
    /// Base colour, sRGB (averaged as light). Row 0 is the upper one, as in the files.
    pub base_color: RgbImage,
    /// Packed masks, linear.
    pub mask: RgbaImage,
    /// Occlusion, roughness, metallic, linear, whatever the files are packed for.
    pub orm: RgbImage,
}

impl Reduced {
    /// The power of two by which images of a size have to be made smaller so that no side exceeds `largest_px`.
    ///
    /// At most [`BLOCK`]: a pixel never covers more than one block.
    pub(super) fn factor([width, height]: [u32; 2], largest_px: u32) -> u32 {
        width.max(height).div_ceil(largest_px.max(1)).next_power_of_two().min(BLOCK as u32)
    }

    /// Images of a full size that show nothing but the background.
    pub(super) fn blank([width, height]: [u32; 2], factor: u32, background: Background) -> Reduced {
        let (width, height) = (width.div_ceil(factor), height.div_ceil(factor));
        Reduced {
            factor,
            base_color: RgbImage::from_pixel(width, height, Rgb(background.base_color)),
            mask: RgbaImage::from_pixel(width, height, Rgba(background.mask)),
            orm: RgbImage::from_pixel(width, height, Rgb(background.orm)),
        }
    }

    /// Puts in a block whose upper left texel is (left, top) of the full image, both multiples of [`BLOCK`].
    pub(super) fn put(&mut self, left: usize, top: usize, block: &ReducedBlock) {
        let (left, top) = (left as u32 / self.factor, top as u32 / self.factor);
        for (k, pixel) in block.pixels.iter().enumerate() {
            let (x, y) = (left + (k % block.width) as u32, top + (k / block.width) as u32);
            self.base_color.put_pixel(x, y, Rgb(pixel.base_color));
            self.mask.put_pixel(x, y, Rgba(pixel.mask));
            self.orm.put_pixel(x, y, Rgb(pixel.orm));
        }
    }
}

/// A block, made small: row 0 is the upper one.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ReducedBlock {
    width: usize,
    pixels: Vec<Background>,
}

/// Sums of the texels under a pixel: light of three colours, four masks, occlusion, roughness, metallic.
type Sums = [u32; 10];

impl ReducedBlock {
    /// The mean of each `factor` x `factor` texels, from the block's upper left on; fewer texels at its right and
    /// lower side. Whole numbers, rounded to the nearest.
    pub(super) fn of(block: &ResolvedBlock, [width, height]: [usize; 2], factor: usize) -> ReducedBlock {
        let columns = width.div_ceil(factor);
        let mut pixels = Vec::with_capacity(columns * height.div_ceil(factor));
        let mut sums: Vec<Sums> = vec![[0; 10]; columns];
        for y in 0..height {
            let row = (height - 1 - y) * width;
            for (column, sums) in sums.iter_mut().enumerate() {
                let texels = row + column * factor..row + width.min((column + 1) * factor);
                add(block, texels, sums);
            }
            let rows = y % factor + 1;
            if rows == factor || y + 1 == height {
                for (column, sums) in sums.iter_mut().enumerate() {
                    let count = rows * (width.min((column + 1) * factor) - column * factor);
                    pixels.push(mean(std::mem::take(sums), count as u32));
                }
            }
        }
        ReducedBlock { width: columns, pixels }
    }
}

fn add(block: &ResolvedBlock, texels: std::ops::Range<usize>, sums: &mut Sums) {
    let colours = &block.base_color[texels.clone()];
    for ((colour, mask), orm) in colours.iter().zip(&block.mask[texels.clone()]).zip(&block.orm[texels]) {
        for (sum, &value) in sums[..3].iter_mut().zip(colour) {
            *sum += u32::from(to_linear(value));
        }
        for (sum, &value) in sums[3..].iter_mut().zip(mask.iter().chain(orm)) {
            *sum += u32::from(value);
        }
    }
}

/// 256 x 256 texels of the lightest white are the most that a sum holds.
fn mean(sums: Sums, count: u32) -> Background {
    let mean = |sum: u32| (u64::from(sum) + u64::from(count) / 2) / u64::from(count);
    let [red, green, blue, a, b, c, d, occlusion, roughness, metallic] = sums.map(mean);
    Background {
        base_color: [red, green, blue].map(|light| from_linear(light as u16)),
        mask: [a, b, c, d].map(|value| value as u8),
        orm: [occlusion, roughness, metallic].map(|value| value as u8),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::SplitMix64;

    fn block(width: usize, height: usize, texel: impl Fn(usize, usize) -> u8) -> ResolvedBlock {
        let values: Vec<u8> = (0..width * height).map(|k| texel(k % width, k / width)).collect();
        ResolvedBlock {
            empty: false,
            base_color: values.iter().map(|&v| [v, 255 - v, 7]).collect(),
            mask: values.iter().map(|&v| [v, v / 2, 0, 255]).collect(),
            orm: values.iter().map(|&v| [255, v, 0]).collect(),
            layers: Vec::new(),
        }
    }

    #[test]
    fn light_is_averaged_and_masks_are_averaged_as_numbers() {
        let chequered = block(4, 4, |x, y| if (x + y) % 2 == 0 { 255 } else { 0 });
        let small = ReducedBlock::of(&chequered, [4, 4], 2);
        let pixel = Background { base_color: [188, 188, 7], mask: [128, 64, 0, 255], orm: [255, 128, 0] };
        assert_eq!(small.pixels, [pixel; 4]);
    }

    #[test]
    fn the_whitest_block_does_not_overflow() {
        let white = ResolvedBlock {
            base_color: vec![[255; 3]; 65_536],
            mask: vec![[255; 4]; 65_536],
            orm: vec![[255; 3]; 65_536],
            ..ResolvedBlock::default()
        };
        let small = ReducedBlock::of(&white, [256, 256], 256);
        assert_eq!(small.pixels, [Background { base_color: [255; 3], mask: [255; 4], orm: [255; 3] }]);
    }

    #[test]
    fn pixels_are_means_of_texels_from_above_even_where_the_block_ends_early() {
        let mut random = SplitMix64::new(4);
        let values: Vec<u8> = (0..10 * 7).map(|_| random.next_u64() as u8).collect();
        let small = ReducedBlock::of(&block(10, 7, |x, y| values[y * 10 + x]), [10, 7], 4);
        assert_eq!((small.width, small.pixels.len()), (3, 6));
        for (k, pixel) in small.pixels.iter().enumerate() {
            let (columns, rows) = (k % 3 * 4..(k % 3 * 4 + 4).min(10), k / 3 * 4..(k / 3 * 4 + 4).min(7));
            let texels: Vec<u32> =
                rows.flat_map(|y| columns.clone().map(move |x| (6 - y) * 10 + x)).map(|k| values[k].into()).collect();
            let count = texels.len() as u32;
            assert_eq!(u32::from(pixel.orm[1]), (texels.iter().sum::<u32>() + count / 2) / count);
        }
    }

    #[test]
    fn factors_are_powers_of_two_that_keep_the_limit() {
        assert_eq!(Reduced::factor([8192, 512], 2048), 4);
        assert_eq!(Reduced::factor([8193, 512], 2048), 8);
        assert_eq!(Reduced::factor([300, 200], 2048), 1);
        assert_eq!(Reduced::factor([16_384, 16_384], 0), 256);
    }
}
