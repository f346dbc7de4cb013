//! Clean wall: colour, texture, joints and pores, bricks and tiles, skirting board.

use super::dots::{DotSettings, Dots};
use super::frames::Frames;
use super::masonry::Masonry;
use super::material::WallMaterial;
use super::settings::WallLook;
use super::strip::FaceStrip;
use crate::look::error::LookError;
use crate::look::image::RepeatedImage;
use crate::look::image_set::ImageSet;
use crate::look::lattice::TexelWindow;
use crate::look::noise::{self, Channel, Noise, NoiseField};
use crate::math::{exp_f32, smoothstep_f32, srgb};

/// Size of concrete formwork panels: width along the wall and height, metres.
const PANEL_M: [f64; 2] = [1.25, 1.30];
/// Joints between panels: half width at 1/e, metres, and share of light that they absorb.
const JOINT_M: f32 = 0.0022;
const JOINT_DEPTH: f32 = 0.22;
/// Plugged tie holes: distance from a panel's sides as a share of it, radius in metres, depth.
const TIE_AT: f64 = 0.22;
const TIE_RADIUS_M: f32 = 0.011;
const TIE_DEPTH: f32 = 0.28;
/// Standard deviation of the tone between panels.
const PANEL_SD: f32 = 0.028;

/// Steps of painted walls' tone and roughness: about one byte, and three.
const TONE_STEP: f32 = 0.0094;
const ROUGH_STEP: f32 = 0.0118;

/// Thickness of a skirting board, and depth per tone of joints and pores in concrete, millimetres.
const BOARD_MM: f32 = 10.0;
const CONCRETE_MM: f32 = 7.0;

/// Lip at the top of a skirting board, which collects dust: height, metres, and tone.
const LIP_M: f32 = 0.004;
const LIP_TONE: f32 = 0.82;

/// The clean wall of one look.
pub(super) struct CleanWall {
    base: [f32; 3],
    image: Option<Box<RepeatedImage>>,
    tone: Vec<Noise>,
    tint: Noise,
    panels: Option<Formwork>,
    masonry: Option<Masonry>,
    /// Roughness per tone: what stands out is rougher.
    rough_gain: f32,
    /// Height per tone of the grain, and of joints and pores of concrete, millimetres.
    grain_mm: f32,
    /// Whether tone and roughness are rounded to steps.
    stepped: bool,
    board_m: f32,
    board: [f32; 3],
    pub frames: Frames,
    roughness: f32,
}

/// Formwork panels.
struct Formwork {
    key: u32,
    gain: f32,
    pores: Dots,
}

/// The clean wall over one window.
pub(super) struct CleanWallWindow<'a> {
    plaster: &'a CleanWall,
    window: TexelWindow,
    strip: FaceStrip,
    row: usize,
    tone: Vec<NoiseField>,
    tint: Option<NoiseField>,
    /// Light absorbed by pores, per texel.
    pores: Vec<f32>,
}

/// A row of texels of the clean wall.
#[derive(Default)]
pub(super) struct CleanWallRow {
    /// Linear colour, one plane per channel.
    pub rgb: [Vec<f32>; 3],
    /// Added to the roughness, per texel; empty where the wall is even.
    pub rough: Vec<f32>,
    /// Height over the mean surface, millimetres.
    pub height: Vec<f32>,
    /// Share of skirting board in the row.
    pub board: f32,
    fine: Vec<f32>,
    spots: Vec<f32>,
}

impl CleanWallRow {
    /// Drops the first texel of all but the height.
    pub fn drop_first(&mut self) {
        for plane in self.rgb.iter_mut().chain([&mut self.rough]).filter(|plane| !plane.is_empty()) {
            plane.remove(0);
        }
    }
}

impl CleanWall {
    pub fn new(wall: &WallLook, seed: u64, texels_per_metre: f64) -> Result<CleanWall, LookError> {
        let image = match &wall.image {
            Some(path) => Some(Box::new(RepeatedImage::open(
                &ImageSet::find(path)?.colour,
                wall.image_size_m,
                texels_per_metre,
                srgb::light_of,
            )?)),
            None => None,
        };
        let own = srgb::light_of(wall.colour.unwrap_or(wall.material.properties().colour));
        let noise = |channel, [x, y, sd]: [f64; 3]| Noise::new(seed, channel, [x, y], sd as f32 * wall.texture);
        // Length along the wall and height of spots, metres, and deviation; the last is for the tint.
        let [fine, middle, coarse, tint] = match wall.material {
            // Stipple of the roller, orange peel, overlapping strokes.
            WallMaterial::Matt => [[0.004, 0.0045, 0.015], [0.018, 0.024, 0.008], [0.24, 0.8, 0.005], [1.0, 1.0, 0.0]],
            WallMaterial::Gloss => [[0.005, 0.006, 0.010], [0.018, 0.024, 0.006], [0.24, 0.8, 0.004], [1.0, 1.0, 0.0]],
            WallMaterial::Brick => [[0.006, 0.005, 0.055], [0.022, 0.018, 0.03], [1.4, 0.9, 0.035], [0.6, 0.4, 0.006]],
            WallMaterial::Tile => [[0.05, 0.05, 0.004], [0.4, 0.4, 0.004], [1.5, 1.2, 0.006], [1.0, 1.0, 0.0]],
            // Grain, blotches, clouds.
            WallMaterial::Concrete => {
                [[0.007, 0.007, 0.030], [0.16, 0.12, 0.022], [0.85, 0.55, 0.042], [0.5, 0.4, 0.004]]
            }
        };
        let channels = [Channel::WallGround, Channel::WallGroundMiddle, Channel::WallGroundCoarse];
        let panels = (wall.material == WallMaterial::Concrete && wall.texture > 0.0).then(|| Formwork {
            key: noise::key(seed, Channel::WallPiece),
            gain: wall.texture.min(1.5),
            pores: Dots::new(
                noise::key(seed, Channel::WallPore),
                DotSettings { per_m2: 260.0, radius_m: [0.0008, 0.0042], depth: [0.10, 0.42] },
            ),
        });
        Ok(CleanWall {
            base: image.as_ref().map_or(own, |image| image.mean()),
            image,
            tone: channels.into_iter().zip([fine, middle, coarse]).map(|(c, spots)| noise(c, spots)).collect(),
            tint: noise(Channel::WallGroundTint, tint),
            panels,
            masonry: Masonry::of(wall.material, wall.texture, noise::key(seed, Channel::Masonry)),
            rough_gain: match wall.material {
                WallMaterial::Matt | WallMaterial::Gloss => 1.6,
                WallMaterial::Tile => 0.0,
                WallMaterial::Concrete | WallMaterial::Brick => 0.6,
            },
            grain_mm: match wall.material {
                WallMaterial::Matt => 5.0,
                WallMaterial::Gloss => 7.0,
                WallMaterial::Brick | WallMaterial::Concrete => 6.0,
                WallMaterial::Tile => 0.0,
            },
            stepped: matches!(wall.material, WallMaterial::Matt | WallMaterial::Gloss),
            board_m: wall.skirting.height_m,
            board: srgb::light_of(wall.skirting.colour),
            frames: Frames::default(),
            roughness: wall.roughness.unwrap_or(wall.material.properties().roughness),
        })
    }

    /// Mean colour of the clean wall, linear.
    pub fn mean(&self) -> [f32; 3] {
        self.base
    }

    /// Whether the wall above the skirting board has a single colour.
    pub fn is_even(&self) -> bool {
        self.image.is_none()
            && self.panels.is_none()
            && self.masonry.is_none()
            && self.tone.iter().chain([&self.tint]).all(Noise::is_flat)
    }

    /// Whether a row is above the skirting board.
    pub fn is_above_board(&self, j: i64, texels_per_metre: f64) -> bool {
        j as f32 >= self.board_m * texels_per_metre as f32
    }

    pub fn over(&self, window: &TexelWindow, strip: &FaceStrip) -> CleanWallWindow<'_> {
        let shown = CleanWallWindow {
            plaster: self,
            window: *window,
            strip: *strip,
            row: 0,
            tone: Vec::new(),
            tint: None,
            pores: Vec::new(),
        };
        if self.image.is_some() {
            return shown;
        }
        let field =
            |noise: &Noise| (!noise.is_flat()).then(|| noise.over_strip(window, strip.salt, strip.width, strip.closed));
        let pores = match &self.panels {
            Some(panels) => panels.pores.over(window, strip),
            None => Vec::new(),
        };
        CleanWallWindow { tone: self.tone.iter().filter_map(field).collect(), tint: field(&self.tint), pores, ..shown }
    }
}

impl CleanWallWindow<'_> {
    pub fn begin_row(&mut self, row: usize) {
        self.row = row;
        for field in self.tone.iter_mut().chain(&mut self.tint) {
            field.begin_row(row);
        }
    }

    /// Reads the texels of the current row.
    pub fn read(&self, out: &mut CleanWallRow) {
        for plane in &mut out.rgb {
            plane.clear();
            plane.resize(self.window.width, 0.0);
        }
        out.rough.clear();
        out.height.clear();
        out.height.resize(self.window.width, 0.0);
        let j = self.window.j0 + self.row as i64;
        let texel_m = (1.0 / self.window.texels_per_metre) as f32;
        let low_m = j as f32 * texel_m;
        out.board = ((self.plaster.board_m - low_m) / texel_m).clamp(0.0, 1.0);
        if out.board < 1.0 {
            self.read_wall(j, out);
        }
        if out.board > 0.0 {
            out.rough.iter_mut().for_each(|rough| *rough *= 1.0 - out.board);
            out.height.iter_mut().for_each(|height| *height += out.board * (BOARD_MM - *height));
            // The lip's share of the row's board.
            let top = self.plaster.board_m;
            let lip = (top.min(low_m + texel_m) - (top - LIP_M).max(low_m)).max(0.0) / (texel_m * out.board);
            let tone = 1.0 + (LIP_TONE - 1.0) * lip.min(1.0);
            for (plane, board) in out.rgb.iter_mut().zip(self.plaster.board) {
                for value in plane.iter_mut() {
                    *value += out.board * (board * tone - *value);
                }
            }
        }
        let wall = (self.plaster.roughness, out.board);
        let planes = (&mut out.rgb, &mut out.rough, &mut out.height[..]);
        self.plaster.frames.paint((&self.window, &self.strip), j, wall, planes);
    }

    fn read_wall(&self, j: i64, out: &mut CleanWallRow) {
        let CleanWallRow { rgb, rough, height, fine, spots, .. } = out;
        if let Some(image) = &self.plaster.image {
            image.read_row(self.window.i0, j, rgb);
            return;
        }
        let [tone, _, tint] = &mut *rgb;
        let mut fields = self.tone.iter();
        if let Some(first) = fields.next() {
            fine.clear();
            fine.resize(self.window.width, 0.0);
            first.add_to(0, fine);
            tone.copy_from_slice(fine);
            if self.plaster.masonry.is_some()
                && let Some(middle) = fields.next()
            {
                spots.clear();
                spots.resize(self.window.width, 0.0);
                middle.add_to(0, spots);
                tone.iter_mut().zip(&*spots).for_each(|(tone, spot)| *tone += spot);
            }
            fields.for_each(|field| field.add_to(0, tone));
            height.iter_mut().zip(&*fine).for_each(|(height, fine)| *height = self.plaster.grain_mm * fine);
            if self.plaster.rough_gain > 0.0 {
                rough.extend(fine.iter().map(|fine| self.plaster.rough_gain * fine));
            }
        }
        if let Some(field) = &self.tint {
            field.add_to(0, tint);
        }
        if let Some(panels) = &self.plaster.panels {
            // Joints, holes and pores are as deep as they are dark.
            let deep = CONCRETE_MM;
            height.iter_mut().zip(&*tone).for_each(|(height, tone)| *height -= deep * tone);
            panels.add_row(&self.window, &self.strip, j, tone);
            for (tone, pores) in tone.iter_mut().zip(self.pores.get(self.row * self.window.width..).unwrap_or_default())
            {
                *tone -= panels.gain * pores;
            }
            height.iter_mut().zip(&*tone).for_each(|(height, tone)| *height += deep * tone);
        }
        // Paint in steps of one byte: files of it compress.
        let stepped = self.plaster.stepped;
        let even = |tone: f32| if stepped { (tone / TONE_STEP).round() * TONE_STEP } else { tone };
        if stepped {
            rough.iter_mut().for_each(|rough| *rough = (*rough / ROUGH_STEP).round() * ROUGH_STEP);
        }
        let [r0, g0, b0] = self.plaster.base;
        let [red, green, blue] = rgb;
        for ((r, g), b) in red.iter_mut().zip(green).zip(blue) {
            let (tone, tint) = ((1.0 + even(*r)).max(0.2), *b);
            *r = r0 * tone * (1.0 + tint);
            *g = g0 * tone;
            *b = b0 * tone * (1.0 - tint);
        }
        if let Some(masonry) = &self.plaster.masonry {
            rough.clear();
            rough.resize(self.window.width, 0.0);
            masonry.lay((&self.window, &self.strip), j, (fine, spots), (rgb, rough, height));
        }
    }
}

impl Formwork {
    /// Adds the tone of panels, joints and tie holes to row `j`.
    fn add_row(&self, window: &TexelWindow, strip: &FaceStrip, j: i64, tone: &mut [f32]) {
        let texel_m = 1.0 / window.texels_per_metre;
        let length_m = f64::from(strip.width) * texel_m;
        // A whole number of panels fits a closed face.
        let around = (length_m / PANEL_M[0]).round().max(1.0);
        let [width_m, height_m] = if strip.closed { [length_m / around, PANEL_M[1]] } else { PANEL_M };
        let up = (j as f64 + 0.5) * texel_m;
        let level = (up / height_m).floor();
        let (above, below) = (up - level * height_m, (level + 1.0) * height_m - up);
        let level_joint = if level == 0.0 { below } else { above.min(below) } as f32;
        let texel = texel_m as f32;
        for (k, tone) in tone.iter_mut().enumerate() {
            let along = ((window.i0 + k as i64) as f64 + 0.5) * texel_m;
            let panel = (along / width_m).floor();
            let (left, right) = (along - panel * width_m, (panel + 1.0) * width_m - along);
            let mut light =
                self.gain * PANEL_SD * 1.73 * noise::signed(self.key ^ strip.salt, panel as i32, level as i32);
            light -= line(left.min(right) as f32, texel).max(line(level_joint, texel)) * JOINT_DEPTH * self.gain;
            let tie = [left.min(right) - TIE_AT * width_m, above.min(below) - TIE_AT * height_m].map(|d| d as f32);
            light -= hole(tie, texel) * TIE_DEPTH * self.gain;
            *tone += light;
        }
    }
}

/// Share of light that a joint absorbs at a distance from its centre, as a mean over texels.
fn line(distance_m: f32, texel_m: f32) -> f32 {
    let spread = (JOINT_M * JOINT_M + texel_m * texel_m / 6.0).sqrt();
    let ratio = distance_m / spread;
    if ratio > 4.0 { 0.0 } else { JOINT_M / spread * exp_f32(-ratio * ratio) }
}

/// Coverage of a plugged hole: a disc with a soft rim.
fn hole([x, y]: [f32; 2], texel_m: f32) -> f32 {
    let squared = x * x + y * y;
    let soft = 0.002 + 0.5 * texel_m;
    if squared > (TIE_RADIUS_M + soft) * (TIE_RADIUS_M + soft) {
        return 0.0;
    }
    smoothstep_f32((TIE_RADIUS_M + soft - squared.sqrt()) / (2.0 * soft))
}
