//! What was found in a photograph, in one picture.

use image::{Rgb, RgbImage, imageops};

use super::super::sheet::{self, GAP, LINE};
use super::Import;

/// Longest side of each of the three, pixels.
const SIDE: u32 = 700;

/// Draws the photograph as it was looked at, its density against the clean wall (white is the peak), and the
/// pattern that came of it, laid on a light wall at 10 px/cm.
pub fn import_picture(import: &Import) -> RgbImage {
    let photo = shrunk(&import.looked_at);
    let density = shrunk(&RgbImage::from_fn(import.densities.width as u32, import.densities.height as u32, |x, y| {
        let value = import.densities.values[y as usize * import.densities.width + x as usize];
        Rgb([(value.clamp(0.0, 1.0) * 255.0).round() as u8; 3])
    }));
    let result = sheet::laid(&import.coverage, import.cause);
    let parts = [("photograph", photo), ("density", density), ("pattern, 10 px/cm", result)];
    let width = parts.iter().map(|(label, part)| part.width().max(sheet::text_width(label)) + GAP).sum::<u32>() + GAP;
    let height = parts.iter().map(|(_, part)| part.height()).fold(0, u32::max) + 3 * GAP + LINE;
    let mut page = RgbImage::from_pixel(width, height, Rgb(sheet::WALL));
    let mut left = GAP;
    for (label, part) in parts {
        sheet::write(&mut page, label, left, GAP);
        imageops::replace(&mut page, &part, i64::from(left), i64::from(GAP + LINE + GAP / 2));
        left += part.width().max(sheet::text_width(label)) + GAP;
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
