//! Key formations come back, and nothing jumps between them.

use trodden::Silent;
use trodden::formation::{Carry, Ease, FormationOptions, KeyFormation, interpolate};
use trodden::math::{Vec2, vec2};

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
