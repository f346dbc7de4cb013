//! A preview of an import.

use image::{Rgb, RgbImage, imageops};

use super::ImportedPattern;
use crate::patterns::contact_sheet::{self, GAP, LINE};

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
    let parts = [("photograph", photo), ("density", density), ("pattern, 10 px/cm", result)];
    let width =
        parts.iter().map(|(label, part)| part.width().max(contact_sheet::text_width(label)) + GAP).sum::<u32>() + GAP;
    let height = parts.iter().map(|(_, part)| part.height()).fold(0, u32::max) + 3 * GAP + LINE;
    let mut page = RgbImage::from_pixel(width, height, Rgb(contact_sheet::WALL));
    let mut left = GAP;
    for (label, part) in parts {
        contact_sheet::write(&mut page, label, left, GAP);
        imageops::replace(&mut page, &part, i64::from(left), i64::from(GAP + LINE + GAP / 2));
        left += part.width().max(contact_sheet::text_width(label)) + GAP;
    }
    page
}

fn shrunk(picture: &RgbImage) -> RgbImage {
    let longest = picture.width().max(picture.height());
    if longest <= SIDE {
        return picture.clone();
    }
    let side = |px: u32| (u64::from(px) * u64::from(SIDE) / u64::from(longest)).max(1) as u32;
    imageops::thumbnail(picture, side(picture.width()), side(picture.height()))
}
