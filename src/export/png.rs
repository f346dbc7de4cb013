//! PNG files of textures, written row by row.

use std::fmt;
use std::io::{self, Write};
use std::sync::{Arc, Mutex, PoisonError};

use flate2::write::ZlibEncoder;
use png::{BitDepth, ColorType, Compression, Encoder, Filter, SrgbRenderingIntent, StreamWriter};

/// Bytes of an `IDAT` chunk.
const CHUNK_BYTES: usize = 1 << 18;

/// Bytes of a row that are looked at to choose its filter: the first so many of each stretch.
const LOOKED_AT: usize = 128;
const STRETCH: usize = 1024;

/// Rows that share a filter where files are to be small.
///
/// The filter that leaves the least absolute sum is a poor guess for smooth numbers with dither, such as roughness: there the
/// deflate step finds more in rows as they are.
const SHARING_ROWS: usize = 16;

/// Pixel format and colour space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pixels {
    /// Red, green, blue in sRGB, with an `sRGB` chunk.
    Srgb,
    /// The same with alpha, not multiplied.
    Srgb4,
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
            Pixels::Linear4 | Pixels::Srgb4 => 4,
            Pixels::Fine1 => 2,
            Pixels::Fine3 => 6,
        }
    }
}

/// Writes a PNG file, row by row from above.
pub(super) struct PngWriter<W: Write + Send + 'static> {
    out: SharedWriter<W>,
    rows: StreamWriter<'static, SharedWriter<W>>,
    /// Bytes of a pixel.
    pixel: usize,
    /// The last row that was written; zeros before the first, as PNG has it.
    above: Vec<u8>,
    /// Rows that wait for those that share their filter, where the file is to be small.
    waiting: Option<Vec<u8>>,
}

impl<W: Write + Send + 'static> PngWriter<W> {
    /// Writes the header. To compress a file that is to be small takes 20 to 30 times as long.
    pub(super) fn begin(out: W, pixels: Pixels, [width, height]: [u32; 2], is_small: bool) -> io::Result<PngWriter<W>> {
        let out = SharedWriter(Arc::new(Mutex::new(Sink { out, failure: None })));
        let mut encoder = Encoder::new(out.clone(), width, height);
        let is_fine = matches!(pixels, Pixels::Fine1 | Pixels::Fine3);
        encoder.set_depth(if is_fine { BitDepth::Sixteen } else { BitDepth::Eight });
        encoder.set_color(match pixels {
            Pixels::Linear1 | Pixels::Fine1 => ColorType::Grayscale,
            Pixels::Srgb | Pixels::Linear3 | Pixels::Fine3 => ColorType::Rgb,
            Pixels::Linear4 | Pixels::Srgb4 => ColorType::Rgba,
        });
        if matches!(pixels, Pixels::Srgb | Pixels::Srgb4) {
            encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
        }
        // Level 9 takes 5 to 15 times as long as level 6, `Balanced`, for files smaller by 1 to 4 %.
        encoder.set_compression(if is_small { Compression::Balanced } else { Compression::Fast });
        let begun = encoder.write_header().and_then(|writer| writer.into_stream_writer_with_size(CHUNK_BYTES));
        match begun {
            Ok(rows) => {
                let pixel = pixels.bytes();
                let above = vec![0; width as usize * pixel];
                Ok(PngWriter { out, rows, pixel, above, waiting: is_small.then(Vec::new) })
            }
            Err(error) => Err(out.failure().unwrap_or_else(|| error.into())),
        }
    }

    /// Appends a row.
    pub(super) fn push(&mut self, row: &[u8]) -> io::Result<()> {
        let Some(mut waiting) = self.waiting.take() else {
            return self.write(row, filter_of(row, &self.above, self.pixel));
        };
        waiting.extend_from_slice(row);
        if waiting.len() >= SHARING_ROWS * row.len() {
            self.write(&waiting, smallest_filter(&waiting, &self.above, self.pixel))?;
            waiting.clear();
        }
        self.waiting = Some(waiting);
        Ok(())
    }

    /// Writes rows, all with this filter.
    fn write(&mut self, rows: &[u8], filter: Filter) -> io::Result<()> {
        self.rows.set_filter(filter);
        if let Some(last) = rows.chunks_exact(self.above.len()).next_back() {
            self.above.copy_from_slice(last);
        }
        self.rows.write_all(rows).map_err(|error| self.out.failure().unwrap_or(error))
    }

    /// Finishes the file and flushes its writer.
    pub(super) fn finish(mut self) -> io::Result<()> {
        if let Some(waiting) = self.waiting.take().filter(|waiting| !waiting.is_empty()) {
            self.write(&waiting, smallest_filter(&waiting, &self.above, self.pixel))?;
        }
        let PngWriter { mut out, rows, .. } = self;
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

/// Chooses the filter that leaves the least absolute sum, from a sample of the row.
///
/// `Filter::Adaptive` looks at whole rows, which costs as much as to compress them; files are as small with a sample.
fn filter_of(row: &[u8], above: &[u8], pixel: usize) -> Filter {
    let mut sums = [0u32; 4];
    for from in (pixel..row.len()).step_by(STRETCH) {
        let stretch = |row: &[u8], from: usize| row[from..].first_chunk::<LOOKED_AT>().copied();
        let Some((own, up)) = stretch(row, from).zip(stretch(above, from)) else { break };
        let Some((left, corner)) = stretch(row, from - pixel).zip(stretch(above, from - pixel)) else { break };
        sums[0] += left_over(&own, |k| paeth(left[k], up[k], corner[k]));
        sums[1] += left_over(&own, |k| ((u16::from(left[k]) + u16::from(up[k])) / 2) as u8);
        sums[2] += left_over(&own, |k| up[k]);
        sums[3] += left_over(&own, |k| left[k]);
    }
    // Of equals the first, since it is the best of all for rows that are mostly clean.
    let filters = [Filter::Paeth, Filter::Avg, Filter::Up, Filter::Sub].into_iter().zip(sums);
    filters.min_by_key(|(_, sum)| *sum).map_or(Filter::Paeth, |(filter, _)| filter)
}

/// Chooses the filter that makes rows smallest, by trying all at the lowest effort.
fn smallest_filter(rows: &[u8], above: &[u8], pixel: usize) -> Filter {
    let filters = [Filter::Paeth, Filter::Avg, Filter::Up, Filter::Sub, Filter::NoFilter];
    let size = |filter: &Filter| {
        let mut compressed = ZlibEncoder::new(Vec::new(), flate2::Compression::fast());
        let mut above = above;
        let mut left_over = Vec::with_capacity(above.len());
        for row in rows.chunks_exact(above.len()) {
            left_over.clear();
            match filter {
                Filter::Paeth => leave(row, above, pixel, &mut left_over, paeth),
                Filter::Avg => leave(row, above, pixel, &mut left_over, |left, up, _| left.midpoint(up)),
                Filter::Up => leave(row, above, pixel, &mut left_over, |_, up, _| up),
                Filter::Sub => leave(row, above, pixel, &mut left_over, |left, _, _| left),
                _ => left_over.extend_from_slice(row),
            }
            compressed.write_all(&left_over).expect("memory does not fail");
            above = row;
        }
        compressed.finish().expect("memory does not fail").len()
    };
    filters.into_iter().min_by_key(size).unwrap_or(Filter::Paeth)
}

/// Appends what a guess from left, up and corner leaves of each byte of a row.
#[inline(always)]
fn leave(row: &[u8], above: &[u8], pixel: usize, out: &mut Vec<u8>, guess: impl Fn(u8, u8, u8) -> u8) {
    let (first, first_above) = (&row[..pixel.min(row.len())], &above[..pixel.min(above.len())]);
    out.extend(first.iter().zip(first_above).map(|(value, up)| value.wrapping_sub(guess(0, *up, 0))));
    let lefts = row.iter().zip(above);
    let rest = row.iter().zip(above).skip(pixel).zip(lefts);
    out.extend(rest.map(|((value, up), (left, corner))| value.wrapping_sub(guess(*left, *up, *corner))));
}

/// Absolute sum of what a guess of each byte leaves. Sums of 16 bits suffice, and twice as many fit into a register.
#[inline(always)]
fn left_over(values: &[u8; LOOKED_AT], guess: impl Fn(usize) -> u8) -> u32 {
    let mut sum = 0u16;
    for (k, value) in values.iter().enumerate() {
        sum = sum.wrapping_add(u16::from(value.wrapping_sub(guess(k)).cast_signed().unsigned_abs()));
    }
    u32::from(sum)
}

/// The neighbour that is nearest to `left + up - corner` (PNG specification, 9.4).
#[inline(always)]
fn paeth(left: u8, up: u8, corner: u8) -> u8 {
    let [a, b, c] = [i16::from(left), i16::from(up), i16::from(corner)];
    let (from_left, from_up) = (b.wrapping_sub(c), a.wrapping_sub(c));
    let from_corner = from_left.wrapping_add(from_up).wrapping_abs();
    let (from_left, from_up) = (from_left.wrapping_abs(), from_up.wrapping_abs());
    let beside = if from_up <= from_corner { up } else { corner };
    if from_left <= from_up && from_left <= from_corner { left } else { beside }
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

    fn write(disk: &Disk, (pixels, small): (Pixels, bool), size: [usize; 2], image: &[u8]) -> io::Result<()> {
        let mut writer = PngWriter::begin(disk.clone(), pixels, size.map(|side| side as u32), small)?;
        for row in image.chunks(size[0] * pixels.bytes()) {
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
        for (pixels, small) in [Pixels::Srgb, Pixels::Linear1, Pixels::Linear3, Pixels::Linear4, Pixels::Fine3]
            .into_iter()
            .flat_map(|pixels| [(pixels, false), (pixels, true)])
        {
            for size in [[1, 1], [7, 33], [200, 65], [3, 16]] {
                let image = image(pixels, size);
                let disk = Disk::of(usize::MAX);
                write(&disk, (pixels, small), size, &image).unwrap();
                let file = disk.0.lock().unwrap().clone();
                let mut reader = png::Decoder::new(io::Cursor::new(file)).read_info().unwrap();
                let mut back = vec![0; image.len()];
                let info = reader.next_frame(&mut back).unwrap();
                assert_eq!([info.width as usize, info.height as usize], size);
                assert_eq!(back, image, "{pixels:?} {size:?} {small}");
                reader.finish().unwrap();
                let is_colour = pixels == Pixels::Srgb;
                assert_eq!((reader.info().srgb.is_some(), reader.info().gama_chunk.is_some()), (is_colour, false));
            }
        }
    }

    /// Wherever the disk becomes full, also within the last bytes.
    #[test]
    fn a_full_disk_is_an_error_at_every_byte() {
        for (form, size) in [((Pixels::Srgb, false), [40, 9]), ((Pixels::Srgb, true), [40, 18])] {
            let image = image(form.0, size);
            let whole = Disk::of(usize::MAX);
            write(&whole, form, size, &image).unwrap();
            let length = whole.0.lock().unwrap().len();
            for room in (0..length).step_by(7).chain([length - 1]) {
                let error = write(&Disk::of(room), form, size, &image).unwrap_err();
                assert_eq!(error.to_string(), "the disk of the test", "{room} of {length} bytes");
            }
        }
    }
}
