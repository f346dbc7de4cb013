use serde::{Deserialize, Serialize};

use super::target::Target;
use crate::math::{Rect, Vec2};

/// The target's world: how places of the plan become places there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TargetEntry {
    /// What the files were made for.
    pub name: Target,
    /// Units of the target in a metre.
    pub units_per_metre: f64,
    /// The axis that points up.
    pub up: String,
    /// `right` or `left`.
    pub handed: String,
    /// Three rows, for X, Y and Z of the target in its units: factors of the plan's x, y and height above the floor in
    /// metres, and what is added. `scene.glb` lies there once the target has read it.
    pub world_from_plan: [[f64; 4]; 3],
    /// The two axes of which the `world` of a tile speaks.
    pub uv_axes: [String; 2],
    /// Where v of that is 0: at the `top` of an image or at its `bottom`, as the target's shaders have it.
    pub v_zero: String,
    /// What is to be known of normal maps.
    pub normals: String,
    /// The largest side of a texture that the target takes, texels.
    pub largest_px: u32,
}

/// Where a tile lies in the target's world: `uv = (world - origin) / size`, axis by axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorldEntry {
    /// Place at which uv is (0, 0), units of the target.
    pub origin: [f64; 2],
    /// What uv grows by 1 over, units of the target. Negative where uv grows against the axis.
    pub size: [f64; 2],
}

impl Default for TargetEntry {
    fn default() -> TargetEntry {
        TargetEntry::of(Target::default())
    }
}

/// Scale, and for X, Y and Z of the target the axis of the plan (x, y, height) with its sign.
struct Frame {
    units_per_metre: f64,
    rows: [(usize, f64); 3],
    /// Axes of the target that u and v run along.
    ground: [usize; 2],
    v_from_top: bool,
}

/// Where an importer of glTF puts the scene, whose places are (x, height, -y).
fn frame(target: Target) -> Frame {
    const X: usize = 0;
    const Y: usize = 1;
    const HEIGHT: usize = 2;
    match target {
        Target::Gltf | Target::Godot => {
            Frame { units_per_metre: 1.0, rows: [(X, 1.0), (HEIGHT, 1.0), (Y, -1.0)], ground: [0, 2], v_from_top: true }
        }
        // Its importer makes Z the height and keeps the hand.
        Target::Blender => {
            Frame { units_per_metre: 1.0, rows: [(X, 1.0), (Y, 1.0), (HEIGHT, 1.0)], ground: [0, 1], v_from_top: false }
        }
        // Its importer swaps glTF's Y and Z, which makes the hand left.
        Target::Unreal => Frame {
            units_per_metre: 100.0,
            rows: [(X, 1.0), (Y, -1.0), (HEIGHT, 1.0)],
            ground: [0, 1],
            v_from_top: true,
        },
        // glTFast and UnityGLTF both take glTF's X negative.
        Target::Unity => Frame {
            units_per_metre: 1.0,
            rows: [(X, -1.0), (HEIGHT, 1.0), (Y, -1.0)],
            ground: [0, 2],
            v_from_top: false,
        },
    }
}

impl TargetEntry {
    /// What a manifest says of a target.
    pub fn of(target: Target) -> TargetEntry {
        let Frame { units_per_metre, rows, ground, v_from_top } = frame(target);
        let (up, handed, normals) = match target {
            Target::Gltf => ("Y", "right", "up (OpenGL)"),
            Target::Godot => ("Y", "right", "up (OpenGL)"),
            Target::Blender => ("Z", "right", "up (OpenGL)"),
            Target::Unity => ("Y", "left", "up (OpenGL)"),
            Target::Unreal => ("Z", "left", "down (DirectX)"),
        };
        TargetEntry {
            name: target,
            units_per_metre,
            up: up.to_string(),
            handed: handed.to_string(),
            world_from_plan: rows.map(|(axis, sign)| {
                let mut row = [0.0; 4];
                row[axis] = sign * units_per_metre;
                row
            }),
            uv_axes: ground.map(|axis| ["X", "Y", "Z"][axis].to_string()),
            v_zero: if v_from_top { "top" } else { "bottom" }.to_string(),
            normals: format!("none are written; in the target's own, green points {normals}"),
            largest_px: target.largest_px(),
        }
    }

    /// A place of the plan frame, metres, with its height above the floor, in the target's world.
    pub fn world(&self, p: Vec2, height_m: f64) -> [f64; 3] {
        self.world_from_plan.map(|[x, y, h, one]| x * p.x + y * p.y + h * height_m + one)
    }
}

impl WorldEntry {
    /// Where a rectangle of the plan lies in a target's world.
    pub(in crate::export) fn of(target: Target, place: Rect) -> WorldEntry {
        let Frame { units_per_metre, rows, ground, v_from_top } = frame(target);
        // Where an image's texture coordinates are (0, 0) and (1, 1).
        let (mut zero, mut one) = (place.min, place.max);
        if v_from_top {
            (zero.y, one.y) = (one.y, zero.y);
        }
        let along = |axis: usize, p: Vec2| {
            let (of_plan, sign) = rows[axis];
            // Adding nothing makes no zero negative.
            sign * units_per_metre * [p.x, p.y, 0.0][of_plan] + 0.0
        };
        let origin = ground.map(|axis| along(axis, zero));
        let end = ground.map(|axis| along(axis, one));
        WorldEntry { origin, size: [end[0] - origin[0], end[1] - origin[1]] }
    }

    /// Texture coordinates of a place of the target's world, along the manifest's `uv_axes`.
    pub fn uv(&self, [a, b]: [f64; 2]) -> [f64; 2] {
        [(a - self.origin[0]) / self.size[0], (b - self.origin[1]) / self.size[1]]
    }
}
