//! Conversion between sRGB (IEC 61966-2-1) and linear light.
//!
//! Integers keep sums of light independent of their order.

use std::sync::LazyLock;

use super::pow;

/// Linear light of each sRGB byte, 0 to 65 535.
static LINEAR: LazyLock<[u16; 256]> = LazyLock::new(|| {
    std::array::from_fn(|byte| {
        let s = byte as f64 / 255.0;
        let linear = if s <= 0.04045 { s / 12.92 } else { pow((s + 0.055) / 1.055, 2.4) };
        (linear * 65_535.0).round() as u16
    })
});

/// Linear light of an sRGB byte, 0 to 65 535.
pub fn to_linear(byte: u8) -> u16 {
    LINEAR[usize::from(byte)]
}

/// The sRGB byte nearest to each value of linear light.
static NEAREST: LazyLock<Vec<u8>> = LazyLock::new(|| (0..=u16::MAX).map(nearest).collect());

fn nearest(linear: u16) -> u8 {
    let above = LINEAR.partition_point(|&l| l < linear).min(255);
    let below = above.saturating_sub(1);
    if LINEAR[above] - linear.min(LINEAR[above]) <= linear.abs_diff(LINEAR[below]) { above as u8 } else { below as u8 }
}

/// The sRGB byte nearest to a value of linear light, 0 to 65 535.
pub fn from_linear(linear: u16) -> u8 {
    NEAREST[usize::from(linear)]
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
}
