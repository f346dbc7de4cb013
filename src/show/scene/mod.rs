//! The baked plan as triangles: floor, walls, their tops, lintels over doors.

mod build;
mod builder;
mod faces;
mod fittings;
mod floor;
mod glb;
mod lintels;
mod model;
mod region;
#[cfg(test)]
mod tests;
mod tiles;
mod tops;

pub(crate) use build::{SceneOptions, build};
pub(crate) use glb::{GlbImage, GlbOptions, PlainMaterial, SurfaceImages, write_glb};
pub(crate) use model::WallStrip;
pub use model::{Mesh, Scene, SceneSurface};
