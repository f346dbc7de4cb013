//! PNG files made of strips that any thread compresses separately.
//!
//! Each strip of rows becomes an `IDAT` chunk; the chunks together are one zlib stream. The bytes depend on the image
//! only, not on the threads.

use std::io::{self, Write};

use super::deflate::{Part, ZLIB_HEADER, adler32, adler32_joined, deflate};

pub(super) struct Signature;

impl Signature {
    pub(super) const BYTES: [u8; 8] = *b"\x89PNG\r\n\x1a\n";
}

/// Pixel format and colour space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pixels {
    /// Red, green, blue in sRGB, with an `sRGB` chunk.
    Srgb,
    /// One linear value, stored as grey.
    Linear1,
    /// Three linear values, without a `gAMA` chunk: some readers would apply a gamma to the data.
    Linear3,
    /// Four linear values.
    Linear4,
}

impl Pixels {
    pub(super) fn bytes(self) -> usize {
        match self {
            Pixels::Linear1 => 1,
            Pixels::Srgb | Pixels::Linear3 => 3,
            Pixels::Linear4 => 4,
        }
    }
}

/// A compressed run of rows.
#[derive(Clone, Debug, Default)]
pub(super) struct Strip {
    chunk: Vec<u8>,
    adler: u32,
    bytes: u64,
}

/// Filters and compresses rows of an image from above.
#[derive(Debug)]
pub(super) struct StripEncoder {
    pixel_bytes: usize,
    above: Vec<u8>,
    row: Vec<u8>,
    filtered: Vec<u8>,
}

impl StripEncoder {
    pub(super) fn new(pixels: Pixels, width: usize) -> StripEncoder {
        let bytes = width * pixels.bytes();
        StripEncoder { pixel_bytes: pixels.bytes(), above: vec![0; bytes], row: vec![0; bytes], filtered: Vec::new() }
    }

    /// Begins a strip at the image's top.
    pub(super) fn begin_at_top(&mut self) {
        self.begin_below(|row| row.fill(0));
    }

    /// Begins a strip below the row that `fill` writes.
    pub(super) fn begin_below(&mut self, fill: impl FnOnce(&mut [u8])) {
        self.filtered.clear();
        fill(&mut self.above);
    }

    /// Adds the row that `fill` writes.
    pub(super) fn push(&mut self, fill: impl FnOnce(&mut [u8])) {
        fill(&mut self.row);
        let at = self.filtered.len();
        self.filtered.resize(at + 1 + self.row.len(), 0);
        self.filtered[at] = AVERAGE;
        filter_average(self.pixel_bytes, &self.above, &self.row, &mut self.filtered[at + 1..]);
        std::mem::swap(&mut self.above, &mut self.row);
    }

    /// Compresses the rows added since the strip began.
    pub(super) fn finish(&mut self) -> Strip {
        let mut chunk = begin_chunk(b"IDAT", self.filtered.len() / 3);
        deflate(&self.filtered, Part::Middle, &mut chunk);
        end_chunk(&mut chunk);
        Strip { chunk, adler: adler32(&self.filtered), bytes: self.filtered.len() as u64 }
    }
}

/// The rendering intent of the sRGB chunk.
const PERCEPTUAL: u8 = 0;
/// The filter of each row. For floors it gives files a tenth smaller than `Up`, `Sub` and `Paeth`.
const AVERAGE: u8 = 3;

fn filter_average(pixel_bytes: usize, above: &[u8], row: &[u8], out: &mut [u8]) {
    let (first, rest) = out.split_at_mut(pixel_bytes.min(row.len()));
    for ((out, &value), &above) in first.iter_mut().zip(row).zip(above) {
        *out = value.wrapping_sub(above / 2);
    }
    let (values, above) = (&row[first.len()..], &above[first.len()..]);
    for (((out, &value), &above), &left) in rest.iter_mut().zip(values).zip(above).zip(row) {
        *out = value.wrapping_sub(((u16::from(left) + u16::from(above)) / 2) as u8);
    }
}

/// Writes strips to a PNG file.
#[derive(Debug)]
pub(super) struct PngWriter<W: Write> {
    out: W,
    adler: u32,
}

impl<W: Write> PngWriter<W> {
    pub(super) fn begin(mut out: W, pixels: Pixels, width: u32, height: u32) -> io::Result<PngWriter<W>> {
        let colour_type = match pixels {
            Pixels::Linear1 => 0,
            Pixels::Srgb | Pixels::Linear3 => 2,
            Pixels::Linear4 => 6,
        };
        let mut head = Signature::BYTES.to_vec();
        let size = [width.to_be_bytes(), height.to_be_bytes()].concat();
        chunk(b"IHDR", &[&size[..], &[8, colour_type, 0, 0, 0]].concat(), &mut head);
        if pixels == Pixels::Srgb {
            chunk(b"sRGB", &[PERCEPTUAL], &mut head);
        }
        chunk(b"IDAT", &ZLIB_HEADER, &mut head);
        out.write_all(&head)?;
        Ok(PngWriter { out, adler: adler32(&[]) })
    }

    /// Appends the next strip from above.
    pub(super) fn push(&mut self, strip: &Strip) -> io::Result<()> {
        self.adler = adler32_joined(self.adler, strip.adler, strip.bytes);
        self.out.write_all(&strip.chunk)
    }

    /// Finishes the file and returns its writer, not yet flushed.
    pub(super) fn finish(mut self) -> io::Result<W> {
        let mut end = Vec::new();
        deflate(&[], Part::Last, &mut end);
        end.extend_from_slice(&self.adler.to_be_bytes());
        let mut tail = Vec::new();
        chunk(b"IDAT", &end, &mut tail);
        chunk(b"IEND", &[], &mut tail);
        self.out.write_all(&tail)?;
        Ok(self.out)
    }
}

/// Appends a chunk: length, name, data, checksum.
pub(super) fn chunk(name: &[u8; 4], data: &[u8], out: &mut Vec<u8>) {
    let mut chunk = begin_chunk(name, data.len());
    chunk.extend_from_slice(data);
    end_chunk(&mut chunk);
    out.append(&mut chunk);
}

fn begin_chunk(name: &[u8; 4], room: usize) -> Vec<u8> {
    let mut chunk = Vec::with_capacity(room + 12);
    chunk.extend_from_slice(&[0; 4]);
    chunk.extend_from_slice(name);
    chunk
}

fn end_chunk(chunk: &mut Vec<u8>) {
    let length = chunk.len() as u32 - 8;
    chunk[..4].copy_from_slice(&length.to_be_bytes());
    let sum = crc32fast::hash(&chunk[4..]);
    chunk.extend_from_slice(&sum.to_be_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;

    fn encoded(pixels: Pixels, width: usize, height: usize, rows_per_strip: usize, image: &[u8]) -> Vec<u8> {
        let bytes = width * pixels.bytes();
        let row = |y: usize| &image[y * bytes..(y + 1) * bytes];
        let mut writer = PngWriter::begin(Vec::new(), pixels, width as u32, height as u32).unwrap();
        let mut encoder = StripEncoder::new(pixels, width);
        for top in (0..height).step_by(rows_per_strip) {
            match top {
                0 => encoder.begin_at_top(),
                _ => encoder.begin_below(|out| out.copy_from_slice(row(top - 1))),
            }
            for y in top..height.min(top + rows_per_strip) {
                encoder.push(|out| out.copy_from_slice(row(y)));
            }
            writer.push(&encoder.finish()).unwrap();
        }
        writer.finish().unwrap()
    }

    #[test]
    fn another_decoder_reads_back_every_pixel_whatever_the_strips() {
        let mut random = crate::math::SplitMix64::new(3);
        for pixels in [Pixels::Srgb, Pixels::Linear3, Pixels::Linear4] {
            for (width, height) in [(1, 1), (7, 33), (200, 65)] {
                let image: Vec<u8> = (0..width * height * pixels.bytes())
                    .map(|k| ((k / 50) as u8).wrapping_add((random.next_u64() & 3) as u8))
                    .collect();
                for rows in [1, 32, 100] {
                    let file = encoded(pixels, width, height, rows, &image);
                    let mut reader = png::Decoder::new(io::Cursor::new(file)).read_info().unwrap();
                    let mut back = vec![0; image.len()];
                    let info = reader.next_frame(&mut back).unwrap();
                    assert_eq!((info.width as usize, info.height as usize), (width, height));
                    assert_eq!(back, image, "{pixels:?} {width} x {height}, {rows} rows a strip");
                    reader.finish().unwrap();
                    assert_eq!(reader.info().srgb.is_some(), pixels == Pixels::Srgb);
                }
            }
        }
    }

    #[test]
    fn the_check_sum_is_that_of_the_standard() {
        assert_eq!(crc32fast::hash(b"123456789"), 0xcbf4_3926);
        assert_eq!(crc32fast::hash(b"IEND"), 0xae42_6082);
    }

    #[test]
    fn a_failing_writer_is_an_error() {
        struct Full(usize);
        impl Write for Full {
            fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
                if self.0 < bytes.len() {
                    return Err(io::ErrorKind::StorageFull.into());
                }
                self.0 -= bytes.len();
                Ok(bytes.len())
            }
            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }
        assert!(PngWriter::begin(Full(10), Pixels::Srgb, 4, 4).is_err());
        let mut writer = PngWriter::begin(Full(100), Pixels::Srgb, 400, 1).unwrap();
        let mut encoder = StripEncoder::new(Pixels::Srgb, 400);
        encoder.begin_at_top();
        encoder.push(|row| row.iter_mut().enumerate().for_each(|(k, v)| *v = (k * k) as u8));
        assert_eq!(writer.push(&encoder.finish()).unwrap_err().kind(), io::ErrorKind::StorageFull);
    }
}
