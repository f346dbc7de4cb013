//! The baked plan as triangles: floor, walls, their tops, lintels over doors, a ceiling.

mod build;
mod builder;
mod faces;
mod file;
mod fittings;
mod floor;
mod glb;
mod hulls;
mod light_map;
mod lintels;
mod model;
mod region;
mod sdf;
#[cfg(test)]
mod tests;
mod tiles;
mod tops;
mod usda;

pub(crate) use build::{SceneOptions, build, ceiling};
pub(crate) use file::{PlainMaterial, SceneFile, SceneLamp, SurfaceImages};
pub(crate) use glb::write_glb;
pub(crate) use hulls::{Prism, hulls};
pub(crate) use model::WallStrip;
pub use model::{Mesh, Scene, SceneSurface};
pub(crate) use sdf::write_sdf;
pub(crate) use usda::write_usda;
