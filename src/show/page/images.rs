//! Tiles and sheets as the page carries them: the dirt by kind, the clean colour under it, the roughness.

use image::imageops::crop_imm;
use image::{ExtendedColorType, GrayImage, ImageEncoder, RgbImage, RgbaImage};

use crate::export::Reduced;
use crate::export::reduction::{halved_colours, halved_numbers};
use crate::show::encode_picture;

/// JPEG quality, 1 to 100: at less, nearly plain areas show blocks.
const QUALITY: u8 = 97;

/// A rectangle of an image, pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PixelRect {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
}

/// A tile's or sheet's images as the page uses them.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PageImages {
    /// Opacity 1 - exp(-D), a channel per kind of dirt.
    pub dirt: RgbaImage,
    /// Base colour without dirt, sRGB.
    pub clean: RgbImage,
    /// Roughness as baked.
    pub rough: GrayImage,
}

/// The same, compressed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ImageFiles {
    pub width: u32,
    pub height: u32,
    /// PNG.
    pub dirt: Vec<u8>,
    /// JPEG.
    pub clean: Vec<u8>,
    /// JPEG.
    pub rough: Vec<u8>,
}

impl ImageFiles {
    pub fn bytes(&self) -> usize {
        self.dirt.len() + self.clean.len() + self.rough.len()
    }
}

impl PageImages {
    /// The part of a tile's or sheet's images that is used.
    pub fn cropped(image: &Reduced, area: PixelRect) -> PageImages {
        let PixelRect { x, y, width, height } = area;
        let rough = |pixel: &image::Rgb<u8>| pixel.0[1];
        let orm = crop_imm(&image.orm, x, y, width, height).to_image();
        PageImages {
            dirt: crop_imm(&image.dirt, x, y, width, height).to_image(),
            clean: crop_imm(&image.clean, x, y, width, height).to_image(),
            rough: GrayImage::from_raw(width, height, orm.pixels().map(rough).collect()).unwrap_or_default(),
        }
    }

    /// Images of half the size, rounded up.
    pub fn halved(&self) -> PageImages {
        PageImages {
            dirt: halved_numbers(&self.dirt),
            clean: halved_colours(&self.clean),
            rough: halved_numbers(&self.rough),
        }
    }

    /// The longer side, pixels.
    pub fn longest_px(&self) -> u32 {
        self.dirt.width().max(self.dirt.height())
    }
}

/// Compresses the images.
pub(super) fn encode(layers: &PageImages) -> ImageFiles {
    let (width, height) = layers.dirt.dimensions();
    let jpeg = |pixels: &[u8], colour: ExtendedColorType| {
        let mut file = Vec::new();
        image::codecs::jpeg::JpegEncoder::new_with_quality(&mut file, QUALITY)
            .write_image(pixels, width, height, colour)
            .expect("memory does not fail and the image has the size that it says");
        file
    };
    let (dirt, (clean, rough)) = rayon::join(
        || encode_picture(&layers.dirt),
        || (jpeg(&layers.clean, ExtendedColorType::Rgb8), jpeg(&layers.rough, ExtendedColorType::L8)),
    );
    ImageFiles { width, height, dirt, clean, rough }
}
