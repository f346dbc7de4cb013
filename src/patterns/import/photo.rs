//! Reads a photograph as the logarithm of the light that it shows.

use std::io::Cursor;

use image::{DynamicImage, ImageDecoder, ImageReader, Limits, RgbImage};

use super::raster::PixelRaster;
use super::{ImportError, ImportOptions, PhotoScale};
use crate::math::{self, srgb};

/// Limits on the pixels of a photograph and on the side of its crop.
const MOST_PX: u64 = 64_000_000;
const LEAST_SIDE_PX: u32 = 32;
/// Number of pixels above which the photograph is reduced.
const ENOUGH_PX: u64 = 12_000_000;
/// Smallest linear light that counts: half a step of 8 bits.
const DARKEST: f64 = 0.5 / 255.0 / 12.92;

/// The cropped photograph as logarithms of light.
pub(super) struct Photo {
    /// ln of linear light per channel.
    pub logs: [PixelRaster; 3],
    /// Pixels of the photograph per pixel of `logs`, along each axis.
    pub factor: usize,
    /// Upper left corner of the crop in the photograph.
    pub corner_px: [u32; 2],
    /// The crop in sRGB, for the preview.
    pub cropped: RgbImage,
}

/// Decodes, crops and reduces a photograph.
pub(super) fn read(bytes: &[u8], options: &ImportOptions) -> Result<Photo, ImportError> {
    let image = decode(bytes)?;
    let (width, height) = (image.width(), image.height());
    let [left, top, across, down] = options.crop.unwrap_or([0, 0, width, height]);
    let fits = |from: u32, count: u32, all: u32| from.checked_add(count).is_some_and(|end| end <= all);
    if !fits(left, across, width) || !fits(top, down, height) || across.min(down) < LEAST_SIDE_PX {
        let crop = [left, top, across, down];
        return Err(ImportError::Crop { crop, width, height, least: LEAST_SIDE_PX });
    }
    let part = image.crop_imm(left, top, across, down);
    drop(image);
    let factor = factor(across, down, options.size);
    let cropped = part.to_rgb8();
    let part = part.into_rgb16();
    let log_of: Vec<f32> = (0..=u16::MAX).map(log_of).collect();
    let logs = [0, 1, 2].map(|channel| {
        let values = part.pixels().map(|pixel| log_of[usize::from(pixel.0[channel])]).collect();
        PixelRaster { width: across as usize, height: down as usize, values }.reduced(factor)
    });
    Ok(Photo { logs, factor, corner_px: [left, top], cropped })
}

/// Decodes an image and applies the orientation stored in it.
pub(crate) fn decode(bytes: &[u8]) -> Result<DynamicImage, ImportError> {
    let unreadable = |reason: String| ImportError::Unreadable { reason };
    if bytes.is_empty() {
        return Err(unreadable("the file is empty".to_owned()));
    }
    let mut reader =
        ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|error| unreadable(error.to_string()))?;
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_PX * 16);
    reader.limits(limits);
    let mut decoder = reader.into_decoder().map_err(|error| unreadable(error.to_string()))?;
    let (width, height) = decoder.dimensions();
    if u64::from(width) * u64::from(height) > MOST_PX {
        return Err(ImportError::Size { width, height, allowed: "64 million pixels" });
    }
    if width.min(height) < LEAST_SIDE_PX {
        return Err(ImportError::Size { width, height, allowed: "at least 32 px a side" });
    }
    let orientation = decoder.orientation().map_err(|error| unreadable(error.to_string()))?;
    let mut image = DynamicImage::from_decoder(decoder).map_err(|error| unreadable(error.to_string()))?;
    image.apply_orientation(orientation);
    Ok(image)
}

/// Reduction factor of a large photograph: never below the resolution of the pattern.
fn factor(width: u32, height: u32, size: PhotoScale) -> usize {
    let mut factor = 1;
    while u64::from(width) * u64::from(height) / (factor * factor) > ENOUGH_PX {
        factor += 1;
    }
    match size {
        PhotoScale::PxPerCm(scale) => factor.min((scale / 10.0) as u64).max(1) as usize,
        PhotoScale::LengthCm(_) => factor as usize,
    }
}

/// ln of the linear light of an sRGB value (IEC 61966-2-1).
fn log_of(value: u16) -> f32 {
    let light = srgb::decode(f64::from(value) / 65_535.0);
    math::ln(light.max(DARKEST)) as f32
}
