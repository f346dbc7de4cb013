//! Hashed value noise: the same on every machine, no state.

use trodden::math::{SplitMix64, Vec2, vec2};

/// Uniform in `[0, 1)`, fixed for a lattice point and a seed.
pub fn hash(i: i64, j: i64, seed: u64) -> f64 {
    let word = (i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15)
        ^ (j as u64).rotate_left(32)
        ^ seed.wrapping_mul(0xd1b5_4a32_d192_ed03);
    let mut stream = SplitMix64::new(word);
    stream.next_u64();
    f64::from(stream.unit())
}

/// Smooth noise in `[-1, 1]` whose lumps are about `size` across.
pub fn value(p: Vec2, size: f64, seed: u64) -> f64 {
    let (x, y) = (p.x / size, p.y / size);
    let (i, j) = (x.floor(), y.floor());
    let (s, t) = (ease(x - i), ease(y - j));
    let at = |di: i64, dj: i64| hash(i as i64 + di, j as i64 + dj, seed);
    let low = at(0, 0) + (at(1, 0) - at(0, 0)) * s;
    let high = at(0, 1) + (at(1, 1) - at(0, 1)) * s;
    2.0 * (low + (high - low) * t) - 1.0
}

/// Several octaves of [`value`], each half the size and 0.6 of the strength; about `[-1, 1]`.
pub fn cloudy(p: Vec2, size: f64, octaves: u32, seed: u64) -> f64 {
    let (mut sum, mut total, mut weight, mut size, mut p) = (0.0, 0.0, 1.0, size, p);
    for octave in 0..octaves {
        // Turned at every octave (by an angle with cosine 0.8), so that no lattice shows.
        p = p.rotated(vec2(0.8, 0.6));
        sum += weight * value(p, size, seed.wrapping_add(u64::from(octave)));
        total += weight;
        weight *= 0.6;
        size *= 0.5;
    }
    sum / total
}

fn ease(t: f64) -> f64 {
    t * t * (3.0 - 2.0 * t)
}
