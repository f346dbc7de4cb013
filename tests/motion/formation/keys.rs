//! Key formations come back, and nothing jumps between them.

use trodden::Silent;
use trodden::formation::{Carry, Ease, FormationOptions, KeyFormation, interpolate};
use trodden::math::{Vec2, vec2};
use trodden::motion::Ensemble;

use super::crowds::{farthest_m, grid, line, ring, scattered, triangle, walking};

fn formations(people: usize) -> Vec<(&'static str, Vec<Vec2>)> {
    let columns = (people as f64).sqrt().ceil() as usize;
    vec![
        ("grid", grid(people, columns, 1.0)),
        ("ring", ring(people, 1.0, 0)),
        ("ring one on", ring(people, 1.0, 1)),
        ("ring turned over", {
            let mut ring = ring(people, 1.0, 0);
            ring.reverse();
            ring
        }),
        ("triangle", triangle(people, 0.9)),
        ("line", line(people, 0.8)),
        ("scattered", scattered(people, 7)),
        ("scattered otherwise", scattered(people, 8)),
        ("on one point", vec![vec2(3.0, 4.0); people]),
        ("two groups far apart", (0..people).map(|k| vec2(if k % 2 == 0 { 0.0 } else { 5e3 }, k as f64)).collect()),
    ]
}

#[test]
fn every_key_comes_back() {
    for people in [2, 3, 4, 7, 9, 16, 25, 60] {
        let all = formations(people);
        let example = walking(&all[people % 3].1, 5.0, (all.len() - 1) as f64, 5);
        let keys: Vec<KeyFormation> = all
            .iter()
            .enumerate()
            .map(|(k, (_, places_m))| KeyFormation { time_s: 2.0 + k as f64, places_m: places_m.clone() })
            .collect();
        for carry in [Carry::Shapes, Carry::People] {
            let options = FormationOptions { carry, ease: Ease::Rest, ..FormationOptions::default() };
            let motion = interpolate(&example, &keys, &options, &Silent).unwrap();
            assert_eq!((motion.start_s, motion.moments(), &motion.ids), (2.0, 5 * (all.len() - 1) + 1, &example.ids));
            for (k, (name, places_m)) in all.iter().enumerate() {
                let off_m = farthest_m(motion.places_at(5 * k), places_m);
                assert!(off_m < 1e-6, "{people} people, {name}: off by {off_m:e} m");
            }
        }
    }
}

/// Twelve people who wander up to 2 m about hold a ring for ten seconds of twenty.
#[test]
fn a_held_formation_is_kept_within_a_quarter_of_a_metre() {
    for seed in 1..=3 {
        let turn = |x: f64| trodden::math::sin_cos(x).0;
        let person = |k: u32| f64::from(k) * 1.7 + f64::from(seed);
        let wander = |n: u32, k: u32| {
            let t = 0.1 * f64::from(n);
            vec2(2.0 * turn(0.3 * t + person(k)), 2.0 * turn(0.23 * t + 2.0 * person(k)))
        };
        let wanders = (0..201).flat_map(|n| (0..12).map(move |k| wander(n, k))).collect();
        let example = Ensemble::new(10.0, 0.0, (0..12).collect(), wanders);
        let ring: Vec<Vec2> = (0..12)
            .map(|k| {
                vec2(3.0, 0.0).rotated({
                    let (sin, cos) = trodden::math::sin_cos(f64::from(k) * std::f64::consts::FRAC_PI_6);
                    vec2(cos, sin)
                })
            })
            .collect();
        let key = |time_s, places_m: &[Vec2]| KeyFormation { time_s, places_m: places_m.to_vec() };
        let row: Vec<Vec2> = (0..12).map(|k| vec2(f64::from(k), 0.0)).collect();
        let keys = [key(0.0, &row), key(5.0, &ring), key(15.0, &ring), key(20.0, &row)];
        let made = interpolate(&example, &keys, &FormationOptions::default(), &Silent).unwrap();
        let off_m = |n: usize| made.places_at(n).iter().zip(&ring).map(|(a, b)| a.distance(*b)).collect::<Vec<f64>>();
        let all: Vec<f64> = (50..=150).flat_map(off_m).collect();
        let [mean_m, most_m] = [all.iter().sum::<f64>() / all.len() as f64, all.iter().copied().fold(0.0, f64::max)];
        println!("seed {seed}: {mean_m:.3} m off in the mean, {most_m:.3} m at most");
        assert!(mean_m > 0.1 && mean_m < 0.25 && most_m <= 0.25, "seed {seed}: {mean_m} m, at most {most_m} m");
        // Nobody jumps where the hold begins and ends.
        let options = FormationOptions { carry: Carry::People, ease: Ease::Rest, ..FormationOptions::default() };
        let made = interpolate(&example, &keys, &options, &Silent).unwrap();
        let step = |n: usize, k: usize| made.places_at(n + 1)[k] - made.places_at(n)[k];
        for (n, k) in [49, 50, 149, 150].into_iter().flat_map(|n| (0..12).map(move |k| (n, k))) {
            let jump_m = (step(n, k) - step(n - 1, k)).length();
            assert!(jump_m < 0.06, "seed {seed}: a step of person {k} changes by {jump_m} m at {n}");
        }
    }
}
