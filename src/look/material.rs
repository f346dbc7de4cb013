use serde::{Deserialize, Serialize};

use crate::math::srgb::Srgb8;
use crate::options::names;

names!(Material);

/// Floor material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Material {
    /// Light PVC sheet with flecks, welded and waxed: the film forms a lane, and wear dulls the wax.
    Vinyl,
    /// Dark PVC or rubber: soil is lighter than the floor.
    Dark,
    /// Terrazzo: chips in a matrix, polished by steps; dirt stays at the edges.
    Terrazzo,
    /// Bare, sealed concrete: cloudy, cracked, absorbs soil, worn smooth.
    Concrete,
    /// Varnished planks: worn bare along lanes.
    Wood,
    /// Carpet tiles: wide, soft lanes, no prints, no heel marks.
    Carpet,
    /// Glazed tiles: nearly clean, with dirt in the joints.
    Tile,
    /// Slabs of honed limestone, polished by steps.
    Stone,
    /// Asphalt, outdoors.
    Asphalt,
    /// Concrete paving stones, outdoors.
    Paving,
}

/// Properties of a material: absolute values, and factors on the look's settings.
#[derive(Clone, Copy, Debug)]
pub(super) struct Properties {
    pub colour: Srgb8,
    /// Roughness when clean, and on lanes.
    pub roughness: [f32; 2],
    pub film: f32,
    /// Film in joints, as a share of the look's: off the lanes, and added on lanes.
    pub joint_film: [f32; 2],
    /// How much more film lies in the low places of the surface, per millimetre.
    pub low_film: f32,
    pub prints: f32,
    pub scuffs: f32,
    /// Factor on stains, gum, grit and rubs.
    pub spots: f32,
    pub edge: f32,
    pub dust: f32,
    /// What wear turns the floor's colour into, relative to it, per channel.
    pub worn: [f32; 3],
    /// Passes that wear it by 1 - 1/e.
    pub wear_passes: f32,
    /// Least spread of the film, metres: fibres pass dirt on to adjacent ones.
    pub least_spread_m: f64,
    /// Whether the film shows traces of single passes.
    pub shows_single_passes: bool,
}

impl Material {
    /// Every material.
    #[cfg(test)]
    pub(super) const ALL: [Material; 10] = [
        Material::Vinyl,
        Material::Dark,
        Material::Terrazzo,
        Material::Concrete,
        Material::Wood,
        Material::Carpet,
        Material::Tile,
        Material::Stone,
        Material::Asphalt,
        Material::Paving,
    ];

    pub(super) fn properties(self) -> Properties {
        let plain = Properties {
            colour: [197, 192, 182],
            roughness: [0.35, 0.50],
            film: 1.0,
            joint_film: [0.3, 1.4],
            low_film: 0.0,
            prints: 1.0,
            scuffs: 1.0,
            spots: 1.0,
            edge: 1.0,
            dust: 1.0,
            worn: [1.0; 3],
            wear_passes: 4000.0,
            least_spread_m: 0.0,
            shows_single_passes: true,
        };
        let mineral = Properties { joint_film: [2.0, 3.4], ..plain };
        match self {
            Material::Vinyl => Properties { low_film: 3.0, ..plain },
            Material::Dark => Properties { colour: [60, 58, 56], film: 0.75, ..plain },
            Material::Terrazzo => Properties {
                colour: [186, 181, 172],
                roughness: [0.30, 0.20],
                film: 0.66,
                low_film: 10.0,
                scuffs: 0.7,
                joint_film: [0.0, 0.6],
                ..plain
            },
            Material::Concrete => Properties {
                colour: [158, 154, 147],
                roughness: [0.75, 0.55],
                low_film: 1.2,
                prints: 0.8,
                scuffs: 0.8,
                wear_passes: 12_000.0,
                ..mineral
            },
            Material::Wood => Properties {
                colour: [172, 132, 92],
                roughness: [0.40, 0.62],
                film: 0.9,
                low_film: 3.0,
                worn: [1.06, 1.14, 1.28],
                wear_passes: 3000.0,
                joint_film: [0.6, 1.2],
                ..plain
            },
            Material::Carpet => Properties {
                colour: [122, 124, 130],
                roughness: [0.95, 0.95],
                film: 0.9,
                low_film: 0.2,
                prints: 0.0,
                scuffs: 0.0,
                spots: 0.35,
                edge: 0.6,
                least_spread_m: 0.15,
                shows_single_passes: false,
                joint_film: [0.2, 1.0],
                ..plain
            },
            Material::Tile => Properties { colour: [206, 203, 196], roughness: [0.18, 0.24], film: 0.35, ..mineral },
            Material::Stone => {
                Properties { colour: [188, 179, 162], roughness: [0.45, 0.28], film: 0.7, low_film: 2.5, ..mineral }
            }
            Material::Asphalt => Properties {
                colour: [82, 80, 78],
                roughness: [0.92, 0.80],
                film: 0.45,
                low_film: 0.16,
                edge: 0.7,
                prints: 0.5,
                scuffs: 0.4,
                wear_passes: 30_000.0,
                ..plain
            },
            Material::Paving => Properties {
                colour: [156, 148, 136],
                roughness: [0.85, 0.70],
                film: 0.75,
                low_film: 0.6,
                prints: 0.8,
                scuffs: 0.6,
                wear_passes: 12_000.0,
                ..mineral
            },
        }
    }
}
