//! The floor's real outline as triangles, one part per tile.

use super::builder::{MeshVertex, SceneBuilder};
use super::model::SceneSurface;
use super::region::PolygonSet;
use super::tiles::TileCuts;
use crate::math::{Rect, Vec2};

/// Adds the floor's triangles by tile. Floor where there is no tile is left out.
pub(super) fn add(floor: &PolygonSet, tiles: &[Rect], cuts: &TileCuts, scene: &mut SceneBuilder) {
    for corners in floor.triangles().corners {
        cuts.polygon(&corners, |piece| {
            let middle = piece.iter().fold(Vec2::ZERO, |sum, &p| sum + p) / piece.len().max(1) as f64;
            let Some(tile) = cuts.tile(middle) else { return };
            let vertices: Vec<MeshVertex> = piece.iter().map(|&p| vertex(p, tiles[tile])).collect();
            scene.part(SceneSurface::FloorTile(tile)).polygon(&vertices);
        });
    }
}

fn vertex(p: Vec2, tile: Rect) -> MeshVertex {
    let u = (p.x - tile.min.x) / tile.width();
    let v = (tile.max.y - p.y) / tile.height();
    MeshVertex { position_m: [p.x, p.y, 0.0], normal: [0.0, 0.0, 1.0], uv: [u.clamp(0.0, 1.0), v.clamp(0.0, 1.0)] }
}
