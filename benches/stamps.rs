//! Stamps in a room that fits a few blocks: prints of 28 x 11 texels at 100 texels/m, 112 x 44 at 400.
//!
//! One thread. `ours` is all that a footfall leaves: passes, presence, and on every third soil. `naive` samples every texel
//! of a print 36 times ([`stamp_reference`]) and adds passes only.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use trodden::marks::{Contact, Mark};
use trodden::math::{SplitMix64, sin_cos, vec2};
use trodden::patterns::{Cause, PatternLibrary};
use trodden::plan::FloorPlan;
use trodden::stamps::{FaceSpan, StampOptions, Stamper, TexelGrid, WallGrid, WallStamper, stamp_reference};
use trodden::sums::{FloorSums, WallSums};
use trodden::walls::{Walls, WallsOptions};

const SIDE_M: f64 = 8.0;

fn walls() -> Walls {
    let side = (SIDE_M * 10.0) as usize;
    let amid = |k: usize| k > 0 && k < side - 1;
    let inside = |k: usize| amid(k % side) && amid(k / side);
    let floor = (0..side * side).map(|k| u8::from(inside(k))).collect();
    let plan = FloorPlan::from_mask(side as u32, side as u32, 0.1, floor);
    Walls::trace(&plan, &WallsOptions::default())
}

/// Footfalls of all soles, evenly over the room, in all directions.
fn footfalls(library: &PatternLibrary, count: usize, soil: f32) -> Vec<Mark> {
    let rng = &mut SplitMix64::new(1);
    (0..count)
        .map(|k| {
            let (sin, cos) = sin_cos(f64::from(rng.range(-3.2, 3.2)));
            let mut place = || f64::from(rng.range(0.4, SIDE_M as f32 - 0.4));
            Mark {
                cause: Cause::Sole,
                place_m: vec2(place(), place()),
                heading: vec2(cos, sin),
                mirrored: k % 2 == 0,
                pattern: library.pick(Cause::Sole, f64::from(rng.unit()), Some(28.0)).expect("it has soles"),
                length_m: 0.28,
                smear_m: rng.range(0.0, 0.025),
                twist_rad: 0.0,
                forefoot: 0.0,
                effort: 0.0,
                stood_s: 0.0,
                wheel_m: 0.0,
                strength: 1.0,
                soil: if k % 3 == 0 { soil } else { 0.0 },
                wet: 0.0,
                wear: k as u32 % 300,
                variation: rng.next_u64(),
            }
        })
        .collect()
}

fn grid(texels_per_metre: f64) -> TexelGrid {
    let side = (SIDE_M * texels_per_metre) as u32;
    TexelGrid { texels_per_metre, width: side, height: side }
}

fn stamps(c: &mut Criterion) {
    let library = PatternLibrary::built_in();
    let walls = walls();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread can be started");
    let mut group = c.benchmark_group("stamps");
    group.sample_size(10).warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(3));
    for (density, count, naive_count) in [(100.0, 20_000, 500), (400.0, 2000, 30)] {
        let grid = grid(density);
        let stamper = Stamper::new(&library, grid, &StampOptions::default()).expect("the default options are in range");
        for (what, soil) in [("no soil", 0.0), ("faint soil", 0.002), ("readable soil", 0.1)] {
            let marks = footfalls(&library, count, soil);
            let mut sums = FloorSums::new(grid);
            group.throughput(Throughput::Elements(count as u64));
            group.bench_function(BenchmarkId::new(format!("ours, {what}"), format!("{density} texels/m")), |b| {
                b.iter(|| pool.install(|| sums.add(&stamper, &walls, &marks)));
            });
        }
        let marks = footfalls(&library, naive_count, 0.0);
        let mut passes = vec![0u32; grid.width as usize * grid.height as usize];
        group.throughput(Throughput::Elements(naive_count as u64));
        group.bench_function(BenchmarkId::new("naive", format!("{density} texels/m")), |b| {
            b.iter(|| {
                marks.iter().for_each(|mark| add_naively(&library, mark, grid, &mut passes));
                black_box(&mut passes);
            });
        });
    }
    group.finish();
}

fn add_naively(library: &PatternLibrary, mark: &Mark, grid: TexelGrid, passes: &mut [u32]) {
    let print = stamp_reference(&library.patterns[usize::from(mark.pattern)], mark, grid);
    for (row, line) in print.coverage.chunks_exact(print.width).enumerate() {
        let start = (print.j0 as usize + row) * grid.width as usize + print.i0 as usize;
        let texels = passes.get_mut(start..start + print.width).unwrap_or(&mut []);
        texels.iter_mut().zip(line).for_each(|(t, c)| *t = t.saturating_add((c * 256.0) as u32));
    }
}

/// Touches, drags and scuffs of the built-in wall patterns, evenly over 100 m of wall.
fn contacts(library: &PatternLibrary, count: usize) -> Vec<Contact> {
    let rng = &mut SplitMix64::new(2);
    (0..count)
        .map(|_| {
            let cause = Cause::WALL[(rng.next_u64() % 5) as usize];
            let number = library.pick(cause, f64::from(rng.unit()), None).expect("it has wall patterns");
            let pattern = &library.patterns[usize::from(number)];
            let stretch = rng.range(0.7, 1.4);
            Contact {
                cause,
                face: 0,
                along_m: f64::from(rng.range(0.0, 100.0)),
                height_m: f64::from(rng.range(0.1, 1.5)),
                direction_rad: rng.range(-3.2, 3.2),
                pattern: number,
                mirrored: rng.unit() < 0.5,
                length_m: stretch * pattern.length_cm as f32 / 100.0,
                breadth_m: pattern.breadth_cm() as f32 / 100.0,
                strength: rng.range(0.02, 0.3),
                variation: rng.next_u64(),
            }
        })
        .collect()
}

/// 100 m of wall, 2.6 m high.
fn wall_grid(texels_per_metre: f64) -> WallGrid {
    let texels = |metres: f64| (metres * texels_per_metre) as u32;
    let face = FaceSpan { width: texels(100.0), length_m: 100.0, closed: false };
    WallGrid { texels_per_metre, height_m: 2.6, height: texels(2.6), faces: vec![face] }
}

fn stains(c: &mut Criterion) {
    let library = PatternLibrary::built_in();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread can be started");
    let mut group = c.benchmark_group("walls");
    group.sample_size(10).warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(3));
    for (density, count) in [(50.0, 10_000), (200.0, 10_000), (1000.0, 500)] {
        let grid = wall_grid(density);
        let stamper =
            WallStamper::new(&library, &grid, &StampOptions::default()).expect("the default options are in range");
        let contacts = contacts(&library, count);
        let mut sums = WallSums::new(grid);
        group.throughput(Throughput::Elements(count as u64));
        group.bench_function(BenchmarkId::new("contacts", format!("{density} texels/m")), |b| {
            b.iter(|| pool.install(|| sums.add(&stamper, &contacts)));
        });
    }
    group.finish();
}

fn making(c: &mut Criterion) {
    let library = PatternLibrary::built_in();
    let mut group = c.benchmark_group("new");
    group.sample_size(10).warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(2));
    for density in [100.0, 400.0] {
        group.bench_function(BenchmarkId::new("stamper", format!("{density} texels/m")), |b| {
            b.iter(|| {
                Stamper::new(&library, grid(density), &StampOptions::default())
                    .expect("the default options are in range")
            });
        });
        let walls = wall_grid(density);
        group.bench_function(BenchmarkId::new("wall stamper", format!("{density} texels/m")), |b| {
            b.iter(|| {
                WallStamper::new(&library, &walls, &StampOptions::default()).expect("the default options are in range")
            });
        });
    }
    group.finish();
}

criterion_group!(benches, stamps, stains, making);
criterion_main!(benches);
