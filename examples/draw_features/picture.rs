//! A picture of where everybody goes, the same scale for all crowds.

use image::{Rgb, RgbImage};
use trodden::math::Vec2;
use trodden::motion::Ensemble;

/// Side of the picture, pixels.
const SIDE_PX: u32 = 360;
/// What lies at the picture's edge, metres from its middle.
const REACH_M: f64 = 9.5;
/// Dots are drawn so many times finer, and averaged.
const FINER: u32 = 3;
/// Metres between two dots of a trajectory.
const STEP_M: f64 = 0.02;

const PAPER: [f64; 3] = [250.0, 250.0, 248.0];
const START: [f64; 3] = [40.0, 50.0, 90.0];
const END: [f64; 3] = [250.0, 150.0, 40.0];

/// Trajectories from dark to bright, with a dot where each ends.
pub fn trajectories(crowd: &Ensemble) -> RgbImage {
    let side = SIDE_PX * FINER;
    let mut fine = RgbImage::from_pixel(side, side, Rgb(PAPER.map(|value| value as u8)));
    let last = crowd.moments() - 1;
    for moment in 0..last {
        let ends = crowd.places_at(moment).iter().zip(crowd.places_at(moment + 1));
        for (&from, &to) in ends {
            let dots = (from.distance(to) / STEP_M).ceil().clamp(1.0, 1000.0) as usize;
            for dot in 0..dots {
                let share = dot as f64 / dots as f64;
                stamp(&mut fine, from.lerp(to, share), 0.045, (moment as f64 + share) / last as f64);
            }
        }
    }
    crowd.places_at(last).iter().for_each(|&place| stamp(&mut fine, place, 0.13, 1.0));
    image::imageops::thumbnail(&fine, SIDE_PX, SIDE_PX)
}

/// A dot whose colour says the share of the time that has gone.
fn stamp(picture: &mut RgbImage, at: Vec2, radius_m: f64, share: f64) {
    let side = f64::from(picture.width());
    let pixels_per_metre = side / (2.0 * REACH_M);
    let [x, y] = [(at.x + REACH_M) * pixels_per_metre, side - (at.y + REACH_M) * pixels_per_metre];
    let radius = radius_m * pixels_per_metre;
    let colour = Rgb(std::array::from_fn(|k| (START[k] + (END[k] - START[k]) * share) as u8));
    let range = |middle: f64| ((middle - radius).max(0.0) as u32)..=((middle + radius).clamp(0.0, side - 1.0) as u32);
    for v in range(y) {
        for u in range(x) {
            let (dx, dy) = (f64::from(u) + 0.5 - x, f64::from(v) + 0.5 - y);
            if dx * dx + dy * dy <= radius * radius {
                picture.put_pixel(u, v, colour);
            }
        }
    }
}
