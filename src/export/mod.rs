//! Writes a bake: textures, sums, previews, manifest, report.

mod atlas;
mod band;
mod birdseye;
mod busy;
mod camera;
mod deflate;
pub mod diff;
mod error;
mod estimate;
mod exr_tiles;
mod layout;
mod manifest;
mod memory;
mod output;
mod png;
mod reduced;
pub(crate) mod reduction;
mod report;
mod source;
mod sums;
mod targets;
mod textures;

pub use atlas::{Atlas, Sheet, Strip};
pub use birdseye::Birdseye;
pub use camera::{Camera, CameraError, DEFAULT_FOV_DEG, FOV_DEG, StillEntry};
pub use error::ExportError;
pub use estimate::{Estimate, LARGE_BYTES};
pub use layout::{BLOCK, Tile, TileLayout};
pub use manifest::{
    BakePath, CROP_M, ChannelEntry, FORMAT, FloorEntry, GENERATOR, Manifest, ManifestError, Naming, NotInside,
    PlanEntry, PresenceEntry, PreviewEntry, SheetEntry, StripEntry, SumsEntry, TileEntry, WallsEntry,
};
pub use memory::peak_memory_mib;
pub use output::{OutputFile, OutputFolder, is_bake, restore, settled};
pub use reduced::Reduced;
pub use report::{PeopleReport, Report, StuckReport};
pub use source::{SheetSource, TextureSource, WallSource};
pub use sums::{read_sums, read_wall_sums, write_sums, write_wall_sums};
pub use targets::{Target, TargetEntry, WorldEntry, write_target_files};
pub use textures::{FloorTextures, PADDING_PX, TextureOptions, WallTextures, floor_textures, wall_textures};
