//! A file of sums: an EXR of integers in tiles, where untouched tiles take almost no space.

use std::io::BufReader;
use std::path::Path;

use exr::block::UncompressedBlock;
use exr::block::chunk::{Chunk, CompressedBlock};
use exr::math::RoundingMode;
use exr::meta::attribute::LevelMode;
use exr::meta::{BlockDescription, MetaData};
use exr::prelude::{TileDescription, Vec2};
use rayon::prelude::*;

use crate::export::band::Pool;
use crate::export::exr_tiles::{ExrWriter, Samples, TileEncoder, zero_tile};
use crate::export::layout::BLOCK;
use crate::export::{ExportError, OutputFile};
use crate::files::open_input;
use crate::progress::Progress;

/// An image of sums. Columns and rows count from its lower left.
pub(super) trait SumsImage: Sync {
    /// Width and height, cells.
    fn size(&self) -> [u32; 2];

    /// Names of the channels, sorted.
    fn channels(&self) -> Vec<&'static str>;

    /// Whether a rectangle may hold a value other than zero.
    fn touched(&self, at: [u32; 2], size: [usize; 2]) -> bool;

    /// Copies a rectangle of a channel into `out`, row 0 lowest.
    fn read(&self, channel: usize, at: [u32; 2], size: [usize; 2], out: &mut [u32]);
}

/// Returns the lower-left cell and the size of the block at a column and a row from above.
fn block([width, height]: [u32; 2], left: usize, top: usize) -> ([u32; 2], [usize; 2]) {
    let size = [BLOCK.min(width as usize - left), BLOCK.min(height as usize - top)];
    ([left as u32, (height as usize - top - size[1]) as u32], size)
}

pub(super) fn write_image(
    file: OutputFile,
    image: &impl SumsImage,
    progress: &dyn Progress,
) -> Result<(), ExportError> {
    let names: Vec<String> = image.channels().into_iter().map(String::from).collect();
    let [width, height] = image.size().map(|side| side as usize);
    let mut writer = ExrWriter::begin(file, Samples::U32, width, height, &names).map_err(OutputFile::explain)?;
    let blank = zero_tile(names.len(), [BLOCK, BLOCK]);
    let pool = Pool::default();
    for top in (0..height).step_by(BLOCK) {
        progress.keep_on()?;
        let lefts: Vec<usize> = (0..width).step_by(BLOCK).collect();
        let encode = |&left: &usize| {
            let (at, size) = block(image.size(), left, top);
            if !image.touched(at, size) {
                return if size == [BLOCK, BLOCK] { blank.clone() } else { zero_tile(names.len(), size) };
            }
            pool.with(SumsEncoder::default, |encoder| encoder.encode(image, names.len(), at, size))
        };
        let tiles: Vec<Vec<u8>> = lefts.par_iter().with_max_len(1).map(encode).collect();
        for tile in tiles {
            writer.push(&tile).map_err(OutputFile::explain)?;
        }
    }
    writer.finish().map_err(OutputFile::explain)?.close()
}

#[derive(Debug, Default)]
struct SumsEncoder {
    values: Vec<u32>,
    tile: TileEncoder,
}

impl SumsEncoder {
    fn encode(&mut self, image: &impl SumsImage, channels: usize, at: [u32; 2], size: [usize; 2]) -> Vec<u8> {
        let count = size[0] * size[1];
        self.values.resize(channels * count, 0);
        for (channel, values) in self.values.chunks_mut(count).enumerate() {
            image.read(channel, at, size, values);
        }
        let channels: Vec<&[u32]> = self.values.chunks(count).collect();
        self.tile.u32(&channels, size[0])
    }
}

/// Number of tiles to unpack in parallel.
const BATCH: usize = 64;

/// Reads an image of sums with this size and these channels.
///
/// `add` takes channel, place, size and values of each block that is not all zero.
///
/// # Errors
/// A missing or invalid file, another size or other channels; errors of `add`.
pub(super) fn read_image(
    path: &Path,
    size: [u32; 2],
    channels: &[&str],
    mut add: impl FnMut(usize, [u32; 2], [usize; 2], &[u32]) -> Result<(), ExportError>,
) -> Result<(), ExportError> {
    let damaged = |error: exr::error::Error| match error {
        exr::error::Error::Io(source) => ExportError::Read { path: path.to_path_buf(), source },
        other => ExportError::damaged(path, other),
    };
    let file = open_input(path).map_err(ExportError::read(path))?;
    let reader = exr::block::read(BufReader::with_capacity(1 << 16, file), false).map_err(damaged)?;
    check_header(path, reader.headers(), size, channels)?;
    let mut chunks = reader.all_chunks(false).map_err(damaged)?;
    let meta = exr::block::reader::ChunksReader::meta_data(&chunks).clone();
    let blank = zero_tile(channels.len(), [BLOCK, BLOCK]);
    loop {
        let mut batch = Vec::new();
        for chunk in chunks.by_ref().take(BATCH) {
            batch.push(chunk.map_err(damaged)?);
        }
        if batch.is_empty() {
            return Ok(());
        }
        let blocks: Vec<Option<Block>> = batch
            .into_par_iter()
            .map(|chunk| unpack(chunk, &meta, &blank))
            .collect::<Result<_, _>>()
            .map_err(damaged)?;
        for read in blocks.into_iter().flatten() {
            let usual = read.left < size[0] as usize && read.top < size[1] as usize;
            let (at, expected) = if usual { block(size, read.left, read.top) } else { ([0; 2], [0; 2]) };
            if !usual || expected != read.size {
                return Err(ExportError::damaged(path, "its tiles are not of the usual size"));
            }
            for (channel, values) in read.channels.iter().enumerate() {
                add(channel, at, expected, values)?;
            }
        }
    }
}

fn check_header(
    path: &Path,
    headers: &[exr::meta::header::Header],
    [width, height]: [u32; 2],
    names: &[&str],
) -> Result<(), ExportError> {
    let [header] = headers else { return Err(ExportError::damaged(path, "it has more than one part")) };
    let size = header.layer_size;
    if [size.0, size.1] != [width as usize, height as usize] {
        let problem = format!("it is {} x {} px, not {width} x {height}", size.0, size.1);
        return Err(ExportError::damaged(path, problem));
    }
    let tiles = TileDescription {
        tile_size: Vec2(BLOCK, BLOCK),
        level_mode: LevelMode::Singular,
        rounding_mode: RoundingMode::Down,
    };
    if header.deep || header.blocks != BlockDescription::Tiles(tiles) {
        return Err(ExportError::damaged(path, "its tiles are not of the usual size"));
    }
    let channels = &header.channels.list;
    let fits = channels.len() == names.len()
        && channels.iter().zip(names).all(|(channel, name)| {
            channel.sample_type == exr::prelude::SampleType::U32 && channel.name.to_string() == *name
        });
    if !fits {
        return Err(ExportError::damaged(path, format!("its channels are not {} in whole numbers", names.join(", "))));
    }
    Ok(())
}

/// An unpacked tile, row 0 lowest.
struct Block {
    left: usize,
    top: usize,
    size: [usize; 2],
    channels: Vec<Vec<u32>>,
}

/// Unpacks a tile; `None` if it equals `blank`, as most tiles do.
fn unpack(chunk: Chunk, meta: &MetaData, blank: &[u8]) -> exr::error::Result<Option<Block>> {
    if matches!(&chunk.compressed_block, CompressedBlock::Tile(tile) if tile.compressed_pixels_le == blank) {
        return Ok(None);
    }
    let block = UncompressedBlock::decompress_chunk(chunk, meta, false)?;
    let (position, size) = (block.index.pixel_position, block.index.pixel_size);
    let count = meta.headers[block.index.layer].channels.list.len();
    let mut channels = vec![vec![0; size.0 * size.1]; count];
    for (k, line) in block.data.chunks_exact(4 * size.0).enumerate() {
        let (row, channel) = (size.1 - 1 - k / count, k % count);
        for (value, bytes) in channels[channel][row * size.0..].iter_mut().zip(line.chunks_exact(4)) {
            *value = bytes.try_into().map_or(0, u32::from_ne_bytes);
        }
    }
    Ok(Some(Block { left: position.0, top: position.1, size: [size.0, size.1], channels }))
}

/// Cuts a file of sums short, bends its bytes and removes it: reading must name it each time.
#[cfg(test)]
pub(super) fn assert_damage_is_named(path: &Path, read: impl Fn() -> Result<(), ExportError>) {
    let name = path.file_name().unwrap().to_string_lossy();
    let whole = std::fs::read(path).unwrap();
    let mut bent = whole.clone();
    for at in (400..whole.len()).step_by(97) {
        bent[at] ^= 0x55;
    }
    for bytes in [&whole[..whole.len() / 2], &whole[..20], &[], &bent] {
        std::fs::write(path, bytes).unwrap();
        let error = read().unwrap_err();
        assert!(error.to_string().contains(&*name), "{error}");
    }
    std::fs::remove_file(path).unwrap();
    assert!(matches!(read(), Err(ExportError::Read { .. })));
}
