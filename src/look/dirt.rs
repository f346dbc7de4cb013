//! The law of dirt over a surface, for floors and walls: C = clean T + light (1 - T) / total with T = exp(-total), where
//! `total` is the sum of optical density times absorption over the kinds of dirt, and `light` that sum weighted by their
//! colours. Channel by channel, in linear light.

use super::colours::absorption;
use crate::math::exp_f32;

/// A kind of dirt.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dirt {
    /// Linear colour.
    colour: [f32; 3],
    /// Optical density of red, green and blue per density.
    absorbs: [f32; 3],
}

impl Dirt {
    pub fn of(colour: [f32; 3]) -> Dirt {
        Dirt { colour, absorbs: absorption(colour) }
    }

    /// Adds its densities to the sums of a channel.
    pub fn add_to(&self, channel: usize, density: &[f32], total: &mut [f32], light: &mut [f32]) {
        let absorbs = self.absorbs[channel];
        let coloured = absorbs * self.colour[channel];
        for ((total, light), density) in total.iter_mut().zip(light).zip(density) {
            *total += absorbs * density;
            *light += coloured * density;
        }
    }
}

/// Turns the sums of a channel into the colour shown: `light` becomes it. Dirt darkens no texel below `darkest`, and does
/// not lighten a darker surface to it.
pub(super) fn cover(clean: &[f32], total: &[f32], light: &mut [f32], darkest: f32) {
    for ((light, total), clean) in light.iter_mut().zip(total).zip(clean) {
        let through = exp_f32(-total);
        *light = (clean * through + *light * (1.0 - through) / total.max(1e-6)).max(darkest.min(*clean));
    }
}
