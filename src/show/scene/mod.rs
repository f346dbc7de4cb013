//! The baked plan as triangles: floor, walls, their tops, lintels over doors.

use crate::math::Rect;
use crate::walls::{Doorway, Walls};

mod builder;
mod faces;
mod floor;
mod glb;
mod lintels;
mod region;
#[cfg(test)]
mod tests;
mod tiles;
mod tops;

pub use glb::{GlbImage, GlbOptions, MOST_EMBEDDED_PX, PlainMaterial, SurfaceImages, write_glb};

/// What a part of the scene is covered with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Surface {
    /// A floor texture: place in the manifest's list of tiles.
    FloorTile(usize),
    /// A wall texture: place in the manifest's list of sheets.
    WallSheet(usize),
    /// What lies on top of walls, and the outer sides of the plan: nobody sees more of it than its colour.
    WallTop,
    /// Clean wall: above a door, with its underside, and wherever a wall has no texture.
    Lintel,
}

/// Triangles that share a surface. All lists but `indices` have an entry per vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// What it is covered with.
    pub surface: Surface,
    /// x, y in the plan frame and height above the floor, metres.
    pub positions_m: Vec<[f32; 3]>,
    /// Unit vectors in the same frame.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates from 0 to 1 within the tile or sheet, from its upper left, v downward; empty for surfaces
    /// without a texture.
    pub uvs: Vec<[f32; 2]>,
    /// Three per triangle, counter-clockwise for who sees its front.
    pub indices: Vec<u32>,
}

/// A whole plan as triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// By surface, each once.
    pub parts: Vec<Part>,
}

/// Which piece of a wall face a piece of a wall sheet shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallStrip {
    /// Index into [`Walls::faces`].
    pub face: usize,
    /// Place in the manifest's list of sheets.
    pub sheet: usize,
    /// Arc lengths from the face's start at which the piece starts and ends, metres.
    pub along_m: [f64; 2],
    /// Texture coordinates (0 to 1 from the sheet's upper left, v downward) of three of its corners: start and end on
    /// the floor, and the start at the wall's top. A strip may be turned.
    pub uv: [[f64; 2]; 3],
}

impl WallStrip {
    /// Texture coordinates at an arc length from the face's start, on the floor or at the wall's top.
    fn uv_at(&self, along_m: f64, top: bool) -> [f64; 2] {
        let [from, to] = self.along_m;
        let share = if to > from { ((along_m - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
        let [start, end, above] = self.uv;
        let up = if top { 1.0 } else { 0.0 };
        [0, 1].map(|k| start[k] + (end[k] - start[k]) * share + (above[k] - start[k]) * up)
    }
}

/// Sizes that a plan does not tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneOptions {
    /// Height of the walls, metres.
    pub wall_height_m: f64,
    /// Thickness that outer walls are shown with, metres, 0 to 10: plans do not tell what is behind them.
    pub rim_m: f64,
}

impl Default for SceneOptions {
    fn default() -> SceneOptions {
        SceneOptions { wall_height_m: 2.6, rim_m: 0.2 }
    }
}

/// Lintels are at least this high, metres.
const LOWEST_LINTEL_M: f64 = 0.05;

/// A plan as triangles.
///
/// `tiles` are the places of the floor's textures in the plan frame, in the manifest's order; floor outside all of
/// them is left out. `strips` tell which wall is found where on the wall sheets; wall that is on none is clean
/// ([`Surface::Lintel`]).
///
/// The floor has the walls' real outline, with holes and islands, cut at the tiles' borders such that neighbours
/// share their corners. Wall faces are upright quads with smooth normals round curved walls (turns of less than 40
/// degrees) and hard ones at edges. What is solid between floors is closed on top at the walls' height, and the outer
/// walls are shown as a rim with its outer sides; above doors that are at least 5 cm lower than the walls are lintels; where the floor goes on beyond the plan it is open. All triangles
/// have an area and are counter-clockwise for who sees their front.
///
/// The same triangles in the same order on every machine.
pub fn build(
    walls: &Walls,
    tiles: &[Rect],
    strips: &[WallStrip],
    doorways: &[Doorway],
    options: &SceneOptions,
) -> Scene {
    let height_m = options.wall_height_m;
    let mut scene = builder::SceneBuilder::default();
    let cuts = tiles::TileCuts::new(tiles);
    let floor = region::Region::inside_right(walls.outlines().iter().map(|o| o.points_m.iter().copied()));
    floor::add(&floor, tiles, &cuts, &mut scene);
    faces::add(&walls.faces, strips, &cuts, height_m, &mut scene);
    let solid = tops::Solid::around(&floor, walls.outlines(), options.rim_m.clamp(0.0, 10.0));
    solid.add_tops(height_m, scene.part(Surface::WallTop));
    solid.add_sides(height_m, scene.part(Surface::WallTop));
    let mut heads_m: Vec<f64> =
        doorways.iter().map(|door| door.head_m).filter(|head_m| height_m - head_m >= LOWEST_LINTEL_M).collect();
    heads_m.sort_by(f64::total_cmp);
    heads_m.dedup();
    for head_m in heads_m {
        let alike = doorways.iter().filter(|door| door.head_m == head_m);
        lintels::add(&floor, walls, alike, [head_m.max(0.0), height_m], &mut scene);
    }
    scene.finish()
}
