//! How fast walls are traced, and how fast they say what is near: queries per second on one thread.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use trodden::math::{sin_cos, vec2};
use trodden::plan::FloorPlan;
use trodden::walls::{Walls, WallsOptions};

const SIDE_PX: u32 = 1000;
const METRES_PER_PIXEL: f64 = 0.1;

/// A hall of 100 x 100 m with a round pillar of 1 m every 5 m.
fn hall() -> FloorPlan {
    let aside = |px: u32| f64::from(px % 50) - 24.5;
    let floor = |at: u32| {
        let (x, y) = (aside(at % SIDE_PX), aside(at / SIDE_PX));
        u8::from(x * x + y * y > 25.0)
    };
    FloorPlan::from_mask(SIDE_PX, SIDE_PX, METRES_PER_PIXEL, (0..SIDE_PX * SIDE_PX).map(floor).collect())
}

fn walls(c: &mut Criterion) {
    let plan = hall();
    let trace = || Walls::trace(&plan, &WallsOptions::default());
    let mut group = c.benchmark_group("walls");
    group.throughput(Throughput::Elements(u64::from(SIDE_PX * SIDE_PX)));
    group.sample_size(20);
    group.bench_function("pixels traced", |b| b.iter(|| black_box(trace().faces.len())));

    let walls = trace();
    let places: Vec<_> = (0..10_000)
        .map(|k| {
            let (sin, cos) = sin_cos(f64::from(k) * 2.4);
            vec2(50.0, 50.0) + vec2(cos, sin) * (0.005 * f64::from(k))
        })
        .collect();
    group.throughput(Throughput::Elements(places.len() as u64));
    group.bench_function("nearest within 1.5 m", |b| {
        b.iter(|| black_box(places.iter().filter(|&&place| walls.nearest(place, 1.5).is_some()).count()));
    });
    group.finish();
}

criterion_group!(benches, walls);
criterion_main!(benches);
