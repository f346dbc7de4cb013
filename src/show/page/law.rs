//! The look's law for whole images: what dirt of known density and colour makes of a clean colour, and back.

use std::sync::LazyLock;

use crate::look::Srgb8;
use crate::math;

/// Masks of 255 hide everything: as much as eight bits can say.
const MOST_MASK: f32 = 254.5 / 255.0;

static LINEAR: LazyLock<[f32; 256]> = LazyLock::new(|| {
    std::array::from_fn(|value| {
        let value = value as f64 / 255.0;
        let light = if value <= 0.04045 { value / 12.92 } else { math::pow((value + 0.055) / 1.055, 2.4) };
        light as f32
    })
});

static DENSITY: LazyLock<[f32; 256]> = LazyLock::new(|| {
    std::array::from_fn(|mask| -math::ln(1.0 - f64::from((mask as f32 / 255.0).min(MOST_MASK))) as f32)
});

/// Linear light, 0 to 1, of an 8-bit sRGB value (IEC 61966-2-1).
pub(super) fn linear(srgb: u8) -> f32 {
    LINEAR[usize::from(srgb)]
}

/// Linear light of a colour.
pub(super) fn linear_rgb(colour: Srgb8) -> [f32; 3] {
    colour.map(linear)
}

/// Steps of the table from light to sRGB: twenty to a value where it is steepest.
const LIGHT_STEPS: usize = 1 << 16;

static SRGB: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let byte = |step: usize| {
        let light = step as f64 / (LIGHT_STEPS - 1) as f64;
        let value = if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * math::pow(light, 1.0 / 2.4) - 0.055 };
        (255.0 * value).round() as u8
    };
    (0..LIGHT_STEPS).map(byte).collect()
});

/// The 8-bit sRGB value of linear light.
pub(super) fn srgb(light: f32) -> u8 {
    SRGB[(light.clamp(0.0, 1.0) * (LIGHT_STEPS - 1) as f32 + 0.5) as usize]
}

/// Optical density D of an 8-bit mask: mask = 255 (1 - exp(-D)).
pub(super) fn density(mask: u8) -> f32 {
    DENSITY[usize::from(mask)]
}

/// The 8-bit mask of an optical density.
pub(super) fn mask(density: f32) -> u8 {
    (255.0 * (1.0 - math::exp_f32(-density))).round() as u8
}

/// Light of two colours mixed, `share` of the second.
pub(super) fn mixed(a: Srgb8, b: Srgb8, share: f32) -> Srgb8 {
    std::array::from_fn(|n| srgb(linear(a[n]) + share * (linear(b[n]) - linear(a[n]))))
}

/// Dirt over a texel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Layer {
    /// T = exp(-sum D): the share of the clean surface's light that comes through.
    pub through: f32,
    /// (1 - T) sum(D c) / sum(D): the dirt's own light.
    pub own: [f32; 3],
}

impl Layer {
    /// C = clean T + own, in linear light.
    pub fn over(&self, clean: [f32; 3]) -> [f32; 3] {
        std::array::from_fn(|n| clean[n] * self.through + self.own[n])
    }

    /// The clean colour that shows as `seen`, as far as light comes through; never far from `expected`.
    pub fn under(&self, seen: [f32; 3], expected: [f32; 3]) -> [f32; 3] {
        std::array::from_fn(|n| {
            let clean = (seen[n] - self.own[n]) / self.through.max(0.02);
            clean.clamp(0.25 * expected[n], (4.0 * expected[n]).min(1.0))
        })
    }
}

/// All dirt of a texel: D and linear colour of each kind.
pub(super) fn layer(dirt: &[(f32, [f32; 3])]) -> Layer {
    let sum: f32 = dirt.iter().map(|(density, _)| density).sum();
    let through = math::exp_f32(-sum);
    let hiding = (1.0 - through) / sum.max(1e-6);
    let own = std::array::from_fn(|n| hiding * dirt.iter().map(|(density, colour)| density * colour[n]).sum::<f32>());
    Layer { through, own }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eight_bits_come_back() {
        for value in 0..=255u8 {
            assert_eq!(srgb(linear(value)), value);
            assert!(mask(density(value)).abs_diff(value) <= 1, "{value}");
        }
    }

    #[test]
    fn what_lies_under_dirt_is_found_again() {
        let clean = linear_rgb([197, 192, 182]);
        let layer = layer(&[(0.4, linear_rgb([116, 107, 94])), (0.9, linear_rgb([42, 41, 40]))]);
        let found = layer.under(layer.over(clean), clean);
        assert!(found.iter().zip(clean).all(|(found, clean)| (found - clean).abs() < 1e-5), "{found:?}");
    }

    #[test]
    fn without_dirt_a_surface_is_clean() {
        let clean = linear_rgb([60, 58, 56]);
        assert_eq!(layer(&[(0.0, [1.0; 3])]).over(clean), clean);
    }
}
