//! Pictures of a bake for people: the floor from above, crops at native density, plan and paths.

pub(super) mod canvas;
mod crops;
pub(super) mod drawing;
mod flipbook;
mod keys;
mod paths;
mod render;
pub(super) mod stuck;
pub(super) mod style;
mod units;
mod write;

pub use crops::{Crop, choose_crops};
pub use drawing::{draw_paths, draw_plan};
pub use flipbook::write_flipbook;
pub use keys::draw_keys;
pub use paths::{Path, PathSample, PathSampler};
pub use render::{render_crop, render_floor};
pub use units::draw_unit;
pub use write::{PATHS_FILE, encode_picture, write_picture, write_previews};
