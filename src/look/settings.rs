use serde::{Deserialize, Serialize};
use std::path::PathBuf;

use super::colours::{RUBBER, SOIL_DRY, SOIL_WET};
use super::material::Material;
use super::octaves::NoiseLook;
use super::wall::WallLook;
use crate::math::srgb::Srgb8;

/// The look: settings that turn sums into textures. Changes need no new simulation.
///
/// A look file is TOML with these keys; missing keys have the value of its preset:
///
/// ```toml
/// preset = "heavy"
/// [floor]
/// material = "dark"
/// [film]
/// density = 0.6
/// ```
///
/// Densities are optical densities D: dirt has the opacity 1 - exp(-D).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Look {
    /// Preset on which these values are based: one of [`super::LOOK_PRESETS`].
    pub preset: String,
    /// Seed of the noise, independent of the crowd's seed.
    pub seed: u64,
    /// Passes since the floor was laid or last stripped, which the simulated people represent. 1 to 1e9; 20 000 in the
    /// presets `commuters`, `heavy` and `wet`.
    pub total_passes: u64,
    /// Smallest sRGB value, 0 to 255, to which dirt darkens a texel: indoor dirt is never black.
    pub darkest: f32,
    /// The clean floor.
    pub floor: FloorLook,
    /// Grey film of all passes together: the lane.
    pub film: FilmLook,
    /// Ingrained dirt: continues to darken at very many passes, as on thresholds.
    pub ingrained: IngrainedLook,
    /// Readable single prints.
    pub prints: PrintsLook,
    /// Black marks of heels and toes.
    pub scuffs: ScuffsLook,
    /// Dirty line along the skirting, where no mop reaches.
    pub edge: EdgeLook,
    /// Dust beside the lanes.
    pub dust: DustLook,
    /// Noise of film and dust, in plan space: independent of the texel density.
    pub noise: NoiseLook,
    /// Walls. All other settings but `seed` and `darkest` are for the floor.
    pub wall: WallLook,
}

/// The clean floor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FloorLook {
    /// Material: colour, texture, roughness, and adhesion of dirt.
    pub material: Material,
    /// Colour of the clean floor, sRGB; default: the material's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<Srgb8>,
    /// Contrast of the clean floor's texture, 0 (flat) to 3; 1 is the material's.
    pub texture: f32,
    /// Image of the floor, repeated from the plan's origin. It replaces the material's colour and texture. The path is
    /// relative to the look file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub image: Option<PathBuf>,
    /// Width and height of the floor in the image, metres, 0.01 to 1000.
    pub image_size_m: [f64; 2],
    /// Roughness of the clean floor, 0 to 1; default: the material's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roughness: Option<f32>,
    /// Roughness on lanes, 0 to 1; default: the material's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roughness_trodden: Option<f32>,
    /// Side of a tile (material `tile`), metres, 0.02 to 5.
    pub tile_m: f64,
    /// Width of a joint (material `tile`), metres, 0 to 0.05.
    pub joint_m: f64,
}

/// The film: D = density (1 - exp(-per_pass n)) for n passes, times noise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FilmLook {
    /// Optical density of a saturated film, 0 to 3.
    pub density: f32,
    /// Share of the missing density that one pass adds, 0 to 1.
    pub per_pass: f32,
    /// Standard deviation of the Gaussian that smooths the simulated passes, metres, 0 to 0.5.
    ///
    /// It represents people who were not simulated and walked nearby. The deviation of single passes remains, scaled by
    /// 1/sqrt(w).
    pub spread_m: f64,
    /// Colour, sRGB.
    pub colour: Srgb8,
}

/// Ingrained dirt: the film's formula at a far lower rate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct IngrainedLook {
    /// Optical density at saturation, 0 to 3.
    pub density: f32,
    /// Share of the missing density that one pass adds, 0 to 1.
    pub per_pass: f32,
}

/// Readable prints.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PrintsLook {
    /// Factor on the soil of fresh prints, 0 to 20.
    pub soil: f32,
    /// Optical density painted by every simulated pass, 0 to 3: the method of the paper, otherwise 0.
    pub every_pass: f32,
    /// Colour, sRGB.
    pub colour: Srgb8,
}

/// Heel and toe marks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ScuffsLook {
    /// Factor on the marks' optical density, 0 to 20.
    pub strength: f32,
    /// Colour, sRGB.
    pub colour: Srgb8,
}

/// Skirting line: D = density exp(-d / reach) at distance d from the wall, uneven along the wall.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EdgeLook {
    /// Optical density at the wall, 0 to 3.
    pub density: f32,
    /// Distance over which it falls to 1/e, metres, 0.005 to 0.5.
    pub reach_m: f32,
    /// Relative unevenness along the wall (standard deviation of the logarithm), 0 to 1.5.
    pub unevenness: f32,
    /// Factor on the density in a right-angled inner corner, 1 to 4.
    pub corner: f32,
    /// Radius of a corner's effect, metres, 0.01 to 0.5.
    pub corner_radius_m: f32,
    /// Colour, sRGB.
    pub colour: Srgb8,
}

/// Dust: D = density exp(-d / reach), removed by passes as the film grows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DustLook {
    /// Optical density at the wall, 0 to 3.
    pub density: f32,
    /// Distance over which it falls to 1/e, metres, 0.02 to 3.
    pub reach_m: f32,
    /// Colour, sRGB.
    pub colour: Srgb8,
}

impl Default for Look {
    fn default() -> Look {
        Look {
            preset: "commuters".to_string(),
            seed: 1,
            total_passes: 20_000,
            darkest: 50.0,
            floor: FloorLook::default(),
            film: FilmLook::default(),
            ingrained: IngrainedLook::default(),
            prints: PrintsLook::default(),
            scuffs: ScuffsLook::default(),
            edge: EdgeLook::default(),
            dust: DustLook::default(),
            noise: NoiseLook::default(),
            wall: WallLook::default(),
        }
    }
}

impl Default for FloorLook {
    fn default() -> FloorLook {
        FloorLook {
            material: Material::Vinyl,
            colour: None,
            texture: 1.0,
            image: None,
            image_size_m: [2.0, 2.0],
            roughness: None,
            roughness_trodden: None,
            tile_m: 0.3,
            joint_m: 0.004,
        }
    }
}

impl Default for FilmLook {
    fn default() -> FilmLook {
        FilmLook { density: 0.46, per_pass: 0.035, spread_m: 0.0, colour: SOIL_DRY }
    }
}

impl Default for IngrainedLook {
    fn default() -> IngrainedLook {
        IngrainedLook { density: 0.12, per_pass: 0.001 }
    }
}

impl Default for PrintsLook {
    fn default() -> PrintsLook {
        PrintsLook { soil: 4.5, every_pass: 0.0, colour: SOIL_DRY }
    }
}

impl Default for ScuffsLook {
    fn default() -> ScuffsLook {
        ScuffsLook { strength: 1.8, colour: RUBBER }
    }
}

impl Default for EdgeLook {
    fn default() -> EdgeLook {
        EdgeLook {
            density: 0.30,
            reach_m: 0.04,
            unevenness: 0.45,
            corner: 1.75,
            corner_radius_m: 0.10,
            colour: SOIL_WET,
        }
    }
}

impl Default for DustLook {
    fn default() -> DustLook {
        DustLook { density: 0.10, reach_m: 0.30, colour: SOIL_DRY }
    }
}

impl Look {
    /// Returns the same look without dirt and wear.
    pub fn clean(&self) -> Look {
        let mut look = Look { wall: self.wall.clean(), ..self.clone() };
        look.film.density = 0.0;
        // Nor is it worn.
        look.film.per_pass = 0.0;
        look.ingrained.density = 0.0;
        look.prints.soil = 0.0;
        look.prints.every_pass = 0.0;
        look.scuffs.strength = 0.0;
        look.edge.density = 0.0;
        look.dust.density = 0.0;
        look
    }

    /// Paths of the images of floor and wall.
    pub fn images(&mut self) -> [Option<&mut PathBuf>; 2] {
        [self.floor.image.as_mut(), self.wall.image.as_mut()]
    }
}
