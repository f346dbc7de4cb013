//! Decodes plan images.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use image::{DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader, Limits};

use super::{LARGEST_AREA_PX, LARGEST_SIDE_PX, PlanError, palette};
use crate::files::{LARGEST_IMAGE_BYTES, open_input_up_to};

/// Limit on an image's decoded size, bytes: four for each of [`LARGEST_AREA_PX`].
const LARGEST_DECODED_BYTES: u64 = 4 * LARGEST_AREA_PX;
/// Most memory for reading a plan beyond the image itself, bytes per pixel.
const WORKING_BYTES: u64 = 6;

/// Decodes an image of any known format, whatever its file extension.
pub(super) fn decode(path: &Path) -> Result<DynamicImage, PlanError> {
    let open = |source| PlanError::Open { path: path.to_owned(), source };
    let file = open_input_up_to(path, LARGEST_IMAGE_BYTES).map_err(open)?;
    let metadata = file.metadata().map_err(open)?;
    if metadata.is_file() && metadata.len() == 0 {
        return Err(PlanError::Empty { path: path.to_owned() });
    }
    let mut reader = ImageReader::new(BufReader::new(file)).with_guessed_format().map_err(open)?;
    let format = reader.format().ok_or_else(|| PlanError::UnknownFormat { path: path.to_owned() })?;
    reader.limits(limits());
    if format == ImageFormat::Jpeg && !ends_as_jpeg(path).map_err(open)? {
        return Err(damaged(path, "the JPEG has no end: it was cut off"));
    }
    match reader.into_decoder() {
        Ok(decoder) => pixels(path, decoder),
        Err(ImageError::Unsupported(_)) if format == ImageFormat::Tiff => palette::decode(path),
        Err(ImageError::Unsupported(_)) => Err(PlanError::UnknownFormat { path: path.to_owned() }),
        Err(error) => Err(damaged(path, error)),
    }
}

/// Decodes the pixels of an image whose header was read; refuses too many pixels.
pub(super) fn pixels(path: &Path, decoder: impl ImageDecoder) -> Result<DynamicImage, PlanError> {
    let (width, height) = decoder.dimensions();
    let area = u64::from(width) * u64::from(height);
    if width > LARGEST_SIDE_PX || height > LARGEST_SIDE_PX || area > LARGEST_AREA_PX {
        return Err(PlanError::TooManyPixels { path: path.to_owned(), width, height });
    }
    if width < 2 || height < 2 {
        return Err(PlanError::TooFewPixels { path: path.to_owned(), width, height });
    }
    let bytes = decoder.total_bytes();
    if bytes > LARGEST_DECODED_BYTES {
        return Err(PlanError::TooManyBytes {
            path: path.to_owned(),
            width,
            height,
            bytes,
            most: LARGEST_DECODED_BYTES,
        });
    }
    let needed = bytes + WORKING_BYTES * area;
    if Vec::<u8>::new().try_reserve_exact(usize::try_from(needed).unwrap_or(usize::MAX)).is_err() {
        return Err(PlanError::NoMemory { path: path.to_owned(), width, height, needed });
    }
    DynamicImage::from_decoder(decoder).map_err(|error| damaged(path, error))
}

pub(super) fn damaged(path: &Path, reason: impl ToString) -> PlanError {
    PlanError::Damaged { path: path.to_owned(), reason: reason.to_string() }
}

/// Memory limit for the largest image in the widest pixel type. The caller checks the sides.
pub(super) fn limits() -> Limits {
    let mut limits = Limits::default();
    limits.max_alloc = Some(LARGEST_DECODED_BYTES + (64 << 20));
    limits
}

/// Whether a JPEG ends with its end marker; decoders replace missing data with grey.
fn ends_as_jpeg(path: &Path) -> std::io::Result<bool> {
    // Some cameras and editors append their own data.
    const TAIL: u64 = 64 << 10;
    let mut file = File::open(path)?;
    let length = file.metadata()?.len();
    file.seek(SeekFrom::Start(length.saturating_sub(TAIL).max(2).min(length)))?;
    let mut tail = Vec::new();
    file.take(TAIL).read_to_end(&mut tail)?;
    Ok(tail.windows(2).any(|marker| marker == [0xff, 0xd9]))
}
