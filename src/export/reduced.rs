use image::{Rgb, RgbImage, Rgba, RgbaImage};

use super::layout::BLOCK;
use super::reduction::{LightSum, rounded_mean};
use crate::look::{Background, Layer, ResolvedBlock};
use crate::math::exp_f32;

/// Reduced images of a tile or a sheet, embedded in pages and models.
#[derive(Clone, Debug, PartialEq)]
pub struct Reduced {
    /// Texels per pixel along each axis, a power of two.
    pub factor: u32,
    /// Base colour, sRGB, averaged in linear light. Row 0 is the topmost, as in the files.
    pub base_color: RgbImage,
    /// Base colour without dirt, sRGB, averaged in linear light.
    pub clean: RgbImage,
    /// Opacity 1 - exp(-D) of the dirt of each [kind](Layer::kind), linear.
    pub dirt: RgbaImage,
    /// Occlusion, roughness, metallic, linear, for every target.
    pub orm: RgbImage,
}

impl Reduced {
    /// Returns the power of two that reduces an image so that no side exceeds `largest_px`.
    ///
    /// It is at most [`BLOCK`]: a pixel covers no more than one block.
    pub(super) fn factor([width, height]: [u32; 2], largest_px: u32) -> u32 {
        width.max(height).div_ceil(largest_px.max(1)).next_power_of_two().min(BLOCK as u32)
    }

    /// Creates reduced images that show the background, for an image of this full size.
    pub(super) fn blank([width, height]: [u32; 2], factor: u32, background: Background) -> Reduced {
        let (width, height) = (width.div_ceil(factor), height.div_ceil(factor));
        let colour = RgbImage::from_pixel(width, height, Rgb(background.base_color));
        Reduced {
            factor,
            clean: colour.clone(),
            base_color: colour,
            dirt: RgbaImage::new(width, height),
            orm: RgbImage::from_pixel(width, height, Rgb(background.orm)),
        }
    }

    /// Inserts a block at column `left`, row `top` of the full image, multiples of [`BLOCK`].
    pub(super) fn put(&mut self, left: usize, top: usize, block: &ReducedBlock) {
        let (left, top) = (left as u32 / self.factor, top as u32 / self.factor);
        for (k, pixel) in block.pixels.iter().enumerate() {
            let (x, y) = (left + (k % block.width) as u32, top + (k / block.width) as u32);
            self.base_color.put_pixel(x, y, Rgb(pixel.base_color));
            self.clean.put_pixel(x, y, Rgb(pixel.clean.unwrap_or(self.clean.get_pixel(x, y).0)));
            self.dirt.put_pixel(x, y, Rgba(pixel.dirt));
            self.orm.put_pixel(x, y, Rgb(pixel.orm));
        }
    }
}

/// A reduced block. Row 0 is the topmost.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ReducedBlock {
    width: usize,
    pixels: Vec<ReducedPixel>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct ReducedPixel {
    base_color: [u8; 3],
    /// `None` if the source has no clean base colour.
    clean: Option<[u8; 3]>,
    dirt: [u8; Layer::KINDS],
    orm: [u8; 3],
}

/// Sums over the texels of a pixel.
#[derive(Clone, Copy, Default)]
struct PixelSums {
    base_color: LightSum,
    clean: LightSum,
    dirt: [f32; Layer::KINDS],
    orm: [u32; 3],
    count: u32,
}

impl ReducedBlock {
    /// Averages each `factor` x `factor` texels, from the block's upper left; rounds to nearest.
    ///
    /// Pixels at its right and lower side may cover fewer texels.
    pub(super) fn of(block: &ResolvedBlock, [width, height]: [usize; 2], factor: usize) -> ReducedBlock {
        let columns = width.div_ceil(factor);
        let mut pixels = Vec::with_capacity(columns * height.div_ceil(factor));
        let mut sums = vec![PixelSums::default(); columns];
        let mut opacity = std::array::from_fn(|_| Vec::new());
        for y in 0..height {
            let row = (height - 1 - y) * width;
            opacities(block, row..row + width, &mut opacity);
            for (column, sums) in sums.iter_mut().enumerate() {
                let texels = column * factor..width.min((column + 1) * factor);
                sums.count += texels.len() as u32;
                let of_row = row + texels.start..row + texels.end;
                block.base_color[of_row.clone()].iter().for_each(|colour| sums.base_color.add(*colour));
                let clean = block.clean.get(of_row.clone()).unwrap_or_default();
                clean.iter().for_each(|light| sums.clean.add_linear(*light));
                for orm in &block.orm[of_row] {
                    for (sum, value) in sums.orm.iter_mut().zip(orm) {
                        *sum += u32::from(*value);
                    }
                }
                for (sum, opacity) in sums.dirt.iter_mut().zip(&opacity) {
                    *sum += opacity.get(texels.clone()).unwrap_or_default().iter().sum::<f32>();
                }
            }
            if y % factor + 1 == factor || y + 1 == height {
                pixels.extend(sums.iter_mut().map(|sums| std::mem::take(sums).mean()));
            }
        }
        ReducedBlock { width: columns, pixels }
    }
}

impl PixelSums {
    fn mean(self) -> ReducedPixel {
        ReducedPixel {
            base_color: self.base_color.mean().unwrap_or_default(),
            clean: self.clean.mean(),
            dirt: self.dirt.map(|sum| (255.0 * sum / self.count as f32).round() as u8),
            orm: self.orm.map(|sum| rounded_mean(sum, self.count) as u8),
        }
    }
}

/// Computes the opacity 1 - exp(-D) of each kind of dirt; empty for kinds without a layer.
fn opacities(block: &ResolvedBlock, texels: std::ops::Range<usize>, out: &mut [Vec<f32>; Layer::KINDS]) {
    out.iter_mut().for_each(Vec::clear);
    for layer in &block.layers {
        let Some(kind) = layer.kind() else { continue };
        let densities = &layer.values[texels.clone()];
        if densities.iter().all(|&density| density == 0.0) {
            continue;
        }
        out[kind].resize(densities.len(), 0.0);
        out[kind].iter_mut().zip(densities).for_each(|(sum, density)| *sum += density);
    }
    out.iter_mut().flatten().for_each(|density| *density = 1.0 - exp_f32(-*density));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::SplitMix64;

    /// A layer with a density of 1 where `values` are 255.
    fn layer(name: &'static str, values: &[u8]) -> Layer {
        Layer { name, values: values.iter().map(|&v| f32::from(v) / 255.0).collect() }
    }

    fn block(width: usize, height: usize, texel: impl Fn(usize, usize) -> u8) -> ResolvedBlock {
        let values: Vec<u8> = (0..width * height).map(|k| texel(k % width, k / width)).collect();
        ResolvedBlock {
            relief: Vec::new(),
            fine: Vec::new(),
            empty: false,
            base_color: values.iter().map(|&v| [v, 255 - v, 7]).collect(),
            mask: values.iter().map(|&v| [v, v / 2, 0, 255]).collect(),
            orm: values.iter().map(|&v| [255, v, 0]).collect(),
            clean: values.iter().map(|&v| [u16::from(v) * 257, 0, 65_535]).collect(),
            layers: ["film", "edge", "dust"].map(|name| layer(name, &values)).to_vec(),
        }
    }

    #[test]
    fn colours_are_averaged_as_light_and_opacities_as_numbers() {
        let chequered = block(4, 4, |x, y| if (x + y) % 2 == 0 { 255 } else { 0 });
        let small = ReducedBlock::of(&chequered, [4, 4], 2);
        // Half of the texels are clean; the others transmit exp(-1) through film, exp(-2) through edge and dust.
        let dirt = [81, 0, 0, 110];
        let pixel = ReducedPixel { base_color: [188, 188, 7], clean: Some([188, 0, 255]), dirt, orm: [255, 128, 0] };
        assert_eq!(small.pixels, [pixel; 4]);
    }

    #[test]
    fn the_whitest_block_does_not_overflow() {
        let white = ResolvedBlock {
            base_color: vec![[255; 3]; 65_536],
            clean: vec![[65_535; 3]; 65_536],
            orm: vec![[255; 3]; 65_536],
            layers: vec![Layer { name: "hand", values: vec![1e9; 65_536] }],
            ..ResolvedBlock::default()
        };
        let small = ReducedBlock::of(&white, [256, 256], 256);
        let white = [255; 3];
        assert_eq!(
            small.pixels,
            [ReducedPixel { base_color: white, clean: Some(white), dirt: [255, 0, 0, 0], orm: white }]
        );
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
