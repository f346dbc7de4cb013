//! Target programs: file names, channel packing, axes, and scripts for each program.

use super::band::{GreenPoints, Image, LayerFile};
use super::manifest::ChannelEntry;

mod covered;
mod frame;
mod scripts;
mod target;

#[cfg(test)]
mod tests;

pub(super) use covered::Covered;
pub use frame::{TargetEntry, WorldEntry};
pub use scripts::write_target_files;
pub use target::Target;

/// What the manifest calls the images that may have 16 bits per channel, and what the others have. Layers are half floats.
const FINE_IMAGES: [&str; 5] = ["mask", "passes", "splash", "rub", "wear"];
const USUAL_BITS: u32 = 8;

/// The number in a texture's file name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    Udim(u32),
    /// Column and row.
    Uv(u32, u32),
}

impl Target {
    /// The images of a texture.
    pub(super) fn images(self, covered: Covered, dirt: bool) -> impl Iterator<Item = Image> {
        let masks = [Image::Mask(covered), Image::LoneMask(covered), Image::Rub, Image::Wear];
        let all = [Image::BaseColor].into_iter().chain(masks).chain([Image::Orm, Image::MaskMap, self.normal()]);
        let all = all.chain([Image::Clean, Image::Dirt].into_iter().filter(move |_| dirt));
        all.filter(move |image| match image {
            Image::MaskMap => self == Target::Unity,
            Image::Rub => covered == Covered::Wall,
            Image::Wear => covered == Covered::Floor,
            _ => true,
        })
    }

    /// The normal map as the target reads it.
    pub(super) fn normal(self) -> Image {
        Image::Normal(if self == Target::Unreal { GreenPoints::Down } else { GreenPoints::Up })
    }

    /// The EXR files of a texture: engines refuse channels of other names than R, G, B and A.
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
            (Target::Unreal | Target::Unity, Image::Rub) => "Rub",
            (Target::Unreal | Target::Unity, Image::Wear) => "Wear",
            (Target::Unreal | Target::Unity, Image::Normal(_)) => "Normal",
            (Target::Unreal | Target::Unity, Image::Orm) => "ORM",
            (Target::Unreal | Target::Unity, Image::Clean) => "Clean",
            (Target::Unreal | Target::Unity, Image::Dirt) => "Dirt",
            (Target::Unity, Image::BaseColor) => "BaseMap",
            // Unity's own mask map has other channels.
            (Target::Unity, Image::Mask(_)) => "DirtMask",
            (Target::Unity, Image::MaskMap) => "MaskMap",
            (Target::Godot, Image::BaseColor) => "albedo",
            (_, Image::BaseColor) => "basecolor",
            (_, Image::Mask(_)) => "mask",
            (_, Image::LoneMask(covered)) => covered.lone_mask_name(),
            (_, Image::Rub) => "rub",
            (_, Image::Wear) => "wear",
            (_, Image::Normal(_)) => "normal",
            (_, Image::Orm) => "orm",
            (_, Image::MaskMap) => "maskmap",
            (_, Image::Clean) => "clean",
            (_, Image::Dirt) => "dirt",
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
        (covered, bits, dirt): (Covered, u32, bool),
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
            bits: if FINE_IMAGES.contains(&image) { bits } else { USUAL_BITS },
        };
        let mut channels = vec![entry("basecolor", "RGB", colour, "sRGB")];
        let rgba = ["R", "G", "B", "A"];
        let packed = covered.packed_masks().map(|kind| masks[kind]);
        channels.extend(rgba.into_iter().zip(packed).map(|(name, mask)| entry("mask", name, mask, "1 - exp(-D)")));
        let how = match covered {
            Covered::Floor => "0.6 ln(1 + look.film.per_pass n) / ln(1 + 1000 look.film.per_pass), at most 1",
            Covered::Wall => "1 - exp(-D)",
        };
        channels.push(entry(covered.lone_mask_name(), "Y", masks[covered.lone_mask()], how));
        if covered == Covered::Floor {
            let packed = [
                ("wear, 1 is worn through", "linear"),
                ("heel marks, gum and rubs", "1 - exp(-D)"),
                ("height over the mean surface", "0.5 + 0.098 per millimetre"),
            ];
            let wear = rgba.into_iter().zip(packed).map(|(name, (holds, how))| entry("wear", name, holds, how));
            channels.extend(wear);
        }
        let green = if self == Target::Unreal { "DirectX" } else { "OpenGL" };
        channels.push(entry("normal", "RGB", "normal of the surface", &format!("0.5 + 0.5 n, {green}")));
        if covered == Covered::Wall {
            let packed = ["rub of arms", "rub of shoulders", "rub of bags"];
            channels.extend(rgba.into_iter().zip(packed).map(|(name, holds)| entry("rub", name, holds, "1 - exp(-D)")));
        }
        let packed = ["occlusion", "roughness", "metallic"];
        channels.extend(rgba.into_iter().zip(packed).map(|(name, holds)| entry("orm", name, holds, "linear")));
        if dirt {
            channels.push(entry("clean", "RGB", "colour of the surface without dirt", "sRGB"));
            channels.push(entry("dirt", "RGB", "colour of the dirt", "sRGB"));
            channels.push(entry("dirt", "A", "opacity of the dirt, laid over in linear light", "linear"));
        }
        if self.images(covered, dirt).any(|image| image == Image::MaskMap) {
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
                channels.push(ChannelEntry { bits: 16, ..entry(&image, name, &holds, "linear, half float") });
            }
        }
        channels
    }
}
