//! The feet of a simulated crowd in a corridor with a narrow end, where people queue up.

use std::collections::BTreeMap;

use trodden::crowd::{CrowdOptions, Simulation};
use trodden::marks::{HeelOptions, MarksOptions};
use trodden::math::atan2;
use trodden::motion::{BodyOptions, Frame, Motion, People};
use trodden::patterns::PatternLibrary;
use trodden::plan::FloorPlan;
use trodden::routes::{self, PlaceRequest, RouteRequest, RoutesOptions};
use trodden::walls::{Walls, WallsOptions};

use super::measure::{Floor, Path, Step, by_speed, measured_step_m, spread, steps};

/// A corridor of 30 x 2.4 m that ends in a door of 0.9 m, and everybody's way through it.
fn congested(time_step: f64) -> (Floor, Vec<Path>) {
    let (width, height) = (600, 48);
    let floor = |x: u32, y: u32| (2..46).contains(&y) && (!(440..444).contains(&x) || (15..33).contains(&y));
    let mask = (0..width * height).map(|at| u8::from(floor(at % width, at / width))).collect();
    let plan = FloorPlan::from_mask(width, height, 0.05, mask);
    let walls = Walls::trace(&plan, &WallsOptions::default());
    let people = People::new(3, BodyOptions::default());
    let options = CrowdOptions { people: 160, entry_seconds: Some(70.0), time_step, ..CrowdOptions::default() };
    let [from, to] = ["west", "east"].map(|side| PlaceRequest::Opening(side.to_owned()));
    let route = RouteRequest { from, to, ..RouteRequest::default() };
    let found =
        routes::find(&plan, &walls, &RoutesOptions { routes: vec![route], ..RoutesOptions::default() }).unwrap();
    let mut paths: BTreeMap<u32, Path> = BTreeMap::new();
    let mut crowd = Simulation::new(&plan, &walls, &found, &people, &options).unwrap();
    let mut frame = Frame::default();
    while crowd.next_frame(&mut frame).unwrap() {
        for walker in &frame.walkers {
            let path = paths.entry(walker.id).or_insert_with(|| Path { id: walker.id, at: Vec::new() });
            path.at.push((frame.time_s, *walker));
        }
    }
    let library = PatternLibrary::built_in();
    let floor = Floor { people, walls, library, options: MarksOptions::default(), crowd: 160 };
    (floor, paths.into_values().filter(|path| path.at.len() > 10).collect())
}

#[test]
fn a_crowd_that_queues_up_walks_on_feet_like_people() {
    let (floor, paths) = congested(0.1);
    let mut all = Vec::new();
    let mut turns = Vec::new();
    for path in &paths {
        let feet = floor.feet(path);
        all.extend(steps(path, &feet));
        turns.extend(feet.windows(3).map(|f| atan2(f[0].heading.cross(f[2].heading), f[0].heading.dot(f[2].heading))));
    }
    let rows = by_speed("corridor with a narrow end", &all, 0.2);
    let [_, turn_sd] = spread(turns.iter().map(|turn| turn.to_degrees()));
    println!("the same foot turns by {turn_sd:.1} degrees from step to step");
    let mut bins = 0;
    for &(speed, length, count) in &rows {
        if speed < 0.4 || count < 200 {
            continue;
        }
        let law = measured_step_m(speed);
        assert!((length / law - 1.0).abs() < 0.1, "{length:.3} m at {speed:.2} m/s, measured {law:.3}");
        bins += 1;
    }
    assert!(bins >= 4, "{bins} bins of speed hold enough steps");
    let slow: Vec<&Step> = all.iter().filter(|step| step.speed_m_s < 0.4).collect();
    assert!(slow.len() > 300, "{} slow steps: nothing congested", slow.len());
    let [length, _] = spread(slow.iter().map(|step| step.length_m));
    assert!((0.12..0.36).contains(&length), "slow steps of {length} m");
    let [_, toe_sd] = spread(all.iter().filter(|s| s.speed_m_s > 0.4).map(|s| s.toe_out_rad.to_degrees()));
    assert!(toe_sd < 7.0 && turn_sd < 20.0, "toe-out +- {toe_sd}, from step to step {turn_sd} degrees");
}

#[test]
fn a_jostling_crowd_leaves_as_much_at_half_the_frames() {
    let (mut floor, paths) = congested(0.05);
    floor.options.heel =
        HeelOptions { per_metre: 0.05, per_radian: 0.2, per_stop: 0.2, per_second_stood: 0.02, ..floor.options.heel };
    let count = |every: usize| {
        let seen = paths.iter().map(|path| path.thinned(every)).filter(|path| path.at.len() > 10);
        seen.fold([0.0, 0.0], |[heels, feet], path| {
            [heels + floor.heels(&path) as f64, feet + floor.feet(&path).len() as f64]
        })
    };
    let ([heels, feet], [half_heels, half_feet]) = (count(1), count(2));
    println!("{feet} footfalls and {heels} heel marks, {half_feet} and {half_heels} at half the frames");
    assert!((half_feet / feet - 1.0).abs() < 0.03 && (half_heels / heels - 1.0).abs() < 0.03);
}
