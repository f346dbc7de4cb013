//! Whole batches of marks added to the sums of a floor of corridors: passes, presence, soil of three persons in ten,
//! heel marks. One footfall is one element. And contacts added to the sums of the corridors' walls.

use std::time::Duration;

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use trodden::marks::{Contact, Mark};
use trodden::math::{SplitMix64, exp, sin_cos, vec2};
use trodden::patterns::{Cause, PatternLibrary};
use trodden::plan::FloorPlan;
use trodden::stamps::{StampOptions, Stamper, TexelGrid, WallGrid, WallStamper};
use trodden::sums::{FloorSums, WallSums};
use trodden::walls::{Walls, WallsOptions};

const SIDE_M: f64 = 80.0;

/// Corridors `x0, y0, x1, y1` in metres, 4 to 6 m wide, in a plan of 80 x 80 m.
const CORRIDORS: [[f64; 4]; 5] = [
    [0.0, 37.0, 80.0, 43.0],
    [10.0, 2.0, 15.0, 78.0],
    [62.0, 2.0, 67.0, 78.0],
    [10.0, 4.0, 67.0, 8.0],
    [10.0, 72.0, 67.0, 76.0],
];

fn walls() -> Walls {
    let side_px = (SIDE_M * 10.0) as usize;
    let inside = |k: usize| {
        let (x, y) = ((k % side_px) as f64 / 10.0, SIDE_M - (k / side_px) as f64 / 10.0 - 0.05);
        CORRIDORS.iter().any(|&[x0, y0, x1, y1]| x >= x0 && x < x1 && y >= y0 && y < y1)
    };
    let floor = (0..side_px * side_px).map(|k| u8::from(inside(k))).collect();
    let plan = FloorPlan::from_mask(side_px as u32, side_px as u32, 0.1, floor);
    Walls::trace(&plan, &WallsOptions::default())
}

/// Footfalls of people who each walk one corridor from end to end, until there are `count`.
fn walks(library: &PatternLibrary, count: usize) -> Vec<Mark> {
    let rng = &mut SplitMix64::new(1);
    let mut marks = Vec::with_capacity(count);
    let mut person = 0u32;
    while marks.len() < count {
        let [x0, y0, x1, y1] = CORRIDORS[person as usize % CORRIDORS.len()];
        let along_x = x1 - x0 > y1 - y0;
        let (length, width) = if along_x { (x1 - x0, y1 - y0) } else { (y1 - y0, x1 - x0) };
        let lane = f64::from(rng.range(0.3, width as f32 - 0.3));
        let sole_m = rng.range(0.24, 0.31);
        let draw = f64::from(rng.unit());
        let pattern = library.pick(Cause::Sole, draw, Some(f64::from(sole_m) * 100.0)).expect("it has soles");
        let load = if person % 10 < 3 { 0.01 * exp(1.4 * f64::from(rng.normal())) } else { 0.0 };
        let steps = (length / 0.7) as usize;
        for step in 0..steps {
            let at = (step as f64 + f64::from(rng.unit()) * 0.2) * 0.7;
            let side = lane + if step % 2 == 0 { 0.05 } else { -0.05 } + 0.03 * f64::from(rng.normal());
            let (sin, cos) = sin_cos(0.15 * f64::from(rng.normal()));
            let (place_m, heading) = if along_x {
                (vec2(x0 + at, y0 + side), vec2(cos, sin))
            } else {
                (vec2(x0 + side, y0 + at), vec2(-sin, cos))
            };
            let footfall = Mark {
                cause: Cause::Sole,
                place_m,
                heading,
                mirrored: step % 2 == 1,
                pattern,
                length_m: sole_m,
                smear_m: rng.range(0.0, 0.025),
                twist_rad: 0.0,
                forefoot: 0.0,
                effort: 0.0,
                stood_s: 0.0,
                wheel_m: 0.0,
                strength: rng.range(0.9, 1.1),
                soil: (load * 2.68 / (step as f64 * 0.5 + 2.68)) as f32,
                wet: 0.0,
                wear: person,
                variation: rng.next_u64(),
            };
            marks.push(footfall);
            if rng.unit() < 0.01 {
                let pattern = library.pick(Cause::Heel, f64::from(rng.unit()), None).expect("it has heel marks");
                let length_m = rng.range(0.02, 0.12);
                marks.push(Mark { cause: Cause::Heel, pattern, length_m, strength: 0.25, ..footfall });
            }
        }
        person += 1;
    }
    marks.truncate(count);
    marks
}

fn grid(texels_per_metre: f64) -> TexelGrid {
    let side = (SIDE_M * texels_per_metre) as u32;
    TexelGrid { texels_per_metre, width: side, height: side }
}

fn adding(c: &mut Criterion) {
    let library = PatternLibrary::built_in();
    let walls = walls();
    let mut group = c.benchmark_group("add");
    group.sample_size(10).warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(5));
    for (density, count) in [(100.0, 150_000), (400.0, 15_000)] {
        let grid = grid(density);
        let marks = walks(&library, count);
        let stamper = Stamper::new(&library, grid, &StampOptions::default()).expect("the default options are in range");
        group.throughput(Throughput::Elements(count as u64));
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be started");
            let name =
                |what: &str| BenchmarkId::new(format!("{what}, {density} texels/m"), format!("{threads} threads"));
            group.bench_function(name("fresh sums"), |b| {
                b.iter_batched(
                    || FloorSums::new(grid),
                    |mut sums| {
                        pool.install(|| sums.add(&stamper, &walls, &marks));
                        sums
                    },
                    BatchSize::PerIteration,
                );
            });
            let mut sums = FloorSums::new(grid);
            group.bench_function(name("touched sums"), |b| {
                b.iter(|| pool.install(|| sums.add(&stamper, &walls, &marks)));
            });
        }
    }
    group.finish();
}

/// Touches of hands round the walls, a third of them at ten places.
fn contacts(library: &PatternLibrary, grid: &WallGrid, count: usize) -> Vec<Contact> {
    let rng = &mut SplitMix64::new(3);
    (0..count)
        .map(|k| {
            let face = (rng.next_u64() % grid.faces.len() as u64) as u32;
            let length_m = grid.faces[face as usize].length_m;
            let share = if k % 3 == 0 { (k % 10) as f64 / 10.0 } else { f64::from(rng.unit()) };
            let number = library.pick(Cause::Hand, f64::from(rng.unit()), None).expect("it has hands");
            let pattern = &library.patterns[usize::from(number)];
            Contact {
                cause: Cause::Hand,
                face,
                along_m: share * length_m,
                height_m: 1.15 + 0.1 * f64::from(rng.normal()),
                direction_rad: rng.range(-3.2, 3.2),
                pattern: number,
                mirrored: rng.unit() < 0.5,
                length_m: pattern.length_cm as f32 / 100.0,
                breadth_m: pattern.breadth_cm() as f32 / 100.0,
                strength: rng.range(0.02, 0.2),
                variation: rng.next_u64(),
            }
        })
        .collect()
}

fn adding_to_walls(c: &mut Criterion) {
    let library = PatternLibrary::built_in();
    let walls = walls();
    let mut group = c.benchmark_group("add to walls");
    group.sample_size(10).warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(5));
    let grid = WallGrid::covering(&walls, 2.6, 200.0).expect("the walls have a height");
    let stamper =
        WallStamper::new(&library, &grid, &StampOptions::default()).expect("the default options are in range");
    let contacts = contacts(&library, &grid, 20_000);
    group.throughput(Throughput::Elements(contacts.len() as u64));
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be started");
        group.bench_function(BenchmarkId::new("fresh sums, 200 texels/m", format!("{threads} threads")), |b| {
            b.iter_batched(
                || WallSums::new(grid.clone()),
                |mut sums| {
                    pool.install(|| sums.add(&stamper, &contacts));
                    sums
                },
                BatchSize::PerIteration,
            );
        });
    }
    group.finish();
}

criterion_group!(benches, adding, adding_to_walls);
criterion_main!(benches);
