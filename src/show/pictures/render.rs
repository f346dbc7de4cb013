use image::{Rgb, RgbImage};
use rayon::prelude::*;

use super::crops::Crop;
use crate::export::Birdseye;
use crate::export::TextureSource;
use crate::math::srgb::{from_linear, to_linear};
use crate::stamps::TexelGrid;
use crate::walls::Walls;

/// Colour of walls and of the outside in pictures of the floor, sRGB.
const WALL: [u8; 3] = [58, 58, 62];

/// Side of the blocks in which a crop is resolved, texels.
const BLOCK: usize = 256;

/// The whole floor from above, at most 2048 px wide and high, walls and outside dark.
pub fn render_floor(birdseye: &Birdseye, walls: &Walls) -> RgbImage {
    let mut picture = birdseye.picture(WALL);
    cover(&mut picture, walls, birdseye.pixels_per_metre(), [0, 0]);
    picture
}

/// A piece of the floor at its own texel density, walls and outside dark.
pub fn render_crop(source: &impl TextureSource, walls: &Walls, grid: TexelGrid, crop: &Crop) -> RgbImage {
    let t = grid.texels_per_metre;
    let texel = |metres: f64| (metres * t).round() as i64;
    let [i0, j0] = [texel(crop.min_m.x), texel(crop.min_m.y)];
    let width = (texel(crop.max_m.x) - i0).max(1) as usize;
    let height = (texel(crop.max_m.y) - j0).max(1) as usize;
    let corners: Vec<[usize; 2]> =
        (0..height).step_by(BLOCK).flat_map(|y| (0..width).step_by(BLOCK).map(move |x| [x, y])).collect();
    let resolve = |&[x, y]: &[usize; 2]| {
        let (columns, rows) = (BLOCK.min(width - x), BLOCK.min(height - y));
        (columns, source.resolve(i0 + x as i64, j0 + y as i64, columns, rows))
    };
    let blocks: Vec<_> = corners.par_iter().with_max_len(1).map(resolve).collect();
    let mut picture = RgbImage::from_pixel(width as u32, height as u32, Rgb(WALL));
    for ([left, below], (columns, block)) in corners.into_iter().zip(blocks) {
        for (k, &colour) in block.base_color.iter().enumerate().filter(|_| !block.empty) {
            let [x, y] = [left + k % columns, height - 1 - (below + k / columns)];
            picture.put_pixel(x as u32, y as u32, Rgb(colour));
        }
    }
    cover(&mut picture, walls, t, [i0, j0]);
    picture
}

/// Blends [`WALL`] over pixels outside the floor, in linear light and by the exact share covered at the walls.
fn cover(picture: &mut RgbImage, walls: &Walls, pixels_per_metre: f64, [i0, j0]: [i64; 2]) {
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let mut row_share = vec![0.0f32; width];
    for y in 0..height {
        walls.coverage(pixels_per_metre, i0, j0 + (height - 1 - y) as i64, width, 1, &mut row_share);
        for (x, &share) in row_share.iter().enumerate().filter(|(_, share)| **share < 1.0) {
            let pixel = &mut picture.get_pixel_mut(x as u32, y as u32).0;
            for (value, wall) in pixel.iter_mut().zip(WALL) {
                let (floor, wall) = (f32::from(to_linear(*value)), f32::from(to_linear(wall)));
                *value = from_linear((wall + (floor - wall) * share.max(0.0)).round() as u16);
            }
        }
    }
}
