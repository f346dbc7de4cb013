use serde::{Deserialize, Serialize};

use super::target::Target;
use crate::math::{Rect, Vec2};

/// Coordinate frame of the target's world, and its relation to the plan frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TargetEntry {
    /// The target program.
    pub name: Target,
    /// Units of the target per metre.
    pub units_per_metre: f64,
    /// The target's up axis.
    pub up: String,
    /// Handedness: `right` or `left`.
    pub handed: String,
    /// Affine map from the plan to the target's world: rows for X, Y and Z in its units.
    ///
    /// Each row holds the factors of the plan's x, y and height above the floor, metres, and an offset. An imported
    /// `scene.glb` lies there.
    pub world_from_plan: [[f64; 4]; 3],
    /// The two axes of a tile's `world` rectangle.
    pub uv_axes: [String; 2],
    /// Where v is 0 in the target's shaders: at the `top` or the `bottom` of an image.
    pub v_zero: String,
    /// Convention for normal maps.
    pub normals: String,
    /// Largest side of a texture for the target, texels.
    pub largest_px: u32,
}

/// Rectangle of a tile in the target's world: `uv = (world - origin) / size`, axis by axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorldEntry {
    /// Point with uv (0, 0), units of the target.
    pub origin: [f64; 2],
    /// Extent over which uv grows by 1, units of the target. Negative where uv grows against the axis.
    pub size: [f64; 2],
}

impl Default for TargetEntry {
    fn default() -> TargetEntry {
        TargetEntry::of(Target::default())
    }
}

/// Scale, and for each axis of the target the plan's axis (x, y, height) with its sign.
struct Frame {
    units_per_metre: f64,
    rows: [(usize, f64); 3],
    /// Axes of the target along u and v.
    ground: [usize; 2],
    v_from_top: bool,
}

/// Returns the frame in which the target imports a glTF scene with points (x, height, -y).
fn frame(target: Target) -> Frame {
    const X: usize = 0;
    const Y: usize = 1;
    const HEIGHT: usize = 2;
    match target {
        Target::Gltf | Target::Godot => {
            Frame { units_per_metre: 1.0, rows: [(X, 1.0), (HEIGHT, 1.0), (Y, -1.0)], ground: [0, 2], v_from_top: true }
        }
        // The importer makes Z the height; the frame stays right-handed.
        Target::Blender => {
            Frame { units_per_metre: 1.0, rows: [(X, 1.0), (Y, 1.0), (HEIGHT, 1.0)], ground: [0, 1], v_from_top: false }
        }
        // The importer swaps glTF's Y and Z, so the frame becomes left-handed.
        Target::Unreal => Frame {
            units_per_metre: 100.0,
            rows: [(X, 1.0), (Y, -1.0), (HEIGHT, 1.0)],
            ground: [0, 1],
            v_from_top: true,
        },
        // glTFast and UnityGLTF both negate glTF's X.
        Target::Unity => Frame {
            units_per_metre: 1.0,
            rows: [(X, -1.0), (HEIGHT, 1.0), (Y, -1.0)],
            ground: [0, 2],
            v_from_top: false,
        },
    }
}

impl TargetEntry {
    /// Returns a target's entry for the manifest.
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
            normals: format!("green points {normals}"),
            largest_px: target.largest_px(),
        }
    }

    /// Maps a point of the plan and its height above the floor, metres, to the target's world.
    pub fn world(&self, p: Vec2, height_m: f64) -> [f64; 3] {
        self.world_from_plan.map(|[x, y, h, one]| x * p.x + y * p.y + h * height_m + one)
    }
}

impl WorldEntry {
    /// Maps a rectangle of the plan to a target's world.
    pub(in crate::export) fn of(target: Target, place: Rect) -> WorldEntry {
        let Frame { units_per_metre, rows, ground, v_from_top } = frame(target);
        // Corners with the texture coordinates (0, 0) and (1, 1).
        let (mut zero, mut one) = (place.min, place.max);
        if v_from_top {
            (zero.y, one.y) = (one.y, zero.y);
        }
        let along = |axis: usize, p: Vec2| {
            let (of_plan, sign) = rows[axis];
            // Adding 0.0 turns -0.0 into 0.0.
            sign * units_per_metre * [p.x, p.y, 0.0][of_plan] + 0.0
        };
        let origin = ground.map(|axis| along(axis, zero));
        let end = ground.map(|axis| along(axis, one));
        WorldEntry { origin, size: [end[0] - origin[0], end[1] - origin[1]] }
    }

    /// Returns the texture coordinates of a point of the target's world, along `uv_axes`.
    pub fn uv(&self, [a, b]: [f64; 2]) -> [f64; 2] {
        [(a - self.origin[0]) / self.size[0], (b - self.origin[1]) / self.size[1]]
    }
}
