//! Writes the result: textures, sums, previews, manifest, report.

mod band;
mod busy;
mod deflate;
pub mod diff;
mod error;
mod exr_tiles;
mod layout;
mod manifest;
mod memory;
mod output;
mod png;
pub mod preview;
mod report;
mod source;
mod sums;
mod textures;

pub use error::ExportError;
pub use layout::{BLOCK, Tile, TileLayout};
pub use manifest::{
    ChannelEntry, FORMAT, FloorEntry, GENERATOR, Manifest, Naming, PlanEntry, PresenceEntry, PreviewEntry, SumsEntry,
    TileEntry,
};
pub use memory::peak_memory_mib;
pub use output::{OutputFile, OutputFolder, is_bake, restore};
pub use report::{PeopleReport, Report, StuckReport};
pub use source::FloorSource;
pub use sums::{read_sums, write_sums};
pub use textures::{FloorTextures, TextureOptions, floor_textures};
