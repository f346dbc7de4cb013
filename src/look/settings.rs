use serde::{Deserialize, Serialize};
use std::path::PathBuf;

use super::colours::{RUBBER, SOIL_DRY, SOIL_WET};
use super::material::Material;
use super::octaves::NoiseLook;
use super::wall::WallLook;
use crate::math::srgb::Srgb8;

/// The look: settings that turn sums into textures. Changing them needs no new simulation.
///
/// A look file is TOML with these keys; keys that it leaves out keep the value of the preset that it names:
///
/// ```toml
/// preset = "heavy"
/// [floor]
/// material = "dark"
/// [film]
/// density = 0.6
/// ```
///
/// Densities are optical densities D: dirt covers the floor with opacity 1 - exp(-D).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Look {
    /// The preset that these values started from: one of [`super::LOOK_PRESETS`].
    pub preset: String,
    /// Chooses the noise's pattern; independent of the crowd's seed.
    pub seed: u64,
    /// Passes since the floor was laid or last stripped; the simulated people stand for them.
    /// 1 to 1e9. For the presets `commuters`, `heavy` and `wet` 20 000.
    pub total_passes: u64,
    /// Least sRGB value, 0 to 255, to which dirt darkens a texel: indoor dirt is never black.
    pub darkest: f32,
    /// The clean floor.
    pub floor: FloorLook,
    /// The grey film that all passes leave together: the lane.
    pub film: FilmLook,
    /// Ingrained dirt: goes on darkening where very many pass, as on thresholds.
    pub ingrained: IngrainedLook,
    /// Single prints that can be read.
    pub prints: PrintsLook,
    /// Black marks of heels and toes.
    pub scuffs: ScuffsLook,
    /// The dirty line along the skirting, where no mop reaches.
    pub edge: EdgeLook,
    /// Dust off the lanes.
    pub dust: DustLook,
    /// Unevenness of film and dust, in plan space: it does not move when the texel density changes.
    pub noise: NoiseLook,
    /// The walls: all of the above but `seed` and `darkest` is about the floor.
    pub wall: WallLook,
}

/// The clean floor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FloorLook {
    /// Material: colour, texture, roughness, and how dirt stays on it.
    pub material: Material,
    /// Colour of the clean floor, sRGB; the material's own if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<Srgb8>,
    /// Contrast of the clean floor's own texture: 0 (flat) to 3; 1 as the material has it.
    pub texture: f32,
    /// An image of the floor, repeated from the plan's origin on, instead of the material's colour and texture.
    /// A path relative to the look file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub image: Option<PathBuf>,
    /// Width and height of the floor that the image shows, metres, 0.01 to 1000.
    pub image_size_m: [f64; 2],
    /// Roughness of the clean floor, 0 to 1; the material's own if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roughness: Option<f32>,
    /// Roughness where many people have walked, 0 to 1; the material's own if left out.
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
    /// Optical density where the floor takes up no more, 0 to 3.
    pub density: f32,
    /// Share of what is still missing that one pass adds, 0 to 1.
    pub per_pass: f32,
    /// Standard deviation of the Gaussian that evens out the simulated passes, metres, 0 to 0.5.
    ///
    /// It stands for the people who were not simulated and walked beside. The deviation of single passes is kept,
    /// scaled by 1/sqrt(w).
    pub spread_m: f64,
    /// Colour, sRGB.
    pub colour: Srgb8,
}

/// Dirt that has worked its way in: the same law as the film's, at a far lower rate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct IngrainedLook {
    /// Optical density at the end, 0 to 3.
    pub density: f32,
    /// Share of what is still missing that one pass adds, 0 to 1.
    pub per_pass: f32,
}

/// Readable prints.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PrintsLook {
    /// Factor on the soil that fresh people brought in, 0 to 20.
    pub soil: f32,
    /// Optical density that every simulated pass paints, fresh or not, 0 to 3: the way of the paper, 0 otherwise.
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

/// The skirting line: D = density exp(-d / reach) at the distance d from the wall, broken up along the wall.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EdgeLook {
    /// Optical density at the wall, 0 to 3.
    pub density: f32,
    /// Distance in which it falls to 1/e, metres, 0.005 to 0.5.
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

/// Dust: D = density exp(-d / reach), walked off as the film grows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DustLook {
    /// Optical density at the wall, 0 to 3.
    pub density: f32,
    /// Distance in which it falls to 1/e, metres, 0.02 to 3.
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
    /// The same look without dirt and wear.
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
