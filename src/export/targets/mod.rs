//! Target programs: file names, channel packing, axes, and scripts for each program.

use serde::{Deserialize, Serialize};

use super::ExportError;
use super::band::{Image, LayerFile};
use super::layout::TileLayout;
use super::manifest::ChannelEntry;

mod frame;
mod scripts;

#[cfg(test)]
mod tests;

pub use frame::{TargetEntry, WorldEntry};
pub use scripts::write_target_files;

/// The program that the textures are for. It sets names, packing and axes, but not the texels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Target {
    /// Programs that read glTF; film tools. EXR channels are named after their layers.
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

/// The surface of a texture, the first part of its file name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Covered {
    Floor,
    Wall,
}

impl Covered {
    /// Returns the indices of the masks in a mask image, as red, green and blue.
    pub(super) fn packed_masks(self) -> [usize; 3] {
        match self {
            Covered::Floor => [0, 2, 3],
            Covered::Wall => [0, 1, 2],
        }
    }

    /// Returns the index of the mask with its own image, the one needed least often.
    pub(super) fn lone_mask(self) -> usize {
        match self {
            Covered::Floor => 1,
            Covered::Wall => 3,
        }
    }

    fn lone_mask_name(self) -> &'static str {
        match self {
            Covered::Floor => "passes",
            Covered::Wall => "splash",
        }
    }
}

/// The number in a texture's file name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    Udim(u32),
    /// Column and row.
    Uv(u32, u32),
}

impl Target {
    /// All targets.
    pub const ALL: [Target; 5] = [Target::Gltf, Target::Blender, Target::Unreal, Target::Unity, Target::Godot];

    /// Returns its name on the command line and in scenarios.
    pub fn name(self) -> &'static str {
        match self {
            Target::Gltf => "gltf",
            Target::Blender => "blender",
            Target::Unreal => "unreal",
            Target::Unity => "unity",
            Target::Godot => "godot",
        }
    }

    /// Returns the largest side of a texture that the target accepts, texels.
    ///
    /// Unreal streams up to 14 mip levels, 8192 texels. The limit of the others is that of Direct3D 11 and Vulkan.
    pub fn largest_px(self) -> u32 {
        match self {
            Target::Unreal => 8192,
            _ => TileLayout::MAX_TILE,
        }
    }

    /// Checks the side of a texture, texels, against the target's limit.
    pub(super) fn check_size(self, tile: u32) -> Result<(), ExportError> {
        let (target, max) = (self.name(), self.largest_px());
        if tile > max { Err(ExportError::TileTooLargeFor { tile, target, max }) } else { Ok(()) }
    }

    /// Returns the images of a texture for the target.
    pub(super) fn images(self, covered: Covered) -> impl Iterator<Item = Image> {
        let all = [Image::BaseColor, Image::Mask(covered), Image::LoneMask(covered), Image::Orm, Image::MaskMap];
        all.into_iter().filter(move |image| *image != Image::MaskMap || self == Target::Unity)
    }

    /// Whether the layers are written as EXR by default.
    ///
    /// Game engines import every image of a bake; the layers are the largest ones and rarely used in games.
    pub fn wants_layers(self) -> bool {
        matches!(self, Target::Gltf | Target::Blender)
    }

    /// Returns the EXR files of a texture. Engines only accept the channels R, G, B and A.
    pub(super) fn layer_files(self, layers: &[&'static str]) -> Vec<LayerFile> {
        match self {
            Target::Gltf | Target::Blender => LayerFile::by_name(layers),
            Target::Unreal | Target::Unity | Target::Godot => LayerFile::by_colour(layers),
        }
    }

    /// Returns the file name of an image, without its folder.
    pub(super) fn image_name(self, covered: Covered, image: Image, number: Number) -> String {
        let kind = match (self, image) {
            (Target::Unreal, Image::BaseColor) => "BaseColor",
            (Target::Unreal, Image::Mask(_)) => "Mask",
            (Target::Unreal | Target::Unity, Image::LoneMask(Covered::Floor)) => "Passes",
            (Target::Unreal | Target::Unity, Image::LoneMask(Covered::Wall)) => "Splash",
            (Target::Unreal | Target::Unity, Image::Orm) => "ORM",
            (Target::Unity, Image::BaseColor) => "BaseMap",
            // Unity's own mask map has other channels.
            (Target::Unity, Image::Mask(_)) => "DirtMask",
            (Target::Unity, Image::MaskMap) => "MaskMap",
            (Target::Godot, Image::BaseColor) => "albedo",
            (_, Image::BaseColor) => "basecolor",
            (_, Image::Mask(_)) => "mask",
            (_, Image::LoneMask(covered)) => covered.lone_mask_name(),
            (_, Image::Orm) => "orm",
            (_, Image::MaskMap) => "maskmap",
        };
        self.file_name(covered, kind, number, "png")
    }

    /// Returns the file name of the `index`-th EXR file, without its folder.
    pub(super) fn layers_name(self, covered: Covered, index: usize, number: Number) -> String {
        let kind = match self {
            Target::Gltf | Target::Blender => "layers".to_string(),
            Target::Unreal | Target::Unity => format!("Layers{}", index + 1),
            Target::Godot => format!("layers{}", index + 1),
        };
        self.file_name(covered, &kind, number, "exr")
    }

    fn file_name(self, covered: Covered, kind: &str, number: Number, extension: &str) -> String {
        let (lower, upper) = match covered {
            Covered::Floor => ("floor", "Floor"),
            Covered::Wall => ("wall", "Wall"),
        };
        let number = match (self, number) {
            // Blender and Unreal recognise UDIM tiles by the dot.
            (Target::Gltf | Target::Blender | Target::Unreal, Number::Udim(udim)) => format!(".{udim}"),
            (Target::Unity | Target::Godot, Number::Udim(udim)) => format!("_{udim}"),
            (_, Number::Uv(u, v)) => format!("_u{u:03}_v{v:03}"),
        };
        match self {
            Target::Gltf | Target::Blender | Target::Godot => format!("{lower}_{kind}{number}.{extension}"),
            Target::Unreal => format!("T_{upper}_{kind}{number}.{extension}"),
            Target::Unity => format!("{upper}_{kind}{number}.{extension}"),
        }
    }

    /// Describes the channels of all images. `masks` and `of_layer` describe masks and layers.
    pub(super) fn channels(
        self,
        covered: Covered,
        colour: &str,
        masks: [&str; 4],
        layers: &[&'static str],
        of_layer: impl Fn(&str) -> &'static str,
    ) -> Vec<ChannelEntry> {
        let entry = |image: &str, channel: &str, holds: &str, encoding: &str| ChannelEntry {
            image: image.to_string(),
            channel: channel.to_string(),
            holds: holds.to_string(),
            encoding: encoding.to_string(),
        };
        let mut channels = vec![entry("basecolor", "RGB", colour, "sRGB")];
        let rgba = ["R", "G", "B", "A"];
        let packed = covered.packed_masks().map(|kind| masks[kind]);
        channels.extend(rgba.into_iter().zip(packed).map(|(name, mask)| entry("mask", name, mask, "1 - exp(-D)")));
        channels.push(entry(covered.lone_mask_name(), "Y", masks[covered.lone_mask()], "1 - exp(-D)"));
        let packed = ["occlusion", "roughness", "metallic"];
        channels.extend(rgba.into_iter().zip(packed).map(|(name, holds)| entry("orm", name, holds, "linear")));
        if self.images(covered).any(|image| image == Image::MaskMap) {
            let packed = ["metallic", "occlusion", "detail: 1 everywhere", "smoothness: 1 - roughness"];
            let map = rgba.into_iter().zip(packed).map(|(name, holds)| entry("mask_map", name, holds, "linear"));
            channels.extend(map);
        }
        let files = self.layer_files(layers);
        for (k, file) in files.iter().enumerate() {
            let image = if files.len() == 1 { "layers".to_string() } else { format!("layers{}", k + 1) };
            for (name, layer) in file.channels() {
                let holds = match layer.and_then(|k| layers.get(k)) {
                    Some(layer) if name.strip_suffix(".V") == Some(layer) => of_layer(layer).to_string(),
                    Some(layer) => format!("{layer}: {}", of_layer(layer)),
                    None => "nothing".to_string(),
                };
                channels.push(entry(&image, name, &holds, "linear"));
            }
        }
        channels
    }
}
