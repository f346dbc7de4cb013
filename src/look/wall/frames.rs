//! Frames of doors, as images on the jambs and beside them.

use super::settings::WallLook;
use super::strip::FaceStrip;
use crate::look::lattice::TexelWindow;
use crate::math::srgb;
use crate::walls::{Doorway, Walls};

/// Widest door that has a frame, metres; broader ones are openings.
pub(crate) const WIDEST_FRAMED_M: f64 = 1.6;
/// Roughness of a frame: lacquer.
const ROUGHNESS: f32 = 0.38;
/// Joint between frame and wall: width, metres, and share of light that it absorbs.
const JOINT_M: f32 = 0.004;
const JOINT_DEPTH: f32 = 0.45;
/// Thickness of a frame, and how deep its joint is per share of light, millimetres.
const FRAME_MM: f32 = 8.0;
const JOINT_MM: f32 = 9.0;

/// A frame's side on a face.
#[derive(Clone, Copy, Debug)]
struct FrameSide {
    from_m: f64,
    to_m: f64,
    top_m: f32,
}

/// The frames of all doors.
#[derive(Default)]
pub(super) struct Frames {
    colour: [f32; 3],
    faces: Vec<Vec<FrameSide>>,
}

impl Frames {
    pub fn new(walls: &Walls, doorways: &[Doorway], look: &WallLook) -> Frames {
        let mut faces = vec![Vec::new(); walls.faces.len()];
        let framed = |door: &&Doorway| look.frame_m > 0.0 && door.width_m() <= WIDEST_FRAMED_M;
        for door in doorways.iter().filter(framed) {
            for (face, along_m) in door.on_faces {
                let half_m = 0.5 * door.depth_m + f64::from(look.frame_m);
                let top_m = door.head_m as f32 + look.frame_m;
                if let Some(sides) = faces.get_mut(face) {
                    sides.push(FrameSide { from_m: along_m - half_m, to_m: along_m + half_m, top_m });
                }
            }
        }
        Frames { colour: srgb::light_of(look.frame_colour), faces }
    }

    /// Whether a window shows part of a frame.
    pub fn touches(&self, window: &TexelWindow, strip: &FaceStrip) -> bool {
        let low = window.j0 as f64 / window.texels_per_metre;
        let sides = self.faces.get(strip.face).into_iter().flatten();
        sides.filter(|side| low < f64::from(side.top_m)).any(|side| !columns(side, window, strip).is_empty())
    }

    /// Paints the frames over row `j` of a clean wall of this roughness, with a share `board` of skirting board.
    pub fn paint(
        &self,
        (window, strip): (&TexelWindow, &FaceStrip),
        j: i64,
        (roughness, board): (f32, f32),
        (rgb, rough, height): (&mut [Vec<f32>; 3], &mut Vec<f32>, &mut [f32]),
    ) {
        let texel_m = (1.0 / window.texels_per_metre) as f32;
        let low_m = j as f32 * texel_m;
        for side in self.faces.get(strip.face).into_iter().flatten() {
            let up = ((side.top_m - low_m) / texel_m).clamp(0.0, 1.0);
            if up <= 0.0 {
                continue;
            }
            for (k, from_side_m) in columns(side, window, strip) {
                let edge_m = (from_side_m as f32).min(side.top_m - low_m - 0.5 * texel_m);
                // Shares of the texel that are frame and that are joint.
                let frame = up * ((from_side_m as f32) / texel_m + 0.5).clamp(0.0, 1.0);
                let joint =
                    JOINT_DEPTH * (JOINT_M / texel_m).min(1.0) * (1.0 - edge_m / JOINT_M.max(texel_m)).clamp(0.0, 1.0);
                height[k] += frame * (FRAME_MM - JOINT_MM * joint - height[k]);
                for (plane, colour) in rgb.iter_mut().zip(self.colour) {
                    plane[k] += frame * (colour * (1.0 - joint) - plane[k]);
                }
                if rough.is_empty() {
                    rough.resize(window.width, 0.0);
                }
                // Roughness counts from the wall with its board.
                rough[k] += frame * (ROUGHNESS - roughness - rough[k]) * (1.0 - board);
            }
        }
    }
}

/// Columns of a window on a side, with the distance from its nearer end, metres.
fn columns(side: &FrameSide, window: &TexelWindow, strip: &FaceStrip) -> Vec<(usize, f64)> {
    let t = window.texels_per_metre;
    let turn = if strip.closed { f64::from(strip.width) } else { 0.0 };
    let mut found = Vec::new();
    for shift in if strip.closed { vec![-turn, 0.0, turn] } else { vec![0.0] } {
        let [from, to] = [side.from_m * t + shift, side.to_m * t + shift];
        let first = ((from - 1.0).floor() as i64).max(window.i0);
        let last = ((to + 1.0).ceil() as i64).min(window.i0 + window.width as i64);
        for i in first..last {
            let middle = i as f64 + 0.5;
            let inside = (middle - from).min(to - middle);
            if inside > -0.5 {
                found.push(((i - window.i0) as usize, inside / t));
            }
        }
    }
    found
}
