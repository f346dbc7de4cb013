use std::path::Path;

use super::file::{SumsImage, read_image, write_image};
use crate::export::bake_path::{BakePath, MANIFEST_NAME};
use crate::export::layout::{Tile, TileLayout};
use crate::export::manifest::{Manifest, PresenceEntry, SumsEntry, TileEntry};
use crate::export::{ExportError, FloorTextures, OutputFolder};
use crate::progress::Progress;
use crate::stamps::TexelGrid;
use crate::sums::{FloorSums, Quantity};

/// Quantities in a tile's file, sorted by name.
const TILE_QUANTITIES: [Quantity; 5] =
    [Quantity::Passes, Quantity::Scuff, Quantity::Soil, Quantity::Wet, Quantity::Wheels];
/// Quantities in the file of `presence`, sorted by name.
const COARSE_QUANTITIES: [Quantity; 3] = [Quantity::Dwell, Quantity::Grind, Quantity::Presence];
/// Quantities that bakes of earlier versions lack.
const LATER_QUANTITIES: [Quantity; 4] = [Quantity::Dwell, Quantity::Grind, Quantity::Wet, Quantity::Wheels];
const PRESENCE_FILE: &str = "sums/floor_presence.exr";

/// Writes the exact sums into `sums/`: a file per written tile, and one for `presence` and the other coarse quantities.
///
/// Integers, one channel per quantity. Untouched blocks take almost no space.
///
/// # Errors
/// A file cannot be written; an interruption.
pub fn write_sums(
    folder: &OutputFolder,
    sums: &FloorSums,
    textures: &FloorTextures,
    progress: &dyn Progress,
) -> Result<SumsEntry, ExportError> {
    for (tile, entry) in textures.layout.tiles().filter_map(|tile| Some((tile, entry_of(&tile, &textures.tiles)?))) {
        let area = Area { at: [tile.i0, tile.j0], size: [tile.width, tile.height], quantities: &TILE_QUANTITIES };
        write_image(folder.create(&entry.sums)?, &FloorImage { sums, area }, progress)?;
    }
    let TexelGrid { texels_per_metre, width, height } = sums.presence_grid();
    let area = Area { at: [0, 0], size: [width, height], quantities: &COARSE_QUANTITIES };
    write_image(folder.create(PRESENCE_FILE)?, &FloorImage { sums, area }, progress)?;
    Ok(SumsEntry {
        one: Quantity::ALL.iter().map(|quantity| (quantity.name().to_string(), quantity.one())).collect(),
        presence: PresenceEntry {
            file: BakePath::new(PRESENCE_FILE)?,
            texels_per_metre,
            width_px: width,
            height_px: height,
        },
    })
}

fn entry_of<'a>(tile: &Tile, entries: &'a [TileEntry]) -> Option<&'a TileEntry> {
    entries.iter().find(|entry| (entry.u, entry.v) == (tile.u, tile.v))
}

/// A rectangle of a grid, stored as one image.
#[derive(Clone, Copy, Debug)]
struct Area<'a> {
    /// Lower-left cell.
    at: [u32; 2],
    size: [u32; 2],
    quantities: &'a [Quantity],
}

impl Area<'_> {
    /// Returns the grid's cell for a cell of the image, counted from the lower left.
    fn cell(&self, [i, j]: [u32; 2]) -> [u32; 2] {
        [self.at[0] + i, self.at[1] + j]
    }

    fn channels(&self) -> Vec<&'static str> {
        self.quantities.iter().map(|quantity| quantity.name()).collect()
    }
}

/// A rectangle of a floor's sums as an image.
struct FloorImage<'a> {
    sums: &'a FloorSums,
    area: Area<'a>,
}

impl SumsImage for FloorImage<'_> {
    fn size(&self) -> [u32; 2] {
        self.area.size
    }

    fn channels(&self) -> Vec<&'static str> {
        self.area.channels()
    }

    fn touched(&self, at: [u32; 2], [width, height]: [usize; 2]) -> bool {
        let [i0, j0] = self.area.cell(at);
        self.area.quantities.iter().any(|&quantity| self.sums.touched(quantity, i0, j0, width, height))
    }

    fn read(&self, channel: usize, at: [u32; 2], [width, height]: [usize; 2], out: &mut [u32]) {
        let [i0, j0] = self.area.cell(at);
        self.sums.read(self.area.quantities[channel], i0, j0, width, height, out);
    }
}

/// Reads the exact sums of a bake that [`write_sums`] wrote.
///
/// # Errors
/// A file is missing, invalid or contradicts the manifest.
pub fn read_sums(bake: &Path, manifest: &Manifest) -> Result<FloorSums, ExportError> {
    let floor = &manifest.floor;
    let grid = TexelGrid { texels_per_metre: floor.texels_per_metre, width: floor.width_px, height: floor.height_px };
    let in_manifest = |problem: &str| ExportError::damaged(&bake.join(MANIFEST_NAME), problem);
    let is_here =
        |quantity: &Quantity| !LATER_QUANTITIES.contains(quantity) || floor.sums.one.contains_key(quantity.name());
    for quantity in Quantity::ALL.into_iter().filter(is_here) {
        if floor.sums.one.get(quantity.name()) != Some(&quantity.one()) {
            return Err(in_manifest(&format!("`floor.sums.one.{}` is not {}", quantity.name(), quantity.one())));
        }
    }
    let density = grid.texels_per_metre;
    if !(1.0..=1000.0).contains(&density) {
        return Err(in_manifest(&format!("`floor.texels_per_metre` is {density}, allowed is 1 to 1000")));
    }
    let mut sums = FloorSums::new(grid);
    let [width, height] = floor.tile_px;
    let layout = TileLayout { grid, width, height };
    if width == 0 || height == 0 {
        return Err(in_manifest("`floor.tile_px` is zero"));
    }
    let [of_tiles, coarse] =
        [&TILE_QUANTITIES[..], &COARSE_QUANTITIES].map(|all| all.iter().copied().filter(is_here).collect::<Vec<_>>());
    for entry in &floor.tiles {
        let [i0, j0] = [entry.u.checked_mul(layout.width), entry.v.checked_mul(layout.height)];
        let (Some(i0), Some(j0)) = (i0, j0) else { return Err(in_manifest("a tile lies beyond the floor")) };
        let area = Area { at: [i0, j0], size: [width, height], quantities: &of_tiles };
        read_area(&entry.sums.within(bake)?, &mut sums, area)?;
    }
    let presence = sums.presence_grid();
    if [presence.width, presence.height] != [floor.sums.presence.width_px, floor.sums.presence.height_px] {
        return Err(in_manifest("`floor.sums.presence` has another size than follows from the floor's"));
    }
    let area = Area { at: [0, 0], size: [presence.width, presence.height], quantities: &coarse };
    read_area(&floor.sums.presence.file.within(bake)?, &mut sums, area)?;
    Ok(sums)
}

fn read_area(path: &Path, sums: &mut FloorSums, area: Area<'_>) -> Result<(), ExportError> {
    read_image(path, area.size, &area.channels(), |channel, at, [width, height], values| {
        let [i0, j0] = area.cell(at);
        sums.add_block(area.quantities[channel], i0, j0, width, height, values);
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::Birdseye;
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
                sums: BakePath::new(name(&tile, "sums")).unwrap(),
                ..TileEntry::default()
            })
            .collect();
        let birdseye = Birdseye::new(grid);
        let textures = FloorTextures {
            layout,
            tiles,
            target: crate::export::Target::Gltf,
            bits: 8,
            dirt: false,
            layers: Vec::new(),
            reduced: Vec::new(),
            birdseye,
            look_busy_s: 0.0,
            export_busy_s: 0.0,
        };
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
    fn sums_of_earlier_versions_lack_later_quantities() {
        let sums = some_sums(TexelGrid { texels_per_metre: 100.0, width: 300, height: 300 });
        let dir = tempfile::tempdir().unwrap();
        let folder = OutputFolder::begin(&dir.path().join("out"), false).unwrap();
        let mut manifest = Manifest { floor: written(&folder, &sums, 512), ..Manifest::default() };
        let one = &mut manifest.floor.sums.one;
        assert!(LATER_QUANTITIES.iter().all(|quantity| one.remove(quantity.name()).is_some()));
        assert!(read_sums(folder.path(), &manifest).is_err(), "it has channels that the manifest does not name");
        let file = manifest.floor.tiles[0].sums.within(folder.path()).unwrap();
        let area = Area { at: [0, 0], size: manifest.floor.tile_px, quantities: &TILE_QUANTITIES[..3] };
        std::fs::remove_file(&file).unwrap();
        write_image(folder.create(&manifest.floor.tiles[0].sums).unwrap(), &FloorImage { sums: &sums, area }, &Silent)
            .unwrap();
        let TexelGrid { width, height, .. } = sums.presence_grid();
        let area = Area { at: [0, 0], size: [width, height], quantities: &[Quantity::Presence] };
        std::fs::remove_file(folder.path().join(PRESENCE_FILE)).unwrap();
        write_image(folder.create(PRESENCE_FILE).unwrap(), &FloorImage { sums: &sums, area }, &Silent).unwrap();
        let back = read_sums(folder.path(), &manifest).unwrap();
        assert!(!back.blocks(Quantity::Presence).is_empty());
        assert!(LATER_QUANTITIES.iter().all(|&quantity| back.blocks(quantity).is_empty()));
        assert!(!back.blocks(Quantity::Soil).is_empty());
    }

    #[test]
    fn a_damaged_file_is_an_error_that_names_it() {
        let sums = some_sums(TexelGrid { texels_per_metre: 100.0, width: 300, height: 300 });
        let dir = tempfile::tempdir().unwrap();
        let folder = OutputFolder::begin(&dir.path().join("out"), false).unwrap();
        let manifest = Manifest { floor: written(&folder, &sums, 512), ..Manifest::default() };
        let path = folder.path().join(&manifest.floor.tiles[0].sums);
        super::super::file::assert_damage_is_named(&path, || read_sums(folder.path(), &manifest).map(|_| ()));
    }
}
