use serde::{Deserialize, Serialize};

use crate::math::srgb::Srgb8;
use crate::options::names;

names!(Material);

/// Floor material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Material {
    /// Light PVC sheet, waxed: the film forms a grey lane, and wear dulls the wax.
    Vinyl,
    /// Dark PVC or rubber: soil is lighter than the floor.
    Dark,
    /// Terrazzo and polished stone: steps polish the lane, dirt stays at the edges.
    Terrazzo,
    /// Bare, sealed concrete: cloudy, absorbs soil, worn smooth.
    Concrete,
    /// Varnished planks: worn dull and grey on lanes.
    Wood,
    /// Carpet: wide, soft lanes, no prints, no heel marks.
    Carpet,
    /// Glazed tiles: nearly clean, with dirt in the joints.
    Tile,
}

/// Properties of a material: absolute values, and factors on the look's settings.
#[derive(Clone, Copy, Debug)]
pub(super) struct Properties {
    pub colour: Srgb8,
    /// Roughness when clean, and on lanes.
    pub roughness: [f32; 2],
    pub film: f32,
    pub prints: f32,
    pub scuffs: f32,
    pub edge: f32,
    pub dust: f32,
    /// Least spread of the film, metres: fibres pass dirt on to adjacent ones.
    pub least_spread_m: f64,
    /// Whether the film shows traces of single passes.
    pub shows_single_passes: bool,
}

impl Material {
    pub(super) fn properties(self) -> Properties {
        let plain = Properties {
            colour: [197, 192, 182],
            roughness: [0.35, 0.50],
            film: 1.0,
            prints: 1.0,
            scuffs: 1.0,
            edge: 1.0,
            dust: 1.0,
            least_spread_m: 0.0,
            shows_single_passes: true,
        };
        match self {
            Material::Vinyl => plain,
            Material::Dark => Properties { colour: [60, 58, 56], film: 0.5, ..plain },
            Material::Terrazzo => {
                Properties { colour: [186, 181, 172], roughness: [0.30, 0.22], film: 0.35, scuffs: 0.7, ..plain }
            }
            Material::Concrete => {
                Properties { colour: [158, 154, 147], roughness: [0.75, 0.55], prints: 0.8, scuffs: 0.8, ..plain }
            }
            Material::Wood => Properties { colour: [172, 132, 92], roughness: [0.40, 0.60], ..plain },
            Material::Carpet => Properties {
                colour: [122, 124, 130],
                roughness: [0.95, 0.95],
                prints: 0.0,
                scuffs: 0.0,
                edge: 0.6,
                least_spread_m: 0.15,
                shows_single_passes: false,
                ..plain
            },
            Material::Tile => Properties { colour: [206, 203, 196], roughness: [0.18, 0.24], film: 0.28, ..plain },
        }
    }
}
