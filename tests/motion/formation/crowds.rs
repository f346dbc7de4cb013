//! Formations and examples to try the method on.

use trodden::math::{SplitMix64, Vec2, sin_cos, vec2};
use trodden::motion::Ensemble;

/// Random numbers in `[-1, 1)`.
pub struct Dice(SplitMix64);

impl Dice {
    pub fn new(seed: u64) -> Dice {
        Dice(SplitMix64::new(seed))
    }

    pub fn next(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

pub fn grid(people: usize, columns: usize, spacing_m: f64) -> Vec<Vec2> {
    (0..people).map(|k| vec2((k % columns) as f64 * spacing_m, (k / columns) as f64 * spacing_m)).collect()
}

pub fn ring(people: usize, spacing_m: f64, first: usize) -> Vec<Vec2> {
    let radius_m = spacing_m * people as f64 / std::f64::consts::TAU;
    let at = |k: usize| {
        let (sine, cosine) = sin_cos(std::f64::consts::TAU * ((k + first) % people) as f64 / people as f64);
        vec2(radius_m * cosine, radius_m * sine)
    };
    (0..people).map(at).collect()
}

/// Rows of 1, 2, 3, ... people.
pub fn triangle(people: usize, spacing_m: f64) -> Vec<Vec2> {
    let mut places = Vec::new();
    let mut row = 0;
    while places.len() < people {
        for k in 0..=row {
            places.push(vec2(k as f64 - row as f64 / 2.0, -(row as f64) * 0.75f64.sqrt()) * spacing_m);
        }
        row += 1;
    }
    places.truncate(people);
    places
}

pub fn line(people: usize, spacing_m: f64) -> Vec<Vec2> {
    (0..people).map(|k| vec2(k as f64 * 0.6, k as f64 * 0.8) * spacing_m).collect()
}

pub fn scattered(people: usize, seed: u64) -> Vec<Vec2> {
    let mut dice = Dice::new(seed);
    let half_m = (people as f64).sqrt() * 0.7;
    (0..people).map(|_| vec2(dice.next() * half_m, dice.next() * half_m)).collect()
}

/// People who walk in a formation to the right as people do: each sways to the sides once in two steps, pulses with each
/// step, and drifts a little, all at a pace and phase of their own.
pub fn walking(places_m: &[Vec2], fps: f64, seconds: f64, seed: u64) -> Ensemble {
    walking_between(|_| places_m.to_vec(), fps, seconds, seed)
}

/// The same in a formation that changes with the share of the time.
pub fn walking_between(formation: impl Fn(f64) -> Vec<Vec2>, fps: f64, seconds: f64, seed: u64) -> Ensemble {
    let people = formation(0.0).len();
    let moments = (fps * seconds).round() as usize + 1;
    let mut dice = Dice::new(seed);
    let gaits: Vec<[f64; 6]> = (0..people)
        .map(|_| {
            let steps_s = 1.8 + 0.2 * dice.next();
            [
                steps_s,
                dice.next() * 3.2,
                dice.next() * 3.2,
                0.03 + 0.01 * dice.next(),
                dice.next() * 3.2,
                dice.next() * 3.2,
            ]
        })
        .collect();
    let mut places_m = Vec::with_capacity(people * moments);
    for moment in 0..moments {
        let time_s = moment as f64 / fps;
        let formation = formation(moment as f64 / (moments - 1) as f64);
        for (place, [steps_s, sway, pulse, amplitude_m, drift_x, drift_y]) in formation.iter().zip(&gaits) {
            let wave = |per_s: f64, phase: f64| sin_cos(std::f64::consts::TAU * per_s * time_s + phase).0;
            let own = vec2(
                0.6 * amplitude_m * wave(*steps_s, *pulse) + 0.05 * wave(0.11, *drift_x),
                amplitude_m * wave(steps_s / 2.0, *sway) + 0.05 * wave(0.09, *drift_y),
            );
            places_m.push(*place + own + vec2(1.2 * time_s, 0.1 * wave(0.2, 0.0)));
        }
    }
    Ensemble::new(fps, 2.0, (0..people as u32).map(|id| 3 * id + 1).collect(), places_m)
}

/// The largest distance between two people of the same number.
pub fn farthest_m(a: &[Vec2], b: &[Vec2]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

/// People who stroll about within a round place, each turning as they like.
pub fn strolling(people: usize, fps: f64, seconds: f64, seed: u64) -> Ensemble {
    let mut dice = Dice::new(seed);
    let radius_m = (people as f64).sqrt() * 0.9;
    let mut places = scattered(people, seed);
    let mut headings: Vec<f64> = places.iter().map(|_| dice.next() * 3.2).collect();
    let mut turns = vec![0.0; people];
    let moments = (fps * seconds).round() as usize + 1;
    let mut places_m = Vec::with_capacity(people * moments);
    for _ in 0..moments {
        places_m.extend_from_slice(&places);
        for ((place, heading), turn) in places.iter_mut().zip(&mut headings).zip(&mut turns) {
            *turn += (1.4 * dice.next() - 0.6 * *turn) / fps.sqrt() / 2.0;
            *heading += *turn / fps;
            let (sine, cosine) = sin_cos(*heading);
            if place.length() > radius_m && vec2(cosine, sine).dot(*place) > 0.0 {
                *heading += 3.0 / fps;
            }
            *place += vec2(cosine, sine) * (0.9 / fps);
        }
    }
    Ensemble::new(fps, 2.0, (0..people as u32).collect(), places_m)
}
