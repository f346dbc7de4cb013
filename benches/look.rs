//! How fast sums resolve: texels per second on one thread, in the middle of a lane and along walls.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use trodden::look::{FloorLook, FloorResolver, Look, Material};
use trodden::marks::Mark;
use trodden::math::{SplitMix64, vec2};
use trodden::patterns::{Cause, PatternLibrary};
use trodden::plan::FloorPlan;
use trodden::stamps::{StampOptions, Stamper, TexelGrid};
use trodden::sums::FloorSums;
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
    let walls = Walls::trace(&plan, &WallsOptions::default()).expect("the plan has floor");
    let texels = (side as f64 * 0.1 * DENSITY) as u32;
    let grid = TexelGrid { texels_per_metre: DENSITY, width: texels, height: texels };
    let library = PatternLibrary::built_in().expect("the built-in library is tested");
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
            strength: 1.0,
            soil: if n % 10 == 0 { 0.02 } else { 0.0 },
            wear: n,
            variation: rng.next_u64(),
        })
        .collect();
    let mut sums = FloorSums::new(grid);
    sums.add(&Stamper::new(&library, grid, &StampOptions::default()), &walls, &marks);
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

criterion_group!(benches, look);
criterion_main!(benches);
