//! Vectors, rectangles, random streams, distributions and elementary functions for all stages.
//!
//! Results are bit-identical on every machine: the `libm` crate replaces the platform's libm, there is no fused
//! multiply-add, and values from `rand_distr` are rounded to a coarse grid.

mod assignment;
mod disjoint;
mod distribution;
mod eigen;
mod random;
pub mod srgb;
mod vector;

pub(crate) use assignment::assign;
pub(crate) use disjoint::DisjointSets;
pub use distribution::{Distribution, DistributionError};
pub use eigen::NoConvergence;
pub(crate) use eigen::eigenvectors;
pub use random::SplitMix64;
pub(crate) use random::{Purpose, person_stream, round_to_grid};
pub use vector::{Rect, Vec2, vec2};

/// Sine and cosine of an angle in radians, bit-identical on every machine.
pub fn sin_cos(angle_rad: f64) -> (f64, f64) {
    (libm::sin(angle_rad), libm::cos(angle_rad))
}

/// Angle of the vector `(x, y)`, radians counter-clockwise from +x in `(-pi, pi]`.
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// `e^x`, bit-identical on every machine.
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// Natural logarithm, bit-identical on every machine.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// `base^exponent`, bit-identical on every machine.
pub fn pow(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}

/// From 0 at 0 to 1 at 1 without a kink at either end: 3 t^2 - 2 t^3, constant beyond.
#[inline]
pub(crate) fn smoothstep(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// [`smoothstep`] in single precision.
#[inline]
pub(crate) fn smoothstep_f32(t: f32) -> f32 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// `e^x` in single precision for inner loops, branch-free so that it vectorises.
///
/// Relative error below 4e-7 over `[-87, 88]`; arguments beyond are clamped to that range.
/// Formula: `2^n * p(r)` with `x = n ln 2 + r`, `|r| <= ln 2 / 2`, `p` the Taylor polynomial of degree 6.
#[inline]
pub(crate) fn exp_f32(x: f32) -> f32 {
    const LN2_HIGH: f32 = 0.693_359_4;
    const LN2_LOW: f32 = -2.121_944_4e-4;
    // Adding and taking away 1.5 * 2^23 rounds to the nearest integer without a branch or a libm call.
    const ROUND: f32 = 12_582_912.0;
    let x = x.clamp(-87.0, 88.0);
    let shifted = x * std::f32::consts::LOG2_E + ROUND;
    let n = shifted - ROUND;
    let r = (x - n * LN2_HIGH) - n * LN2_LOW;
    let p = 1.0 + r * (1.0 + r * (0.5 + r * (1.0 / 6.0 + r * (1.0 / 24.0 + r * (1.0 / 120.0 + r * (1.0 / 720.0))))));
    // The lowest bits of `shifted` are n; a cast would check the range of each float.
    let scale = f32::from_bits(shifted.to_bits().wrapping_sub(ROUND.to_bits()).wrapping_add(127) << 23);
    p * scale
}

/// Natural logarithm of a positive, normal number in single precision for inner loops, branch-free so that it
/// vectorises.
///
/// Error below 3e-7 of the larger of 1 and the result. Formula: `n ln 2 + 2 artanh s` with `x = 2^n m`,
/// `sqrt(1/2) <= m < sqrt 2`, `s = (m - 1) / (m + 1)`, by the series of artanh to `s^9`.
#[inline]
pub(crate) fn ln_f32(x: f32) -> f32 {
    const SQRT_HALF: u32 = 0x3f35_04f3;
    let shifted = x.to_bits().wrapping_sub(SQRT_HALF);
    let n = (shifted as i32 >> 23) as f32;
    let m = f32::from_bits((shifted & 0x007f_ffff).wrapping_add(SQRT_HALF));
    let s = (m - 1.0) / (m + 1.0);
    let squared = s * s;
    let series = 1.0 + squared * (1.0 / 3.0 + squared * (1.0 / 5.0 + squared * (1.0 / 7.0 + squared * (1.0 / 9.0))));
    n * std::f32::consts::LN_2 + 2.0 * s * series
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ln_f32_is_close_to_libm() {
        for step in 1..200_000 {
            let x = step as f32 * step as f32 / 1000.0;
            let truth = ln(f64::from(x));
            let error = (f64::from(ln_f32(x)) - truth).abs() / truth.abs().max(1.0);
            assert!(error < 3e-7, "ln({x}) is off by {error:e}");
        }
    }

    #[test]
    fn exp_f32_is_close_to_libm_over_its_range() {
        for step in -8600..8800 {
            let x = step as f32 / 100.0;
            let truth = exp(f64::from(x));
            let error = (f64::from(exp_f32(x)) - truth).abs() / truth;
            assert!(error < 4e-7, "exp({x}) is off by {error:e}");
        }
    }

    #[test]
    fn exp_f32_clamps_instead_of_overflowing() {
        assert!(exp_f32(1e9).is_finite());
        assert!(exp_f32(-1e9) > 0.0);
    }
}
