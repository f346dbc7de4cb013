//! Patterns of pieces in plan space: flecks, chips, cracks and the grain of boards. As the noise they have the same value
//! at a place for any window, without storage.

use super::noise;
use crate::math::smoothstep_f32;

/// A hashed number from 0 to 1.
#[inline]
pub(super) fn unit(key: u32, i: i32, j: i32) -> f32 {
    (noise::hash(key, i, j) >> 8) as f32 / 16_777_216.0
}

/// Another number from 0 to 1 of the same piece.
#[inline]
pub(super) fn again(word: u32, n: u32) -> f32 {
    (noise::mix(word ^ n.wrapping_mul(0x9e37_79b9)) >> 8) as f32 / 16_777_216.0
}

/// Rises smoothly from 0 to 1 while `x` goes from `from` to `to`.
#[inline]
pub(super) fn rise(x: f32, from: f32, to: f32) -> f32 {
    smoothstep_f32((x - from) / (to - from))
}

/// Smooth noise from -1 to 1 with a spot per unit, for patterns that turn or shift from piece to piece.
pub(super) fn smooth(key: u32, x: f64, y: f64) -> f32 {
    let floor = y.floor();
    let g = smoothstep_f32((y - floor) as f32);
    let j = floor as i64 as i32;
    let (below, above) = (smooth_along(key, x, j), smooth_along(key, x, j.wrapping_add(1)));
    below + g * (above - below)
}

/// [`smooth`] along the row `j`.
#[inline]
pub(super) fn smooth_along(key: u32, x: f64, j: i32) -> f32 {
    let i = x.floor();
    let f = smoothstep_f32((x - i) as f32);
    let i = i as i64 as i32;
    let (a, b) = (noise::signed(key, i, j), noise::signed(key, i.wrapping_add(1), j));
    a + f * (b - a)
}

/// Smooth noise of `octaves` halving sizes.
pub(super) fn cloudy(key: u32, x: f64, y: f64, octaves: u32) -> f32 {
    let (mut sum, mut size, mut gain) = (0.0, 1.0, 0.55);
    for octave in 0..octaves {
        sum += gain * smooth(key.wrapping_add(octave), x * size, y * size);
        size *= 2.07;
        gain *= 0.55;
    }
    sum
}

/// The two nearest of points that are strewn one to a unit square.
#[derive(Clone, Copy)]
pub(super) struct Nearest {
    /// Distances to the nearest point and to the next one.
    pub first: f32,
    pub second: f32,
    /// Hash of the nearest point.
    pub word: u32,
}

pub(super) fn nearest(key: u32, x: f64, y: f64) -> Nearest {
    let (i, j) = (x.floor(), y.floor());
    let (f, g) = ((x - i) as f32, (y - j) as f32);
    let (i, j) = (i as i64 as i32, j as i64 as i32);
    let mut found = Nearest { first: f32::INFINITY, second: f32::INFINITY, word: 0 };
    for dj in -1..=1 {
        for di in -1..=1 {
            let word = noise::hash(key, i.wrapping_add(di), j.wrapping_add(dj));
            let [u, v] = [word & 0xffff, word >> 16].map(|half| half as f32 / 65_536.0);
            let (dx, dy) = (di as f32 + u - f, dj as f32 + v - g);
            let squared = dx * dx + dy * dy;
            if squared < found.first {
                found = Nearest { first: squared, second: found.first, word };
            } else if squared < found.second {
                found.second = squared;
            }
        }
    }
    Nearest { first: found.first.sqrt(), second: found.second.sqrt(), ..found }
}
