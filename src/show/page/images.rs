//! Tiles and sheets as the page carries them: the dirt by kind, the clean colour under it, the roughness.

use image::{ExtendedColorType, GrayImage, ImageEncoder, Luma, Rgb, RgbImage, Rgba, RgbaImage};
use rayon::prelude::*;

use super::content::Covering;
use super::law::{self, Layer};
use crate::export::Reduced;

/// Kinds of dirt that a surface can have: channels of an image.
pub(super) const KINDS: usize = 4;

/// How much the clean surface's own texture varies, relative to its mean: what differs by less is not put down to
/// another kind of dirt.
const TEXTURE: f32 = 0.04;

/// JPEG quality: what is nearly plain shows blocks at less.
const QUALITY: u8 = 97;

/// A part of an image, pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Crop {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
}

/// A tile's or sheet's images, apart by what the page does with them.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Layers {
    /// Masks 1 - exp(-D), a channel per kind of dirt.
    pub dirt: RgbaImage,
    /// Base colour without dirt, sRGB.
    pub clean: RgbImage,
    /// Roughness as baked.
    pub rough: GrayImage,
}

/// The same as files.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Files {
    pub width: u32,
    pub height: u32,
    /// PNG.
    pub dirt: Vec<u8>,
    /// JPEG.
    pub clean: Vec<u8>,
    /// JPEG.
    pub rough: Vec<u8>,
}

impl Files {
    pub fn bytes(&self) -> usize {
        self.dirt.len() + self.clean.len() + self.rough.len()
    }
}

/// The part of an image that is used.
pub(super) fn cropped(image: &Reduced, crop: Crop) -> Reduced {
    let Crop { x, y, width, height } = crop;
    Reduced {
        factor: image.factor,
        base_color: image::imageops::crop_imm(&image.base_color, x, y, width, height).to_image(),
        mask: image::imageops::crop_imm(&image.mask, x, y, width, height).to_image(),
        orm: image::imageops::crop_imm(&image.orm, x, y, width, height).to_image(),
    }
}

/// An image of half the size, rounded up: colours averaged as light, the rest as it is.
pub(super) fn halved(image: &Reduced) -> Reduced {
    let (width, height) = image.base_color.dimensions();
    let size = (width.div_ceil(2), height.div_ceil(2));
    let four = |x: u32, y: u32| {
        let (right, low) = ((2 * x + 1).min(width - 1), (2 * y + 1).min(height - 1));
        [(2 * x, 2 * y), (right, 2 * y), (2 * x, low), (right, low)]
    };
    let mean = |values: [u8; 4]| ((values.into_iter().map(u32::from).sum::<u32>() + 2) / 4) as u8;
    let light = |values: [u8; 4]| law::srgb(0.25 * values.into_iter().map(law::linear).sum::<f32>());
    Reduced {
        factor: image.factor.saturating_mul(2),
        base_color: RgbImage::from_fn(size.0, size.1, |x, y| {
            let of = four(x, y).map(|(x, y)| image.base_color.get_pixel(x, y).0);
            Rgb(std::array::from_fn(|n| light(of.map(|pixel| pixel[n]))))
        }),
        mask: RgbaImage::from_fn(size.0, size.1, |x, y| {
            let of = four(x, y).map(|(x, y)| image.mask.get_pixel(x, y).0);
            Rgba(std::array::from_fn(|n| mean(of.map(|pixel| pixel[n]))))
        }),
        orm: RgbImage::from_fn(size.0, size.1, |x, y| {
            let of = four(x, y).map(|(x, y)| image.orm.get_pixel(x, y).0);
            Rgb(std::array::from_fn(|n| mean(of.map(|pixel| pixel[n]))))
        }),
    }
}

/// Takes an image apart.
pub(super) fn layers(covering: &Covering<'_>, image: &Reduced) -> Layers {
    let (width, height) = image.base_color.dimensions();
    let kinds = Kinds::of(covering);
    let texels: Vec<([u8; 4], [u8; 3])> = (0..width as usize * height as usize)
        .into_par_iter()
        .map(|n| {
            let (x, y) = (n as u32 % width, n as u32 / width);
            kinds.apart(image.base_color.get_pixel(x, y).0, image.mask.get_pixel(x, y).0)
        })
        .collect();
    let at = |x: u32, y: u32| texels[y as usize * width as usize + x as usize];
    Layers {
        dirt: RgbaImage::from_fn(width, height, |x, y| Rgba(at(x, y).0)),
        clean: RgbImage::from_fn(width, height, |x, y| Rgb(at(x, y).1)),
        rough: GrayImage::from_fn(width, height, |x, y| Luma([image.orm.get_pixel(x, y).0[1]])),
    }
}

/// What is known of a covering's kinds of dirt.
struct Kinds {
    clean: [f32; 3],
    colours: [[f32; 3]; KINDS],
    /// Channel of the packed masks, and the kind that shares it, if it is the first of two.
    channels: [Option<(usize, Option<usize>)>; KINDS],
}

impl Kinds {
    fn of(covering: &Covering<'_>) -> Kinds {
        let dirt = &covering.dirt[..covering.dirt.len().min(KINDS)];
        let mut kinds =
            Kinds { clean: law::linear_rgb(covering.clean), colours: [[0.0; 3]; KINDS], channels: [None; KINDS] };
        for (n, kind) in dirt.iter().enumerate() {
            kinds.colours[n] = law::linear_rgb(kind.colour);
            let is_second = dirt[..n].iter().any(|other| other.channel == kind.channel);
            let second = (n + 1..dirt.len()).find(|&other| dirt[other].channel == kind.channel);
            kinds.channels[n] = (!is_second && kind.channel < 4).then_some((kind.channel, second));
        }
        kinds
    }

    /// Masks by kind, and the clean colour.
    fn apart(&self, base_color: [u8; 3], mask: [u8; 4]) -> ([u8; 4], [u8; 3]) {
        // Most of a wall.
        if mask == [0; 4] {
            return ([0; KINDS], base_color);
        }
        let seen = law::linear_rgb(base_color);
        let mut densities = [0.0; KINDS];
        for (n, channel) in self.channels.iter().enumerate() {
            if let Some((channel, _)) = channel {
                densities[n] = law::density(mask[*channel]);
            }
        }
        for (first, channel) in self.channels.iter().enumerate() {
            if let Some((_, Some(second))) = *channel {
                self.share_out(seen, first, second, &mut densities);
            }
        }
        let masks = densities.map(law::mask);
        // From the masks as they are kept, so that the two fit together.
        let clean = self.layer(&masks.map(law::density)).under(seen, self.clean);
        (masks, clean.map(law::srgb))
    }

    fn layer(&self, densities: &[f32; KINDS]) -> Layer {
        law::layer(&std::array::from_fn::<_, KINDS, _>(|n| (densities[n], self.colours[n])))
    }

    /// Moves what the base colour shows to be of the `second` kind there: least squares with the texture's variance
    /// as a weight for leaving all with the `first`.
    fn share_out(&self, seen: [f32; 3], first: usize, second: usize, densities: &mut [f32; KINDS]) {
        let all = densities[first];
        if all <= 0.0 {
            return;
        }
        let layer = self.layer(densities);
        let expected = layer.over(self.clean);
        let hiding = (1.0 - layer.through) / densities.iter().sum::<f32>();
        let mut products = [0.0; 2];
        let mut variance = 0.0;
        for n in 0..3 {
            let slope = hiding * all * (self.colours[second][n] - self.colours[first][n]);
            products[0] += slope * (seen[n] - expected[n]);
            products[1] += slope * slope;
            variance += (TEXTURE * layer.through * self.clean[n]) * (TEXTURE * layer.through * self.clean[n]);
        }
        let share = (products[0] / (products[1] + variance).max(1e-12)).clamp(0.0, 1.0);
        densities[second] = share * all;
        densities[first] = all - densities[second];
    }
}

/// Compresses the images.
pub(super) fn encode(layers: &Layers) -> Files {
    let (width, height) = layers.dirt.dimensions();
    let jpeg = |pixels: &[u8], colour: ExtendedColorType| {
        let mut file = Vec::new();
        image::codecs::jpeg::JpegEncoder::new_with_quality(&mut file, QUALITY)
            .write_image(pixels, width, height, colour)
            .expect("memory does not fail and the image has the size that it says");
        file
    };
    let (dirt, (clean, rough)) = rayon::join(
        || png(&layers.dirt, width, height, ExtendedColorType::Rgba8),
        || (jpeg(&layers.clean, ExtendedColorType::Rgb8), jpeg(&layers.rough, ExtendedColorType::L8)),
    );
    Files { width, height, dirt, clean, rough }
}

/// A PNG file.
pub(super) fn png(pixels: &[u8], width: u32, height: u32, colour: ExtendedColorType) -> Vec<u8> {
    use image::codecs::png::{CompressionType, FilterType, PngEncoder};
    let mut file = Vec::new();
    PngEncoder::new_with_quality(&mut file, CompressionType::Fast, FilterType::Adaptive)
        .write_image(pixels, width, height, colour)
        .expect("memory does not fail and the image has the size that it says");
    file
}
