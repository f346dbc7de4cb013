//! How fast sums resolve: texels per second on one thread, in the middle of a lane, along walls, and on them.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use trodden::look::{FloorLook, FloorResolver, Look, Material, ResolvedBlock, WallMaterial, WallResolver};
use trodden::marks::Mark;
use trodden::math::{SplitMix64, vec2};
use trodden::patterns::{Cause, PatternLibrary};
use trodden::plan::FloorPlan;
use trodden::stamps::{StampOptions, Stamper, TexelGrid, WallGrid};
use trodden::sums::{FloorSums, WallSums};
use trodden::walls::{Walls, WallsOptions};

const DENSITY: f64 = 100.0;
const SIDE: usize = 256;

/// A hall of 20 x 20 m, 30 cm of wall around it, a pillar every 5 m, and 60 000 footfalls.
fn hall() -> (Walls, FloorSums) {
    let (side, wall) = (206, 3);
    let is_floor = |column: usize, row: usize| {
        let inside = |at: usize| at >= wall && at < side - wall;
        inside(column) && inside(row) && !(column % 50 < 4 && row % 50 < 4)
    };
    let floor = (0..side * side).map(|n| u8::from(is_floor(n % side, n / side))).collect();
    let plan = FloorPlan::from_mask(side as u32, side as u32, 0.1, floor);
    let walls = Walls::trace(&plan, &WallsOptions::default());
    let texels = (side as f64 * 0.1 * DENSITY) as u32;
    let grid = TexelGrid { texels_per_metre: DENSITY, width: texels, height: texels };
    let library = PatternLibrary::built_in();
    let pattern = library.pick(Cause::Sole, 0.3, None).expect("there is a sole");
    let mut rng = SplitMix64::new(1);
    let marks: Vec<Mark> = (0..60_000)
        .map(|n| Mark {
            cause: Cause::Sole,
            place_m: vec2(f64::from(rng.range(0.5, 20.0)), f64::from(rng.range(0.5, 20.0))),
            heading: vec2(0.6, 0.8),
            mirrored: n % 2 == 0,
            pattern,
            length_m: 0.28,
            smear_m: 0.01,
            twist_rad: 0.0,
            forefoot: 0.0,
            effort: 0.0,
            stood_s: 0.0,
            wheel_m: 0.0,
            strength: 1.0,
            soil: if n % 10 == 0 { 0.02 } else { 0.0 },
            wet: 0.0,
            wear: n,
            variation: rng.next_u64(),
        })
        .collect();
    let mut sums = FloorSums::new(grid);
    sums.add(
        &Stamper::new(&library, grid, &StampOptions::default()).expect("the default options are in range"),
        &walls,
        &marks,
    );
    (walls, sums)
}

fn look(c: &mut Criterion) {
    let (walls, sums) = hall();
    let mut group = c.benchmark_group("look");
    group.throughput(Throughput::Elements((SIDE * SIDE) as u64));
    group.sample_size(30);
    for material in [Material::Vinyl, Material::Wood, Material::Tile] {
        let look = Look { floor: FloorLook { material, ..FloorLook::default() }, ..Look::default() };
        let resolver = FloorResolver::new(&sums, &walls, &look, 1000).expect("the look is in range");
        for (name, i0, j0) in [("open floor", 5 * 256, 5 * 256 + 30), ("a pillar", 4 * 256, 4 * 256), ("walls", 0, 0)] {
            let name = format!("{material:?}, {name}").to_lowercase();
            group.bench_function(name, |b| b.iter(|| black_box(resolver.resolve(i0, j0, SIDE, SIDE))));
        }
    }
    group.finish();
}

/// The walls of a corridor of 20 m, both sides together 40 m, 2.6 m high: a touch of every cause every half metre.
fn corridor() -> (Walls, WallSums) {
    let floor = (0..200 * 30).map(|n| u8::from((5..25).contains(&(n / 200)))).collect();
    let plan = FloorPlan::from_mask(200, 30, 0.1, floor);
    let walls = Walls::trace(&plan, &WallsOptions::default());
    let grid = WallGrid::covering(&walls, 2.6, 200.0).expect("the walls are small");
    let mut sums = WallSums::new(grid);
    let touch: Vec<u32> = (0..24 * 24).map(|n| 200 - 15 * (n as u32 % 24).abs_diff(12)).collect();
    for face in 0..walls.faces.len() {
        for n in 0..40 {
            for (cause, row) in Cause::WALL.into_iter().zip([230, 220, 280, 80, 20]) {
                sums.add_block(cause, face, 100 * n + 7 * row % 60, row, [24, 24], &touch);
            }
        }
    }
    (walls, sums)
}

fn walls(c: &mut Criterion) {
    let (walls, sums) = corridor();
    let clean = WallSums::new(sums.grid().clone());
    let mut group = c.benchmark_group("look of walls");
    group.throughput(Throughput::Elements(2 * 20 * 200 * 520));
    group.sample_size(10);
    for material in [WallMaterial::Matt, WallMaterial::Gloss, WallMaterial::Concrete] {
        let mut look = Look::default();
        look.wall.material = material;
        for (name, sums) in [("touched", &sums), ("clean", &clean)] {
            let resolver = WallResolver::new(sums, &walls, &look, 1000).expect("the look is in range");
            let mut block = ResolvedBlock::default();
            let name = format!("{material:?}, {name}, 40 m x 2.6 m").to_lowercase();
            group.bench_function(name, |b| {
                b.iter(|| {
                    for (face, j0, i0) in blocks() {
                        let (width, height) = ((4000 - i0).min(SIDE), (520 - j0).min(SIDE));
                        resolver.resolve_into(face, i0 as i64, j0 as i64, width, height, black_box(&mut block));
                    }
                });
            });
        }
    }
    group.finish();
}

/// Faces, rows and columns of all blocks of the corridor's walls.
fn blocks() -> impl Iterator<Item = (usize, usize, usize)> {
    let columns = |(face, j0)| (0..4000).step_by(SIDE).map(move |i0| (face, j0, i0));
    (0..2).flat_map(|face| (0..520).step_by(SIDE).map(move |j0| (face, j0))).flat_map(columns)
}

criterion_group!(benches, look, walls);
criterion_main!(benches);
