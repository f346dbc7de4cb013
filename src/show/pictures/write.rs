use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ImageBuffer, ImageEncoder, PixelWithColorType, RgbImage};

use super::crops::Crop;
use super::render::{render_crop, render_floor};
use crate::export::{ExportError, FloorTextures, OutputFolder, PreviewEntry, TextureSource};
use crate::math::{Vec2, vec2};
use crate::walls::Walls;

/// The picture of plan and paths in a bake.
pub const PATHS_FILE: &str = "preview/paths.png";

/// Writes the floor from above and crops of it into `preview/`.
///
/// # Errors
/// A file cannot be written.
pub fn write_previews(
    folder: &OutputFolder,
    textures: &FloorTextures,
    source: &impl TextureSource,
    walls: &Walls,
    crops: &[Crop],
) -> Result<Vec<PreviewEntry>, ExportError> {
    let grid = textures.layout.grid;
    let far_corner = vec2(f64::from(grid.width), f64::from(grid.height)) / grid.texels_per_metre;
    let floor = PreviewEntry { file: "preview/floor.png".to_string(), min_m: Vec2::ZERO, max_m: far_corner };
    write_picture(folder, &floor.file, &render_floor(&textures.birdseye, walls))?;
    let mut written = vec![floor];
    for crop in crops {
        write_picture(folder, &crop.file(), &render_crop(source, walls, grid, crop))?;
        written.push(PreviewEntry { file: crop.file(), min_m: crop.min_m, max_m: crop.max_m });
    }
    Ok(written)
}

/// Writes a picture as 8-bit PNG.
///
/// # Errors
/// The file cannot be written.
pub fn write_picture(folder: &OutputFolder, relative: &str, picture: &RgbImage) -> Result<(), ExportError> {
    folder.write(relative, &encode_picture(picture))
}

/// A picture as an 8-bit PNG.
pub fn encode_picture<P: PixelWithColorType<Subpixel = u8>>(picture: &ImageBuffer<P, Vec<u8>>) -> Vec<u8> {
    let mut png = Vec::new();
    PngEncoder::new_with_quality(&mut png, CompressionType::Fast, FilterType::Adaptive)
        .write_image(picture, picture.width(), picture.height(), P::COLOR_TYPE)
        .expect("memory does not fail and the picture has the size that it says");
    png
}
