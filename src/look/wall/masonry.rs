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

/// Width of the darker rim of a brick, metres.
const RIM_M: f32 = 0.01;

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
    /// How much edges of pieces wander, and radius of their corners, metres.
    ragged_m: f32,
    corner_m: f32,
    /// Deviation of the tone from end to end of a piece, as of the kiln, and how much darker its rim is.
    fired_sd: f32,
    rim: f32,
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
            joint: light_of([161, 153, 141]),
            tone_sd: 0.13,
            tint_sd: 0.045,
            ragged_m: 0.0011,
            corner_m: 0.005,
            fired_sd: 0.08,
            rim: 0.14,
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
                corner_m: 0.001,
                fired_sd: 0.0,
                rim: 0.0,
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
    /// the row, `spots` are those of the size by which edges wander.
    pub fn lay(
        &self,
        (window, strip): (&TexelWindow, &FaceStrip),
        j: i64,
        (fine, spots): (&[f32], &[f32]),
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
        let from_middle = (up - (course + 0.5) * height_m) as f32;
        let half = [width_m, height_m].map(|side| 0.5 * (side as f32 - self.joint_m) - self.corner_m);
        let shift = if course.rem_euclid(2.0) < 1.0 { 0.0 } else { self.bond * width_m };
        let soft = 0.5 * texel_m as f32 + 0.0006;
        for k in 0..window.width {
            let along = ((window.i0 + k as i64) as f64 + 0.5) * texel_m + shift;
            let number = (along / width_m).floor();
            let across = (along - (number + 0.5) * width_m) as f32;
            let number = if strip.closed { number.rem_euclid(around) } else { number };
            let of = |row: &[f32]| row.get(k).copied().unwrap_or(0.0);
            let (fine, spot) = (of(fine), of(spots));
            // How far the texel lies beyond the edge of a piece with round corners.
            let [x, y] = [across.abs() - half[0], from_middle.abs() - half[1]];
            let beyond = (x.max(0.0) * x.max(0.0) + y.max(0.0) * y.max(0.0)).sqrt() + x.max(y).min(0.0) - self.corner_m
                + self.ragged_m * (28.0 * spot + 6.0 * fine).clamp(-1.5, 1.5);
            let joint = smoothstep_f32((beyond + soft) / (2.0 * soft)) * self.gain.min(1.0);
            let draw = |n: u32| {
                let word = noise::mix(n.wrapping_mul(0x9e37_79b9));
                1.73 * noise::signed(self.key ^ strip.salt ^ word, number as i32, course as i32)
            };
            let fired = self.fired_sd * draw(4) * across / half[0];
            let rim = self.rim * smoothstep_f32(1.0 + beyond / RIM_M);
            let tone = (1.0 + self.gain * (self.tone_sd * draw(1) + fired + fine - rim)).max(0.2);
            let tint = self.gain * self.tint_sd * draw(2);
            let piece = [tone * (1.0 + tint), tone, tone * (1.0 - tint)];
            for ((plane, piece), mortar) in rgb.iter_mut().zip(piece).zip(self.joint) {
                let value = plane[k] * piece;
                plane[k] = value + joint * (mortar * (1.0 + 2.0 * fine + 3.0 * spot) - value);
            }
            height[k] += self.gain * self.height_sd_mm * draw(3) * (1.0 - joint) - self.joint_mm * joint;
            rough[k] = joint * (JOINT_ROUGHNESS - self.roughness) + 0.5 * fine;
        }
    }
}
