//! Writes a bake: textures, sums, previews, manifest, report.

mod atlas;
mod bake_path;
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
mod options;
mod output;
mod output_size;
mod png;
mod reduced;
pub(crate) mod reduction;
mod report;
mod source;
mod sums;
mod targets;
mod textures;

pub use atlas::{Atlas, Sheet, Strip};
pub use bake_path::BakePath;
pub use birdseye::Birdseye;
pub use camera::{Camera, CameraError, DEFAULT_FOV_DEG, FOV_DEG, StillEntry};
pub use error::{ExportError, NotInside};
pub use estimate::LARGE_BYTES;
pub use layout::{BLOCK, Naming, Tile, TileLayout};
pub use manifest::{
    CROP_M, ChannelEntry, FORMAT, FloorEntry, GENERATOR, Manifest, ManifestError, PlanEntry, PresenceEntry,
    PreviewEntry, SheetEntry, StripEntry, SumsEntry, TileEntry, WallsEntry,
};
pub use memory::peak_memory_mib;
pub use options::TextureOptions;
pub use output::{OutputFile, OutputFolder, is_bake, restore, settled};
pub use output_size::Estimate;
pub use reduced::Reduced;
pub use report::{PeopleReport, Report, StuckReport};
pub use source::{SheetSource, TextureSource, WallSource};
pub use sums::{read_sums, read_wall_sums, write_sums, write_wall_sums};
pub use targets::{Target, TargetEntry, WorldEntry, write_target_files};
pub use textures::{FloorTextures, PADDING_PX, WallTextures, floor_textures, wall_textures};
