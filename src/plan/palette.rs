//! Reads TIFF images with a palette, which the `image` crate refuses.
//!
//! The photometric interpretation 3 in the header means palette indices. With a 1 in its place the same file is a grey
//! image of the indices, to which the palette is applied afterwards. Format: TIFF 6.0, section 5.

use std::io::Cursor;
use std::path::Path;

use image::{DynamicImage, GrayImage, ImageReader, RgbImage};

use super::PlanError;
use super::pixels::{damaged, limits, pixels};
use crate::files::{LARGEST_IMAGE_BYTES, read_input};

/// Numbers of TIFF tags, and values of `INTERPRETATION`.
const BITS_PER_SAMPLE: u16 = 258;
const INTERPRETATION: u16 = 262;
const COLOUR_MAP: u16 = 320;
const OF_PALETTE: u16 = 3;
const BLACK_IS_ZERO: u16 = 1;

/// Reads a TIFF with a palette of 2 or 256 colours.
pub(super) fn decode(path: &Path) -> Result<DynamicImage, PlanError> {
    let open = |source| PlanError::Open { path: path.to_owned(), source };
    let unsupported = |what: &str| PlanError::Unsupported { path: path.to_owned(), what: what.to_owned() };
    let mut tiff = Tiff::of(read_input(path, LARGEST_IMAGE_BYTES).map_err(open)?)
        .ok_or_else(|| unsupported("this kind of TIFF"))?;
    if tiff.entry(INTERPRETATION).and_then(|at| tiff.short(at + 8)) != Some(OF_PALETTE) {
        return Err(unsupported("this kind of TIFF"));
    }
    let bits = tiff.entry(BITS_PER_SAMPLE).and_then(|at| tiff.short(at + 8)).unwrap_or(1);
    if bits != 1 && bits != 8 {
        return Err(unsupported(&format!("a TIFF with a palette of {bits} bits")));
    }
    let colours = tiff.colours(1 << bits).ok_or_else(|| damaged(path, "the TIFF has no palette"))?;
    tiff.set_interpretation(BLACK_IS_ZERO);
    let mut reader = ImageReader::new(Cursor::new(tiff.bytes)).with_guessed_format().map_err(open)?;
    reader.limits(limits());
    let decoder = reader.into_decoder().map_err(|error| damaged(path, error))?;
    match pixels(path, decoder)? {
        DynamicImage::ImageLuma8(indices) => Ok(coloured(&indices, &colours, bits == 1)),
        _ => Err(unsupported("a TIFF with a palette and more channels")),
    }
}

/// Applies the palette to indices. One-bit indices are decoded as black and white.
fn coloured(indices: &GrayImage, colours: &[[u8; 3]], one_bit: bool) -> DynamicImage {
    let colour = |index: u8| colours[usize::from(if one_bit { index >> 7 } else { index })];
    let is_grey = colours.iter().all(|[r, g, b]| r == g && g == b);
    if is_grey {
        let mut greys = indices.clone();
        greys.iter_mut().for_each(|pixel| *pixel = colour(*pixel)[0]);
        return DynamicImage::ImageLuma8(greys);
    }
    let mut rgb = RgbImage::new(indices.width(), indices.height());
    rgb.pixels_mut().zip(indices.iter()).for_each(|(pixel, &index)| pixel.0 = colour(index));
    DynamicImage::ImageRgb8(rgb)
}

/// A TIFF file and the position of its first directory.
struct Tiff {
    bytes: Vec<u8>,
    little_endian: bool,
    directory: usize,
}

impl Tiff {
    fn of(bytes: Vec<u8>) -> Option<Tiff> {
        let little_endian = match bytes.get(..4)? {
            b"II\x2a\0" => true,
            b"MM\0\x2a" => false,
            _ => return None,
        };
        let mut tiff = Tiff { bytes, little_endian, directory: 0 };
        tiff.directory = tiff.long(4)?;
        Some(tiff)
    }

    fn short(&self, at: usize) -> Option<u16> {
        let bytes = self.bytes.get(at..at.checked_add(2)?)?.try_into().ok()?;
        Some(if self.little_endian { u16::from_le_bytes(bytes) } else { u16::from_be_bytes(bytes) })
    }

    fn long(&self, at: usize) -> Option<usize> {
        let bytes = self.bytes.get(at..at.checked_add(4)?)?.try_into().ok()?;
        let value = if self.little_endian { u32::from_le_bytes(bytes) } else { u32::from_be_bytes(bytes) };
        usize::try_from(value).ok()
    }

    /// Returns the position of a tag's entry of 12 bytes.
    fn entry(&self, tag: u16) -> Option<usize> {
        let count = usize::from(self.short(self.directory)?);
        (0..count).map(|k| self.directory + 2 + 12 * k).find(|&at| self.short(at) == Some(tag))
    }

    /// Reads the palette: all reds, then all greens, then all blues, of 16 bits.
    fn colours(&self, count: usize) -> Option<Vec<[u8; 3]>> {
        let entry = self.entry(COLOUR_MAP)?;
        let (length, start) = (self.long(entry + 4)?, self.long(entry + 8)?);
        if length != 3 * count {
            return None;
        }
        let values: Vec<u16> = (0..length).map(|k| self.short(start.checked_add(2 * k)?)).collect::<Option<_>>()?;
        // Some programs write 8 bits.
        let shift = if values.iter().all(|&value| value < 256) { 0 } else { 8 };
        Some((0..count).map(|k| [0, 1, 2].map(|channel| (values[channel * count + k] >> shift) as u8)).collect())
    }

    fn set_interpretation(&mut self, value: u16) {
        let Some(at) = self.entry(INTERPRETATION) else { return };
        let bytes = if self.little_endian { value.to_le_bytes() } else { value.to_be_bytes() };
        if let Some(place) = self.bytes.get_mut(at + 8..at + 10) {
            place.copy_from_slice(&bytes);
        }
    }
}
