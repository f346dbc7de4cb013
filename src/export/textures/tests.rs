use std::collections::BTreeMap;
use std::path::Path;

use super::*;
use crate::Stage;
use crate::look::{Background, Layer, ResolvedBlock};
use crate::math::SplitMix64;
use crate::progress::Silent;

/// A floor in the shape of a disc; each texel's value is a pure function of its place.
struct Disc {
    centre: [i64; 2],
    radius: i64,
}

impl Disc {
    fn texel(&self, i: i64, j: i64) -> Option<u64> {
        let [x, y] = [i - self.centre[0], j - self.centre[1]];
        (x * x + y * y < self.radius * self.radius).then(|| SplitMix64::new((i * 1_000_003 + j) as u64).next_u64() >> 3)
    }
}

impl TextureSource for Disc {
    fn layers(&self) -> &[&'static str] {
        &["scuff", "film"]
    }

    fn background(&self) -> Background {
        Background { base_color: [10, 20, 30], mask: [10, 20, 30, 40], orm: [40, 30, 0] }
    }

    fn resolve(&self, i0: i64, j0: i64, width: usize, height: usize) -> ResolvedBlock {
        let texels: Vec<Option<u64>> =
            (0..width * height).map(|k| self.texel(i0 + (k % width) as i64, j0 + (k / width) as i64)).collect();
        if texels.iter().all(Option::is_none) {
            return ResolvedBlock { empty: true, ..ResolvedBlock::default() };
        }
        let bytes = |v: &Option<u64>| v.map_or([10, 20, 30, 40], |v| (v as u32 & 0x0f1f_ff07).to_le_bytes());
        let mask: Vec<[u8; 4]> = texels.iter().map(bytes).collect();
        let film = texels.iter().map(|v| v.map_or(0.0, |v| (v % 2048) as f32)).collect();
        ResolvedBlock {
            relief: Vec::new(),
            fine: Vec::new(),
            empty: false,
            base_color: mask.iter().map(|m| [m[0], m[1], m[2]]).collect(),
            clean: Vec::new(),
            orm: mask.iter().map(|m| [m[3], m[2], 0]).collect(),
            mask,
            layers: vec![
                Layer { name: "scuff", values: vec![0.0; width * height] },
                Layer { name: "film", values: film },
            ],
        }
    }
}

fn bake(out: &Path, source: &Disc, grid: TexelGrid, tile: u32) -> FloorTextures {
    let folder = OutputFolder::begin(out, false).unwrap();
    let options = TextureOptions { tile, ..TextureOptions::default() };
    let written = floor_textures(&folder, grid, source, &options, &Silent).unwrap();
    let copied: Vec<(String, Vec<u8>)> = std::fs::read_dir(folder.path().join("floor"))
        .unwrap()
        .map(|entry| entry.unwrap())
        .map(|e| (e.file_name().into_string().unwrap(), std::fs::read(e.path()).unwrap()))
        .collect();
    drop(folder);
    std::fs::create_dir_all(out).unwrap();
    for (name, bytes) in copied {
        std::fs::write(out.join(name), bytes).unwrap();
    }
    written
}

fn grid(width: u32, height: u32) -> TexelGrid {
    TexelGrid { texels_per_metre: 100.0, width, height }
}

/// Returns the texel (i, j) of the whole floor from the written images.
fn image_texel(out: &Path, written: &FloorTextures, kind: &str, i: u32, j: u32) -> Option<Vec<u8>> {
    let layout = &written.layout;
    let tile = layout.tiles().find(|t| (t.i0..t.i0 + t.width).contains(&i) && (t.j0..t.j0 + t.height).contains(&j))?;
    let path = out.join(layout.file_name(&tile, kind, "png"));
    let image = image::open(path).ok()?.to_rgb8();
    Some(image.get_pixel(i - tile.i0, tile.height - 1 - (j - tile.j0)).0.to_vec())
}

/// Returns the four masks of texel (i, j) of the whole floor.
fn masks(out: &Path, written: &FloorTextures, i: u32, j: u32) -> Option<[u8; 4]> {
    let packed = image_texel(out, written, "mask", i, j)?;
    let passes = image_texel(out, written, "passes", i, j)?;
    Some([packed[0], passes[0], packed[1], packed[2]])
}

#[test]
fn any_tile_size_gives_the_same_texels() {
    let dir = tempfile::tempdir().unwrap();
    let disc = Disc { centre: [300, 280], radius: 270 };
    for tile in [64, 300, 1024] {
        let out = dir.path().join(tile.to_string());
        let written = bake(&out, &disc, grid(610, 560), tile);
        for k in 0..200 {
            let (i, j) = (k * 37 % 610, k * 101 % 560);
            let block = disc.resolve(i64::from(i), i64::from(j), 1, 1);
            let value = block.mask.first().copied().unwrap_or([10, 20, 30, 40]);
            let found = masks(&out, &written, i, j);
            // Tiles without floor have no files.
            assert_eq!(found.unwrap_or([10, 20, 30, 40]), value, "({i}, {j}), tile {tile}");
        }
    }
}

#[test]
fn layers_hold_what_the_source_says_and_row_0_is_the_largest_y() {
    use exr::prelude::*;
    let dir = tempfile::tempdir().unwrap();
    let disc = Disc { centre: [100, 400], radius: 90 };
    bake(dir.path().join("out").as_path(), &disc, grid(300, 500), 512);
    let image = read_first_flat_layer_from_file(dir.path().join("out/floor_layers.1001.exr")).unwrap();
    let channel = &image.layer_data.channel_data.list[0];
    assert_eq!(channel.name.to_string(), "film.V");
    let values: Vec<f32> = channel.sample_data.values_as_f32().collect();
    let block = disc.resolve(0, 0, 512, 512);
    for (k, value) in values.into_iter().enumerate() {
        assert_eq!(value, block.layers[1].values[(511 - k / 512) * 512 + k % 512]);
    }
}

#[test]
fn tiles_without_floor_are_left_out_and_blank_bands_above_the_floor_are_not() {
    let dir = tempfile::tempdir().unwrap();
    // Floor only in the lower left corner of the lower left tile.
    let written = bake(&dir.path().join("out"), &Disc { centre: [0, 0], radius: 50 }, grid(2000, 2000), 1024);
    assert_eq!(written.tiles.len(), 1);
    let image = image::open(dir.path().join("out/floor_mask.1001.png")).unwrap().to_rgb8();
    assert_eq!(image.dimensions(), (1024, 1024));
    let floor = |(x, y): (u32, u32)| {
        let [i, j] = [i64::from(x), i64::from(1023 - y)];
        i * i + j * j < 2500
    };
    assert!(image.enumerate_pixels().all(|(x, y, p)| floor((x, y)) || p.0 == [10, 30, 40]));
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let dir = tempfile::tempdir().unwrap();
    let bytes = |threads: usize| {
        let out = dir.path().join(threads.to_string());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let written = pool.install(|| bake(&out, &Disc { centre: [400, 400], radius: 390 }, grid(900, 700), 512));
        let files: BTreeMap<_, _> = std::fs::read_dir(&out)
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .map(|path| (path.file_name().unwrap().to_owned(), std::fs::read(&path).unwrap()))
            .collect();
        assert_eq!(files.len(), written.tiles.len() * 7);
        (files, written.birdseye.picture([0; 3]))
    };
    let one = bytes(1);
    assert_eq!(one, bytes(2));
    assert_eq!(one, bytes(16));
}

#[test]
fn an_interruption_ends_it() {
    struct Stop;
    impl Progress for Stop {
        fn advance(&self, _: Stage, _: f64) {}
        fn warn(&self, _: &str) {}
        fn interrupted(&self) -> bool {
            true
        }
    }
    let dir = tempfile::tempdir().unwrap();
    let folder = OutputFolder::begin(&dir.path().join("out"), false).unwrap();
    let disc = Disc { centre: [0, 0], radius: 50 };
    let result = floor_textures(&folder, grid(100, 100), &disc, &TextureOptions::default(), &Stop);
    assert!(matches!(result, Err(ExportError::Interrupted(_))));
    drop(folder);
    assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 0);
}
