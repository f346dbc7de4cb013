//! How many people walk a step in a second: a square hall with pillars on a 10 m grid at 0.5 persons per square metre,
//! half of them on their way to the right, half to the left.

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use trodden::crowd::{Crowd, CrowdOptions};
use trodden::math::{Vec2, vec2};
use trodden::motion::{BodyOptions, Frame, Motion, People};
use trodden::plan::FloorPlan;
use trodden::routes::{Navigation, PlaceRequest, RouteRequest, RoutesOptions};
use trodden::walls::{Walls, WallsOptions};

/// Steps per measurement.
const STEPS: u64 = 20;
/// Distance between pillars, and their side, metres.
const PITCH_M: f64 = 10.0;
const PILLAR_M: f64 = 2.0;

fn hall(side_m: f64) -> FloorPlan {
    let pixels = (side_m / 0.1) as usize;
    let floor = |i: usize| {
        let p = vec2((i % pixels) as f64 + 0.5, (i / pixels) as f64 + 0.5) * 0.1;
        let beside = |v: f64| (v % PITCH_M - 0.5 * PITCH_M).abs() < 0.5 * PILLAR_M;
        let wall = p.x.min(p.y) < 0.2 || p.x.max(p.y) > side_m - 0.2;
        u8::from(!(wall || beside(p.x) && beside(p.y)))
    };
    FloorPlan::from_mask(pixels as u32, pixels as u32, 0.1, (0..pixels * pixels).map(floor).collect())
}

/// From anywhere to a strip at the right or left wall.
fn crossing(side_m: f64) -> RoutesOptions {
    let all = PlaceRequest::Area([[0.0, 0.0], [side_m, side_m]]);
    let strip = |x: [f64; 2]| PlaceRequest::Area([[x[0], 0.3], [x[1], side_m - 0.3]]);
    let route = |to| RouteRequest { name: None, from: all.clone(), to, via: Vec::new(), share: 1.0 };
    RoutesOptions { routes: vec![route(strip([side_m - 1.5, side_m - 0.3])), route(strip([0.3, 1.5]))] }
}

fn steps(c: &mut Criterion) {
    let mut group = c.benchmark_group("crowd");
    for people in [1_000u32, 10_000, 100_000] {
        let side_m = (f64::from(people) / 0.5).sqrt();
        let plan = hall(side_m);
        let walls = Walls::trace(&plan, &WallsOptions::default()).expect("a hall has walls");
        let (routes, navigation) = Navigation::find(&plan, &walls, &crossing(side_m)).expect("ways across");
        let options = CrowdOptions { people, entry_seconds: Some(0.0), ..CrowdOptions::commuters() };
        let everybody = People::new(1, BodyOptions::default());
        let mut frame = Frame::default();
        group.throughput(Throughput::Elements(STEPS * u64::from(people)));
        group.sample_size(10);
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            group.bench_function(format!("{people} people, {threads} threads"), |b| {
                let warmed_up = || {
                    let mut crowd =
                        Crowd::with_navigation(&plan, &walls, &routes, navigation.clone(), &everybody, &options)
                            .expect("a crowd");
                    // Everybody comes in, and gets going.
                    for _ in 0..30 {
                        crowd.next_frame(&mut Frame::default()).expect("a step");
                    }
                    crowd
                };
                b.iter_batched_ref(
                    warmed_up,
                    |crowd| {
                        pool.install(|| {
                            for _ in 0..STEPS {
                                crowd.next_frame(&mut frame).expect("a step");
                            }
                        })
                    },
                    BatchSize::PerIteration,
                );
            });
        }
    }
    group.finish();
}

fn default_scenario(c: &mut Criterion) {
    // 1000 people, a corridor of 60 m with a side branch, about a minute's walk each.
    let floor = |p: Vec2| (p.y > 20.0 && p.y < 25.0) || (p.x > 28.0 && p.x < 32.0 && p.y > 20.0);
    let mask = (0..600 * 450)
        .map(|i| u8::from(floor(vec2(f64::from(i % 600) + 0.5, 450.0 - f64::from(i / 600) - 0.5) * 0.1)))
        .collect();
    let plan = FloorPlan::from_mask(600, 450, 0.1, mask);
    let walls = Walls::trace(&plan, &WallsOptions::default()).expect("corridors have walls");
    let (routes, navigation) = Navigation::find(&plan, &walls, &RoutesOptions::default()).expect("default routes");
    let people = People::new(1, BodyOptions::default());
    let mut group = c.benchmark_group("crowd");
    group.sample_size(10);
    group.bench_function("1000 people from opening to opening", |b| {
        b.iter(|| {
            let options = CrowdOptions::commuters();
            let mut crowd =
                Crowd::with_navigation(&plan, &walls, &routes, navigation.clone(), &people, &options).expect("a crowd");
            let mut frame = Frame::default();
            while crowd.next_frame(&mut frame).expect("a step") {}
            crowd.tally().arrived
        })
    });
    group.finish();
}

criterion_group!(benches, steps, default_scenario);
criterion_main!(benches);
