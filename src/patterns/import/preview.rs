//! A preview of an import.

use image::{Rgb, RgbImage, imageops};

use super::ImportedPattern;
use crate::patterns::contact_sheet;

/// Longest side of each picture, pixels.
const SIDE: u32 = 700;

/// Draws an import: the cropped photograph, its density (white is the peak), and the pattern on a light wall.
pub fn import_picture(import: &ImportedPattern) -> RgbImage {
    let photo = shrunk(&import.cropped);
    let density = shrunk(&RgbImage::from_fn(import.densities.width as u32, import.densities.height as u32, |x, y| {
        let value = import.densities.values[y as usize * import.densities.width + x as usize];
        Rgb([(value.clamp(0.0, 1.0) * 255.0).round() as u8; 3])
    }));
    let result = contact_sheet::on_ground(&import.coverage, import.cause);
    contact_sheet::side_by_side(&[("photograph", photo), ("density", density), ("pattern, 10 px/cm", result)])
}

fn shrunk(picture: &RgbImage) -> RgbImage {
    let longest = picture.width().max(picture.height());
    if longest <= SIDE {
        return picture.clone();
    }
    let side = |px: u32| (u64::from(px) * u64::from(SIDE) / u64::from(longest)).max(1) as u32;
    imageops::thumbnail(picture, side(picture.width()), side(picture.height()))
}
