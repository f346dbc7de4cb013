//! Collects triangles into parts; corners that agree in everything are one vertex.

use std::collections::{BTreeMap, HashMap};

use super::model::{Mesh, Scene, SceneSurface};

/// A scene that is being built: a part per surface.
#[derive(Debug, Default)]
pub(super) struct SceneBuilder {
    parts: BTreeMap<SceneSurface, MeshBuilder>,
}

impl SceneBuilder {
    /// The part with this surface.
    pub fn part(&mut self, surface: SceneSurface) -> &mut MeshBuilder {
        self.parts.entry(surface).or_insert_with(|| MeshBuilder::new(surface))
    }

    /// All parts that have triangles, by surface.
    pub fn finish(self) -> Scene {
        Scene { meshes: self.parts.into_values().filter_map(MeshBuilder::finish).collect() }
    }
}

/// A corner of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MeshVertex {
    /// Plan frame and height, metres.
    pub position_m: [f64; 3],
    pub normal: [f64; 3],
    /// As in [`Mesh::uvs`].
    pub uv: [f64; 2],
}

/// A part that is being built.
#[derive(Debug)]
pub(super) struct MeshBuilder {
    part: Mesh,
    /// By the bits of all its numbers.
    known: HashMap<[u32; 8], u32>,
}

impl MeshBuilder {
    fn new(surface: SceneSurface) -> MeshBuilder {
        let (positions_m, normals, uvs) = (Vec::new(), Vec::new(), Vec::new());
        let part =
            Mesh { surface, positions_m, normals, uvs, indices: Vec::new(), faces: Vec::new(), light_uvs: Vec::new() };
        MeshBuilder { part, known: HashMap::new() }
    }

    /// Adds a convex polygon of a wall face to a wall sheet.
    pub fn wall(&mut self, face: usize, corners: &[MeshVertex]) {
        let [face, first] = [face, self.part.indices.len() / 3].map(|number| number as u32);
        if self.part.faces.last().is_none_or(|[last, _]| *last != face) {
            self.part.faces.push([face, first]);
        }
        self.polygon(corners);
    }

    /// Adds a triangle, counter-clockwise seen from its front, unless it has no area in single precision.
    pub fn triangle(&mut self, corners: [MeshVertex; 3]) {
        let positions = corners.map(|c| single(c.position_m));
        if !has_area(positions) {
            return;
        }
        for corner in corners {
            let index = self.vertex(&corner);
            self.part.indices.push(index);
        }
    }

    /// Adds a convex polygon, counter-clockwise seen from its front.
    pub fn polygon(&mut self, corners: &[MeshVertex]) {
        for k in 2..corners.len() {
            self.triangle([corners[0], corners[k - 1], corners[k]]);
        }
    }

    fn vertex(&mut self, vertex: &MeshVertex) -> u32 {
        let position = single(vertex.position_m);
        let normal = single(vertex.normal);
        let uv = single(vertex.uv);
        let [x, y, z] = position.map(f32::to_bits);
        let [nx, ny, nz] = normal.map(f32::to_bits);
        let [u, v] = uv.map(f32::to_bits);
        let part = &mut self.part;
        *self.known.entry([x, y, z, nx, ny, nz, u, v]).or_insert_with(|| {
            part.positions_m.push(position);
            part.normals.push(normal);
            part.uvs.push(uv);
            (part.positions_m.len() - 1) as u32
        })
    }

    /// The part, or nothing if it has no triangle.
    fn finish(self) -> Option<Mesh> {
        (!self.part.indices.is_empty()).then_some(self.part)
    }
}

/// To single precision, with one zero only.
fn single<const N: usize>(values: [f64; N]) -> [f32; N] {
    values.map(|v| v as f32 + 0.0)
}

/// Whether three corners are finite and no two sides lie on each other.
fn has_area([a, b, c]: [[f32; 3]; 3]) -> bool {
    let side = |p: [f32; 3], q: [f32; 3]| [0, 1, 2].map(|k| f64::from(q[k]) - f64::from(p[k]));
    let (u, v) = (side(a, b), side(a, c));
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let squared: f64 = cross.iter().map(|v| v * v).sum();
    squared.is_finite() && squared > 0.0
}
