//! The `export` stage: four files of a tile of 8192 x 8192 texels of which a quarter is floor, and its sums.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use trodden::Silent;
use trodden::export::{Atlas, OutputFolder, TextureOptions, TextureSource, floor_textures, write_sums};
use trodden::look::{Background, LAYERS, Layer, ResolvedBlock};
use trodden::math::SplitMix64;
use trodden::stamps::{FaceSpan, TexelGrid, WallGrid};
use trodden::sums::{FloorSums, Quantity};

const SIDE: u32 = 8192;
/// Side of the piece of floor that is repeated.
const PIECE: usize = 1024;

/// Corridors, metres: left, lower, right, upper. 26 % of 80 x 80 m.
const CORRIDORS: [[f64; 4]; 5] = [
    [2.0, 37.0, 78.0, 43.0],
    [10.0, 2.0, 15.0, 78.0],
    [62.0, 2.0, 67.0, 78.0],
    [10.0, 4.0, 67.0, 8.0],
    [10.0, 72.0, 67.0, 76.0],
];

fn is_floor(i: i64, j: i64) -> bool {
    let (x, y) = (i as f64 / 100.0, j as f64 / 100.0);
    CORRIDORS.iter().any(|c| x >= c[0] && x < c[2] && y >= c[1] && y < c[3])
}

/// Corridors of a floor as noisy as real ones, copied from a piece that was made before.
struct Corridors {
    piece: ResolvedBlock,
}

impl Corridors {
    fn new() -> Corridors {
        let mut random = SplitMix64::new(1);
        let coarse: Vec<f32> = (0..128 * 128).map(|_| random.normal()).collect();
        let density: Vec<f32> = (0..PIECE * PIECE)
            .map(|k| 0.25 * (1.0 + 0.15 * coarse[k / PIECE / 8 * 128 + k % PIECE / 8] + 0.08 * random.normal()))
            .map(|d| d.max(0.0))
            .collect();
        let mut dithered = |value: f32| (255.0 * value + random.unit()) as u8;
        let dirt = |d: f32, clean: f32, soil: f32| soil + (clean - soil) / (1.0 + d);
        let base_color = density
            .iter()
            .map(|&d| [dithered(dirt(d, 0.8, 0.45)), dithered(dirt(d, 0.78, 0.42)), dithered(dirt(d, 0.74, 0.36))])
            .collect();
        let mask = density.iter().map(|&d| [dithered(d), dithered(d * 1.5), 0, dithered(d * 0.1)]).collect();
        let orm = density.iter().map(|&d| [255, dithered(0.4 + d * 0.3), 0]).collect();
        let layer = |name: &'static str| {
            let scale = match name {
                "soil" | "scuff" => 0.0,
                name => name.len() as f32,
            };
            Layer { name, values: density.iter().map(|d| d * scale).collect() }
        };
        let layers = LAYERS.map(layer).into();
        Corridors { piece: ResolvedBlock { base_color, mask, orm, layers, ..ResolvedBlock::default() } }
    }
}

/// A rectangle of the repeated piece; what is no floor has the value `outside`.
fn cut<T: Copy>(piece: &[T], outside: T, [i0, j0]: [i64; 2], width: usize, height: usize) -> Vec<T> {
    let mut values = Vec::with_capacity(width * height);
    for j in j0..j0 + height as i64 {
        let row = (j.rem_euclid(PIECE as i64) as usize) * PIECE;
        for i in (i0..i0 + width as i64).step_by(4) {
            let at = row + i.rem_euclid(PIECE as i64) as usize;
            let four =
                if is_floor(i, j) { [piece[at], piece[at + 1], piece[at + 2], piece[at + 3]] } else { [outside; 4] };
            values.extend_from_slice(&four);
        }
    }
    values
}

impl TextureSource for Corridors {
    fn layers(&self) -> &[&'static str] {
        &LAYERS
    }

    fn background(&self) -> Background {
        Background { base_color: [204, 199, 189], mask: [0; 4], orm: [255, 100, 0] }
    }

    fn resolve(&self, i0: i64, j0: i64, width: usize, height: usize) -> ResolvedBlock {
        let (last_i, last_j) = (i0 + width as i64 - 1, j0 + height as i64 - 1);
        let (x, y) = ([i0 as f64 / 100.0, last_i as f64 / 100.0], [j0 as f64 / 100.0, last_j as f64 / 100.0]);
        if !CORRIDORS.iter().any(|c| x[1] >= c[0] && x[0] < c[2] && y[1] >= c[1] && y[0] < c[3]) {
            return ResolvedBlock { empty: true, ..ResolvedBlock::default() };
        }
        let (outside, at) = (self.background(), [i0, j0]);
        ResolvedBlock {
            relief: Vec::new(),
            empty: false,
            clean: Vec::new(),
            fine: Vec::new(),
            base_color: cut(&self.piece.base_color, outside.base_color, at, width, height),
            mask: cut(&self.piece.mask, outside.mask, at, width, height),
            orm: cut(&self.piece.orm, outside.orm, at, width, height),
            layers: (self.piece.layers.iter())
                .map(|layer| Layer { name: layer.name, values: cut(&layer.values, 0.0, at, width, height) })
                .collect(),
        }
    }
}

fn sums(grid: TexelGrid) -> FloorSums {
    let mut sums = FloorSums::new(grid);
    for (quantity, most) in [(Quantity::Passes, 2000), (Quantity::Presence, 8000), (Quantity::Soil, 300)] {
        let cells = sums.grid_of(quantity);
        let factor = i64::from(grid.width / cells.width);
        let mut random = SplitMix64::new(2);
        for j0 in (0..cells.height).step_by(128) {
            for i0 in (0..cells.width).step_by(128) {
                let value = |k: u32| {
                    let floor = is_floor(i64::from(i0 + k % 128) * factor, i64::from(j0 + k / 128) * factor);
                    if floor { (random.unit() * random.unit() * most as f32) as u32 } else { 0 }
                };
                let values: Vec<u32> = (0..128 * 128).map(value).collect();
                if values.iter().any(|&v| v > 0) {
                    sums.add_block(quantity, i0, j0, 128, 128, &values);
                }
            }
        }
    }
    sums
}

fn export(c: &mut Criterion) {
    let dir = std::env::temp_dir().join(format!("trodden-bench-{}", std::process::id()));
    let grid = TexelGrid { texels_per_metre: 100.0, width: SIDE, height: SIDE };
    let (source, sums) = (Corridors::new(), sums(grid));
    let begin = || OutputFolder::begin(&dir, false).expect("the temporary folder can be written");
    let textures = |options: &TextureOptions| {
        let folder = begin();
        let written = floor_textures(&folder, grid, &source, options, &Silent).expect("there is room");
        (folder, written)
    };
    let mut group = c.benchmark_group("export 8192 x 8192");
    group.sample_size(10).measurement_time(Duration::from_secs(10));
    let images = TextureOptions { layers: Some(false), ..TextureOptions::default() };
    group.bench_function("images", |b| b.iter(|| black_box(textures(&images).1.export_busy_s)));
    group.bench_function("images and layers", |b| {
        b.iter(|| black_box(textures(&TextureOptions::default()).1.export_busy_s));
    });
    let (_, written) = textures(&images);
    group.bench_function("sums", |b| {
        b.iter(|| write_sums(&begin(), &sums, &written, &Silent).expect("there is room"));
    });
    group.finish();

    let (folder, written) = textures(&TextureOptions::default());
    write_sums(&folder, &sums, &written, &Silent).expect("there is room");
    println!("busy: source {:.2} s, export {:.2} s", written.look_busy_s, written.export_busy_s);
    for sub in ["floor", "sums"] {
        for entry in std::fs::read_dir(folder.path().join(sub)).into_iter().flatten().flatten() {
            let size = entry.metadata().map_or(0, |m| m.len());
            println!("{:28} {:6.1} MiB", entry.file_name().to_string_lossy(), size as f64 / 1048576.0);
        }
    }
    if let Some(keep) = std::env::var_os("KEEP") {
        let copied = std::process::Command::new("cp").arg("-r").arg(folder.path()).arg(keep).status();
        println!("kept: {copied:?}");
    }
}

/// Lays 100 000 walls of 1 to 41 cm into sheets.
fn atlas(c: &mut Criterion) {
    let mut random = SplitMix64::new(1);
    let mut lengths: Vec<f64> = (0..100_000).map(|_| 0.01 + 0.4 * f64::from(random.unit())).collect();
    lengths.sort_by(|a, b| b.total_cmp(a));
    let face = |&length_m: &f64| FaceSpan { width: (200.0 * length_m).ceil() as u32, length_m, closed: false };
    let faces = lengths.iter().map(face).collect();
    let grid = WallGrid { texels_per_metre: 200.0, height_m: 2.6, height: 520, faces };
    let mut group = c.benchmark_group("atlas");
    group.sample_size(10);
    group.bench_function("100 000 tiny walls", |b| b.iter(|| black_box(Atlas::pack(&grid, &[], 8192, 16).is_ok())));
    group.finish();
}

criterion_group!(benches, export, atlas);
criterion_main!(benches);
