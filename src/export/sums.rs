use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use exr::block::UncompressedBlock;
use exr::block::chunk::{Chunk, CompressedBlock};
use exr::meta::MetaData;
use rayon::prelude::*;

use super::band::Pool;
use super::exr_tiles::{ExrWriter, Samples, TileEncoder};
use super::layout::{BLOCK, Tile, TileLayout};
use super::manifest::{Manifest, PresenceEntry, SumsEntry, TileEntry};
use super::{ExportError, FloorTextures, OutputFile, OutputFolder};
use crate::progress::Progress;
use crate::stamps::TexelGrid;
use crate::sums::{FloorSums, Quantity};

/// The quantities of a tile's file, sorted by name.
const TILE_QUANTITIES: [Quantity; 3] = [Quantity::Passes, Quantity::Scuff, Quantity::Soil];
const PRESENCE_FILE: &str = "sums/floor_presence.exr";

/// Writes the exact sums into `sums/`: one file for each tile that was written, and `presence` on its own grid.
///
/// Whole numbers, a channel per quantity. Only blocks that somebody touched cost anything.
///
/// # Errors
/// A file that cannot be written, an interruption.
pub fn write_sums(
    folder: &OutputFolder,
    sums: &FloorSums,
    textures: &FloorTextures,
    progress: &dyn Progress,
) -> Result<SumsEntry, ExportError> {
    for (tile, entry) in textures.layout.tiles().filter_map(|tile| Some((tile, entry_of(&tile, &textures.tiles)?))) {
        let area = Area { i0: tile.i0, j0: tile.j0, width: tile.width as usize, height: tile.height as usize };
        write_area(folder.create(&entry.sums)?, sums, &TILE_QUANTITIES, area, progress)?;
    }
    let TexelGrid { texels_per_metre, width, height } = sums.presence_grid();
    let area = Area { i0: 0, j0: 0, width: width as usize, height: height as usize };
    write_area(folder.create(PRESENCE_FILE)?, sums, &[Quantity::Presence], area, progress)?;
    Ok(SumsEntry {
        one: Quantity::ALL.iter().map(|quantity| (quantity.name().to_string(), quantity.one())).collect(),
        presence: PresenceEntry {
            file: PRESENCE_FILE.to_string(),
            texels_per_metre,
            width_px: width,
            height_px: height,
        },
    })
}

fn entry_of<'a>(tile: &Tile, entries: &'a [TileEntry]) -> Option<&'a TileEntry> {
    entries.iter().find(|entry| (entry.u, entry.v) == (tile.u, tile.v))
}

/// A rectangle of a grid that is one image.
#[derive(Clone, Copy, Debug)]
struct Area {
    i0: u32,
    j0: u32,
    width: usize,
    height: usize,
}

impl Area {
    /// Lower-left cell of the whole grid and size of the block at a column and a row from above.
    fn block(&self, left: usize, top: usize) -> ([u32; 2], [usize; 2]) {
        let [width, height] = [BLOCK.min(self.width - left), BLOCK.min(self.height - top)];
        ([self.i0 + left as u32, self.j0 + (self.height - top - height) as u32], [width, height])
    }
}

fn write_area(
    file: OutputFile,
    sums: &FloorSums,
    quantities: &[Quantity],
    area: Area,
    progress: &dyn Progress,
) -> Result<(), ExportError> {
    let names: Vec<String> = quantities.iter().map(|quantity| quantity.name().to_string()).collect();
    let mut writer =
        ExrWriter::begin(file, Samples::U32, area.width, area.height, &names).map_err(OutputFile::explain)?;
    let blank = zeros(quantities.len(), [BLOCK, BLOCK]);
    let pool = Pool::default();
    for top in (0..area.height).step_by(BLOCK) {
        if progress.interrupted() {
            return Err(ExportError::Interrupted);
        }
        let lefts: Vec<usize> = (0..area.width).step_by(BLOCK).collect();
        let encode = |&left: &usize| {
            let ([i0, j0], [width, height]) = area.block(left, top);
            if !quantities.iter().any(|&quantity| sums.touched(quantity, i0, j0, width, height)) {
                let full = [width, height] == [BLOCK, BLOCK];
                return if full { blank.clone() } else { zeros(quantities.len(), [width, height]) };
            }
            pool.with(SumsEncoder::default, |encoder| encoder.encode(sums, quantities, [i0, j0], [width, height]))
        };
        let tiles: Vec<Vec<u8>> = lefts.par_iter().with_max_len(1).map(encode).collect();
        for tile in tiles {
            writer.push(&tile).map_err(OutputFile::explain)?;
        }
    }
    writer.finish().map_err(OutputFile::explain)?.close()
}

fn zeros(channels: usize, [width, height]: [usize; 2]) -> Vec<u8> {
    let zeros = vec![0; width * height];
    TileEncoder::default().u32(&vec![zeros.as_slice(); channels], width)
}

#[derive(Debug, Default)]
struct SumsEncoder {
    values: Vec<u32>,
    tile: TileEncoder,
}

impl SumsEncoder {
    fn encode(
        &mut self,
        sums: &FloorSums,
        quantities: &[Quantity],
        [i0, j0]: [u32; 2],
        [width, height]: [usize; 2],
    ) -> Vec<u8> {
        let count = width * height;
        self.values.resize(quantities.len() * count, 0);
        for (&quantity, values) in quantities.iter().zip(self.values.chunks_mut(count)) {
            sums.read(quantity, i0, j0, width, height, values);
        }
        let channels: Vec<&[u32]> = self.values.chunks(count).collect();
        self.tile.u32(&channels, width)
    }
}

/// Reads the exact sums of a bake, as [`write_sums`] wrote them.
///
/// # Errors
/// A file that is missing or damaged, or that does not fit the manifest.
pub fn read_sums(bake: &Path, manifest: &Manifest) -> Result<FloorSums, ExportError> {
    let floor = &manifest.floor;
    let grid = TexelGrid { texels_per_metre: floor.texels_per_metre, width: floor.width_px, height: floor.height_px };
    let in_manifest = |problem: &str| ExportError::damaged(&bake.join(super::manifest::FILE_NAME), problem);
    for quantity in Quantity::ALL {
        if floor.sums.one.get(quantity.name()) != Some(&quantity.one()) {
            return Err(in_manifest(&format!("`floor.sums.one.{}` is not {}", quantity.name(), quantity.one())));
        }
    }
    if !grid.texels_per_metre.is_finite() || grid.texels_per_metre <= 0.0 {
        return Err(in_manifest("`floor.texels_per_metre` is no texel density"));
    }
    let mut sums = FloorSums::new(grid);
    let [width, height] = floor.tile_px;
    let layout = TileLayout { grid, width, height };
    if width == 0 || height == 0 {
        return Err(in_manifest("`floor.tile_px` is zero"));
    }
    for entry in &floor.tiles {
        let [i0, j0] = [entry.u.checked_mul(layout.width), entry.v.checked_mul(layout.height)];
        let (Some(i0), Some(j0)) = (i0, j0) else { return Err(in_manifest("a tile lies beyond the floor")) };
        let area = Area { i0, j0, width: width as usize, height: height as usize };
        read_area(&bake.join(&entry.sums), &mut sums, &TILE_QUANTITIES, area)?;
    }
    let presence = sums.presence_grid();
    if [presence.width, presence.height] != [floor.sums.presence.width_px, floor.sums.presence.height_px] {
        return Err(in_manifest("`floor.sums.presence` has another size than follows from the floor's"));
    }
    let area = Area { i0: 0, j0: 0, width: presence.width as usize, height: presence.height as usize };
    read_area(&bake.join(&floor.sums.presence.file), &mut sums, &[Quantity::Presence], area)?;
    Ok(sums)
}

/// Tiles that are unpacked at a time.
const BATCH: usize = 64;

fn read_area(path: &Path, sums: &mut FloorSums, quantities: &[Quantity], area: Area) -> Result<(), ExportError> {
    let damaged = |error: exr::error::Error| match error {
        exr::error::Error::Io(source) => ExportError::Read { path: path.to_path_buf(), source },
        other => ExportError::damaged(path, other),
    };
    let file = File::open(path).map_err(ExportError::read(path))?;
    let reader = exr::block::read(BufReader::with_capacity(1 << 16, file), false).map_err(damaged)?;
    check_header(path, reader.headers(), quantities, area)?;
    let mut chunks = reader.all_chunks(false).map_err(damaged)?;
    let meta = exr::block::reader::ChunksReader::meta_data(&chunks).clone();
    let blank = zeros(quantities.len(), [BLOCK, BLOCK]);
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
        for Block { left, top, width, height, channels } in blocks.into_iter().flatten() {
            let ([i0, j0], size) = area.block(left, top);
            if size != [width, height] {
                return Err(ExportError::damaged(path, "its tiles are not of the usual size"));
            }
            for (&quantity, values) in quantities.iter().zip(channels) {
                sums.add_block(quantity, i0, j0, width, height, &values);
            }
        }
    }
}

fn check_header(
    path: &Path,
    headers: &[exr::meta::header::Header],
    quantities: &[Quantity],
    area: Area,
) -> Result<(), ExportError> {
    let [header] = headers else { return Err(ExportError::damaged(path, "it has more than one part")) };
    let size = header.layer_size;
    if [size.0, size.1] != [area.width, area.height] {
        let problem = format!("it is {} x {} px, not {} x {}", size.0, size.1, area.width, area.height);
        return Err(ExportError::damaged(path, problem));
    }
    let channels = &header.channels.list;
    let fits = channels.len() == quantities.len()
        && channels.iter().zip(quantities).all(|(channel, quantity)| {
            channel.sample_type == exr::prelude::SampleType::U32 && channel.name.to_string() == quantity.name()
        });
    if !fits {
        let names: Vec<&str> = quantities.iter().map(|quantity| quantity.name()).collect();
        return Err(ExportError::damaged(path, format!("its channels are not {} in whole numbers", names.join(", "))));
    }
    Ok(())
}

/// A tile that was read, row 0 lowest.
struct Block {
    left: usize,
    top: usize,
    width: usize,
    height: usize,
    channels: Vec<Vec<u32>>,
}

/// Unpacks a tile; `None` if it is `blank`, which most are.
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
    Ok(Some(Block { left: position.0, top: position.1, width: size.0, height: size.1, channels }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::preview::Birdseye;
    use crate::math::SplitMix64;
    use crate::progress::Silent;

    /// Sums with noise, zeros and the largest value.
    fn some_sums(grid: TexelGrid) -> FloorSums {
        let mut sums = FloorSums::new(grid);
        for quantity in Quantity::ALL {
            let cells = sums.grid_of(quantity);
            let mut random = SplitMix64::new(quantity as u64);
            let (width, height) = (cells.width as usize / 2, cells.height as usize / 3);
            let values: Vec<u32> = (0..width * height)
                .map(|k| match k % width / 40 {
                    0 => random.next_u64() as u32 >> 20,
                    1 => 0,
                    2 => u32::MAX - (k as u32 & 1),
                    _ => k as u32,
                })
                .collect();
            sums.add_block(quantity, cells.width / 4, cells.height / 5, width, height, &values);
        }
        sums
    }

    fn written(folder: &OutputFolder, sums: &FloorSums, tile: u32) -> crate::export::FloorEntry {
        let grid = sums.grid();
        let layout = TileLayout::new(grid, tile).unwrap();
        let name = |tile: &Tile, kind: &str| format!("floor/{}", layout.file_name(tile, kind, "png"));
        let tiles = layout
            .tiles()
            .map(|tile| TileEntry {
                u: tile.u,
                v: tile.v,
                udim: None,
                min_m: layout.place_m(&tile).min,
                max_m: layout.place_m(&tile).max,
                basecolor: name(&tile, "basecolor"),
                mask: name(&tile, "mask"),
                orm: name(&tile, "orm"),
                layers: None,
                sums: name(&tile, "sums"),
            })
            .collect();
        let birdseye = Birdseye::new(grid);
        let textures =
            FloorTextures { layout, tiles, layers: Vec::new(), birdseye, look_busy_s: 0.0, export_busy_s: 0.0 };
        let entry = write_sums(folder, sums, &textures, &Silent).unwrap();
        textures.entry(entry)
    }

    #[test]
    fn sums_come_back_to_the_bit_whatever_the_tiles() {
        let sums = some_sums(TexelGrid { texels_per_metre: 100.0, width: 700, height: 900 });
        let dir = tempfile::tempdir().unwrap();
        for tile in [256, 500, 1024] {
            let folder = OutputFolder::begin(&dir.path().join("out"), false).unwrap();
            let manifest = Manifest { floor: written(&folder, &sums, tile), ..Manifest::default() };
            let back = read_sums(folder.path(), &manifest).unwrap();
            for quantity in Quantity::ALL {
                let grid = sums.grid_of(quantity);
                let (width, height) = (grid.width as usize, grid.height as usize);
                let (mut before, mut after) = (vec![0; width * height], vec![0; width * height]);
                sums.read(quantity, 0, 0, width, height, &mut before);
                back.read(quantity, 0, 0, width, height, &mut after);
                assert!(before.contains(&u32::MAX));
                assert_eq!(before, after, "{} with tiles of {tile}", quantity.name());
            }
        }
    }

    #[test]
    fn a_damaged_file_is_an_error_that_names_it() {
        let sums = some_sums(TexelGrid { texels_per_metre: 100.0, width: 300, height: 300 });
        let dir = tempfile::tempdir().unwrap();
        let folder = OutputFolder::begin(&dir.path().join("out"), false).unwrap();
        let manifest = Manifest { floor: written(&folder, &sums, 512), ..Manifest::default() };
        let path = folder.path().join(&manifest.floor.tiles[0].sums);
        let whole = std::fs::read(&path).unwrap();
        let mut bent = whole.clone();
        for at in (400..whole.len()).step_by(97) {
            bent[at] ^= 0x55;
        }
        for bytes in [&whole[..whole.len() / 2], &whole[..20], &[], &bent] {
            std::fs::write(&path, bytes).unwrap();
            let error = read_sums(folder.path(), &manifest).map(|_| ()).unwrap_err();
            assert!(error.to_string().contains("floor_sums.1001.png"), "{error}");
        }
        std::fs::remove_file(&path).unwrap();
        assert!(matches!(read_sums(folder.path(), &manifest), Err(ExportError::Read { .. })));
    }
}
