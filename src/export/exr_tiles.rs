//! EXR files made of tiles that any thread compresses separately.
//!
//! The `exr` crate writes the header. The tiles are compressed here, because the crate takes sixteen times as long for
//! the same size.

use std::io::{self, Seek, SeekFrom, Write};

use exr::meta::attribute::{LevelMode, LineOrder};
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData, magic_number};
use exr::prelude::{ChannelDescription, Compression, SampleType, SmallVec, TileDescription, Vec2};
use flate2::write::ZlibEncoder;
use half::f16;
use half::slice::HalfFloatSliceExt;

use super::layout::BLOCK;

/// Sample type of an image's channels, with its compression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Samples {
    /// Half floats, compressed as ZIP.
    Half,
    /// Integers of 32 bit, compressed losslessly as PXR24.
    ///
    /// PXR24 groups bytes of equal weight and needs two thirds of ZIP's space.
    U32,
}

/// Writes an image tile by tile, in rows of tiles from above.
#[derive(Debug)]
pub(super) struct ExrWriter<W: Write + Seek> {
    out: W,
    table_at: u64,
    at: u64,
    offsets: Vec<u64>,
    columns: usize,
    tiles: usize,
}

impl<W: Write + Seek> ExrWriter<W> {
    /// Begins a file with these channel names, which have to be sorted.
    pub(super) fn begin(
        mut out: W,
        samples: Samples,
        width: usize,
        height: usize,
        channels: &[String],
    ) -> io::Result<ExrWriter<W>> {
        let header = header(samples, width, height, channels);
        let headers = [header];
        let requirements = MetaData::validate(&headers, true).map_err(io_error)?;
        let mut head = Vec::new();
        magic_number::write(&mut head).map_err(io_error)?;
        requirements.write(&mut head).map_err(io_error)?;
        Header::write_all(&headers, &mut head, false).map_err(io_error)?;
        let (columns, rows) = (width.div_ceil(BLOCK), height.div_ceil(BLOCK));
        let table_at = head.len() as u64;
        // Space for the tile offsets, which are known at the end.
        head.resize(head.len() + columns * rows * 8, 0);
        out.write_all(&head)?;
        Ok(ExrWriter { out, table_at, at: head.len() as u64, offsets: Vec::new(), columns, tiles: columns * rows })
    }

    pub(super) fn push(&mut self, tile: &[u8]) -> io::Result<()> {
        let index = self.offsets.len();
        let coordinates = [index % self.columns, index / self.columns, 0, 0, tile.len()];
        let mut head = [0; 20];
        for (place, value) in head.chunks_exact_mut(4).zip(coordinates) {
            place.copy_from_slice(&(value as u32).to_le_bytes());
        }
        self.offsets.push(self.at);
        self.at += (head.len() + tile.len()) as u64;
        self.out.write_all(&head)?;
        self.out.write_all(tile)
    }

    /// Finishes the file and returns its writer, not yet flushed.
    pub(super) fn finish(mut self) -> io::Result<W> {
        if self.offsets.len() != self.tiles {
            return Err(io::Error::other(format!("{} of {} tiles were written", self.offsets.len(), self.tiles)));
        }
        let table: Vec<u8> = self.offsets.iter().flat_map(|offset| offset.to_le_bytes()).collect();
        self.out.seek(SeekFrom::Start(self.table_at))?;
        self.out.write_all(&table)?;
        self.out.seek(SeekFrom::Start(self.at))?;
        Ok(self.out)
    }
}

fn header(samples: Samples, width: usize, height: usize, channels: &[String]) -> Header {
    let (sample_type, compression) = match samples {
        Samples::Half => (SampleType::F16, Compression::ZIP16),
        Samples::U32 => (SampleType::U32, Compression::PXR24),
    };
    let channels: SmallVec<[ChannelDescription; 5]> =
        channels.iter().map(|name| ChannelDescription::named(name.as_str(), sample_type)).collect();
    let tiles = TileDescription {
        tile_size: Vec2(BLOCK, BLOCK),
        level_mode: LevelMode::Singular,
        rounding_mode: exr::math::RoundingMode::Down,
    };
    let mut header = Header::new("floor".into(), (width, height), channels);
    // Single-layer files need no name; some readers prefix it to every channel's name.
    header.own_attributes.layer_name = None;
    header.with_encoding(compression, BlockDescription::Tiles(tiles), LineOrder::Increasing)
}

fn io_error(error: exr::error::Error) -> io::Error {
    match error {
        exr::error::Error::Io(error) => error,
        other => io::Error::other(other.to_string()),
    }
}

/// Returns a compressed tile of integers that are all zero.
pub(super) fn zero_tile(channels: usize, [width, height]: [usize; 2]) -> Vec<u8> {
    let count = 4 * channels * width * height;
    // As small as possible: it is written many times.
    let tile = zlib(&vec![0; count], flate2::Compression::best());
    // EXR stores data raw where compression does not shrink it.
    if tile.len() < count { tile } else { vec![0; count] }
}

/// Compresses tiles and reuses its buffers.
#[derive(Debug, Default)]
pub(super) struct TileEncoder {
    halves: Vec<f16>,
    packed: Vec<u8>,
}

impl TileEncoder {
    /// Compresses a tile of half floats. Each channel has rows of `width` values, the southernmost first.
    pub(super) fn half(&mut self, channels: &[&[f32]], width: usize) -> Vec<u8> {
        let count: usize = channels.iter().map(|values| values.len()).sum();
        self.halves.resize(count, f16::ZERO);
        for_rows_from_above(channels, width, |at, values| {
            self.halves[at..at + values.len()].convert_from_f32_slice(values);
        });
        // ZIP: all low bytes, then all high bytes, each as the difference to the previous byte.
        self.packed.resize(2 * count, 0);
        let (low, high) = self.packed.split_at_mut(count);
        let mut before = [128u8, 0];
        for ((low, high), half) in low.iter_mut().zip(high.iter_mut()).zip(&self.halves) {
            let bytes = half.to_bits().to_le_bytes();
            *low = difference(bytes[0], before[0]);
            *high = difference(bytes[1], before[1]);
            before = bytes;
        }
        if let (Some(first_high), Some(last)) = (high.first_mut(), self.halves.last()) {
            let last_low = last.to_bits().to_le_bytes()[0];
            *first_high = difference(self.halves[0].to_bits().to_le_bytes()[1], last_low);
        }
        let raw = || self.halves.iter().flat_map(|half| half.to_bits().to_le_bytes()).collect();
        smaller(&self.packed, raw)
    }

    /// Compresses a tile of integers. Each channel has rows of `width` values, the southernmost first.
    pub(super) fn u32(&mut self, channels: &[&[u32]], width: usize) -> Vec<u8> {
        let count: usize = channels.iter().map(|values| values.len()).sum();
        self.packed.resize(4 * count, 0);
        // PXR24: differences of neighbours in each row, their highest bytes first.
        for_rows_from_above(channels, width, |at, values| {
            let planes = &mut self.packed[4 * at..4 * (at + values.len())];
            let (high, low) = planes.split_at_mut(2 * values.len());
            let (first, second) = high.split_at_mut(values.len());
            let (third, fourth) = low.split_at_mut(values.len());
            let mut before = 0;
            for (k, &value) in values.iter().enumerate() {
                [first[k], second[k], third[k], fourth[k]] = value.wrapping_sub(before).to_be_bytes();
                before = value;
            }
        });
        let raw = || {
            let mut raw = vec![0; 4 * count];
            for_rows_from_above(channels, width, |at, values| {
                for (place, value) in raw[4 * at..].chunks_exact_mut(4).zip(values) {
                    place.copy_from_slice(&value.to_le_bytes());
                }
            });
            raw
        };
        smaller(&self.packed, raw)
    }
}

fn difference(byte: u8, before: u8) -> u8 {
    byte.wrapping_sub(before).wrapping_add(128)
}

/// Calls `row` for each row in EXR's order: rows from above, in each row channel by channel.
///
/// The first argument is the number of samples before that row.
fn for_rows_from_above<T>(channels: &[&[T]], width: usize, mut row: impl FnMut(usize, &[T])) {
    let height = channels.first().map_or(0, |values| values.len() / width.max(1));
    let mut at = 0;
    for y in (0..height).rev() {
        for values in channels {
            row(at, &values[y * width..(y + 1) * width]);
            at += width;
        }
    }
}

/// A zlib stream of some bytes.
fn zlib(bytes: &[u8], level: flate2::Compression) -> Vec<u8> {
    let mut stream = ZlibEncoder::new(Vec::with_capacity(bytes.len() / 2), level);
    let done = stream.write_all(bytes).and_then(|()| stream.finish());
    done.expect("a vector takes all bytes")
}

/// Compresses packed bytes, or returns `raw` where they do not shrink, as EXR requires.
fn smaller(packed: &[u8], raw: impl FnOnce() -> Vec<u8>) -> Vec<u8> {
    // The predictor leaves noise around zero with few repeated strings: a longer search gains nothing.
    let compressed = zlib(packed, flate2::Compression::fast());
    if compressed.len() < packed.len() { compressed } else { raw() }
}

#[cfg(test)]
mod tests {
    use exr::prelude::*;

    use super::*;

    /// An image of 300 x 270 pixels in tiles of 256: `value(channel, column, row from above)`.
    fn written<T: Copy>(
        samples: Samples,
        value: impl Fn(usize, usize, usize) -> T,
        encode: impl Fn(&[&[T]], usize) -> Vec<u8>,
    ) -> Vec<u8> {
        let (width, height) = (300, 270);
        let names = ["passes".to_string(), "scuff".to_string()];
        let mut writer = ExrWriter::begin(io::Cursor::new(Vec::new()), samples, width, height, &names).unwrap();
        for top in (0..height).step_by(BLOCK) {
            for left in (0..width).step_by(BLOCK) {
                let (right, bottom) = (width.min(left + BLOCK), height.min(top + BLOCK));
                let channels: Vec<Vec<T>> = (0..2)
                    .map(|c| {
                        (top..bottom)
                            .rev()
                            .flat_map(|y| (left..right).map(move |x| (x, y)))
                            .map(|(x, y)| value(c, x, y))
                            .collect()
                    })
                    .collect();
                let channels: Vec<&[T]> = channels.iter().map(Vec::as_slice).collect();
                writer.push(&encode(&channels, right - left)).unwrap();
            }
        }
        writer.finish().unwrap().into_inner()
    }

    fn layer(file: &[u8]) -> Layer<AnyChannels<FlatSamples>> {
        read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .pedantic()
            .from_buffered(io::Cursor::new(file))
            .unwrap()
            .layer_data
    }

    #[test]
    fn halves_are_read_back_by_another_reader() {
        // Smooth, constant and noisy parts.
        let value = |c: usize, x: usize, y: usize| match (c, x / 100) {
            (0, 0) => (x as f32 + y as f32) / 256.0,
            (0, 1) => 0.0,
            _ => crate::math::SplitMix64::new((x * 1000 + y) as u64).unit(),
        };
        let file = written(Samples::Half, value, |channels, width| TileEncoder::default().half(channels, width));
        let layer = layer(&file);
        for (c, name) in ["passes", "scuff"].into_iter().enumerate() {
            assert_eq!(layer.channel_data.list[c].name.to_string(), name);
            let FlatSamples::F16(samples) = &layer.channel_data.list[c].sample_data else { panic!("not half") };
            for (k, &sample) in samples.iter().enumerate() {
                assert_eq!(sample, f16::from_f32(value(c, k % 300, k / 300)), "{name} at {} {}", k % 300, k / 300);
            }
        }
    }

    #[test]
    fn whole_numbers_are_read_back_exactly_by_another_reader() {
        let value = |c: usize, x: usize, y: usize| match (c, x / 100) {
            (0, 0) => (x * y) as u32,
            (0, 1) => u32::MAX * (y as u32 & 1),
            (1, 0) => 0,
            _ => crate::math::SplitMix64::new((x * 1000 + y) as u64).next_u64() as u32,
        };
        let file = written(Samples::U32, value, |channels, width| TileEncoder::default().u32(channels, width));
        let layer = layer(&file);
        for c in 0..2 {
            let FlatSamples::U32(samples) = &layer.channel_data.list[c].sample_data else { panic!("not whole") };
            for (k, &sample) in samples.iter().enumerate() {
                assert_eq!(sample, value(c, k % 300, k / 300), "channel {c} at {} {}", k % 300, k / 300);
            }
        }
    }

    #[test]
    fn a_missing_tile_is_an_error() {
        let names = ["a".to_string()];
        let writer = ExrWriter::begin(io::Cursor::new(Vec::new()), Samples::Half, 300, 1, &names).unwrap();
        assert!(writer.finish().is_err());
    }
}
