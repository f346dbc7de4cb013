//! Decodes plan images.

use std::io::Cursor;
use std::path::Path;

use image::{DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader, Limits};

use super::{LARGEST_AREA_PX, LARGEST_SIDE_PX, PlanError};

/// Reads an image of any known format, whatever its name ends in.
pub(super) fn decode(path: &Path) -> Result<DynamicImage, PlanError> {
    let open = |source| PlanError::Open { path: path.to_owned(), source };
    let damaged = |e: ImageError| PlanError::Damaged { path: path.to_owned(), reason: e.to_string() };
    let bytes = std::fs::read(path).map_err(open)?;
    if bytes.is_empty() {
        return Err(PlanError::Empty { path: path.to_owned() });
    }
    let mut reader = ImageReader::new(Cursor::new(bytes.as_slice())).with_guessed_format().map_err(open)?;
    let format = reader.format().ok_or_else(|| PlanError::UnknownFormat { path: path.to_owned() })?;
    reader.limits(limits());
    let decoder = reader.into_decoder().map_err(|e| match e {
        ImageError::Unsupported(_) => PlanError::UnknownFormat { path: path.to_owned() },
        e => damaged(e),
    })?;
    // The header is read, nothing is allocated for pixels yet.
    let (width, height) = decoder.dimensions();
    if width > LARGEST_SIDE_PX || height > LARGEST_SIDE_PX || u64::from(width) * u64::from(height) > LARGEST_AREA_PX {
        return Err(PlanError::TooManyPixels { path: path.to_owned(), width, height });
    }
    if width < 2 || height < 2 {
        return Err(PlanError::TooFewPixels { path: path.to_owned(), width, height });
    }
    if format == ImageFormat::Jpeg && !ends_as_jpeg(&bytes) {
        return Err(PlanError::Damaged { path: path.to_owned(), reason: "the JPEG has no end: it was cut off".into() });
    }
    DynamicImage::from_decoder(decoder).map_err(damaged)
}

/// Room for the largest image in the widest pixel type; sides are checked by the caller.
fn limits() -> Limits {
    let mut limits = Limits::default();
    limits.max_alloc = Some(LARGEST_AREA_PX * 8 + (64 << 20));
    limits
}

/// Whether the end-of-image marker stands near the end; decoders fill up what is missing with grey.
fn ends_as_jpeg(bytes: &[u8]) -> bool {
    // Some cameras and editors append data of their own.
    const TAIL: usize = 64 << 10;
    let tail = &bytes[bytes.len().saturating_sub(TAIL).max(2).min(bytes.len())..];
    tail.windows(2).any(|marker| marker == [0xff, 0xd9])
}
