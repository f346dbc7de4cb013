use serde::{Deserialize, Serialize};

use crate::math::srgb::Srgb8;
use crate::options::names;

names!(WallMaterial);

/// Wall material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum WallMaterial {
    /// Matt emulsion paint, rolled on: absorbs and keeps skin grime, which is smoother than the paint.
    Matt,
    /// Gloss paint or laminate: wiped clean easily; remaining dirt shows as dull patches.
    Gloss,
    /// Fair-faced concrete with formwork joints and pores: keeps rubber and splashes, hardly any skin grime.
    Concrete,
    /// Bricks in running bond with mortar joints: keeps rubber and dust, hides skin grime.
    Brick,
    /// Glazed tiles up to 1.5 m, which are wiped clean but for their joints; matt paint above.
    Tile,
}

/// Properties of a material: absolute values, and factors on the look's settings.
#[derive(Clone, Copy, Debug)]
pub(super) struct WallProperties {
    pub colour: Srgb8,
    pub roughness: f32,
    /// Factors on the residue of a touch: skin, cloth, bag, rubber.
    ///
    /// Hands transfer 28 to 66 % of their load to painted surfaces and under 0.01 % to porous ones (Rusin, Maxwell,
    /// Gerba 2002, J. Appl. Microbiol. 93); concrete that is touched repeatedly is not quite as clean.
    pub touches: [f32; 4],
    /// Share of the history that remains after washing.
    pub history: f32,
    pub splash: f32,
    pub dust: f32,
    /// Change of the roughness by full skin grime, and by full rub of cloth and bags.
    pub grime_roughness: f32,
    pub rub_roughness: f32,
}

impl WallMaterial {
    pub(super) fn properties(self) -> WallProperties {
        match self {
            WallMaterial::Matt => WallProperties {
                colour: [228, 227, 223],
                roughness: 0.85,
                touches: [1.0; 4],
                history: 1.0,
                splash: 1.0,
                dust: 1.0,
                grime_roughness: -0.18,
                rub_roughness: -0.12,
            },
            WallMaterial::Gloss => WallProperties {
                colour: [214, 216, 206],
                roughness: 0.22,
                touches: [1.2, 0.8, 0.8, 0.9],
                history: 0.2,
                splash: 0.7,
                dust: 0.6,
                grime_roughness: 0.22,
                rub_roughness: 0.15,
            },
            WallMaterial::Concrete => WallProperties {
                colour: [160, 158, 153],
                roughness: 0.78,
                touches: [0.03, 0.35, 0.7, 1.0],
                history: 1.0,
                splash: 1.35,
                dust: 1.3,
                grime_roughness: -0.08,
                rub_roughness: -0.06,
            },
            WallMaterial::Brick => WallProperties {
                colour: [146, 92, 72],
                roughness: 0.84,
                touches: [0.15, 0.4, 0.8, 1.0],
                history: 1.0,
                splash: 1.2,
                dust: 1.5,
                grime_roughness: -0.10,
                rub_roughness: -0.06,
            },
            WallMaterial::Tile => WallProperties {
                colour: [226, 227, 222],
                roughness: 0.16,
                touches: [1.0, 0.7, 0.7, 0.8],
                history: 0.35,
                splash: 0.8,
                dust: 0.8,
                grime_roughness: 0.25,
                rub_roughness: 0.18,
            },
        }
    }
}
