//! The texture of each material.

use crate::look::material::Material;
use crate::look::noise::{self, Channel, Noise};
use crate::look::settings::FloorLook;
use crate::math::srgb::Srgb8;

/// Texture of a material.
pub(super) struct Texture {
    /// Relative deviations in lightness, in colour temperature.
    pub tone: Vec<Noise>,
    pub tint: Noise,
    /// Millimetres of height per unit of tone of the finest noise.
    pub relief_mm: f32,
    pub pieces: Option<Pieces>,
    pub chips: Vec<Chips>,
    pub grain: Option<Grain>,
    pub cracks: Option<Cracks>,
}

/// Planks, tiles, slabs, sheets.
pub(super) struct Pieces {
    pub size_m: [f64; 2],
    pub gap_m: f64,
    /// How deep gaps are, millimetres.
    pub gap_mm: f32,
    /// Standard deviations of tone and tint between pieces, and of their roughness.
    pub sd: f32,
    pub tint_sd: f32,
    pub rough_sd: f32,
    /// Share of pieces that are darker, and by how much.
    pub dark: [f32; 2],
    /// How far worn edges reach beside a gap, metres: 0 are sharp ones.
    pub bevel_m: f64,
    /// How much the loops of a pile show.
    pub loops: f32,
    /// Shift of each row along x: a random one, or this share of a piece.
    pub shift: Option<f64>,
    pub key: u32,
}

/// Chips, flecks or pores strewn over the surface.
pub(super) struct Chips {
    /// One chip at most in a square of this side.
    pub spacing_m: f64,
    /// Share of squares with a chip.
    pub share: f32,
    /// Least and greatest radius, in spacings. 0: chips fill the surface as a mosaic, with a gap of the second number.
    pub radius: [f32; 2],
    /// Relative tone and tint of the kinds of chips.
    pub kinds: &'static [[f32; 2]],
    /// Height of a chip, millimetres.
    pub height_mm: f32,
    pub gain: f32,
    pub key: u32,
}

/// The grain of boards: streaks along x, with the arches of flat-sawn wood.
pub(super) struct Grain {
    pub gain: f32,
    pub key: u32,
}

/// Hairline cracks.
pub(super) struct Cracks {
    pub spacing_m: f64,
    pub width_m: f32,
    pub key: u32,
}

/// Colour of the joints of a material.
pub(super) fn joint_colour(material: Material) -> Srgb8 {
    match material {
        Material::Wood => [70, 52, 38],
        Material::Vinyl => [176, 171, 161],
        Material::Dark => [50, 48, 46],
        Material::Terrazzo => [150, 138, 110],
        Material::Carpet => [92, 94, 99],
        Material::Concrete => [96, 93, 88],
        Material::Stone => [158, 150, 136],
        Material::Asphalt => [62, 60, 58],
        Material::Paving => [112, 105, 92],
        Material::Tile => [160, 156, 148],
    }
}

impl Texture {
    pub(super) fn of(floor: &FloorLook, seed: u64) -> Texture {
        let gain = floor.texture;
        let key = |n: u32| noise::key(seed, Channel::Piece).wrapping_add(n.wrapping_mul(0x51_7c_c1));
        // Length and width of spots, metres, and deviation.
        type Spots = (f64, f64, f32);
        let round = |size: f64, sd: f32| (size, size, sd);
        let tones = |tone: [Spots; 3], tint: Spots, relief_mm: f32| {
            let noise = |channel, (x, y, sd): Spots| Noise::new(seed, channel, [x, y], sd * gain);
            let channels = [Channel::Ground, Channel::GroundMiddle, Channel::GroundCoarse];
            Texture {
                tone: channels.into_iter().zip(tone).map(|(channel, spots)| noise(channel, spots)).collect(),
                tint: noise(Channel::GroundTint, tint),
                relief_mm,
                pieces: None,
                chips: Vec::new(),
                grain: None,
                cracks: None,
            }
        };
        let pieces = |size_m: [f64; 2], gap_m: f64, sd: f32| Pieces {
            size_m,
            gap_m,
            gap_mm: 1.5,
            sd: sd * gain,
            tint_sd: 0.2 * sd * gain,
            rough_sd: 0.01 * gain,
            dark: [0.0; 2],
            bevel_m: 0.0,
            loops: 0.0,
            shift: Some(0.0),
            key: key(0),
        };
        let chips = |n: u32, spacing_m: f64, share: f32, radius: [f32; 2], kinds, height_mm: f32| Chips {
            spacing_m,
            share,
            radius,
            kinds,
            height_mm,
            gain,
            key: key(n),
        };
        match floor.material {
            // Sheets of 2 m with welded seams, and flecks.
            Material::Vinyl => Texture {
                pieces: Some(Pieces { gap_mm: 0.1, ..pieces([24.0, 2.0], 0.004, 0.012) }),
                chips: vec![
                    chips(1, 0.011, 0.7, [0.18, 0.42], &[[-0.09, 0.0], [0.06, 0.0], [-0.05, 0.02]], 0.0),
                    chips(2, 0.006, 0.6, [0.15, 0.40], &[[-0.05, 0.0], [0.04, -0.01]], 0.0),
                ],
                ..tones([round(0.004, 0.016), round(0.05, 0.006), round(1.1, 0.012)], round(0.3, 0.004), 0.6)
            },
            // Studded rubber would be a pattern of its own: this is smooth rubber with flecks, in sheets.
            Material::Dark => Texture {
                pieces: Some(Pieces { gap_mm: 0.1, ..pieces([24.0, 2.0], 0.003, 0.02) }),
                // Through a lane's film half of their contrast is left.
                chips: vec![
                    chips(1, 0.012, 0.5, [0.15, 0.38], &[[1.3, 0.0], [0.5, 0.06], [-0.6, 0.0], [-0.6, 0.0]], 0.0),
                    chips(2, 0.006, 0.5, [0.12, 0.36], &[[0.4, 0.0], [-0.35, 0.0]], 0.0),
                ],
                ..tones([round(0.005, 0.05), round(0.05, 0.015), round(0.9, 0.02)], round(0.01, 0.01), 0.8)
            },
            // Chips of 4 to 15 mm in a matrix, and brass strips.
            Material::Terrazzo => Texture {
                pieces: Some(Pieces { gap_mm: 0.0, ..pieces([1.8, 1.8], 0.003, 0.015) }),
                chips: vec![
                    chips(
                        1,
                        0.0065,
                        0.75,
                        [0.0, 0.10],
                        &[[0.10, 0.0], [-0.12, 0.02], [0.03, -0.02], [-0.03, 0.0]],
                        0.01,
                    ),
                    // Broken marble: edges, and every size up to 2 cm.
                    chips(
                        2,
                        0.013,
                        0.42,
                        [0.0, 0.20],
                        &[[0.20, 0.0], [-0.38, 0.03], [-0.20, 0.08], [0.12, 0.03], [-0.55, -0.02], [0.18, -0.02]],
                        0.02,
                    ),
                    chips(
                        3,
                        0.026,
                        0.22,
                        [0.0, 0.30],
                        &[[0.22, 0.0], [-0.42, 0.02], [-0.24, 0.08], [0.16, 0.04], [-0.58, -0.01]],
                        0.02,
                    ),
                ],
                ..tones([round(0.004, 0.03), round(0.08, 0.02), round(0.8, 0.015)], round(0.5, 0.006), 0.1)
            },
            // Bays with saw cuts, clouds of trowelling, pores, hairline cracks.
            Material::Concrete => Texture {
                pieces: Some(Pieces { gap_mm: 3.0, ..pieces([4.8, 4.8], 0.005, 0.03) }),
                chips: vec![
                    // Bubbles, most of them small, and grains of sand.
                    chips(1, 0.05, 0.5, [0.015, 0.11], &[[-0.34, 0.0], [-0.22, 0.0]], -0.8),
                    chips(2, 0.017, 0.45, [0.03, 0.11], &[[-0.26, 0.0], [-0.16, 0.0]], -0.4),
                    chips(4, 0.0045, 0.8, [0.0, 0.15], &[[0.05, 0.01], [-0.06, 0.0], [0.02, -0.01]], 0.04),
                ],
                cracks: Some(Cracks { spacing_m: 2.9, width_m: 0.0008, key: key(3) }),
                ..tones([round(0.012, 0.03), round(0.14, 0.03), round(1.3, 0.05)], round(0.8, 0.008), 3.0)
            },
            Material::Wood => Texture {
                pieces: Some(Pieces {
                    tint_sd: 0.025 * gain,
                    rough_sd: 0.03 * gain,
                    shift: None,
                    ..pieces([1.35, 0.13], 0.0014, 0.085)
                }),
                grain: Some(Grain { gain, key: key(4) }),
                ..tones([(0.30, 0.003, 0.035), (0.9, 0.03, 0.02), round(0.6, 0.01)], (0.9, 0.05, 0.01), 1.2)
            },
            // Tiles of 0.5 m with the pile turned from tile to tile.
            Material::Carpet => Texture {
                pieces: Some(Pieces {
                    gap_mm: 1.0,
                    tint_sd: 0.02 * gain,
                    loops: gain,
                    ..pieces([0.5, 0.5], 0.0015, 0.030)
                }),
                chips: vec![chips(1, 0.005, 1.0, [0.0, 0.16], &[[0.24, 0.0], [-0.26, 0.02], [0.0, -0.03]], 1.5)],
                ..tones([round(0.009, 0.10), (0.30, 0.01, 0.03), round(0.7, 0.02)], round(0.012, 0.02), 4.0)
            },
            Material::Tile => Texture {
                pieces: Some(Pieces {
                    dark: [0.04, 0.06 * gain],
                    rough_sd: 0.03 * gain,
                    bevel_m: 0.0015,
                    ..pieces([floor.tile_m; 2], floor.joint_m, 0.022)
                }),
                chips: vec![chips(1, 0.004, 0.5, [0.15, 0.4], &[[-0.12, 0.0], [0.05, 0.0]], 0.0)],
                ..tones([round(0.012, 0.012), round(0.08, 0.012), round(0.9, 0.006)], round(0.1, 0.005), 0.2)
            },
            // Honed limestone in a running bond.
            Material::Stone => Texture {
                pieces: Some(Pieces {
                    dark: [0.10, 0.10 * gain],
                    tint_sd: 0.009 * gain,
                    rough_sd: 0.04 * gain,
                    bevel_m: 0.004,
                    shift: Some(0.5),
                    ..pieces([0.9, 0.6], 0.004, 0.045)
                }),
                chips: vec![
                    // Shells and pits.
                    chips(1, 0.03, 0.5, [0.03, 0.17], &[[-0.12, 0.01], [0.08, 0.0], [-0.2, 0.02]], -0.2),
                    chips(2, 0.008, 0.4, [0.06, 0.22], &[[-0.10, 0.01], [0.05, 0.0], [-0.16, 0.01]], -0.15),
                ],
                grain: Some(Grain { gain: 0.6 * gain, key: key(4) }),
                ..tones([round(0.006, 0.025), (0.20, 0.05, 0.03), round(0.7, 0.02)], round(0.25, 0.01), 0.5)
            },
            Material::Asphalt => Texture {
                pieces: Some(Pieces { gap_mm: 0.5, ..pieces([60.0, 3.5], 0.012, 0.03) }),
                chips: vec![
                    chips(
                        1,
                        0.009,
                        0.85,
                        [0.0, 0.12],
                        &[[0.26, 0.02], [-0.36, 0.0], [-0.08, 0.0], [0.45, 0.01], [-0.52, 0.0]],
                        2.0,
                    ),
                    // Single stones that stand out of the tar.
                    chips(
                        2,
                        0.017,
                        0.4,
                        [0.0, 0.26],
                        &[[0.60, 0.02], [0.14, 0.0], [-0.46, 0.0], [0.36, 0.03], [-0.52, 0.0]],
                        1.2,
                    ),
                ],
                cracks: Some(Cracks { spacing_m: 3.7, width_m: 0.004, key: key(3) }),
                ..tones([round(0.009, 0.10), round(0.12, 0.03), round(1.6, 0.05)], round(0.9, 0.006), 6.0)
            },
            Material::Paving => Texture {
                pieces: Some(Pieces {
                    gap_mm: 4.0,
                    dark: [0.12, 0.10 * gain],
                    tint_sd: 0.012 * gain,
                    bevel_m: 0.004,
                    shift: Some(0.5),
                    ..pieces([0.40, 0.20], 0.005, 0.06)
                }),
                chips: vec![chips(1, 0.005, 0.8, [0.0, 0.12], &[[0.16, 0.0], [-0.16, 0.02], [0.04, -0.02]], 0.6)],
                ..tones([round(0.006, 0.06), round(0.06, 0.03), round(0.8, 0.02)], round(0.2, 0.01), 3.0)
            },
        }
    }
}
