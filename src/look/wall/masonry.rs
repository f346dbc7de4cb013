//! Bricks and tiles: pieces in rows with joints between them.

use super::material::WallMaterial;
use super::strip::FaceStrip;
use crate::look::lattice::TexelWindow;
use crate::look::noise;
use crate::math::smoothstep_f32;
use crate::math::srgb::{Srgb8, light_of};

/// Height up to which tiles reach, metres; paint is above.
const TILED_M: f64 = 1.5;
/// Colour and roughness of the paint above tiles.
const PAINT: Srgb8 = [228, 227, 223];
const PAINT_ROUGHNESS: f32 = 0.85;
/// Height of its grain per tone, millimetres.
const PAINT_MM: f32 = 8.0;
/// Roughness of mortar and of joints between tiles.
const JOINT_ROUGHNESS: f32 = 0.93;

/// Pieces of one kind, laid in rows.
pub(super) struct Masonry {
    key: u32,
    gain: f32,
    /// Width and height of a piece with its joint, metres.
    piece_m: [f64; 2],
    joint_m: f32,
    /// Shift of each other row, as a share of a piece.
    bond: f64,
    /// Colour of joints, linear.
    joint: [f32; 3],
    /// Deviation of the tone and of the tint between pieces.
    tone_sd: f32,
    tint_sd: f32,
    /// How much edges of pieces wander, metres.
    ragged_m: f32,
    roughness: f32,
    /// How far joints lie back, and deviation of the height between pieces, millimetres.
    joint_mm: f32,
    height_sd_mm: f32,
    /// Where the pieces end, metres.
    top_m: f64,
}

impl Masonry {
    pub fn of(material: WallMaterial, texture: f32, key: u32) -> Option<Masonry> {
        let bricks = Masonry {
            key,
            gain: texture.min(1.5),
            piece_m: [0.250, 0.0833],
            joint_m: 0.011,
            bond: 0.5,
            joint: light_of([173, 165, 153]),
            tone_sd: 0.13,
            tint_sd: 0.045,
            ragged_m: 0.0011,
            roughness: 0.84,
            joint_mm: 4.0,
            height_sd_mm: 0.7,
            top_m: f64::INFINITY,
        };
        match material {
            WallMaterial::Brick => Some(bricks),
            WallMaterial::Tile => Some(Masonry {
                piece_m: [0.15, 0.15],
                joint_m: 0.003,
                bond: 0.0,
                joint: light_of([158, 155, 148]),
                tone_sd: 0.012,
                tint_sd: 0.004,
                ragged_m: 0.0,
                roughness: 0.16,
                joint_mm: 0.8,
                height_sd_mm: 0.15,
                top_m: TILED_M,
                ..bricks
            }),
            _ => None,
        }
    }

    /// Lays the pieces over row `j`: changes the base colour, and adds to the roughness and the height. `fine` is grain in
    /// the row, which makes edges ragged.
    pub fn lay(
        &self,
        (window, strip): (&TexelWindow, &FaceStrip),
        j: i64,
        fine: &[f32],
        (rgb, rough, height): (&mut [Vec<f32>; 3], &mut [f32], &mut [f32]),
    ) {
        let texel_m = 1.0 / window.texels_per_metre;
        let up = (j as f64 + 0.5) * texel_m;
        if up >= self.top_m {
            let paint = light_of(PAINT);
            for (plane, paint) in rgb.iter_mut().zip(paint) {
                plane.iter_mut().zip(fine).for_each(|(value, fine)| *value = paint * (1.0 + 0.3 * fine));
            }
            rough.fill(PAINT_ROUGHNESS - self.roughness);
            height.iter_mut().zip(fine).for_each(|(height, fine)| *height = PAINT_MM * fine);
            return;
        }
        let length_m = f64::from(strip.width) * texel_m;
        // A whole number of pieces fits a closed face.
        let around = (length_m / self.piece_m[0]).round().max(1.0);
        let width_m = if strip.closed { length_m / around } else { self.piece_m[0] };
        let height_m = self.piece_m[1];
        let course = (up / height_m).floor();
        let from_level = (up - course * height_m).min((course + 1.0) * height_m - up) as f32;
        let shift = if course.rem_euclid(2.0) < 1.0 { 0.0 } else { self.bond * width_m };
        let texel = texel_m as f32;
        for k in 0..window.width {
            let along = ((window.i0 + k as i64) as f64 + 0.5) * texel_m + shift;
            let number = (along / width_m).floor();
            let from_side = (along - number * width_m).min((number + 1.0) * width_m - along) as f32;
            let number = if strip.closed { number.rem_euclid(around) } else { number };
            let fine = fine.get(k).copied().unwrap_or(0.0);
            // Share of the texel that is joint: its edge may be ragged.
            let edge = 0.5 * self.joint_m + self.ragged_m * (25.0 * fine).clamp(-1.5, 1.5);
            let soft = 0.5 * texel + 0.0006;
            let joint = smoothstep_f32((edge + soft - from_level.min(from_side)) / (2.0 * soft)) * self.gain.min(1.0);
            let draw = |n: u32| {
                let word = noise::mix(n.wrapping_mul(0x9e37_79b9));
                1.73 * noise::signed(self.key ^ strip.salt ^ word, number as i32, course as i32)
            };
            let tone = (1.0 + self.gain * (self.tone_sd * draw(1) + fine)).max(0.2);
            let tint = self.gain * self.tint_sd * draw(2);
            let piece = [tone * (1.0 + tint), tone, tone * (1.0 - tint)];
            for ((plane, piece), mortar) in rgb.iter_mut().zip(piece).zip(self.joint) {
                let value = plane[k] * piece;
                plane[k] = value + joint * (mortar * (1.0 + 2.0 * fine) - value);
            }
            height[k] += self.gain * self.height_sd_mm * draw(3) * (1.0 - joint) - self.joint_mm * joint;
            rough[k] = joint * (JOINT_ROUGHNESS - self.roughness) + 0.5 * fine;
        }
    }
}
