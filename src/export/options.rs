use super::ExportError;
use super::layout::TileLayout;
use super::targets::Target;
use crate::options::{names, options};

/// The scene in Universal Scene Description.
pub(crate) const USD_FILE: &str = "scene.usda";
/// The scene as a world for Gazebo.
pub(crate) const SDF_FILE: &str = "scene.sdf";

options! {
    /// How textures are written.
    pub struct TextureOptions {
        /// Largest side of a texture; Unreal takes 8192.
        tile: u32 = 8192, in 64.0..=16384.0, unit "px";
        /// Whether every layer is an EXR too; left out: for gltf and blender only.
        layers: Option<bool> = None, eg "true";
        /// Bits per channel of masks, wear and height: 8, or 16 without dither.
        bits: u32 = 8, in 8.0..=16.0;
        /// Whether the clean surface and the dirt on it are images of their own too, to lay the dirt on another surface.
        dirt: bool = false;
        /// Whether PNG files are compressed harder: a third smaller, a bake takes half as long again.
        small_png: bool = false;
        /// What the files are for: "gltf", "blender", "unreal", "unity" or "godot".
        target: Target = Target::default();
        /// Whether walls are made too, and with them the scene, stills and page.
        walls: bool = true;
        /// Whether scene.glb carries its textures, reduced, inside.
        embed: bool = false;
        /// Side of the light maps for which scene.glb has a second set of texture coordinates; 0 leaves them out.
        lightmap: u32 = 1024, in 0.0..=8192.0, unit "px";
        /// Whether scene.glb has the lamps of the stills.
        lamps: bool = false;
        /// Whether the scene has a ceiling where the plan has one.
        ceiling: bool = false;
        /// Whether the scene is also written as scene.usda.
        usd: bool = false;
        /// Whether scene.sdf, a world for Gazebo, is written too.
        sdf: bool = false;
    } with {
        /// The greatest width and height of the small images that are kept of each texture; none are without it.
        reduced_px: Option<u32> = None;
        /// Whether a bake is made even if it is larger than `LARGE_BYTES` or than the disk has room for.
        any_size: bool = false;
    }
}

impl TextureOptions {
    /// Whether the layers are written.
    pub fn writes_layers(&self) -> bool {
        self.layers.unwrap_or_else(|| self.target.wants_layers())
    }

    /// Whether masks have 16 bits.
    pub(super) fn is_fine(&self) -> bool {
        self.bits == 16
    }

    /// Checks the size against what the target takes, and the bits.
    ///
    /// # Errors
    /// A tile size out of range, bits other than 8 and 16.
    pub fn check(&self) -> Result<(), ExportError> {
        let (tile, min, max) = (self.tile, TileLayout::MIN_TILE, TileLayout::MAX_TILE);
        if !(min..=max).contains(&tile) {
            return Err(ExportError::TileSize { tile, min, max });
        }
        if ![8, 16].contains(&self.bits) {
            return Err(ExportError::Bits { bits: self.bits });
        }
        self.target.check_size(tile)
    }
}

names!(Target);
