//! The scene's triangles as bytes.

use super::images::PixelRect;
use crate::show::scene::{Mesh, SceneSurface};

/// Bytes of a vertex: position (3 x f32), texture coordinates (2 x u16, 0 to 1), normal (3 x i8, one unused).
pub(super) const VERTEX_BYTES: usize = 20;

/// True if a part can be drawn: finite positions, an entry per vertex in each list, indices in range.
pub(super) fn usable(part: &Mesh) -> bool {
    let vertices = part.positions_m.len();
    let textured = matches!(part.surface, SceneSurface::FloorTile(_) | SceneSurface::WallSheet(_));
    !part.indices.is_empty()
        && part.normals.len() == vertices
        && (!textured || part.uvs.len() == vertices)
        && part.indices.iter().all(|&index| (index as usize) < vertices)
        && part.positions_m.iter().flatten().all(|value| value.is_finite())
}

/// The part of a `width` x `height` image that a part shows, with a margin for filters.
pub(super) fn shown(part: &Mesh, width: u32, height: u32) -> PixelRect {
    const MARGIN: f32 = 8.0;
    let range = |axis: usize, size: u32| {
        let values = || part.uvs.iter().map(|uv| uv[axis].clamp(0.0, 1.0) * size as f32);
        let low = (values().fold(f32::INFINITY, f32::min) - MARGIN).floor().max(0.0) as u32;
        let high = (values().fold(0.0, f32::max) + MARGIN).ceil().min(size as f32) as u32;
        let low = low.min(size.saturating_sub(1));
        (low, high.max(low + 1) - low)
    };
    let ((x, width), (y, height)) = (range(0, width), range(1, height));
    PixelRect { x, y, width, height }
}

/// Vertices, with texture coordinates from 0 to 1 within the `crop` of an image of `size`.
pub(super) fn vertices(part: &Mesh, crop: Option<(PixelRect, [u32; 2])>, out: &mut Vec<u8>) {
    for (n, position) in part.positions_m.iter().enumerate() {
        position.iter().for_each(|value| out.extend(value.to_le_bytes()));
        let uv = part.uvs.get(n).copied().unwrap_or_default();
        let within = match crop {
            Some((crop, size)) => [
                (uv[0] * size[0] as f32 - crop.x as f32) / crop.width as f32,
                (uv[1] * size[1] as f32 - crop.y as f32) / crop.height as f32,
            ],
            None => [0.0; 2],
        };
        within.iter().for_each(|value| out.extend(((65535.0 * value.clamp(0.0, 1.0)).round() as u16).to_le_bytes()));
        let normal = part.normals[n].map(|value| (127.0 * value.clamp(-1.0, 1.0)).round() as i8);
        out.extend(normal.map(|value| value as u8));
        out.push(0);
    }
}

/// Indices, four bytes each.
pub(super) fn indices(part: &Mesh, out: &mut Vec<u8>) {
    part.indices.iter().for_each(|index| out.extend(index.to_le_bytes()));
}
