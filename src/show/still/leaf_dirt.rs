//! Dirt on door leaves: hands around the handle and along the closing edge, shoes and cases at the foot.

use crate::look::{StainLook, absorption};
use crate::math::exp_f32;
use crate::math::srgb::light_of;
use crate::show::rooms::{LeafUse, LinearRgb, noise};

/// Where hands push a leaf, and where they take its handle: way from its closing edge and height, metres, with the standard
/// deviation of both.
const PUSHED: [f32; 4] = [0.15, 1.22, 0.10, 0.15];
const HANDLE: [f32; 4] = [0.10, 1.05, 0.055, 0.075];
/// Along the closing edge: reach of grime from it, and the heights between which people touch it, metres.
const EDGE_M: f32 = 0.035;
const EDGE_SPAN_M: [f32; 2] = [0.75, 1.55];
/// Height of kick marks, their standard deviation, and reach of the film at the foot, metres.
const KICKS_M: [f32; 2] = [0.13, 0.07];
const FOOT_M: f32 = 0.09;
/// Amounts on the pushed face and on the other one: of hands, of shoes.
const PUSH: [f32; 2] = [1.0, 1.0];
const PULL: [f32; 2] = [0.6, 0.35];

/// A place of a leaf, metres from its hinge and above the floor.
pub(super) struct LeafPlace<'a> {
    pub leaf: &'a LeafUse,
    pub pushed: bool,
    pub along_m: f32,
    pub height_m: f32,
    /// A number by which leaves differ.
    pub seed: f32,
}

impl LeafPlace<'_> {
    /// The colour of the leaf under stains of hands and of shoes, linear.
    pub fn soiled(&self, clean: LinearRgb, stains: &[StainLook; 2]) -> LinearRgb {
        let densities = [self.hands(), self.shoes()];
        let kinds = stains.iter().zip(densities).map(|(stain, amount)| {
            // As on walls: a closed patch does not get darker than the stain's density.
            let n = stain.strength * amount * self.leaf.used;
            (light_of(stain.colour), stain.density * n / (stain.density + n).max(1e-6))
        });
        kinds.fold(clean, |under, (colour, density)| {
            let absorbs = absorption(colour);
            std::array::from_fn(|c| {
                let through = exp_f32(-density * absorbs[c]);
                under[c] * through + colour[c] * (1.0 - through)
            })
        })
    }

    /// Clouds: unevenness of 12 cm and of 2 cm, 0 and more.
    fn cloudy(&self, [x, y]: [f32; 2]) -> f32 {
        let at = |size_m: f32| noise(self.along_m / size_m + self.seed, self.height_m / size_m + y * self.seed + x);
        (0.75 + 0.55 * at(0.12) + 0.35 * at(0.021)).max(0.0)
    }

    fn hands(&self) -> f32 {
        let (edge_m, z) = (self.leaf.length_m as f32 - self.along_m, self.height_m);
        let cloud = |[x, y, sd_x, sd_y]: [f32; 4]| {
            let (x, y) = ((edge_m - x) / sd_x, (z - y) / sd_y);
            exp_f32(-0.5 * (x * x + y * y))
        };
        let [low, high] = EDGE_SPAN_M;
        let beside = ((z - low) / 0.2).min((high - z) / 0.2).clamp(0.0, 1.0);
        let edge = 0.8 * beside * exp_f32(-edge_m.max(0.0) / EDGE_M);
        let [push, _] = if self.pushed { PUSH } else { PULL };
        let pushed = if self.pushed { 1.4 * cloud(PUSHED) } else { 0.0 };
        self.cloudy([3.1, 0.7]) * (push * 2.0 * cloud(HANDLE) + pushed + push * edge)
    }

    /// Dark streaks where toes and cases hit, over a film that mops splash.
    fn shoes(&self) -> f32 {
        let [high_m, sd_m] = KICKS_M;
        let off = (self.height_m - high_m) / sd_m;
        let around = exp_f32(-0.5 * off * off);
        // Shoes hit at a slant, some places more often than others.
        let clustered =
            (0.45 + 0.9 * noise(self.along_m / 0.16 + 2.7 * self.seed, self.height_m / 0.11)).clamp(0.0, 1.0);
        let slant_m = 0.03 * noise(self.along_m / 0.23 - self.seed, 0.5);
        let streak = |long_m: f32, high_m: f32, from: f32| {
            let height_m = self.height_m + slant_m + 0.12 * high_m * self.along_m / long_m;
            let n = noise(self.along_m / long_m + 5.0 * self.seed, height_m / high_m - self.seed);
            ((n - from) / (1.0 - from)).max(0.0)
        };
        let toward_edge = 0.5 + 0.5 * (self.along_m / self.leaf.length_m as f32).clamp(0.0, 1.0);
        let marks = 1.2 * streak(0.11, 0.009, 0.5) + 0.5 * streak(0.05, 0.024, 0.35) + 0.05;
        let kicks = around * toward_edge * clustered * marks;
        let [_, kick] = if self.pushed { PUSH } else { PULL };
        let film = 0.09 * self.cloudy([1.3, 2.9]) * exp_f32(-self.height_m / FOOT_M);
        kick * kicks + film
    }
}
