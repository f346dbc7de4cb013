use std::collections::BTreeMap;
use std::path::Path;

use super::*;
use crate::export::{Atlas, Manifest, SheetEntry, WallSource, WallsEntry};
use crate::look::{Background, Layer, ResolvedBlock};
use crate::plan::FloorPlan;
use crate::progress::Silent;
use crate::stamps::WallGrid;
use crate::walls::{Corner, Walls, WallsOptions};

const LAYERS: [&str; 5] = ["shoe", "arm", "hand", "bag", "splash"];
const BACKGROUND: Background = Background { base_color: [1, 2, 3], mask: [4, 5, 6, 7], orm: [255, 9, 0] };

/// Walls whose texels encode face, column and row; some faces are clean.
struct Told<'a>(&'a WallGrid);

impl Told<'_> {
    /// Returns the face, column and row that a texel shows, `None` for a clean one.
    fn texel(&self, face: usize, i: i64, j: i64) -> Option<[u32; 3]> {
        let span = self.0.faces[face];
        let width = i64::from(span.width);
        let i = if span.closed { i.rem_euclid(width) } else { i.clamp(0, width - 1) };
        let j = j.clamp(0, i64::from(self.0.height) - 1);
        (face % 3 != 2).then_some([face as u32, i as u32, j as u32])
    }
}

fn base_color([face, i, j]: [u32; 3]) -> [u8; 3] {
    [100 + face as u8, i as u8, j as u8]
}

fn mask([face, i, j]: [u32; 3]) -> [u8; 4] {
    [face as u8, (i >> 8) as u8, i as u8, j as u8]
}

fn orm([_, i, j]: [u32; 3]) -> [u8; 3] {
    [200, (i + j) as u8, 17]
}

impl WallSource for Told<'_> {
    fn layers(&self) -> &[&'static str] {
        &LAYERS
    }

    fn background(&self) -> Background {
        BACKGROUND
    }

    fn resolve_into(&self, face: usize, i0: i64, j0: i64, width: usize, height: usize, block: &mut ResolvedBlock) {
        let texels = (0..width * height).map(|k| self.texel(face, i0 + (k % width) as i64, j0 + (k / width) as i64));
        let texels: Option<Vec<[u32; 3]>> = texels.collect();
        let Some(texels) = texels else {
            *block = ResolvedBlock { relief: Vec::new(), empty: true, ..ResolvedBlock::default() };
            return;
        };
        let layer = |(k, &name): (usize, &&'static str)| {
            let value = |&[face, i, j]: &[u32; 3]| (k as u32 * 1000 + face * 100 + i % 10 * 10 + j % 10) as f32;
            Layer { name, values: texels.iter().map(value).collect() }
        };
        *block = ResolvedBlock {
            empty: false,
            base_color: texels.iter().map(|&t| base_color(t)).collect(),
            clean: Vec::new(),
            fine: Vec::new(),
            relief: vec![[0, 0, 0, 100, 200, 230]; texels.len()],
            mask: texels.iter().map(|&t| mask(t)).collect(),
            orm: texels.iter().map(|&t| orm(t)).collect(),
            layers: LAYERS.iter().enumerate().map(layer).collect(),
        };
    }
}

/// A room of 7 x 5 m with four pillars of different sizes.
fn walls() -> Walls {
    let pillar = |x: u32, y: u32| (10..60).contains(&x) && (10..40).contains(&y) && x % 12 < 1 + x / 12 && y % 20 < 9;
    let wall = |x: u32, y: u32| x < 2 || y < 2 || x >= 68 || y >= 48 || pillar(x, y);
    let mask = (0..50u32).flat_map(|y| (0..70u32).map(move |x| u8::from(!wall(x, y)))).collect();
    Walls::trace(&FloorPlan::from_mask(70, 50, 0.1, mask), &WallsOptions::default())
}

/// Returns every vertex as a corner.
fn corners(walls: &Walls) -> Vec<Corner> {
    let mut corners = Vec::new();
    for (face, wall) in walls.faces.iter().enumerate() {
        let mut along_m = 0.0;
        for pair in wall.points_m.windows(2) {
            along_m += pair[0].distance(pair[1]);
            corners.push(Corner { face, along_m, point_m: pair[1], turn_rad: 1.5 });
        }
    }
    corners
}

struct Baked {
    out: tempfile::TempDir,
    entry: WallsEntry,
    textures: WallTextures,
    grid: WallGrid,
}

fn bake(texels_per_metre: f64, options: &TextureOptions) -> Baked {
    let out = tempfile::tempdir().unwrap();
    let walls = walls();
    let grid = WallGrid::covering(&walls, 2.2, texels_per_metre).unwrap();
    let atlas = Atlas::pack(&grid, &corners(&walls), options.tile, 16).unwrap();
    let folder = OutputFolder::begin(&out.path().join("out"), false).unwrap();
    let textures = wall_textures(&folder, &atlas, &Told(&grid), options, &Silent).unwrap();
    let manifest = Manifest {
        target: crate::export::TargetEntry::of(options.target),
        walls: Some(textures.entry(&walls, 1000)),
        ..Manifest::blank([50.0, 50.0])
    };
    folder.publish(&manifest).unwrap();
    let read = Manifest::read(&out.path().join("out")).unwrap();
    assert!(crate::export::output::is_bake(&out.path().join("out")).unwrap());
    assert_eq!(read.walls, manifest.walls);
    Baked { out, entry: read.walls.unwrap(), textures, grid }
}

impl Baked {
    fn path(&self, file: &str) -> std::path::PathBuf {
        self.out.path().join("out").join(file)
    }
}

fn options(tile: u32) -> TextureOptions {
    TextureOptions { tile, ..TextureOptions::default() }
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries
        .map(|path| (path.file_name().unwrap().to_str().unwrap().to_string(), std::fs::read(path).unwrap()))
        .collect()
}

/// Reads the four masks of a sheet.
fn masks(baked: &Baked, sheet: &SheetEntry) -> image::RgbaImage {
    let packed = image::open(baked.path(&sheet.mask)).unwrap().to_rgb8();
    let splash = image::open(baked.path(&sheet.splash)).unwrap().to_luma8();
    image::RgbaImage::from_fn(packed.width(), packed.height(), |x, y| {
        let [skin, rub, scuff] = packed.get_pixel(x, y).0;
        image::Rgba([skin, rub, scuff, splash.get_pixel(x, y).0[0]])
    })
}

#[test]
fn every_texel_of_every_face_lies_where_the_manifest_says_and_padding_goes_on() {
    // A strip is 252 texels high: two rows leave space for turned strips in 700.
    for tile in [1024, 512, 700] {
        let baked = bake(100.0, &options(tile));
        let told = Told(&baked.grid);
        let mut turned = 0;
        for sheet in &baked.entry.sheets {
            let image = masks(&baked, sheet);
            let normals = image::open(baked.path(&sheet.normal)).unwrap().to_rgb8();
            assert_eq!(image.dimensions(), (sheet.width_px, sheet.height_px));
            for strip in &sheet.strips {
                turned += usize::from(strip.turned);
                let [left, top, width, height] = strip.rect_px.map(i64::from);
                for y in top - 16..top + height + 16 {
                    for x in left - 16..left + width + 16 {
                        let (i, j) = match strip.turned {
                            false => (x - left, top + height - 1 - y),
                            true => (top + height - 1 - y, left + width - 1 - x),
                        };
                        let shown = told.texel(strip.face, i64::from(strip.first_column) + i, j);
                        let found = image.get_pixel(x as u32, y as u32).0;
                        assert_eq!(found, shown.map_or(BACKGROUND.mask, mask), "{strip:?} at {x}, {y}");
                        // Up the wall is to the left in a turned strip.
                        let normal = if strip.turned { [56, 100, 230] } else { [100, 200, 230] };
                        let found = normals.get_pixel(x as u32, y as u32).0;
                        assert_eq!(found, shown.map_or([128, 128, 255], |_| normal), "{strip:?} at {x}, {y}");
                    }
                }
            }
        }
        assert_eq!(baked.entry.atlas(), baked.textures.atlas);
        assert_eq!(turned > 0, tile == 700, "{turned} turned in sheets of {tile}");
    }
}

#[test]
fn strips_say_where_they_lie_in_the_plan() {
    let baked = bake(100.0, &options(512));
    let walls = walls();
    let strips: Vec<_> = baked.entry.sheets.iter().flat_map(|sheet| &sheet.strips).collect();
    assert!(strips.len() > walls.faces.len(), "some are broken");
    for strip in strips {
        let length_m: f64 = strip.points_m.windows(2).map(|p| p[0].distance(p[1])).sum();
        assert!((length_m - (strip.to_m - strip.from_m)).abs() < 1e-9, "{strip:?}");
        for point in &strip.points_m {
            assert!(walls.nearest(*point, 1.0).unwrap().distance_m < 1e-9);
        }
        assert!(strip.points_m.windows(2).all(|p| p[0].distance(p[1]) > 1e-6), "{strip:?}");
        let whole = strip.from_m == 0.0 && strip.to_m == baked.grid.faces[strip.face].length_m;
        if whole && walls.faces[strip.face].closed {
            assert_eq!(strip.points_m.len(), walls.faces[strip.face].points_m.len() + 1);
        }
        assert!(strip.uv.iter().flatten().all(|uv| (0.0..=1.0).contains(uv)));
    }
}

#[test]
fn layers_are_named_by_cause_or_by_colour_and_hold_the_same() {
    use exr::prelude::*;
    let read = |baked: &Baked, file: &str| {
        let image = read_first_flat_layer_from_file(baked.path(file)).unwrap();
        let list = image.layer_data.channel_data.list;
        let channel = |c: &AnyChannel<FlatSamples>| {
            (c.name.to_string(), c.sample_data.values_as_f32().collect::<std::vec::Vec<f32>>())
        };
        list.iter().map(channel).collect::<BTreeMap<_, _>>()
    };
    let named = bake(100.0, &options(1024));
    assert_eq!(named.entry.sheets[0].layers, ["walls/wall_layers.1001.exr"]);
    let by_cause = read(&named, &named.entry.sheets[0].layers[0]);
    assert_eq!(
        by_cause.keys().map(String::as_str).collect::<std::vec::Vec<_>>(),
        ["arm.V", "bag.V", "hand.V", "shoe.V", "splash.V"]
    );
    for target in [Target::Unreal, Target::Unity, Target::Godot] {
        let engine = bake(100.0, &TextureOptions { target, layers: Some(true), ..options(1024) });
        let files = &engine.entry.sheets[0].layers;
        assert_eq!(files.len(), 2, "five layers");
        let (first, second) = (read(&engine, &files[0]), read(&engine, &files[1]));
        assert_eq!(first.keys().map(String::as_str).collect::<std::vec::Vec<_>>(), ["A", "B", "G", "R"]);
        assert_eq!(second.keys().map(String::as_str).collect::<std::vec::Vec<_>>(), ["B", "G", "R"]);
        for (name, layer) in ["R", "G", "B", "A"].into_iter().zip(LAYERS) {
            assert!(first[name] == by_cause[&format!("{layer}.V")], "{layer}");
        }
        assert!(second["R"] == by_cause["splash.V"] && second["G"].iter().all(|&value| value == 0.0));
        let holds = |image: &str, channel: &str| {
            let found = engine.entry.channels.iter().find(|c| c.image == image && c.channel == channel).unwrap();
            found.holds.clone()
        };
        assert_eq!(holds("layers1", "B"), "hand: optical density D");
        assert_eq!(holds("layers2", "B"), "nothing");
    }
}

#[test]
fn unity_gets_its_mask_map_too() {
    let baked = bake(100.0, &TextureOptions { target: Target::Unity, ..options(1024) });
    let sheet = &baked.entry.sheets[0];
    let orm = image::open(baked.path(&sheet.orm)).unwrap().to_rgba8();
    let map = image::open(baked.path(sheet.mask_map.as_ref().unwrap())).unwrap();
    assert_eq!(map.color(), image::ColorType::Rgba8);
    for (orm, map) in orm.pixels().zip(map.to_rgba8().pixels()) {
        let [occlusion, roughness, metallic, _] = orm.0;
        assert_eq!(map.0, [metallic, occlusion, 255, 255 - roughness]);
    }
}

#[test]
fn the_same_bytes_on_any_number_of_threads_with_small_images_too() {
    let baked = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let options = TextureOptions { reduced_px: Some(100), ..options(512) };
        let baked = pool.install(|| bake(100.0, &options));
        (files(&baked.path("walls")), baked.textures.reduced)
    };
    let one = baked(1);
    assert_eq!(one.0.len(), 7 * one.1.len());
    assert!(one.1.len() > 1);
    for (reduced, sheet) in one.1.iter().zip(&bake(100.0, &options(512)).textures.atlas.sheets) {
        assert_eq!(reduced.factor, (sheet.width.max(sheet.height) / 64).max(1));
        assert_eq!(reduced.dirt.dimensions(), (sheet.width / reduced.factor, sheet.height / reduced.factor));
    }
    for threads in [2, 16] {
        let other = baked(threads);
        for (name, bytes) in &one.0 {
            assert!(other.0[name] == *bytes, "{name} on {threads} threads");
        }
        assert!(other.1 == one.1);
    }
}

#[test]
fn small_images_are_the_files_made_smaller() {
    let baked = bake(100.0, &TextureOptions { reduced_px: Some(256), ..options(1000) });
    let sheet = &baked.entry.sheets[0];
    let (reduced, full) = (&baked.textures.reduced[0], image::open(baked.path(&sheet.orm)).unwrap().to_rgb8());
    assert_eq!((reduced.factor, reduced.orm.width()), (4, 250));
    for (x, y, pixel) in reduced.orm.enumerate_pixels() {
        let mut sums = [0u32; 3];
        for (dx, dy) in (0..16).map(|k| (k % 4, k / 4)) {
            let texel = full.get_pixel(4 * x + dx, 4 * y + dy).0;
            sums = std::array::from_fn(|k| sums[k] + u32::from(texel[k]));
        }
        assert_eq!(pixel.0, sums.map(|sum| ((sum + 8) / 16) as u8), "{x}, {y}");
    }
}

#[test]
fn a_sheet_that_is_all_clean_has_files_all_the_same() {
    struct Clean;
    impl WallSource for Clean {
        fn layers(&self) -> &[&'static str] {
            &LAYERS
        }
        fn background(&self) -> Background {
            BACKGROUND
        }
        fn resolve_into(&self, _: usize, _: i64, _: i64, _: usize, _: usize, block: &mut ResolvedBlock) {
            *block = ResolvedBlock { empty: true, ..ResolvedBlock::default() };
        }
    }
    let (dir, walls) = (tempfile::tempdir().unwrap(), walls());
    let grid = WallGrid::covering(&walls, 2.2, 100.0).unwrap();
    let atlas = Atlas::pack(&grid, &[], 2048, 16).unwrap();
    let folder = OutputFolder::begin(&dir.path().join("out"), false).unwrap();
    let written = wall_textures(&folder, &atlas, &Clean, &options(2048), &Silent).unwrap();
    let image = image::open(folder.path().join(&written.sheets[0].basecolor)).unwrap().to_rgb8();
    assert!(image.pixels().all(|pixel| pixel.0 == BACKGROUND.base_color));
}

#[test]
fn a_size_that_the_target_does_not_take_is_an_error_that_says_what_it_takes() {
    let (dir, walls) = (tempfile::tempdir().unwrap(), walls());
    let grid = WallGrid::covering(&walls, 2.2, 100.0).unwrap();
    let atlas = Atlas::pack(&grid, &[], 16_384, 16).unwrap();
    let folder = OutputFolder::begin(&dir.path().join("out"), false).unwrap();
    let options = TextureOptions { target: Target::Unreal, ..options(16_384) };
    let error = wall_textures(&folder, &atlas, &Told(&grid), &options, &Silent).unwrap_err();
    assert!(error.to_string().contains("unreal takes textures of at most 8192 px"), "{error}");
    assert!(error.hint().unwrap().contains("texture.tile"));
}
