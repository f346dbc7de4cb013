//! The sRGB transfer function (IEC 61966-2-1): between encoded colour values and linear light.

use std::sync::LazyLock;

use super::pow;

/// An 8-bit sRGB colour, `[red, green, blue]`.
pub type Srgb8 = [u8; 3];

/// Linear light of an sRGB value, both 0 to 1.
pub(crate) fn decode(value: f64) -> f64 {
    if value <= 0.04045 { value / 12.92 } else { pow((value + 0.055) / 1.055, 2.4) }
}

/// The sRGB value of linear light, both 0 to 1.
pub(crate) fn encode(light: f64) -> f64 {
    if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * pow(light, 1.0 / 2.4) - 0.055 }
}

/// The sRGB value, 0 to 255 and not rounded, of linear light, 0 to 1: for inner loops over texels.
///
/// A polynomial in the fourth root (the curve is 1.055 root^(5/3) - 0.055), fitted at Chebyshev points: off by less than
/// 0.003 of an 8-bit step, and compilers vectorise it.
#[inline]
pub(crate) fn encode_f32(light: f32) -> f32 {
    let light = light.clamp(0.0, 1.0);
    let t = light.sqrt().sqrt();
    let curve = -15.678_25 + t * (41.691_35 + t * (318.693_94 + t * (-144.683_87 + t * (71.647_62 + t * -16.672_062))));
    if light <= 0.003_130_8 { 255.0 * 12.92 * light } else { curve }
}

/// Linear light of each sRGB byte, 0 to 1.
static LIGHT: LazyLock<[f64; 256]> = LazyLock::new(|| std::array::from_fn(|byte| decode(byte as f64 / 255.0)));

/// Linear light of each sRGB byte, 0 to 65 535.
static LINEAR: LazyLock<[u16; 256]> = LazyLock::new(|| LIGHT.map(|light| (light * 65_535.0).round() as u16));

/// The sRGB byte nearest to each linear light.
static NEAREST: LazyLock<Vec<u8>> = LazyLock::new(|| (0..=u16::MAX).map(nearest).collect());

fn nearest(linear: u16) -> u8 {
    let above = LINEAR.partition_point(|&l| l < linear).min(255);
    let below = above.saturating_sub(1);
    if LINEAR[above] - linear.min(LINEAR[above]) <= linear.abs_diff(LINEAR[below]) { above as u8 } else { below as u8 }
}

/// Linear light, 0 to 1, of an sRGB byte.
pub fn light(byte: u8) -> f32 {
    LIGHT[usize::from(byte)] as f32
}

/// Linear light, 0 to 1, of an sRGB colour.
pub(crate) fn light_of(colour: Srgb8) -> [f32; 3] {
    colour.map(light)
}

/// Linear light of an sRGB byte, 0 to 65 535: sums of it do not depend on their order.
#[inline]
pub(crate) fn to_linear(byte: u8) -> u16 {
    LINEAR[usize::from(byte)]
}

/// The sRGB byte nearest to a linear light of 0 to 65 535.
#[inline]
pub(crate) fn from_linear(linear: u16) -> u8 {
    NEAREST[usize::from(linear)]
}

/// Luminance of linear light (Rec. 709 primaries), 0 to 1.
pub(crate) fn luminance([r, g, b]: [f64; 3]) -> f64 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// CIE L* of a luminance.
pub(crate) fn lightness(y: f64) -> f64 {
    if y > 216.0 / 24389.0 { 116.0 * libm::cbrt(y) - 16.0 } else { y * 24389.0 / 27.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_comes_back() {
        for byte in 0..=255 {
            assert_eq!(from_linear(to_linear(byte)), byte);
        }
        assert_eq!((to_linear(0), to_linear(255)), (0, 65_535));
    }

    #[test]
    fn half_of_the_light_is_188() {
        assert_eq!(from_linear(32_768), 188);
    }

    #[test]
    fn the_polynomial_is_the_curve() {
        for byte in 0..=255u8 {
            let back = encode_f32(light(byte));
            assert!((back - f32::from(byte)).abs() < 0.004, "{byte} came back as {back}");
            assert!((255.0 * encode(decode(f64::from(byte) / 255.0)) - f64::from(byte)).abs() < 1e-4);
        }
        assert_eq!((encode_f32(-1.0), encode_f32(0.0)), (0.0, 0.0));
        assert!((encode_f32(7.0) - 255.0).abs() < 0.01);
    }
}
