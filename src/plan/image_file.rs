//! Decodes plan images.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use image::{DynamicImage, ImageError, ImageFormat, ImageReader};

use super::pixels::{damaged, limits, pixels};
use super::{PlanError, palette};
use crate::files::{LARGEST_IMAGE_BYTES, open_input_up_to};

/// Reads an image of any known format, whatever its name ends in.
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

/// Whether the end-of-image marker stands near the end; decoders fill up what is missing with grey.
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

/// How many pixels an inch of the printed image has, as a PNG or a JPEG says it.
pub(super) fn dots_per_inch(path: &Path) -> Option<f64> {
    const HEAD: u64 = 64 << 10;
    let mut head = Vec::new();
    open_input_up_to(path, LARGEST_IMAGE_BYTES).ok()?.take(HEAD).read_to_end(&mut head).ok()?;
    let number = |at: usize| Some(u32::from_be_bytes(head.get(at..at + 4)?.try_into().ok()?));
    let dots = if head.starts_with(b"\x89PNG") {
        // Chunks: length, name, data, check sum.
        let mut at = 8;
        while head.get(at + 4..at + 8)? != b"pHYs" {
            at += 12 + number(at)? as usize;
        }
        let per_metre = (head.get(at + 16) == Some(&1)).then(|| number(at + 8)).flatten()?;
        f64::from(per_metre) * 0.0254
    } else if head.starts_with(&[0xff, 0xd8]) && head.get(6..11) == Some(b"JFIF\0") {
        let across = f64::from(u16::from_be_bytes([*head.get(14)?, *head.get(15)?]));
        match head.get(13)? {
            1 => across,
            2 => across * 2.54,
            _ => return None,
        }
    } else {
        return None;
    };
    (20.0..=4800.0).contains(&dots).then_some(dots)
}
