use serde::{Deserialize, Serialize};

use crate::export::ExportError;
use crate::export::layout::TileLayout;

/// The program that the textures are for. It decides on names, packing and axes; texels are the same for all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Target {
    /// Anything that reads glTF; film tools: EXR channels have names of their own.
    #[default]
    Gltf,
    /// Blender.
    Blender,
    /// Unreal Engine 5.
    Unreal,
    /// Unity, High Definition or Universal Render Pipeline.
    Unity,
    /// Godot 4.
    Godot,
}

impl Target {
    /// All of them.
    pub const ALL: [Target; 5] = [Target::Gltf, Target::Blender, Target::Unreal, Target::Unity, Target::Godot];

    /// What the command line and the scenario call it.
    pub fn name(self) -> &'static str {
        match self {
            Target::Gltf => "gltf",
            Target::Blender => "blender",
            Target::Unreal => "unreal",
            Target::Unity => "unity",
            Target::Godot => "godot",
        }
    }

    /// The largest side of a texture that it takes, texels.
    ///
    /// Unreal streams up to 14 mip levels, 8192 texels; the others go as far as Direct3D 11 and Vulkan do.
    pub fn largest_px(self) -> u32 {
        match self {
            Target::Unreal => 8192,
            _ => TileLayout::MAX_TILE,
        }
    }

    /// Checks a side of a texture, texels.
    pub(in crate::export) fn check_size(self, tile: u32) -> Result<(), ExportError> {
        let (target, max) = (self.name(), self.largest_px());
        if tile > max { Err(ExportError::TileTooLargeFor { tile, target, max }) } else { Ok(()) }
    }

    /// Whether the layers are written as EXR unless a caller says otherwise.
    ///
    /// Game engines import every image of a bake, and these are the largest and the ones that games need least.
    pub fn wants_layers(self) -> bool {
        matches!(self, Target::Gltf | Target::Blender)
    }
}
