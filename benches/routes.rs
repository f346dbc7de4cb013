//! How long it takes to find the ways through a plan.

use criterion::{Criterion, criterion_group, criterion_main};
use trodden::plan::FloorPlan;
use trodden::routes::{Navigation, RoutesOptions};
use trodden::walls::{Walls, WallsOptions};

/// Corridors every 20 m in both directions, 5 m wide, on a square plan at 0.1 m a pixel.
fn grid_of_corridors(side_m: usize) -> FloorPlan {
    let pixels = side_m * 10;
    let floor = |i: usize| u8::from((i % pixels) % 200 < 50 || (i / pixels) % 200 < 50);
    FloorPlan::from_mask(pixels as u32, pixels as u32, 0.1, (0..pixels * pixels).map(floor).collect())
}

fn find(c: &mut Criterion) {
    let mut group = c.benchmark_group("routes");
    group.sample_size(10);
    for side_m in [80, 300] {
        let plan = grid_of_corridors(side_m);
        let walls = Walls::trace(&plan, &WallsOptions::default());
        group.bench_function(format!("default routes through {side_m} m of corridors"), |b| {
            b.iter(|| Navigation::find(&plan, &walls, &RoutesOptions::default()).expect("default routes").0.len())
        });
    }
    group.finish();
}

criterion_group!(benches, find);
criterion_main!(benches);
