/// Surface material of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SceneSurface {
    /// A floor texture: place in the manifest's list of tiles.
    FloorTile(usize),
    /// A wall texture: place in the manifest's list of sheets.
    WallSheet(usize),
    /// Tops of walls and outer sides of the plan, in one plain colour.
    WallTop,
    /// Clean wall: above a door, with its underside, and wherever a wall has no texture.
    Lintel,
    /// Furniture, doors and windows of one material: its place in the list of those.
    Fitting(usize),
    /// Ceiling over the floor.
    Ceiling,
}

/// Triangles that share a surface. All lists but `indices` have an entry per vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Its material.
    pub surface: SceneSurface,
    /// x, y in the plan frame and height above the floor, metres.
    pub positions_m: Vec<[f32; 3]>,
    /// Unit vectors in the same frame.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates from 0 to 1 within the tile or sheet, from its upper left, v downward; metres along and
    /// against the surface's height or the plan's y for surfaces without a texture.
    pub uvs: Vec<[f32; 2]>,
    /// Three per triangle, counter-clockwise seen from its front.
    pub indices: Vec<u32>,
    /// Of a wall sheet: wall faces ([`Walls::faces`](crate::walls::Walls::faces)), each with the first of the triangles
    /// that show it.
    pub faces: Vec<[u32; 2]>,
    /// Texture coordinates from 0 to 1 within a light map of the mesh; empty without one.
    pub light_uvs: Vec<[f32; 2]>,
}

/// A whole plan as triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// By surface, each once.
    pub meshes: Vec<Mesh>,
}

/// Which piece of a wall face a piece of a wall sheet shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallStrip {
    /// Index into [`Walls::faces`](crate::walls::Walls::faces).
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
    /// Texture coordinates at an arc length from the face's start, and at a share of the wall's height.
    pub(super) fn uv_at(&self, along_m: f64, up: f64) -> [f64; 2] {
        let [from, to] = self.along_m;
        let share = if to > from { ((along_m - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
        let [start, end, above] = self.uv;
        [0, 1].map(|k| start[k] + (end[k] - start[k]) * share + (above[k] - start[k]) * up)
    }
}

/// The least and the greatest coordinates of some points.
pub(super) fn bounds(points: impl Iterator<Item = [f32; 3]>) -> Option<[[f32; 3]; 2]> {
    points.fold(None, |bounds, p| {
        let [mut least, mut greatest] = bounds.unwrap_or([p, p]);
        for k in 0..3 {
            least[k] = least[k].min(p[k]);
            greatest[k] = greatest[k].max(p[k]);
        }
        Some([least, greatest])
    })
}
