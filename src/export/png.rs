//! PNG files of textures, written row by row.

use std::fmt;
use std::io::{self, Write};
use std::sync::{Arc, Mutex, PoisonError};

use png::{BitDepth, ColorType, Compression, Encoder, Filter, SrgbRenderingIntent, StreamWriter};

/// Bytes of an `IDAT` chunk.
const CHUNK_BYTES: usize = 1 << 18;

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
    /// One linear value, and three, of 16 bits, big-endian.
    Fine1,
    Fine3,
}

impl Pixels {
    pub(super) fn bytes(self) -> usize {
        match self {
            Pixels::Linear1 => 1,
            Pixels::Srgb | Pixels::Linear3 => 3,
            Pixels::Linear4 => 4,
            Pixels::Fine1 => 2,
            Pixels::Fine3 => 6,
        }
    }
}

/// Writes a PNG file, row by row from above.
pub(super) struct PngWriter<W: Write + Send + 'static> {
    out: SharedWriter<W>,
    rows: StreamWriter<'static, SharedWriter<W>>,
}

impl<W: Write + Send + 'static> PngWriter<W> {
    /// Writes the header.
    pub(super) fn begin(out: W, pixels: Pixels, width: u32, height: u32) -> io::Result<PngWriter<W>> {
        let out = SharedWriter(Arc::new(Mutex::new(Sink { out, failure: None })));
        let mut encoder = Encoder::new(out.clone(), width, height);
        let is_fine = matches!(pixels, Pixels::Fine1 | Pixels::Fine3);
        encoder.set_depth(if is_fine { BitDepth::Sixteen } else { BitDepth::Eight });
        encoder.set_color(match pixels {
            Pixels::Linear1 | Pixels::Fine1 => ColorType::Grayscale,
            Pixels::Srgb | Pixels::Linear3 | Pixels::Fine3 => ColorType::Rgb,
            Pixels::Linear4 => ColorType::Rgba,
        });
        if pixels == Pixels::Srgb {
            encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
        }
        // Measured on a floor of 8192 px: a tenth of the time of level 6, and a file a fifth larger.
        encoder.set_compression(Compression::Fast);
        encoder.set_filter(Filter::Adaptive);
        let begun = encoder.write_header().and_then(|writer| writer.into_stream_writer_with_size(CHUNK_BYTES));
        match begun {
            Ok(rows) => Ok(PngWriter { out, rows }),
            Err(error) => Err(out.failure().unwrap_or_else(|| error.into())),
        }
    }

    /// Appends whole rows.
    pub(super) fn push(&mut self, rows: &[u8]) -> io::Result<()> {
        self.rows.write_all(rows).map_err(|error| self.out.failure().unwrap_or(error))
    }

    /// Finishes the file and flushes its writer.
    pub(super) fn finish(self) -> io::Result<()> {
        let PngWriter { mut out, rows } = self;
        let finished = rows.finish().map_err(io::Error::from).and_then(|()| out.flush());
        // The encoder hides failures of the last bytes.
        out.failure().map_or(finished, Err)
    }
}

impl<W: Write + Send + 'static> fmt::Debug for PngWriter<W> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("PngWriter").finish_non_exhaustive()
    }
}

/// A writer that an encoder owns and that keeps its first failure.
struct SharedWriter<W>(Arc<Mutex<Sink<W>>>);

struct Sink<W> {
    out: W,
    failure: Option<io::Error>,
}

impl<W> Clone for SharedWriter<W> {
    fn clone(&self) -> SharedWriter<W> {
        SharedWriter(Arc::clone(&self.0))
    }
}

impl<W: Write> SharedWriter<W> {
    fn failure(&self) -> Option<io::Error> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).failure.take()
    }

    fn with<T>(&self, work: impl FnOnce(&mut W) -> io::Result<T>) -> io::Result<T> {
        let mut sink = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let done = work(&mut sink.out);
        match done {
            Err(error) if error.kind() != io::ErrorKind::Interrupted => {
                let kind = error.kind();
                sink.failure.get_or_insert(error);
                Err(kind.into())
            }
            done => done,
        }
    }
}

impl<W: Write> Write for SharedWriter<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.with(|out| out.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.with(Write::flush)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A writer that is full after some bytes.
    #[derive(Clone)]
    struct Disk(Arc<Mutex<Vec<u8>>>, usize);

    impl Disk {
        fn of(room: usize) -> Disk {
            Disk(Arc::default(), room)
        }
    }

    impl Write for Disk {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let mut held = self.0.lock().unwrap();
            if held.len() + bytes.len() > self.1 {
                return Err(io::Error::new(io::ErrorKind::StorageFull, "the disk of the test"));
            }
            held.extend_from_slice(bytes);
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    fn write(disk: &Disk, pixels: Pixels, [width, height]: [usize; 2], image: &[u8]) -> io::Result<()> {
        let mut writer = PngWriter::begin(disk.clone(), pixels, width as u32, height as u32)?;
        for row in image.chunks(width * pixels.bytes()) {
            writer.push(row)?;
        }
        writer.finish()
    }

    fn image(pixels: Pixels, [width, height]: [usize; 2]) -> Vec<u8> {
        let mut random = crate::math::SplitMix64::new(3);
        let value = |k| ((k / 50) as u8).wrapping_add((random.next_u64() & 3) as u8);
        (0..width * height * pixels.bytes()).map(value).collect()
    }

    #[test]
    fn a_decoder_reads_back_every_pixel() {
        for pixels in [Pixels::Srgb, Pixels::Linear1, Pixels::Linear3, Pixels::Linear4] {
            for size in [[1, 1], [7, 33], [200, 65]] {
                let image = image(pixels, size);
                let disk = Disk::of(usize::MAX);
                write(&disk, pixels, size, &image).unwrap();
                let file = disk.0.lock().unwrap().clone();
                let mut reader = png::Decoder::new(io::Cursor::new(file)).read_info().unwrap();
                let mut back = vec![0; image.len()];
                let info = reader.next_frame(&mut back).unwrap();
                assert_eq!([info.width as usize, info.height as usize], size);
                assert_eq!(back, image, "{pixels:?} {size:?}");
                reader.finish().unwrap();
                let is_colour = pixels == Pixels::Srgb;
                assert_eq!((reader.info().srgb.is_some(), reader.info().gama_chunk.is_some()), (is_colour, false));
            }
        }
    }

    /// Wherever the disk becomes full, also within the last bytes.
    #[test]
    fn a_full_disk_is_an_error_at_every_byte() {
        let (pixels, size) = (Pixels::Srgb, [40, 9]);
        let image = image(pixels, size);
        let whole = Disk::of(usize::MAX);
        write(&whole, pixels, size, &image).unwrap();
        let length = whole.0.lock().unwrap().len();
        for room in (0..length).step_by(7).chain([length - 1]) {
            let error = write(&Disk::of(room), pixels, size, &image).unwrap_err();
            assert_eq!(error.to_string(), "the disk of the test", "{room} of {length} bytes");
        }
    }
}
