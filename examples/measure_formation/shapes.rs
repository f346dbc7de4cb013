//! A crowd that walks on a grid, and the formations that it is led to.

use std::f64::consts::TAU;

use trodden::formation::KeyFormation;
use trodden::math::{SplitMix64, Vec2, sin_cos, vec2};
use trodden::motion::Ensemble;

use super::FPS;

fn grid(people: usize) -> Vec<Vec2> {
    let columns = ((people as f64).sqrt().round() as usize).max(1);
    (0..people).map(|k| vec2((k % columns) as f64, (k / columns) as f64)).collect()
}

/// A grid at the start, a ring in the middle, a triangle at the end.
pub fn keys(people: usize, end_s: f64) -> Vec<KeyFormation> {
    let radius_m = people as f64 / TAU;
    let ring = (0..people).map(|k| {
        let (sine, cosine) = sin_cos(TAU * k as f64 / people as f64);
        vec2(cosine, sine) * radius_m
    });
    let rows = (0..).flat_map(|row: usize| (0..=row).map(move |k| (row as f64, k as f64)));
    let triangle = rows.take(people).map(|(row, k)| vec2(k - row / 2.0, -row * 0.866));
    [(0.0, grid(people)), (end_s / 2.0, ring.collect()), (end_s, triangle.collect())]
        .map(|(time_s, places_m)| KeyFormation { time_s, places_m })
        .to_vec()
}

/// People who walk on a grid: each sways to the sides once in two steps, pulses with each step, and drifts a little, all at
/// a pace and phase of their own.
pub fn walk(people: usize, moments: usize) -> Ensemble {
    let mut dice = SplitMix64::new(3);
    let gaits: Vec<[f64; 5]> = (0..people)
        .map(|_| {
            [(1.6, 2.0), (0.0, TAU), (0.0, TAU), (0.0, TAU), (0.0, TAU)].map(|(low, high)| range(&mut dice, low, high))
        })
        .collect();
    let places = grid(people);
    let mut places_m = Vec::with_capacity(people * moments);
    for moment in 0..moments {
        let time_s = moment as f64 / FPS;
        for (place, [steps_s, sway, pulse, drift_x, drift_y]) in places.iter().zip(&gaits) {
            let wave = |per_s: f64, phase: f64| sin_cos(TAU * per_s * time_s + phase).0;
            let own = vec2(
                0.018 * wave(*steps_s, *pulse) + 0.05 * wave(0.11, *drift_x),
                0.03 * wave(steps_s / 2.0, *sway) + 0.05 * wave(0.09, *drift_y),
            );
            places_m.push(*place + own + vec2(1.2 * time_s, 0.1 * wave(0.2, 0.0)));
        }
    }
    Ensemble::new(FPS, 0.0, (0..people as u32).collect(), places_m)
}

fn range(dice: &mut SplitMix64, low: f64, high: f64) -> f64 {
    low + (high - low) * ((dice.next_u64() >> 11) as f64 / (1u64 << 53) as f64)
}
