//! The baked plan as triangles: floor, walls, their tops, lintels over doors.

mod build;
mod builder;
mod faces;
mod floor;
mod glb;
mod lintels;
mod model;
mod region;
#[cfg(test)]
mod tests;
mod tiles;
mod tops;

pub use build::{SceneOptions, build};
pub use glb::{GlbImage, GlbOptions, MOST_EMBEDDED_PX, PlainMaterial, SurfaceImages, write_glb};
pub use model::{Mesh, Scene, SceneSurface, WallStrip};
