//! Colour: sRGB and linear light, and eight bits without bands.

use super::settings::Srgb8;
use crate::math;

/// Linear light, 0 to 1, of an sRGB value 0 to 255 (IEC 61966-2-1).
pub(super) fn linear(srgb: f32) -> f32 {
    let value = f64::from(srgb) / 255.0;
    let linear = if value <= 0.04045 { value / 12.92 } else { math::pow((value + 0.055) / 1.055, 2.4) };
    linear as f32
}

/// Linear light of an sRGB colour.
pub(super) fn linear_rgb(colour: Srgb8) -> [f32; 3] {
    colour.map(|channel| linear(f32::from(channel)))
}

/// sRGB value 0 to 255, not rounded, of linear light.
///
/// A polynomial in the fourth root (the curve is 1.055 root^(5/3) - 0.055), fitted at Chebyshev points: off by less than
/// 0.003 of an 8-bit step, and compilers vectorise it.
pub(super) fn srgb(linear: f32) -> f32 {
    let linear = linear.clamp(0.0, 1.0);
    let t = linear.sqrt().sqrt();
    let curve = -15.678_25 + t * (41.691_35 + t * (318.693_94 + t * (-144.683_87 + t * (71.647_62 + t * -16.672_062))));
    if linear <= 0.003_130_8 { 255.0 * 12.92 * linear } else { curve }
}

/// Rounds values of 0 to 255 up or down at random, so that their means over neighbours stay: a byte of each word is
/// the threshold.
pub(super) fn dither(values: &[f32], words: &[u32], byte: u32, out: &mut [u8]) {
    // Adding 2^23 rounds to the nearest integer and leaves it in the lowest bits: a cast would not vectorise.
    const ROUND: f32 = 8_388_608.0;
    for ((out, value), word) in out.iter_mut().zip(values).zip(words) {
        let threshold = (((word >> (8 * byte)) & 0xff) as i32 as f32 + 0.5) / 256.0 - 0.5;
        *out = ((value + threshold).clamp(0.0, 255.0) + ROUND).to_bits() as u8;
    }
}

/// CIE L* of linear luminance.
#[cfg(test)]
pub(super) fn lightness(linear: [f32; 3]) -> f64 {
    let y = 0.2126 * f64::from(linear[0]) + 0.7152 * f64::from(linear[1]) + 0.0722 * f64::from(linear[2]);
    if y > 216.0 / 24389.0 { 116.0 * libm::cbrt(y) - 16.0 } else { y * 24389.0 / 27.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_there_and_back() {
        for value in 0..=255u8 {
            let back = srgb(linear(f32::from(value)));
            assert!((back - f32::from(value)).abs() < 0.004, "{value} came back as {back}");
        }
        assert_eq!((srgb(-1.0), srgb(0.0)), (0.0, 0.0));
        assert!((srgb(7.0) - 255.0).abs() < 0.01);
    }

    #[test]
    fn dither_keeps_the_mean_and_whole_values() {
        let words: Vec<u32> = (0..256).map(|threshold| threshold << 16).collect();
        let dithered = |value: f32| {
            let mut out = vec![0; 256];
            dither(&[value; 256], &words, 2, &mut out);
            out
        };
        for value in [0.0, 17.0, 100.25, 200.9, 255.0] {
            let mean = dithered(value).into_iter().map(f32::from).sum::<f32>() / 256.0;
            assert!((mean - value).abs() < 0.004, "{value} became {mean}");
        }
        assert!(dithered(42.0).into_iter().all(|value| value == 42));
        assert!(dithered(-3.0).into_iter().all(|value| value == 0));
        assert!(dithered(300.0).into_iter().all(|value| value == 255));
    }

    #[test]
    fn lightness_of_the_light_vinyl_is_about_78() {
        assert!((lightness(linear_rgb([197, 192, 182])) - 78.0).abs() < 0.5);
    }
}
