use serde::{Deserialize, Serialize};

use super::ChannelEntry;
use crate::export::atlas::{Atlas, Sheet, Strip};
use crate::export::bake_path::BakePath;
use crate::export::layout::Naming;
use crate::math::Vec2;

/// All textures of the walls.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WallsEntry {
    /// For how many people the touches stand.
    pub people: u32,
    /// Texel density.
    pub texels_per_metre: f64,
    /// Height of the walls, metres.
    pub height_m: f64,
    /// Height of each strip, texels.
    pub height_px: u32,
    /// How far colour goes on around each strip, texels.
    pub padding_px: u32,
    /// How sheets are told apart by their file names.
    pub naming: Naming,
    /// What 1 of a sum is as an integer.
    pub sums_one: u32,
    /// What each channel of the images holds.
    pub channels: Vec<ChannelEntry>,
    /// All sheets.
    pub sheets: Vec<SheetEntry>,
}

/// One sheet: strips of wall and the images that show them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SheetEntry {
    /// The UDIM number, where sheets are named so. It tells them apart; each has texture coordinates from 0 to 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub udim: Option<u32>,
    /// Width, texels.
    pub width_px: u32,
    /// Height, texels.
    pub height_px: u32,
    /// Base colour, 8 bit sRGB.
    pub basecolor: String,
    /// Packed masks, 8 bit linear: skin, rub, scuff.
    pub mask: String,
    /// The mask of splashes, 8 bit linear, grey. Empty in bakes of before the mask had three channels.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub splash: String,
    /// Occlusion, roughness, metallic, 8 bit linear.
    pub orm: String,
    /// The same as Unity's mask map, for that target: metallic, occlusion, detail, smoothness.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mask_map: Option<String>,
    /// All layers, half float, linear: a file, or a list of files; left out where they were not asked for.
    #[serde(default, skip_serializing_if = "Vec::is_empty", with = "super::one_or_many")]
    pub layers: Vec<String>,
    /// Exact sums.
    pub sums: BakePath,
    /// What it shows.
    pub strips: Vec<StripEntry>,
}

/// A stretch of a wall face in a sheet.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StripEntry {
    /// Number of the face, longest first.
    pub face: usize,
    /// Arc length along the face at which it begins, metres.
    pub from_m: f64,
    /// Arc length at which it ends, metres.
    pub to_m: f64,
    /// The wall's foot on that stretch, metres of the plan frame; the floor lies on the right.
    pub points_m: Vec<Vec2>,
    /// First column of the face in it: column i covers `[i, i + 1) / texels_per_metre` metres of arc length.
    pub first_column: u32,
    /// Left, top, width, height in the sheet, texels, without padding; row 0 is the upper one, as in the files.
    pub rect_px: [u32; 4],
    /// Texture coordinates of the start of the wall's foot and of the end of its top, from the sheet's upper left and
    /// downward, as glTF has it.
    pub uv: [[f64; 2]; 2],
    /// Whether it is turned by a quarter counter-clockwise: arc length grows upward in the image, height to the left.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub turned: bool,
}

impl WallsEntry {
    /// The atlas that the sheets were written by.
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
