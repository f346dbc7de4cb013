//! Wall shader: computes densities, colours and roughness per texel from touches.
//!
//! Causes without stains in a window are skipped: most of a wall is clean.

use super::clean_wall::CleanWallRow;
use super::settings::{StainLook, WallLook};
use crate::look::bytes::{Bytes, Rounding, ShadedPlanes};
use crate::look::dirt::{Beneath, Dirt};
use crate::look::noise::Noise;
use crate::look::planes::{add2, each1, each2, each3};
use crate::look::settings::Look;
use crate::math::{exp_f32, srgb};

/// Number of kinds of dirt, in the order of [`super::WALL_LAYERS`]: five causes, splash, dust, chips of paint.
pub(super) const KINDS: usize = 8;
pub(super) const SPLASH: usize = 5;
pub(super) const DUST: usize = 6;
pub(super) const CHIP: usize = 7;
/// Channel of the mask for each kind: skin, rub, scuff, splash and dust; chips have none of these.
const CHANNEL: [usize; KINDS] = [0, 1, 1, 1, 2, 3, 3, 4];
const CHANNELS: usize = 5;
/// Index of the material's factor on touches for each cause: skin, cloth, bag, rubber.
const STAIN: [usize; 5] = [0, 1, 1, 2, 3];

/// Least visible optical density. Smaller ones count as 0, so that clean walls stay even.
const LEAST: f32 = 0.002;
/// Largest factor on the stain of one touch.
const MOST_SINGLE: f32 = 8.0;
/// Opacity of skin grime at which its roughness applies in full.
const FULL_GRIME: f32 = 0.30;
/// Roughness of rubber, and of loose dirt.
const RUBBER_ROUGHNESS: f32 = 0.60;
const DIRT_ROUGHNESS: f32 = 0.88;
/// Roughness of a skirting board, and of plaster under chipped paint.
const BOARD_ROUGHNESS: f32 = 0.42;
const CHIP_ROUGHNESS: f32 = 0.92;
/// Colour of that plaster, sRGB.
const CHIP_COLOUR: [u8; 3] = [172, 163, 148];
/// Factor on skin and cloth on a skirting board, which is smooth and wiped with the floor.
const BOARD_TOUCH: f32 = 0.6;

/// Multiple of its reach at which dust ends.
const DUST_END: f32 = 3.0;
/// Dust on the upper edge of a skirting board: density as a multiple of that at the floor, height of the edge, and height
/// in which the line above it falls to 1/e, metres.
const LIP: f32 = 7.0;
const LIP_M: f32 = 0.004;
const LIP_FALL_M: f32 = 0.006;
/// Film at hand height: centre and standard deviation of its height, metres.
const HANDS_M: f32 = 1.15;
const HANDS_SD_M: f32 = 0.22;

/// Values of a look that are the same for all texels.
#[derive(Clone, Debug)]
pub(super) struct WallShader {
    /// Touches of the whole history per simulated touch; factor on the deviation of single ones.
    weight: f32,
    residual: f32,
    every_touch: f32,
    /// Per cause: factor on touches, and density at saturation.
    strength: [f32; 5],
    density: [f32; 5],
    pub splash: f32,
    /// Dust: density at the floor, reach, and density of the film at hand height.
    dust: [f32; 3],
    /// Height of the skirting board and of a texel, metres.
    board_m: f32,
    texel_m: f32,
    kinds: [Dirt; KINDS],
    beneath: Beneath,
    mean_log: f32,
    roughness: f32,
    grime_roughness: f32,
    rub_roughness: f32,
}

/// Inputs of the shader for a row of texels.
#[derive(Default)]
pub(super) struct WallShadeInput {
    pub plaster: CleanWallRow,
    /// Per cause: simulated touches, and their local mean; empty if there are none.
    pub single: [Vec<f32>; 5],
    pub expected: [Vec<f32>; 5],
    /// Sum of the noises; empty without noise.
    pub uneven: Vec<f32>,
    /// Optical density, including factors; empty if there is none.
    pub splash: Vec<f32>,
    /// Optical density of chips; empty if there are none.
    pub chips: Vec<f32>,
    /// Height of the row's centre above the floor, metres.
    pub height_m: f32,
}

/// Results of the shader for a row of texels.
#[derive(Default)]
pub(super) struct WallShadeOutput {
    /// Optical densities by kind; empty if there is none.
    pub density: [Vec<f32>; KINDS],
    uneven: Vec<f32>,
    /// Per channel of the mask: density, then transmittance.
    through: [Vec<f32>; CHANNELS],
    pub total: Vec<f32>,
    /// Optical density by colour.
    totals: [Vec<f32>; 3],
    roughness: Vec<f32>,
    rgb: [Vec<f32>; 3],
    rounding: Rounding,
}

impl WallShadeInput {
    /// Whether all texels are clean.
    fn is_clean(&self, dust: f32) -> bool {
        self.single.iter().all(Vec::is_empty) && self.splash.is_empty() && self.chips.is_empty() && dust == 0.0
    }

    /// Colour and ORM bytes of the row's clean wall, if it is even.
    pub fn even_bytes(&self, law: &WallShader) -> ([u8; 3], [u8; 3]) {
        let colour = self.plaster.rgb.each_ref().map(|plane| srgb::encode_f32(plane[0]).round() as u8);
        (colour, [255, (255.0 * law.roughness_with(self.plaster.board)).round() as u8, 0])
    }
}

impl WallShader {
    pub fn new(look: &Look, clean: [f32; 3], simulated_people: u32, noise: &[Noise], density: f64) -> Self {
        let (wall, properties) = (&look.wall, look.wall.material.properties());
        let weight = properties.history * (wall.total_passes as f64 / f64::from(simulated_people)) as f32;
        let stains = stains(wall);
        let kinds = std::array::from_fn(|kind| {
            Dirt::of(srgb::light_of(match kind {
                SPLASH => wall.splash.colour,
                DUST => wall.dust.colour,
                CHIP => CHIP_COLOUR,
                cause => stains[cause].colour,
            }))
        });
        WallShader {
            weight,
            // With fewer passes than simulated, there is nothing to smooth.
            residual: weight.min(weight.sqrt()).min(MOST_SINGLE),
            every_touch: wall.every_touch,
            strength: std::array::from_fn(|n| stains[n].strength * properties.touches[STAIN[n]]),
            density: stains.map(|stain| stain.density),
            splash: properties.splash,
            dust: [wall.dust.density * properties.dust, wall.dust.reach_m, wall.dust.hands * properties.dust],
            board_m: wall.skirting.height_m,
            texel_m: (1.0 / density) as f32,
            kinds,
            beneath: Beneath::of(look, clean),
            mean_log: noise.iter().map(|noise| noise.sd_of_texels(density)).map(|sd| 0.5 * sd * sd).sum(),
            roughness: wall.roughness.unwrap_or(properties.roughness),
            grime_roughness: properties.grime_roughness,
            rub_roughness: properties.rub_roughness,
        }
    }

    /// Whether touches are smoothed: the history is longer than the simulation.
    pub fn evens_out(&self) -> bool {
        self.residual < self.weight
    }

    /// Whether a cause can leave dirt.
    pub fn takes(&self, cause: usize) -> bool {
        self.strength[cause] > 0.0 && self.density[cause] > 0.0 || self.every_touch > 0.0
    }

    /// Roughness of the clean wall.
    pub fn clean_roughness(&self) -> f32 {
        self.roughness
    }

    /// Whether there may be dust at or above a height.
    pub fn dust_from(&self, height_m: f32) -> bool {
        let [density, reach_m, hands] = self.dust;
        let end_m = (DUST_END * reach_m).max(if self.board_m > 0.0 { self.board_m + 5.0 * LIP_FALL_M } else { 0.0 });
        density > 0.0 && height_m < end_m || hands > 0.0 && height_m < HANDS_M + 3.0 * HANDS_SD_M
    }

    /// Optical density of dust at a height, before noise.
    pub fn dust_at(&self, height_m: f32) -> f32 {
        let [density, reach_m, hands] = self.dust;
        let end = DUST_END * reach_m;
        let low = if height_m < end { density * (exp_f32(-height_m / reach_m) - exp_f32(-DUST_END)) } else { 0.0 };
        let from_hands = (height_m - HANDS_M) / HANDS_SD_M;
        let high = if from_hands.abs() < 3.0 { hands * exp_f32(-0.5 * from_hands * from_hands) } else { 0.0 };
        low + high + density * self.lip_at(height_m)
    }

    /// Dust on the upper edge of the skirting board, as a mean over a row of texels.
    fn lip_at(&self, height_m: f32) -> f32 {
        let half = 0.5 * self.texel_m;
        let (low, high) = (height_m - half - self.board_m, height_m + half - self.board_m);
        if self.board_m <= 0.0 || high < -LIP_M || low > 5.0 * LIP_FALL_M {
            return 0.0;
        }
        let edge = (high.min(0.0) - low.max(-LIP_M)).max(0.0);
        let line = LIP_FALL_M * (exp_f32(-low.max(0.0) / LIP_FALL_M) - exp_f32(-high.max(0.0) / LIP_FALL_M));
        LIP * (edge + line) / self.texel_m
    }

    /// Computes a row; returns `false` if it is clean.
    pub fn shade(&self, known: &WallShadeInput, out: &mut WallShadeOutput) -> bool {
        let len = known.plaster.rgb[0].len();
        let dust = self.dust_at(known.height_m);
        out.clear();
        if known.is_clean(dust) {
            for (plane, wall) in out.rgb.iter_mut().zip(&known.plaster.rgb) {
                plane.clear();
                plane.extend_from_slice(wall);
            }
            out.roughness.clear();
            out.roughness.resize(len, self.roughness_with(known.plaster.board));
            for (roughness, more) in out.roughness.iter_mut().zip(&known.plaster.rough) {
                *roughness = (*roughness + more).clamp(0.0, 1.0);
            }
            out.total.clear();
            out.total.resize(len, 0.0);
            return false;
        }
        out.resize(len);
        self.densities(known, dust, out);
        self.colour(&known.plaster.rgb, out);
        self.roughness(&known.plaster, out);
        true
    }

    /// Roughness of a clean row with a share `board` of skirting board.
    fn roughness_with(&self, board: f32) -> f32 {
        self.roughness + board * (BOARD_ROUGHNESS - self.roughness)
    }

    fn densities(&self, known: &WallShadeInput, dust: f32, out: &mut WallShadeOutput) {
        let len = known.plaster.rgb[0].len();
        let WallShadeOutput { density, uneven, .. } = out;
        if known.uneven.is_empty() {
            uneven.fill(1.0);
        } else {
            each1(uneven, &known.uneven, |noise| exp_f32(noise - self.mean_log));
        }
        for (cause, density) in density[..5].iter_mut().enumerate() {
            let (single, expected) = (&known.single[cause], &known.expected[cause]);
            if single.is_empty() {
                continue;
            }
            let board = if STAIN[cause] < 2 { 1.0 - known.plaster.board * (1.0 - BOARD_TOUCH) } else { 1.0 };
            let (strength, most) = (self.strength[cause] * board, self.density[cause].max(1e-6));
            density.resize(len, 0.0);
            each3(density, single, expected, uneven, |single, expected, uneven| {
                let touches = self.weight * expected + self.residual * (single - expected);
                let n = (strength * uneven * touches).max(0.0);
                seen(most * n / (most + n) + self.every_touch * single)
            });
        }
        if !known.splash.is_empty() {
            density[SPLASH].resize(len, 0.0);
            each2(&mut density[SPLASH], &known.splash, uneven, |splash, uneven| seen(splash * uneven));
        }
        if dust > 0.0 {
            density[DUST].resize(len, 0.0);
            each1(&mut density[DUST], uneven, |uneven| seen(dust * uneven));
        }
        if !known.chips.is_empty() {
            density[CHIP].extend_from_slice(&known.chips);
        }
    }

    /// Computes the colour of dirt over the wall, and the transmittance: dirt absorbs each colour as it does, so that a thin
    /// layer is tinted too.
    fn colour(&self, wall: &[Vec<f32>; 3], out: &mut WallShadeOutput) {
        let WallShadeOutput { density, through, total, totals, rgb, .. } = out;
        for plane in rgb.iter_mut().chain(totals.iter_mut()).chain([&mut *total]) {
            plane.fill(0.0);
        }
        for (kind, density) in density.iter().enumerate().filter(|(_, density)| !density.is_empty()) {
            let through = &mut through[CHANNEL[kind]];
            through.resize(density.len(), 0.0);
            for ((through, total), density) in through.iter_mut().zip(&mut *total).zip(density) {
                *through += density;
                *total += density;
            }
            for (channel, (plane, total)) in rgb.iter_mut().zip(&mut *totals).enumerate() {
                self.kinds[kind].add_to(channel, density, total, plane);
            }
        }
        for through in through {
            for value in through {
                *value = exp_f32(-*value);
            }
        }
        self.beneath.cover(wall, totals, rgb);
    }

    fn roughness(&self, plaster: &CleanWallRow, out: &mut WallShadeOutput) {
        let WallShadeOutput { through: [skin, rub, scuff, splash, chip], roughness, .. } = out;
        roughness.fill(self.roughness_with(plaster.board));
        for (roughness, more) in roughness.iter_mut().zip(&plaster.rough) {
            *roughness = (*roughness + more).clamp(0.0, 1.0);
        }
        if !skin.is_empty() {
            add2(roughness, skin, skin, |skin, _| self.grime_roughness * ((1.0 - skin) / FULL_GRIME).min(1.0));
        }
        if !rub.is_empty() {
            add2(roughness, rub, rub, |rub, _| self.rub_roughness * ((1.0 - rub) / FULL_GRIME).min(1.0));
        }
        if !scuff.is_empty() {
            for (value, scuff) in roughness.iter_mut().zip(&*scuff) {
                *value += (RUBBER_ROUGHNESS - *value) * (1.0 - scuff);
            }
        }
        if !splash.is_empty() {
            for (value, splash) in roughness.iter_mut().zip(&*splash) {
                *value += (DIRT_ROUGHNESS.max(*value) - *value) * (1.0 - splash);
            }
        }
        for (value, chip) in roughness.iter_mut().zip(&*chip) {
            *value += (CHIP_ROUGHNESS - *value) * (1.0 - chip);
        }
    }
}

/// Returns the density, or 0 if it is invisible.
fn seen(density: f32) -> f32 {
    if density < LEAST { 0.0 } else { density }
}

/// Stain settings by cause: hand, arm, shoulder, bag, shoe.
pub(super) fn stains(wall: &WallLook) -> [StainLook; 5] {
    [wall.skin, wall.cloth, wall.cloth, wall.bag, wall.rubber]
}

impl WallShadeOutput {
    fn clear(&mut self) {
        for plane in self.density.iter_mut().chain(&mut self.through) {
            plane.clear();
        }
    }

    fn resize(&mut self, len: usize) {
        let WallShadeOutput { uneven, total, totals, roughness, rgb, .. } = self;
        for plane in [uneven, total, roughness].into_iter().chain(totals).chain(rgb) {
            plane.resize(len, 0.0);
        }
    }

    /// Rounds a row that starts at texel (i, j) to 8 bits.
    pub fn write(&mut self, dither: u32, i: i64, j: i64, out: &mut Bytes<'_>) {
        let [skin, rub, scuff, splash, _] = &self.through;
        let shown = ShadedPlanes { rgb: &self.rgb, through: [skin, rub, scuff, splash], roughness: &self.roughness };
        self.rounding.write(dither, i, j, &shown, out);
    }

    /// Rounds clean texels to the nearest.
    pub fn write_clean(&self, out: &mut Bytes<'_>) {
        let [red, green, blue] = &self.rgb;
        let byte = |light: f32| (srgb::encode_f32(light) + 0.5) as u8;
        for (k, _) in self.total.iter().enumerate().filter(|(_, total)| **total == 0.0) {
            out.base_color[k] = [byte(red[k]), byte(green[k]), byte(blue[k])];
            out.orm[k][1] = (255.0 * self.roughness[k] + 0.5) as u8;
        }
    }
}
