//! The export stage from outside: a plan with known sums becomes files that are whole, seamless and always the same.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use image::RgbImage;
use trodden::Silent;
use trodden::export::{
    ExportError, Manifest, OutputFolder, TextureOptions, TextureSource, TileEntry, floor_textures, read_sums,
    write_sums,
};
use trodden::look::{Background, FloorResolver, Look, ResolvedBlock};
use trodden::math::{SplitMix64, vec2};
use trodden::plan::FloorPlan;
use trodden::show::{self, Crop, PathSample};
use trodden::stamps::TexelGrid;
use trodden::sums::{FloorSums, Quantity};
use trodden::walls::{Walls, WallsOptions};

use super::golden::{EXACT, RESAMPLED, assert_golden};

const PEOPLE: u32 = 100;

/// 9 x 7 m: a corridor with a side room behind a door and a pillar.
fn plan() -> FloorPlan {
    let floor = |x: u32, y: u32| {
        let corridor = (40..65).contains(&y);
        let room = (5..35).contains(&y) && (20..70).contains(&x);
        let door = (35..40).contains(&y) && (40..50).contains(&x);
        let pillar = (50..54).contains(&y) && (60..64).contains(&x);
        (corridor || room || door) && !pillar
    };
    let mask = (0..70u32).flat_map(|y| (0..90u32).map(move |x| u8::from(floor(x, y)))).collect();
    FloorPlan::from_mask(90, 70, 0.1, mask)
}

fn walls() -> Walls {
    Walls::trace(&plan(), &WallsOptions::default())
}

/// Sums of a lane through the corridor with some noise, on floor only.
fn sums(walls: &Walls, texels_per_metre: f64) -> FloorSums {
    let mut sums = FloorSums::new(TexelGrid::covering(9.0, 7.0, texels_per_metre).unwrap());
    for quantity in [Quantity::Passes, Quantity::Presence, Quantity::Soil] {
        let grid = sums.grid_of(quantity);
        let (width, height) = (grid.width as usize, grid.height as usize);
        let mut share = vec![0.0; width * height];
        walls.coverage(grid.texels_per_metre, 0, 0, width, height, &mut share);
        let mut random = SplitMix64::new(quantity as u64);
        let value = |(k, &share): (usize, &f32)| {
            let p = grid.centre_m((k % width) as u32, (k / width) as u32);
            let lane = (1.0 - (p.y - 1.8).abs()).max(0.0) as f32 + 0.02;
            let noise = if quantity == Quantity::Presence { 1.0 } else { 2.0 * random.unit() };
            if share > 0.0 { (8.0 * lane * noise * quantity.one() as f32) as u32 } else { 0 }
        };
        let values: Vec<u32> = share.iter().enumerate().map(value).collect();
        sums.add_block(quantity, 0, 0, width, height, &values);
    }
    sums
}

/// Bakes the sums to a folder.
fn bake(out: &Path, walls: &Walls, sums: &FloorSums, tile: u32) -> Manifest {
    let folder = OutputFolder::begin(out, false).unwrap();
    let floor = FloorResolver::new(sums, walls, &Look::default(), PEOPLE).unwrap();
    let options = TextureOptions { tile, ..TextureOptions::default() };
    let textures = floor_textures(&folder, sums.grid(), &floor, &options, &Silent).unwrap();
    let written = write_sums(&folder, sums, &textures, &Silent).unwrap();
    let crops = [Crop { name: "narrow".to_string(), min_m: vec2(2.0, 2.0), max_m: vec2(8.0, 6.0) }];
    let preview = show::write_previews(&folder, &textures, &floor, walls, &crops).unwrap();
    let manifest = Manifest { floor: textures.entry(written), preview, ..Manifest::of_plan(&plan(), walls, &[]) };
    folder.publish(&manifest).unwrap();
    Manifest::read(out).unwrap()
}

/// Every file of a folder by its path in it.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(dir) = open.pop() {
        for entry in std::fs::read_dir(dir).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else {
                let bytes = std::fs::read(&path).unwrap();
                found.insert(path.strip_prefix(folder).unwrap().to_path_buf(), bytes);
            }
        }
    }
    found
}

/// The image of a kind of all tiles together, cut to the floor's grid.
fn whole(out: &Path, manifest: &Manifest, kind: fn(&TileEntry) -> &str) -> image::RgbaImage {
    let floor = &manifest.floor;
    let mut whole = image::RgbaImage::new(floor.width_px, floor.height_px);
    for tile in &floor.tiles {
        let image = image::open(out.join(kind(tile))).unwrap().to_rgba8();
        let [width, height] = floor.tile_px;
        assert_eq!(image.dimensions(), (width, height));
        let left = i64::from(tile.u * width);
        let top = i64::from(floor.height_px) - i64::from((tile.v + 1) * height);
        image::imageops::replace(&mut whole, &image, left, top);
    }
    whole
}

#[test]
fn the_manifest_lists_every_file_and_no_other() {
    let dir = tempfile::tempdir().unwrap();
    let (out, walls) = (dir.path().join("out"), walls());
    let manifest = bake(&out, &walls, &sums(&walls, 50.0), 256);
    let listed: Vec<PathBuf> = manifest.files.iter().map(PathBuf::from).collect();
    assert_eq!(listed, files(&out).into_keys().collect::<Vec<_>>());
    assert_eq!(manifest.floor.tiles.len(), 4);
    let tile = &manifest.floor.tiles[3];
    assert_eq!((tile.u, tile.v, tile.udim), (1, 1, Some(1012)));
    assert_eq!(tile.min_m, vec2(5.12, 5.12));
    assert_eq!(tile.basecolor, "floor/floor_basecolor.1012.png");
    let text = std::fs::read_to_string(out.join("manifest.json")).unwrap();
    assert!(!text.contains(dir.path().to_str().unwrap()), "absolute paths");
}

#[test]
fn any_tile_size_gives_the_same_texels_without_a_seam() {
    let dir = tempfile::tempdir().unwrap();
    let walls = walls();
    let sums = sums(&walls, 50.0);
    let bakes = [64, 100, 1024].map(|tile| {
        let out = dir.path().join(tile.to_string());
        let manifest = bake(&out, &walls, &sums, tile);
        (out, manifest)
    });
    let kinds: [fn(&TileEntry) -> &str; 4] = [|t| &t.basecolor, |t| &t.mask, |t| &t.passes, |t| &t.orm];
    for kind in kinds {
        let [a, b, c] = bakes.each_ref().map(|(out, manifest)| whole(out, manifest, kind));
        // Tiles without floor are left out: there, only the one large tile has texels.
        for (small, large) in [(&a, &c), (&b, &c)] {
            let differ = small.pixels().zip(large.pixels()).filter(|(s, l)| s.0 != l.0 && s.0 != [0; 4]).count();
            assert_eq!(differ, 0);
            assert!(small.pixels().filter(|p| p.0 != [0; 4]).count() > 100_000);
        }
    }
    let [a, b, c] = bakes.each_ref().map(|(out, _)| std::fs::read(out.join("preview/narrow.png")).unwrap());
    assert!(a == b && b == c);
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let dir = tempfile::tempdir().unwrap();
    let walls = walls();
    let baked = |threads: usize| {
        let out = dir.path().join(threads.to_string());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| bake(&out, &walls, &sums(&walls, 50.0), 256));
        files(&out)
    };
    let one = baked(1);
    assert_eq!(one.len(), 4 * 8 + 4);
    for threads in [2, 16] {
        for (name, bytes) in baked(threads) {
            assert!(one[&name] == bytes, "{} on {threads} threads", name.display());
        }
    }
}

#[test]
fn a_bake_can_be_resolved_again_from_its_files_alone() {
    let dir = tempfile::tempdir().unwrap();
    let (out, walls) = (dir.path().join("out"), walls());
    let sums = sums(&walls, 50.0);
    let manifest = bake(&out, &walls, &sums, 256);
    let again = read_sums(&out, &manifest).unwrap();
    bake(&dir.path().join("again"), &manifest.walls().unwrap(), &again, 256);
    let (first, second) = (files(&out), files(&dir.path().join("again")));
    for (name, bytes) in &first {
        assert!(second[name] == *bytes, "{}", name.display());
    }
}

#[test]
fn base_colour_says_that_it_is_srgb_and_the_others_say_nothing() {
    let dir = tempfile::tempdir().unwrap();
    let (out, walls) = (dir.path().join("out"), walls());
    bake(&out, &walls, &sums(&walls, 25.0), 256);
    for (kind, srgb, bytes) in [("basecolor", true, 3), ("mask", false, 3), ("passes", false, 1), ("orm", false, 3)] {
        let file = std::fs::File::open(out.join(format!("floor/floor_{kind}.1001.png"))).unwrap();
        let reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().unwrap();
        let info = reader.info();
        assert_eq!((info.srgb.is_some(), info.bytes_per_pixel()), (srgb, bytes), "{kind}");
        assert!(info.source_gamma.is_none() && info.icc_profile.is_none());
    }
}

/// A floor of coloured squares of 0.5 m, so that previews do not change with the look.
struct Squares;

impl TextureSource for Squares {
    fn layers(&self) -> &[&'static str] {
        &[]
    }

    fn background(&self) -> Background {
        Background { base_color: [255, 0, 255], mask: [0; 4], orm: [0; 3] }
    }

    fn resolve(&self, i0: i64, j0: i64, width: usize, height: usize) -> ResolvedBlock {
        let colour = |k: usize| {
            let (column, row) = ((i0 + (k % width) as i64).div_euclid(12), (j0 + (k / width) as i64).div_euclid(12));
            [200 - 5 * column as u8, 100 + 5 * row as u8, if (column + row) % 2 == 0 { 40 } else { 160 }]
        };
        let base_color: Vec<[u8; 3]> = (0..width * height).map(colour).collect();
        let (mask, orm) = (vec![[0; 4]; base_color.len()], vec![[0; 3]; base_color.len()]);
        ResolvedBlock { base_color, mask, orm, ..ResolvedBlock::default() }
    }
}

#[test]
fn previews_show_the_floor_where_it_lies_and_walls_dark() {
    let dir = tempfile::tempdir().unwrap();
    let walls = walls();
    let folder = OutputFolder::begin(&dir.path().join("out"), false).unwrap();
    let grid = TexelGrid::covering(9.0, 7.0, 24.0).unwrap();
    let options = TextureOptions { tile: 128, layers: Some(false), ..TextureOptions::default() };
    let textures = floor_textures(&folder, grid, &Squares, &options, &Silent).unwrap();
    let crop = Crop { name: "narrow".to_string(), min_m: vec2(2.0, 2.0), max_m: vec2(8.0, 6.0) };
    assert_golden("preview_floor", &show::render_floor(&textures.birdseye, &walls), EXACT);
    assert_golden("preview_crop", &show::render_crop(&Squares, &walls, grid, &crop), EXACT);
}

#[test]
fn drawings_look_as_they_should() {
    let (plan, walls) = (plan(), walls());
    let samples = |speed_m_s: f64, y: f64| {
        [0.5, 3.0, 6.0, 8.5].map(|x| PathSample { position_m: vec2(x, y + 0.1 * x), speed_m_s }).to_vec()
    };
    let path = |id, speed_m_s, y| show::Path { id, samples: samples(speed_m_s, y) };
    let paths = [path(0, 0.3, 0.8), path(1, 1.0, 1.2), path(2, 1.9, 1.6)];
    let small = |picture: &RgbImage| {
        let height = 256 * picture.height() / picture.width();
        image::imageops::resize(picture, 256, height, image::imageops::FilterType::Triangle)
    };
    assert_golden("drawing_plan", &small(&show::draw_plan(&plan, &walls, &[])), RESAMPLED);
    assert_golden("drawing_paths", &small(&show::draw_paths(&plan, &walls, &[], &paths, &[])), RESAMPLED);
}

/// A file system of a given size, where the system lets one be made (root on Linux).
struct SmallDisk(PathBuf);

impl SmallDisk {
    fn mount(at: &Path, size: &str) -> Option<SmallDisk> {
        let options = format!("size={size}");
        let mut mount = std::process::Command::new("mount");
        mount.args(["-t", "tmpfs", "-o", &options, "tmpfs"]).arg(at).stderr(std::process::Stdio::null());
        mount.status().ok()?.success().then(|| SmallDisk(at.to_path_buf()))
    }
}

impl Drop for SmallDisk {
    fn drop(&mut self) {
        let _ = std::process::Command::new("umount").arg(&self.0).status();
    }
}

#[test]
fn a_full_disk_is_an_error_that_names_the_file_and_leaves_nothing() {
    let dir = tempfile::tempdir().unwrap();
    let Some(disk) = SmallDisk::mount(dir.path(), "100k") else {
        eprintln!("skipped: no small disk can be mounted here");
        return;
    };
    let (out, walls) = (disk.0.join("out"), walls());
    let sums = sums(&walls, 50.0);
    let floor = FloorResolver::new(&sums, &walls, &Look::default(), PEOPLE).unwrap();
    let folder = OutputFolder::begin(&out, false).unwrap();
    let error =
        floor_textures(&folder, sums.grid(), &floor, &TextureOptions::default(), &Silent).map(|_| ()).unwrap_err();
    assert!(matches!(error, ExportError::Write { .. }), "{error}");
    assert!(error.to_string().contains("out/floor/floor_"), "{error}");
    assert!(error.hint().unwrap().contains("full"), "{:?}", error.hint());
    drop(folder);
    assert_eq!(std::fs::read_dir(&disk.0).unwrap().count(), 0);
}
