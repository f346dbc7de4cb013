//! The pixels of an image whose header was read, within the limits on plan images.

use std::path::Path;

use image::{DynamicImage, ImageDecoder, Limits};

use super::{LARGEST_AREA_PX, LARGEST_SIDE_PX, PlanError};

/// Most bytes of an image's decoded pixels: four for each of [`LARGEST_AREA_PX`].
const LARGEST_DECODED_BYTES: u64 = 4 * LARGEST_AREA_PX;
/// Bytes for each pixel that understanding a plan takes at most, beyond the image.
const WORKING_BYTES: u64 = 6;

/// The pixels of an image whose header was read, unless there are too many.
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

/// Room for the largest image in the widest pixel type; sides are checked by the caller.
pub(super) fn limits() -> Limits {
    let mut limits = Limits::default();
    limits.max_alloc = Some(LARGEST_DECODED_BYTES + (64 << 20));
    limits
}
