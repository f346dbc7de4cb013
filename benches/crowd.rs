//! How many people walk a step in a second: a square hall with pillars on a 10 m grid at 0.5 persons per square metre,
//! half of them on their way to the right, half to the left.

use std::time::Instant;

use criterion::{Criterion, criterion_group};
use trodden::crowd::{CrowdModel, CrowdOptions, Simulation};
use trodden::math::{Vec2, vec2};
use trodden::motion::{BodyOptions, Frame, Motion, People};
use trodden::plan::FloorPlan;
use trodden::routes::{Navigation, PlaceRequest, RouteRequest, RoutesOptions};
use trodden::walls::{Walls, WallsOptions};

/// Persons per square metre.
const DENSITY: f64 = 0.5;
/// Steps before anything is measured, steps that are measured, and how often.
const WARM_UP_STEPS: usize = 20;
const STEPS: usize = 20;
const TURNS: usize = 4;
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
    let route = |to| RouteRequest { name: None, from: all.clone(), to, via: Vec::new(), arrivals: None, share: 1.0 };
    RoutesOptions {
        routes: vec![route(strip([side_m - 1.5, side_m - 0.3])), route(strip([0.3, 1.5]))],
        ..RoutesOptions::default()
    }
}

/// Prints how many seconds of how many people's walking a second gives, for crowds of one density, on one thread and
/// on two: the best of several turns, as the machine may have other things to do.
fn table() {
    println!("model         people   threads  person-steps/s  person-seconds/s  against 1000 people  against 1 thread");
    let mut first = None;
    let boids = [1_000u32, 10_000, 100_000].map(|people| (CrowdModel::Boids, people));
    for (model, people) in boids.into_iter().chain([(CrowdModel::SocialForce, 1_000)]) {
        let side_m = (f64::from(people) / DENSITY).sqrt();
        let plan = hall(side_m);
        let walls = Walls::trace(&plan, &WallsOptions::default());
        let (routes, navigation) = Navigation::find(&plan, &walls, &crossing(side_m)).expect("ways across");
        let options = CrowdOptions { people, entry_seconds: Some(0.0), ..CrowdOptions::default() };
        let everybody = People::new(1, BodyOptions::default());
        let pools = [1, 2].map(|n| rayon::ThreadPoolBuilder::new().num_threads(n).build().expect("a pool"));
        let mut best = [0.0f64; 2];
        let mut frame = Frame::default();
        for _ in 0..TURNS {
            let mut crowd =
                Simulation::with_navigation(&plan, &walls, &routes, navigation.clone(), &everybody, &options)
                    .expect("a crowd");
            // Everybody comes in, and gets going.
            for _ in 0..WARM_UP_STEPS {
                crowd.next_frame(&mut frame).expect("a step");
            }
            for (pool, best) in pools.iter().zip(&mut best) {
                let start = Instant::now();
                let mut walked = 0;
                pool.install(|| {
                    for _ in 0..STEPS {
                        crowd.next_frame(&mut frame).expect("a step");
                        walked += frame.walkers.len();
                    }
                });
                *best = best.max(walked as f64 / start.elapsed().as_secs_f64());
            }
        }
        let first = *first.get_or_insert(best[0]);
        for (threads, rate) in [(1, best[0]), (2, best[1])] {
            println!(
                "{:12} {people:7} {threads:8} {:11.2} M {:15.0} k {:17.2} {:17.2}",
                format!("{model:?}"),
                rate * 1e-6,
                rate * options.time_step * 1e-3,
                first / best[0],
                rate / best[0]
            );
        }
    }
}

fn default_scenario(c: &mut Criterion) {
    // 1000 people, a corridor of 60 m with a side branch, about a minute's walk each.
    let floor = |p: Vec2| (p.y > 20.0 && p.y < 25.0) || (p.x > 28.0 && p.x < 32.0 && p.y > 20.0);
    let mask = (0..600 * 450)
        .map(|i| u8::from(floor(vec2(f64::from(i % 600) + 0.5, 450.0 - f64::from(i / 600) - 0.5) * 0.1)))
        .collect();
    let plan = FloorPlan::from_mask(600, 450, 0.1, mask);
    let walls = Walls::trace(&plan, &WallsOptions::default());
    let (routes, navigation) = Navigation::find(&plan, &walls, &RoutesOptions::default()).expect("default routes");
    let people = People::new(1, BodyOptions::default());
    let mut group = c.benchmark_group("crowd");
    group.sample_size(10);
    group.bench_function("1000 people from opening to opening", |b| {
        b.iter(|| {
            let options = CrowdOptions::default();
            let mut crowd = Simulation::with_navigation(&plan, &walls, &routes, navigation.clone(), &people, &options)
                .expect("a crowd");
            let mut frame = Frame::default();
            while crowd.next_frame(&mut frame).expect("a step") {}
            crowd.tally().arrived
        })
    });
    group.finish();
}

criterion_group!(benches, default_scenario);

fn main() {
    // Without arguments to pick a benchmark: cargo passes --bench.
    if std::env::args().skip(1).all(|argument| argument == "--bench") {
        table();
    }
    benches();
    Criterion::default().configure_from_args().final_summary();
}
