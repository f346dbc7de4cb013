use serde::{Deserialize, Serialize};

use super::ExportError;
use super::layout::TileLayout;
use super::targets::Target;

/// How textures are written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct TextureOptions {
    /// Greatest width and height of a texture, texels: 64 to 16384.
    pub tile: u32,
    /// Whether to write the layers as EXR too; left out: as is usual for the target, see [`Target::wants_layers`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layers: Option<bool>,
    /// The program that they are for.
    pub target: Target,
    /// Whether walls are made too, and with them the scene, stills and page; the floor alone otherwise.
    pub walls: bool,
    /// Whether `scene.glb` carries its textures, reduced, inside.
    pub embed: bool,
    /// The greatest width and height of the small images that are kept of each texture; none are without it.
    #[serde(skip)]
    pub reduced_px: Option<u32>,
    /// Whether a bake is made even if it is larger than [`crate::export::LARGE_BYTES`] or than the disk has room for.
    #[serde(skip)]
    pub any_size: bool,
}

impl Default for TextureOptions {
    fn default() -> TextureOptions {
        TextureOptions {
            tile: 8192,
            layers: None,
            target: Target::default(),
            walls: true,
            embed: false,
            reduced_px: None,
            any_size: false,
        }
    }
}

impl TextureOptions {
    /// Whether the layers are written.
    pub fn writes_layers(&self) -> bool {
        self.layers.unwrap_or_else(|| self.target.wants_layers())
    }

    /// Checks the size against what the target takes.
    ///
    /// # Errors
    /// A tile size out of range.
    pub fn check(&self) -> Result<(), ExportError> {
        let (tile, min, max) = (self.tile, TileLayout::MIN_TILE, TileLayout::MAX_TILE);
        if !(min..=max).contains(&tile) {
            return Err(ExportError::TileSize { tile, min, max });
        }
        self.target.check_size(tile)
    }
}
