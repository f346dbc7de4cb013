use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::material::WallMaterial;
use crate::look::colours::{BAG, CLOTH, RUBBER, SKIN, SOIL_WET};
use crate::look::octaves::{NoiseLook, Octave};
use crate::math::srgb::Srgb8;

/// Look of walls: the section `[wall]` of a look file.
///
/// Densities are optical densities D, as on the floor. A stain's density follows from the touches S of its cause and
/// their local mean E: n = strength (w E + g (S - E)) with w = total_passes / simulated people and g = sqrt(w), at most
/// 8; D = density n / (density + n). Frequent touches merge into a soft patch; single touches stay distinct and faint.
/// For w of at most 1, n = strength w S.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct WallLook {
    /// Material: colour, texture, roughness, and adhesion of stains.
    pub material: WallMaterial,
    /// Colour of the clean wall, sRGB; default: the material's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<Srgb8>,
    /// Contrast of the clean wall's texture, 0 (flat) to 3; 1 is the material's. Only concrete has a texture; paint is
    /// even, so that untouched walls compress well.
    pub texture: f32,
    /// Image of the wall, repeated from each face's start at the floor. It replaces the material's colour and texture.
    /// The path is relative to the look file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub image: Option<PathBuf>,
    /// Width and height of the wall in the image, metres, 0.01 to 1000.
    pub image_size_m: [f64; 2],
    /// Roughness of the clean wall, 0 to 1; default: the material's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roughness: Option<f32>,
    /// Passes since the wall was painted or washed, which the simulated people represent, 1 to 1e9.
    pub total_passes: u64,
    /// Factor on simulated touches painted over each other, 0 to 20: the method of the paper, otherwise 0.
    pub every_touch: f32,
    /// Stains of hands.
    pub skin: StainLook,
    /// Stains of arms and shoulders.
    pub cloth: StainLook,
    /// Stains of bags, cases and trolleys.
    pub bag: StainLook,
    /// Marks of shoes.
    pub rubber: StainLook,
    /// Splashes of mopping.
    pub splash: SplashLook,
    /// Grey film low on the wall.
    pub dust: WallDustLook,
    /// Skirting board along the foot of the wall.
    pub skirting: SkirtingLook,
    /// Noise of all dirt, along the wall and in height.
    pub noise: NoiseLook,
}

/// Stains of one kind of touch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct StainLook {
    /// Factor on the simulated touches, 0 to 20.
    pub strength: f32,
    /// Optical density at saturation, 0 to 3.
    pub density: f32,
    /// Standard deviation of the Gaussian that smooths the simulated touches, metres, 0.005 to 0.5. It represents
    /// people who were not simulated and touched nearby.
    pub spread_m: f64,
    /// Colour, sRGB.
    pub colour: Srgb8,
}

/// The splash band of mopping.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SplashLook {
    /// Optical density at the foot, 0 to 3.
    pub density: f32,
    /// Largest height of the band above the floor, metres, 0.01 to 1.
    pub height_m: f32,
    /// Unevenness along the wall, 0 to 1.5.
    pub unevenness: f32,
    /// Number of drips per metre of wall, 0 to 20.
    pub drips_per_metre: f32,
    /// Colour, sRGB.
    pub colour: Srgb8,
}

/// Dust: D = density exp(-h / reach) at heights h up to 3 reach, and D = hands around 1.15 m.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct WallDustLook {
    /// Optical density at the floor, 0 to 3.
    pub density: f32,
    /// Height over which it falls to 1/e, metres, 0.02 to 3.
    pub reach_m: f32,
    /// Optical density of a film at hand height along all walls, 0 to 3. For walls with a far longer history than
    /// simulated.
    pub hands: f32,
    /// Colour, sRGB.
    pub colour: Srgb8,
}

/// Skirting board, painted on the wall.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SkirtingLook {
    /// Height, metres, 0 (none) to 0.5.
    pub height_m: f32,
    /// Colour, sRGB.
    pub colour: Srgb8,
}

impl Default for WallLook {
    fn default() -> WallLook {
        let stain = |strength, density, spread_m, colour| StainLook { strength, density, spread_m, colour };
        WallLook {
            material: WallMaterial::Matt,
            colour: None,
            texture: 1.0,
            image: None,
            image_size_m: [2.0, 2.0],
            roughness: None,
            total_passes: 20_000,
            every_touch: 0.0,
            skin: stain(0.5, 0.70, 0.06, SKIN),
            cloth: stain(0.5, 0.36, 0.07, CLOTH),
            bag: stain(0.5, 0.42, 0.06, BAG),
            rubber: stain(0.7, 0.95, 0.03, RUBBER),
            splash: SplashLook::default(),
            dust: WallDustLook::default(),
            skirting: SkirtingLook::default(),
            noise: NoiseLook {
                fine: Octave { size_m: 0.012, sd: 0.14 },
                middle: Octave { size_m: 0.09, sd: 0.20 },
                coarse: Octave { size_m: 0.6, sd: 0.22 },
            },
        }
    }
}

impl Default for StainLook {
    /// Returns the stain of hands.
    fn default() -> StainLook {
        WallLook::default().skin
    }
}

impl Default for SplashLook {
    fn default() -> SplashLook {
        SplashLook { density: 0.22, height_m: 0.12, unevenness: 0.7, drips_per_metre: 0.25, colour: SOIL_WET }
    }
}

impl Default for WallDustLook {
    fn default() -> WallDustLook {
        WallDustLook { density: 0.05, reach_m: 0.05, hands: 0.0, colour: [124, 116, 104] }
    }
}

impl Default for SkirtingLook {
    fn default() -> SkirtingLook {
        SkirtingLook { height_m: 0.0, colour: [112, 111, 108] }
    }
}

impl WallLook {
    /// Returns the look of a clean wall.
    pub(in crate::look) fn clean(&self) -> WallLook {
        let clean = |stain: StainLook| StainLook { strength: 0.0, ..stain };
        WallLook {
            every_touch: 0.0,
            skin: clean(self.skin),
            cloth: clean(self.cloth),
            bag: clean(self.bag),
            rubber: clean(self.rubber),
            splash: SplashLook { density: 0.0, drips_per_metre: 0.0, ..self.splash },
            dust: WallDustLook { density: 0.0, hands: 0.0, ..self.dust },
            ..self.clone()
        }
    }

    /// Returns every number with its key, smallest and largest value.
    pub(in crate::look) fn ranges(&self) -> Vec<(&'static str, f64, f64, f64)> {
        macro_rules! stain {
            ($name:literal, $stain:expr) => {
                [
                    (concat!("wall.", $name, ".strength"), f64::from($stain.strength), 0.0, 20.0),
                    (concat!("wall.", $name, ".density"), f64::from($stain.density), 0.0, 3.0),
                    (concat!("wall.", $name, ".spread_m"), $stain.spread_m, 0.005, 0.5),
                ]
            };
        }
        macro_rules! octave {
            ($name:literal, $octave:expr) => {
                [
                    (concat!("wall.noise.", $name, ".size_m"), $octave.size_m, 0.002, 20.0),
                    (concat!("wall.noise.", $name, ".sd"), f64::from($octave.sd), 0.0, 1.0),
                ]
            };
        }
        let WallLook { splash, dust, noise, .. } = self;
        let single = [
            ("wall.texture", f64::from(self.texture), 0.0, 3.0),
            ("wall.image_size_m", self.image_size_m[0], 0.01, 1000.0),
            ("wall.image_size_m", self.image_size_m[1], 0.01, 1000.0),
            ("wall.roughness", f64::from(self.roughness.unwrap_or(0.5)), 0.0, 1.0),
            ("wall.total_passes", self.total_passes as f64, 1.0, 1e9),
            ("wall.every_touch", f64::from(self.every_touch), 0.0, 20.0),
            ("wall.splash.density", f64::from(splash.density), 0.0, 3.0),
            ("wall.splash.height_m", f64::from(splash.height_m), 0.01, 1.0),
            ("wall.splash.unevenness", f64::from(splash.unevenness), 0.0, 1.5),
            ("wall.splash.drips_per_metre", f64::from(splash.drips_per_metre), 0.0, 20.0),
            ("wall.dust.density", f64::from(dust.density), 0.0, 3.0),
            ("wall.dust.reach_m", f64::from(dust.reach_m), 0.02, 3.0),
            ("wall.dust.hands", f64::from(dust.hands), 0.0, 3.0),
            ("wall.skirting.height_m", f64::from(self.skirting.height_m), 0.0, 0.5),
        ];
        let stains = [
            stain!("skin", self.skin),
            stain!("cloth", self.cloth),
            stain!("bag", self.bag),
            stain!("rubber", self.rubber),
        ];
        let octaves = [octave!("fine", noise.fine), octave!("middle", noise.middle), octave!("coarse", noise.coarse)];
        single.into_iter().chain(stains.into_iter().flatten()).chain(octaves.into_iter().flatten()).collect()
    }
}
