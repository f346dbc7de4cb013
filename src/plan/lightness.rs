//! One byte for each pixel of an image of any format: its lightness, or what it is.

use image::DynamicImage;
use rayon::prelude::*;

use super::colour::{Colour, is_saturated, lightness_against, luma};
use super::{PlanOptions, TransparentPolicy};

/// One byte per pixel; grey images are not blown up to colour first.
pub(super) fn map_pixels(image: &DynamicImage, of: impl Fn([u8; 4]) -> u8 + Sync) -> Vec<u8> {
    match image {
        DynamicImage::ImageLuma8(grey) => {
            let table: Vec<u8> = (0..=255).map(|v| of([v, v, v, 255])).collect();
            grey.as_raw().par_iter().map(|&v| table[usize::from(v)]).collect()
        }
        DynamicImage::ImageRgb8(rgb) => map_colours(rgb.as_raw(), |[r, g, b]| of([r, g, b, 255])),
        DynamicImage::ImageRgba8(rgba) => map_colours(rgba.as_raw(), of),
        other => map_colours(other.to_rgba8().as_raw(), of),
    }
}

/// One byte per pixel of `N` bytes. Most pixels are as the one before, and are not worked out again.
fn map_colours<const N: usize>(bytes: &[u8], of: impl Fn([u8; N]) -> u8 + Sync) -> Vec<u8> {
    const TOGETHER: usize = 1 << 16;
    let mut mapped = vec![0; bytes.len() / N];
    mapped.par_chunks_mut(TOGETHER).zip(bytes.par_chunks(TOGETHER * N)).for_each(|(mapped, bytes)| {
        let mut last = ([0; N], of([0; N]));
        for (mapped, pixel) in mapped.iter_mut().zip(bytes.as_chunks().0) {
            if *pixel != last.0 {
                last = (*pixel, of(*pixel));
            }
            // What is 0 already takes no memory until it is written.
            if last.1 != 0 {
                *mapped = last.1;
            }
        }
    });
    mapped
}

/// A pixel laid on white paper.
pub(super) fn on_paper([r, g, b, a]: [u8; 4]) -> [u8; 3] {
    let alpha = u32::from(a);
    [r, g, b].map(|v| ((u32::from(v) * alpha + 255 * (255 - alpha) + 127) / 255) as u8)
}

/// The lightness against the nearest colour of walls.
fn wall_colour_lightness(pixel: [u8; 3], colours: &[Colour]) -> Option<u8> {
    colours.iter().filter_map(|&c| lightness_against(c, pixel)).min()
}

/// Whether a pixel is of a saturated colour that is not one of the walls.
pub(super) fn is_annotation(pixel: [u8; 4], options: &PlanOptions) -> bool {
    let pixel = on_paper(pixel);
    is_saturated(pixel) && wall_colour_lightness(pixel, &options.wall_colours).is_none()
}

/// The lightness of a pixel on paper, 0 for the walls' colours; annotation is as light as paper.
pub(super) fn lightness_of(pixel: [u8; 4], options: &PlanOptions) -> u8 {
    match options.transparent {
        TransparentPolicy::Wall if pixel[3] < 128 => return 0,
        TransparentPolicy::Floor if pixel[3] < 128 => return 255,
        _ => {}
    }
    let pixel = on_paper(pixel);
    if let Some(lightness) = wall_colour_lightness(pixel, &options.wall_colours) {
        // Black is wall for any list of wall colours.
        return if is_saturated(pixel) { lightness } else { lightness.min(luma(pixel)) };
    }
    if is_saturated(pixel) { 255 } else { luma(pixel) }
}
