//! Pictures one after another in one file.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use image::RgbImage;

use crate::files::{FileError, WholeFile};

/// How long a picture is seen, and the last one, milliseconds.
const SHOWN_MS: u16 = 900;
const LAST_SHOWN_MS: u16 = 2500;

/// Writes pictures of one size as an animated PNG, which shows them over and over.
///
/// # Errors
/// A picture cannot be read or has another size than the first; the file cannot be written, or is there and `force` is not
/// set.
pub fn write_flipbook(pictures: &[PathBuf], path: &Path, force: bool) -> Result<(), FileError> {
    let file = WholeFile::begin(path, force)?;
    let mut frames = Vec::with_capacity(pictures.len());
    for picture in pictures {
        let read = image::open(picture).map_err(|error| FileError::Write {
            path: path.to_path_buf(),
            source: io::Error::other(format!("{}: {error}", picture.display())),
        })?;
        frames.push(read.to_rgb8());
    }
    let mut out = file.create()?;
    animated_png(&frames, &mut out).and_then(|()| out.flush()).map_err(|error| file.failed(error))?;
    drop(out);
    file.publish()?;
    Ok(())
}

fn animated_png(frames: &[RgbImage], out: impl Write) -> io::Result<()> {
    let Some(first) = frames.first() else { return Ok(()) };
    if let Some(other) = frames.iter().find(|frame| frame.dimensions() != first.dimensions()) {
        let message = format!("pictures of {:?} and {:?} pixels", first.dimensions(), other.dimensions());
        return Err(io::Error::other(message));
    }
    let mut encoder = png::Encoder::new(out, first.width(), first.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_animated(frames.len() as u32, 0).map_err(io::Error::other)?;
    let mut writer = encoder.write_header().map_err(io::Error::other)?;
    for (n, frame) in frames.iter().enumerate() {
        let shown_ms = if n + 1 == frames.len() { LAST_SHOWN_MS } else { SHOWN_MS };
        writer.set_frame_delay(shown_ms, 1000).map_err(io::Error::other)?;
        writer.write_image_data(frame).map_err(io::Error::other)?;
    }
    writer.finish().map_err(io::Error::other)
}
