//! Resolves the sums of walls: what hands, sleeves, bags and shoes leave, and what the mop throws against their feet.
//!
//! Dirt lies on a wall by the same law as on the floor: C = wall T + dirt (1 - T), T = exp(-sum D), free of order.
//! Everything that is uneven lives in the space of the unrolled face (arc length and height), so that it runs on
//! round corners and over the seam of a closed face.

mod dots;
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

pub use material::WallMaterial;
pub use resolve::{WALL_LAYERS, WallResolver};
pub use settings::{SkirtingLook, SplashLook, StainLook, WallDustLook, WallLook};
