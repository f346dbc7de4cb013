use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::material::WallMaterial;
use crate::look::colours::{BAG, CLOTH, RUBBER, SKIN, SOIL_WET};
use crate::look::octaves::{NoiseLook, Octave};
use crate::math::srgb::Srgb8;

/// The look of walls: the section `[wall]`.
///
/// Densities are optical densities D, as on the floor. A stain's density follows from the touches S of its cause and from
/// their mean E around: n = strength (w E + g (S - E)) with w = total_passes / people for whom touches were drawn, and
/// g = sqrt(w), at most 8; D = density n / (density + n). Where many have touched, a closed soft patch grows; what one
/// touch left stays single and faint. Where w is 1 or less, it is n = strength w S.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct WallLook {
    /// Material: colour, texture, roughness, and how stains stay on it.
    pub material: WallMaterial,
    /// Colour of the clean wall, sRGB; the material's own if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<Srgb8>,
    /// How much the clean wall's own texture shows: 0 (dead flat) to 3, 1 as the material has it. Only concrete has one;
    /// paint is even, so that walls that nobody touches take next to no space in files.
    pub texture: f32,
    /// An image of the wall, repeated from each face's start at the floor on, instead of the material's colour and
    /// texture. A path relative to the look file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub image: Option<PathBuf>,
    /// Width and height of the wall that the image shows, metres, 0.01 to 1000.
    pub image_size_m: [f64; 2],
    /// Roughness of the clean wall, 0 to 1; the material's own if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roughness: Option<f32>,
    /// How many people have passed since the wall was painted or washed; those simulated stand for them. 1 to 1e9.
    pub total_passes: u64,
    /// Factor on the simulated touches as they are, painted over each other, 0 to 20: the way of the paper, 0 otherwise.
    pub every_touch: f32,
    /// Of hands.
    pub skin: StainLook,
    /// Of arms and shoulders.
    pub cloth: StainLook,
    /// Of bags, cases, trolleys.
    pub bag: StainLook,
    /// Of shoes.
    pub rubber: StainLook,
    /// Splashes of mopping.
    pub splash: SplashLook,
    /// Grey film low on the wall.
    pub dust: WallDustLook,
    /// The board along the foot of the wall.
    pub skirting: SkirtingLook,
    /// Unevenness of all dirt, along the wall and up.
    pub noise: NoiseLook,
}

/// Stains of one kind of touch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct StainLook {
    /// Factor on the simulated touches, 0 to 20.
    pub strength: f32,
    /// Optical density where the wall takes up no more, 0 to 3.
    pub density: f32,
    /// How far the simulated touches are evened out (standard deviation of a Gaussian), metres, 0.005 to 0.5: those who
    /// were not simulated touched beside those who were.
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
    /// Drips that ran down, per metre of wall, 0 to 20.
    pub drips_per_metre: f32,
    /// Colour, sRGB.
    pub colour: Srgb8,
}

/// Dust: D = density exp(-h / reach) at the height h up to three times the reach, and D = hands around 1.15 m.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct WallDustLook {
    /// Optical density at the floor, 0 to 3.
    pub density: f32,
    /// Height in which it falls to 1/e, metres, 0.02 to 3.
    pub reach_m: f32,
    /// Optical density of a film at hand height along all of the wall, 0 to 3: for walls that have seen far more than the
    /// simulation tells of.
    pub hands: f32,
    /// Colour, sRGB.
    pub colour: Srgb8,
}

/// A skirting board, painted on.
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
    /// The stain of hands.
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
    /// The look of a clean wall.
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

    /// Every number with its key, its least and its largest value.
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
