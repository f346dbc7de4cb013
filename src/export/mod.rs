//! Writes a bake: textures, sums, previews, manifest, report.
//!
//! More than 5000 lines, since each file format of a bake is written and read here, and the two ends of a format have to
//! change together: textures, exact sums, the manifest, the folder that replaces an earlier bake whole, and what each
//! target program wants. Each has a file or folder of its own; only `ExportError`, `BakePath` and `TileLayout` are common.

mod atlas;
mod bake_path;
mod band;
mod birdseye;
mod busy;
mod camera;
pub mod diff;
mod error;
mod estimate;
mod exr_tiles;
mod fine;
mod layout;
mod manifest;
mod memory;
mod options;
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
pub use bake_path::BakePath;
pub use birdseye::Birdseye;
pub(crate) use camera::DEFAULT_FOV_DEG;
pub use camera::{Camera, CameraError, FOV_DEG, StillEntry};
pub use error::{ExportError, NotInside};
pub(crate) use estimate::Estimate;
pub use layout::{Naming, Tile, TileLayout};
pub(crate) use manifest::{CROP_M, GENERATOR};
pub use manifest::{
    ChannelEntry, FloorEntry, Manifest, ManifestError, PlanEntry, PresenceEntry, PreviewEntry, SheetEntry, StripEntry,
    SumsEntry, TileEntry, WallsEntry,
};
pub use memory::peak_memory_mib;
pub use options::TextureOptions;
pub(crate) use options::{SDF_FILE, USD_FILE};
pub(crate) use output::OutputFile;
pub use output::{OutputFolder, settled};
pub use reduced::Reduced;
pub use report::{LifeReport, PeopleReport, Report, RoomReport, StuckReport};
pub use source::{TextureSource, WallSource};
pub(crate) use sums::write_wall_sums;
pub use sums::{read_sums, read_wall_sums, write_sums};
pub(crate) use targets::write_target_files;
pub use targets::{Target, TargetEntry, WorldEntry};
pub use textures::{FloorTextures, WallTextures, floor_textures};
pub(crate) use textures::{PADDING_PX, wall_textures};
