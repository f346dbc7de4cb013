//! Resolves sums of walls: marks of hands, sleeves, bags and shoes, and splashes of the mop.
//!
//! Dirt covers a wall by the same formula as the floor: C = wall T + dirt (1 - T), T = exp(-sum D), independent of
//! order. All noise is in the space of the unrolled face (arc length and height), so that it continues around corners
//! and across the seam of a closed face.

mod chips;
mod cladding;
mod dots;
pub(crate) mod frames;
mod masonry;
mod material;
mod paint;
mod clean_wall;
mod resolve;
mod settings;
mod shade;
mod splash;
mod strip;
mod touches;

#[cfg(test)]
mod tests;
#[cfg(test)]
mod texture_tests;

pub use material::WallMaterial;
pub use resolve::{WALL_LAYERS, WallResolver};
pub use settings::{SkirtingLook, SplashLook, StainLook, WallDustLook, WallLook};
