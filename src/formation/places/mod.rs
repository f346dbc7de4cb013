//! Positions of key formations: shapes, letters, drawn points, in metres relative to the centroid; up is forward.

mod letters;
mod shapes;
mod spread;

pub(super) use letters::{strokes, unknown_letters};
pub(super) use shapes::{Strokes, disc, grid, grid_of, line, outline, polygon, ranks_of_triangle, rings, star, wedge};
pub(super) use spread::spread;

use crate::math::{Vec2, vec2};

/// Centroid of positions; the origin for an empty list.
pub(super) fn centroid(places: &[Vec2]) -> Vec2 {
    places.iter().fold(Vec2::ZERO, |sum, &place| sum + place) / places.len().max(1) as f64
}

/// Positions relative to their centroid.
pub(super) fn centred(places: &[Vec2]) -> Vec<Vec2> {
    let middle = centroid(places);
    places.iter().map(|&place| place - middle).collect()
}

/// Positions rotated around the origin, counter-clockwise.
pub(super) fn turned(places: &[Vec2], angle_rad: f64) -> Vec<Vec2> {
    let (sin, cos) = crate::math::sin_cos(angle_rad);
    places.iter().map(|place| place.rotated(vec2(cos, sin))).collect()
}

/// Distance between the two positions that are closest.
#[cfg(test)]
fn nearest_m(places: &[Vec2]) -> f64 {
    let pairs = (0..places.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
    pairs.map(|(a, b)| places[a].distance(places[b])).fold(f64::INFINITY, f64::min)
}
