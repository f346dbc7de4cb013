//! Crowds under social forces on the plans of the crowd's tests.

use trodden::crowd::{CrowdModel, CrowdOptions, GroupOptions, Simulation, Tally};
use trodden::motion::{BodyOptions, Frame, Motion, People};

pub use super::plans::{Scene, across, area, opening, route};

/// Everybody in groups of the sizes 1 to 4 in these proportions.
pub fn social(people: u32, shares: [f64; 4]) -> CrowdOptions {
    CrowdOptions {
        model: CrowdModel::SocialForce,
        people,
        groups: GroupOptions { shares, ..GroupOptions::default() },
        ..CrowdOptions::default()
    }
}

/// Nobody in company.
pub const ALONE: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

/// As many groups of each size.
pub const MIXED: [f64; 4] = [1.0; 4];

/// Everybody is there at once, walks round and round a corridor of this length, for so many seconds.
pub fn endless(people: u32, shares: [f64; 4], length_m: f64, seconds: f64) -> CrowdOptions {
    CrowdOptions {
        entry_seconds: Some(0.0),
        end_seconds: Some(seconds),
        period_x: Some(length_m),
        ..social(people, shares)
    }
}

pub fn crowd<'a>(scene: &'a Scene, options: &CrowdOptions, seed: u64) -> Simulation<'a> {
    let people = People::new(seed, BodyOptions::default());
    let navigation = scene.navigation.clone();
    Simulation::with_navigation(&scene.plan, &scene.walls, &scene.routes, navigation, &people, options).unwrap()
}

/// Walks to the end.
pub fn walk(scene: &Scene, options: &CrowdOptions, seed: u64, mut see: impl FnMut(&Frame, &Simulation<'_>)) -> Tally {
    let mut crowd = crowd(scene, options, seed);
    let mut frame = Frame::default();
    while crowd.next_frame(&mut frame).unwrap() {
        see(&frame, &crowd);
    }
    crowd.tally()
}

pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

pub fn deviation(values: &[f64]) -> f64 {
    let mean = mean(values);
    (values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / values.len().max(1) as f64).sqrt()
}
