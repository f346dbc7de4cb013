//! How fast a plan image is read and understood: pixels per second.

use std::hint::black_box;
use std::path::Path;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use trodden::plan::{self, PlanOptions};

fn plan(c: &mut Criterion) {
    let mut group = c.benchmark_group("plan");
    for name in ["corridors", "museum"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans").join(name).with_extension("png");
        let options = PlanOptions { metres_per_pixel: Some(0.05), ..PlanOptions::default() };
        let read = || plan::read(&path, &options).expect("the sample plans are tested");
        let plan = read();
        group.throughput(Throughput::Elements(u64::from(plan.width_px) * u64::from(plan.height_px)));
        group.sample_size(20);
        group.bench_function(name, |b| b.iter(|| black_box(read().regions.len())));
    }
    group.finish();
}

criterion_group!(benches, plan);
criterion_main!(benches);
