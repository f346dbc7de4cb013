use serde::{Deserialize, Serialize};

use super::ChannelEntry;
use crate::export::atlas::{Atlas, Sheet, Strip};
use crate::export::bake_path::BakePath;
use crate::export::layout::Naming;
use crate::math::Vec2;

/// The walls' textures: sheets and channels.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WallsEntry {
    /// Number of people whose touches the sums hold.
    pub people: u32,
    /// Texel density, texels per metre.
    pub texels_per_metre: f64,
    /// Height of the walls, metres.
    pub height_m: f64,
    /// Height of each strip, texels.
    pub height_px: u32,
    /// How far colour continues around each strip, texels.
    pub padding_px: u32,
    /// Naming scheme of the sheets' files.
    pub naming: Naming,
    /// Integer that stands for 1 in the sums.
    pub sums_one: u32,
    /// Content of each channel of the images.
    pub channels: Vec<ChannelEntry>,
    /// All sheets.
    pub sheets: Vec<SheetEntry>,
}

/// One sheet of the wall atlas: its strips and its images.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SheetEntry {
    /// UDIM number, if `naming` is `udim`. It only names the files: each sheet's texture coordinates are 0 to 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub udim: Option<u32>,
    /// Width, texels.
    pub width_px: u32,
    /// Height, texels.
    pub height_px: u32,
    /// Path of the base colour, 8 bit sRGB.
    pub basecolor: String,
    /// Path of the packed masks, 8 bit linear: hands; rub of arms, shoulders and bags together; scuffs of shoes.
    pub mask: String,
    /// Path of the mask of splashes, 8 bit linear grey. Missing in earlier bakes, whose mask has four channels.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub splash: String,
    /// Path of the masks of what rubs, 8 bit linear: arms, shoulders, bags. Missing in earlier bakes.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub rub: String,
    /// Path of the wall's normals, 8 bit linear. Missing in earlier bakes.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub normal: String,
    /// Path of occlusion, roughness, metallic, 8 bit linear.
    pub orm: String,
    /// Path of Unity's mask map, for that target: metallic, occlusion, detail, smoothness.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mask_map: Option<String>,
    /// Path of the clean surface's colour, 8 bit sRGB, if it was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clean: Option<String>,
    /// Path of the dirt on it: colour, 8 bit sRGB, and opacity as alpha.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dirt: Option<String>,
    /// Paths of the layers, half float, linear: one path, or a list. Missing if no layers were written.
    #[serde(default, skip_serializing_if = "Vec::is_empty", with = "super::one_or_many")]
    pub layers: Vec<String>,
    /// Path of the exact sums.
    pub sums: BakePath,
    /// Its strips.
    pub strips: Vec<StripEntry>,
}

impl SheetEntry {
    /// Its images of 8 bits a channel.
    pub(crate) fn images(&self) -> impl Iterator<Item = &String> {
        let images = [&self.basecolor, &self.mask, &self.splash, &self.rub, &self.normal, &self.orm];
        images.into_iter().chain(&self.mask_map).chain(&self.clean).chain(&self.dirt).filter(|file| !file.is_empty())
    }
}

/// A stretch of a wall face in a sheet.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StripEntry {
    /// Index of the face, longest first.
    pub face: usize,
    /// Arc length along the face where it begins, metres.
    pub from_m: f64,
    /// Arc length along the face where it ends, metres.
    pub to_m: f64,
    /// Polyline of the wall's foot, metres of the plan frame, with the floor on the right.
    pub points_m: Vec<Vec2>,
    /// Its first column of the face. Column i covers `[i, i + 1) / texels_per_metre` metres of arc length.
    pub first_column: u32,
    /// Left, top, width, height in the sheet, texels, without padding. Row 0 is the topmost, as in the files.
    pub rect_px: [u32; 4],
    /// Texture coordinates of the start of the wall's foot and of the end of its top.
    ///
    /// The sheet's upper left is (0, 0), v grows downward, as in glTF.
    pub uv: [[f64; 2]; 2],
    /// Whether it is turned by a quarter counter-clockwise. Arc length then grows upward in the image, height to the
    /// left.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub turned: bool,
}

impl WallsEntry {
    /// Rebuilds the atlas of the sheets.
    pub fn atlas(&self) -> Atlas {
        let strip = |sheet: &SheetEntry, entry: &StripEntry| {
            let [left, top, across, up] = entry.rect_px;
            let [width, height] = if entry.turned { [up, across] } else { [across, up] };
            Strip {
                face: entry.face,
                from_m: entry.from_m,
                to_m: entry.to_m,
                i0: entry.first_column,
                width,
                height,
                x: left,
                y: sheet.height_px.saturating_sub(top.saturating_add(up)),
                turned: entry.turned,
            }
        };
        let sheet = |entry: &SheetEntry| Sheet {
            width: entry.width_px,
            height: entry.height_px,
            strips: entry.strips.iter().map(|s| strip(entry, s)).collect(),
        };
        Atlas {
            texels_per_metre: self.texels_per_metre,
            height_m: self.height_m,
            padding_px: self.padding_px,
            sheets: self.sheets.iter().map(sheet).collect(),
        }
    }
}
