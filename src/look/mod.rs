//! Resolves sums into what floors and walls look like: masks, base colour, roughness. Needs no simulation.
//!
//! The simulated people stand for the floor's whole history: `w = total_passes / simulated`. Their sums become
//! optical densities of dirt, each with a colour of its own:
//!
//! - **film**, D = density (1 - exp(-per_pass n)) x noise. The passes n are w `presence`, plus what is left of single
//!   prints (`passes` around `presence`) scaled by sqrt(w): the speckle of a sum of w times as many prints;
//! - **prints** of the last people since mopping (`soil`), and **scuffs** (`scuff`);
//! - the **edge** along the skirting, heavier in corners, and **dust** where nobody walks.
//!
//! Dirt lies on the floor as C = floor T + soil (1 - T) with T = exp(-sum D), soil = sum(D c) / sum(D), in linear light:
//! the order in which it came does not matter, and it is lighter than a dark floor. Walls follow the same law with dirt of
//! their own, see [`WallLook`].

mod block;
mod bytes;
mod coarse;
mod colours;
mod dust;
mod error;
mod segment;
mod file;
mod clean_floor;
mod image;
mod lattice;
mod material;
mod noise;
mod octaves;
mod padding;
mod paint;
mod planes;
mod presets;
mod resolve;
mod settings;
mod shade;
mod skirting;
mod passes;
mod wall;

#[cfg(test)]
mod tests;

pub use crate::math::srgb::Srgb8;
pub use block::{Background, Layer, ResolvedBlock};
pub use error::{FilePlace, LookError};
pub use material::Material;
pub use octaves::{NoiseLook, Octave};
pub use presets::LOOK_PRESETS;
pub use resolve::{FloorResolver, LAYERS};
pub use settings::{DustLook, EdgeLook, FilmLook, FloorLook, IngrainedLook, Look, PrintsLook, ScuffsLook};
pub use wall::{SkirtingLook, SplashLook, StainLook, WALL_LAYERS, WallDustLook, WallLook, WallMaterial, WallResolver};
