//! Resolves sums to textures of floors and walls: masks, base colour, roughness. Needs no simulation.
//!
//! The simulated people represent the floor's whole history: `w = total_passes / simulated`. Their sums become optical
//! densities of dirt, each with a colour:
//!
//! - **film**, D = density ln(1 + per_pass n) / ln(1 + 1000 per_pass) x noise, less what the mop took. The passes n are w `presence`, plus the deviation of single
//!   prints (`passes` around `presence`) scaled by sqrt(w): the speckle of a sum of w times as many prints;
//! - **prints** of the last people since mopping (`soil`), and **scuffs** (`scuff`);
//! - **edge** along the skirting, denser in corners, and **dust** beside the lanes.
//!
//! Dirt covers the floor as C = floor T + soil (1 - T) with T = exp(-sum D k), soil = sum(D k c) / sum(D k), in linear
//! light, where k says how much of the density a colour channel feels: earth takes more of the blue.
//! The result does not depend on the order of deposits, and dirt may be lighter than a dark floor. Walls use the same
//! formula with other kinds of dirt, see [`WallLook`].

mod areas;
mod block;
mod bytes;
mod coarse;
mod colours;
mod dirt;
mod dust;
mod error;
mod segment;
mod file;
mod fit;
mod cells;
mod mopping;
mod spots;
mod surface;
mod image;
mod image_set;
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
mod wet;

#[cfg(test)]
mod tests;

pub use crate::math::srgb::Srgb8;
pub(crate) use areas::RoomFloor;
pub use block::{Background, LAYERS, Layer, ResolvedBlock};
pub(crate) use block::{FLAT, FLAT_FINELY};
pub(crate) use colours::absorption;
pub use error::{FilePlace, LookError};
pub use fit::{FitMeasure, FitOptions, FittedLook};
pub(crate) use image_set::look_files;
pub use material::Material;
pub use octaves::{NoiseLook, Octave};
pub(crate) use presets::LOOK_PRESETS;
pub use resolve::FloorResolver;
pub use settings::{
    AgeLook, AreaLook, DustLook, DwellLook, EdgeLook, FilmLook, FloorLook, Look, MopLook, PrintsLook, ScuffsLook,
    WearLook, WetLook, WheelsLook,
};
pub(crate) use wall::WALL_LAYERS;
pub(crate) use wall::frames::WIDEST_FRAMED_M;
pub use wall::{SkirtingLook, SplashLook, StainLook, WallDustLook, WallLook, WallMaterial, WallResolver};
