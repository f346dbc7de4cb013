//! The law of dirt over a surface, for floors and walls: C = clean T + light (1 - T) / total with T = exp(-total), where
//! `total` is the sum of optical density times absorption over the kinds of dirt, and `light` that sum weighted by their
//! colours. Channel by channel, in linear light.

use super::colours::{DUST, absorption};
use super::settings::Look;
use crate::math::exp_f32;
use crate::math::srgb;

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

/// Part of the light dust that dirt shows over a floor darker than itself.
const DUST_OVER_DARK: f32 = 0.3;

/// What lies under dirt: a floor or a wall.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beneath {
    /// Luminance of the clean surface, in the mean.
    clean: f32,
    /// Linear light below which dirt darkens no texel.
    darkest: f32,
}

impl Beneath {
    /// A surface of a clean linear colour, under a look's dirt.
    pub fn of(look: &Look, clean: [f32; 3]) -> Beneath {
        Beneath { clean: seen(clean), darkest: srgb::decode(f64::from(look.darkest) / 255.0) as f32 }
    }

    /// Turns the sums of the channels into the colour shown: `light` becomes it. Dirt does not lighten a texel to the
    /// darkest light.
    ///
    /// Over a light surface a thin layer filters the light from below, each colour by its own absorption. Over a surface
    /// darker than the dirt there is no light to filter: what shows is scattered by the grains, all colours much alike
    /// (Kubelka and Munk, *Ein Beitrag zur Optik der Farbanstriche*, 1931). There the layer covers all channels as it does
    /// for the eye, and is lighter and greyer; brown dirt would be olive.
    pub fn cover(self, clean: &[Vec<f32>; 3], totals: &[Vec<f32>; 3], light: &mut [Vec<f32>; 3]) {
        let mean: Vec<f32> = texels(totals).map(seen).collect();
        let dark: Vec<f32> =
            mean.iter().zip(texels(light)).map(|(mean, dirt)| is_darker(self.clean * mean, seen(dirt))).collect();
        for (n, dust) in srgb::light_of(DUST).into_iter().enumerate() {
            let sums = totals[n].iter().zip(&mean).zip(&dark);
            for ((light, clean), ((total, mean), dark)) in light[n].iter_mut().zip(&clean[n]).zip(sums) {
                let through = exp_f32(-(total + dark * (mean - total)));
                let colour = *light / total.max(1e-6);
                let colour = colour + DUST_OVER_DARK * dark * (dust - colour);
                *light = (clean * through + colour * (1.0 - through)).max(self.darkest.min(*clean));
            }
        }
    }
}

/// Luminance of a thick layer of dirt, whose own is `dirt`, over a surface.
pub(super) fn shown_over(clean: f32, dirt: f32) -> f32 {
    dirt + DUST_OVER_DARK * is_darker(clean, dirt) * (seen(srgb::light_of(DUST)) - dirt)
}

/// How much darker a surface is than dirt: 0 from four fifths of its light on, 1 at less than half of it.
fn is_darker(clean: f32, dirt: f32) -> f32 {
    (3.0 * (0.8 * dirt - clean) / dirt.max(1e-6)).clamp(0.0, 1.0)
}

fn texels([r, g, b]: &[Vec<f32>; 3]) -> impl Iterator<Item = [f32; 3]> {
    r.iter().zip(g).zip(b).map(|((r, g), b)| [*r, *g, *b])
}

/// The mean of red, green and blue that eyes see.
fn seen([r, g, b]: [f32; 3]) -> f32 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}
