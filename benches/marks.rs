//! How fast frames become marks: people of a frame per second, on one thread. Once from places alone, once with where
//! bodies face, as a crowd gives it; and in corridors, where everybody is near walls, with and without touching them.

use std::hint::black_box;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use trodden::marks::{ContactOptions, Footfalls, MarksOptions, Origin};
use trodden::math::{sin_cos, vec2};
use trodden::motion::{BodyOptions, Frame, People, Walker};
use trodden::patterns::PatternLibrary;
use trodden::plan::FloorPlan;
use trodden::walls::{Walls, WallsOptions};

const PEOPLE: u32 = 1000;
const FRAMES: u32 = 200;
const DT_S: f64 = 0.1;

/// A thousand people who weave through a hall of 60 x 60 m with pillars every 6 m.
fn hall() -> Walls {
    let pillar = |n: u32| n % 60 < 6;
    let mask = (0..600 * 600).map(|at| u8::from(!(pillar(at / 600) && pillar(at % 600)))).collect();
    let plan = FloorPlan::from_mask(600, 600, 0.1, mask);
    Walls::trace(&plan, &WallsOptions::default())
}

/// Corridors of 2.4 m, one above the other.
fn corridors() -> Walls {
    let mask = (0..600 * 600).map(|at| u8::from(at / 600 % 27 < 24)).collect();
    let plan = FloorPlan::from_mask(600, 600, 0.1, mask);
    Walls::trace(&plan, &WallsOptions::default())
}

/// People who weave along; `across_m` says about which line.
fn frames(facing: bool, across_m: impl Fn(u32) -> f64) -> Vec<Frame> {
    let frame = |n: u32| {
        let time_s = f64::from(n) * DT_S;
        let walker = |id: u32| {
            let (weave, slope) = sin_cos(0.4 * time_s + f64::from(id));
            let along = f64::from(id % 40) + 1.0 + 1.2 * time_s;
            Walker {
                id,
                position_m: vec2(along, across_m(id) + 0.7 * weave),
                velocity_m_s: vec2(1.2, 0.0),
                heading: facing.then_some(vec2(1.2, 0.4 * slope)),
            }
        };
        Frame { time_s, walkers: (0..PEOPLE).map(walker).collect() }
    };
    (0..FRAMES).map(frame).collect()
}

fn marks(c: &mut Criterion) {
    let (hall, corridors) = (hall(), corridors());
    let people = People::new(1, BodyOptions::default());
    let library = PatternLibrary::built_in();
    let mut group = c.benchmark_group("marks");
    group.throughput(Throughput::Elements(u64::from(PEOPLE * FRAMES)));
    group.sample_size(20);
    let in_hall = |id: u32| 1.0 + 0.058 * f64::from(id);
    let in_corridor = |id: u32| 1.5 + 2.7 * f64::from(id % 22);
    let untouched = ContactOptions::none();
    for (name, walls, frames, contact) in [
        ("people of a frame", &hall, frames(false, in_hall), ContactOptions::default()),
        ("people of a frame who face somewhere", &hall, frames(true, in_hall), ContactOptions::default()),
        ("people in corridors", &corridors, frames(true, in_corridor), ContactOptions::default()),
        ("people in corridors who touch no wall", &corridors, frames(true, in_corridor), untouched),
    ] {
        let options = MarksOptions { contact, ..MarksOptions::default() };
        group.bench_function(name, |b| {
            let stage = || {
                let origins = Origin::of_arrivals(vec![true; PEOPLE as usize].into_iter(), 300);
                Footfalls::new(&people, walls, &library, &options, origins).expect("the defaults are in range")
            };
            b.iter_batched(
                stage,
                |mut stage| {
                    let (mut out, mut contacts) = (Vec::with_capacity(100_000), Vec::new());
                    for frame in &frames {
                        stage.push(frame, &mut out);
                    }
                    stage.finish(&mut out);
                    stage.take_contacts(&mut contacts);
                    black_box(out.len() + contacts.len())
                },
                BatchSize::PerIteration,
            );
        });
    }
    group.finish();
}

criterion_group!(benches, marks);
criterion_main!(benches);
