//! Shades the texels of a window of a wall strip, row by row.

use std::cell::RefCell;

use super::chips::Chips;
use super::clean_wall::{CleanWall, CleanWallWindow};
use super::frames::Frames;
use super::material::WallMaterial;
use super::settings::StainLook;
use super::shade::{WallShadeInput, WallShadeOutput, WallShader, stains};
use super::splash::{Splash, SplashWindow};
use super::strip::FaceStrip;
use super::touches::TouchFields;
use crate::look::block::{Background, ResolvedBlock};
use crate::look::bytes::Bytes;
use crate::look::error::LookError;
use crate::look::lattice::TexelWindow;
use crate::look::noise::{self, Channel, Noise, NoiseField};
use crate::look::octaves::{NoiseLook, Octave};
use crate::look::settings::Look;
use crate::math::srgb;
use crate::patterns::Cause;
use crate::stamps::DENSITY_ONE;
use crate::sums::WallSums;
use crate::walls::{Doorway, Walls};

/// Buffers that a thread reuses between windows.
#[derive(Default)]
struct WallBuffers {
    known: WallShadeInput,
    shaded: WallShadeOutput,
    /// Heights of the row below, millimetres.
    below: Vec<f32>,
}

thread_local! {
    static BUFFERS: RefCell<WallBuffers> = RefCell::default();
}

/// Fields that are evaluated row by row.
struct WallLayout<'a> {
    plaster: CleanWallWindow<'a>,
    /// By cause.
    touches: [Option<TouchFields>; 5],
    splash: Option<SplashWindow>,
    /// Per texel; empty without chips.
    chips: Vec<f32>,
    noise: Vec<NoiseField>,
    /// Whether there may be dirt.
    dirty: bool,
}

/// Sums of walls, and the look that turns them into texels.
pub(super) struct WallPainter<'a> {
    pub sums: &'a WallSums,
    pub background: Background,
    plaster: CleanWall,
    /// By cause.
    pub stains: [StainLook; 5],
    splash: Splash,
    chips: Chips,
    /// Noise of all dirt.
    noise: Vec<Noise>,
    law: WallShader,
    dither: u32,
}

impl<'a> WallPainter<'a> {
    pub fn new(
        sums: &'a WallSums,
        walls: &Walls,
        look: &Look,
        simulated_people: u32,
    ) -> Result<WallPainter<'a>, LookError> {
        let (wall, texels_per_metre) = (&look.wall, sums.grid().texels_per_metre);
        let plaster = CleanWall::new(wall, look.seed, texels_per_metre)?;
        let noise = dirt_noise(look);
        let law = WallShader::new(look, plaster.mean(), simulated_people, &noise, texels_per_metre);
        // Bricks have no paint.
        let chipped = if wall.material == WallMaterial::Brick { 0.0 } else { wall.chips };
        let history = (wall.total_passes as f64 / f64::from(simulated_people)) as f32;
        Ok(WallPainter {
            chips: Chips::new(walls, sums, look.seed, chipped * history),
            sums,
            background: Background {
                base_color: plaster.mean().map(|light| srgb::encode_f32(light).round() as u8),
                mask: [0; 4],
                orm: [255, (255.0 * law.clean_roughness()).round() as u8, 0],
            },
            plaster,
            stains: stains(wall),
            splash: Splash::new(wall.splash, look.seed),
            noise,
            law,
            dither: noise::key(look.seed, Channel::WallDither),
        })
    }

    /// Adds the frames of doors.
    pub fn with_doors(mut self, walls: &Walls, doorways: &[Doorway], look: &Look) -> WallPainter<'a> {
        self.plaster.frames = Frames::new(walls, doorways, &look.wall);
        self
    }

    /// Shades all texels of a window inside the strip into a block of its size. Returns `false` if all of them have the
    /// background.
    pub fn paint(&self, strip: &FaceStrip, window: &TexelWindow, block: &mut ResolvedBlock) -> bool {
        BUFFERS.with_borrow_mut(|buffers| {
            let mut layout = WallLayout::over(self, strip, window);
            let even = self.plaster.is_even() && !self.plaster.frames.touches(window, strip);
            let all_wall = self.plaster.is_above_board(window.j0, window.texels_per_metre);
            if even && all_wall && !layout.dirty {
                block.clear(0..window.texels(), self.background);
                return false;
            }
            let mut any = !(even && all_wall);
            buffers.below = layout.plaster_below(&mut buffers.known);
            for row in 0..window.height {
                layout.begin_row(row);
                layout.gather(&self.law, window, row, buffers);
                let is_dirty = self.law.shade(&buffers.known, &mut buffers.shaded);
                any |= is_dirty;
                self.write(strip, window, (row, is_dirty), buffers, block);
            }
            any
        })
    }

    fn write(
        &self,
        strip: &FaceStrip,
        window: &TexelWindow,
        (row, is_dirty): (usize, bool),
        buffers: &mut WallBuffers,
        block: &mut ResolvedBlock,
    ) {
        let WallBuffers { known, shaded, below } = buffers;
        let texels = row * window.width..(row + 1) * window.width;
        let mut bytes = Bytes {
            base_color: &mut block.base_color[texels.clone()],
            mask: &mut block.mask[texels.clone()],
            orm: &mut block.orm[texels.clone()],
        };
        if is_dirty {
            shaded.write(self.dither ^ strip.salt, window.i0, window.j0 + row as i64, &mut bytes);
        } else {
            bytes.mask.fill([0; 4]);
            bytes.orm.fill([255, 0, 0]);
        }
        // Clean texels without dither, which does not compress.
        if self.plaster.is_even() && known.plaster.rough.is_empty() {
            let (colour, orm) = known.even_bytes(&self.law);
            for ((total, base_color), out) in shaded.total.iter().zip(&mut *bytes.base_color).zip(&mut *bytes.orm) {
                if *total == 0.0 {
                    (*base_color, *out) = (colour, orm);
                }
            }
        } else {
            shaded.write_clean(&mut bytes);
        }
        block.set_clean(texels.start, &known.plaster.rgb);
        let per_m = 0.001 * window.texels_per_metre as f32;
        let height = &known.plaster.height;
        for (k, own) in height.iter().enumerate().skip(1) {
            let slopes = [own - height[k - 1], own - below[k]].map(|step_mm| per_m * step_mm);
            block.set_normal(texels.start + k - 1, slopes);
        }
        std::mem::swap(below, &mut known.plaster.height);
        for (layer, plane) in block.layers.iter_mut().zip(&shaded.density) {
            let values = &mut layer.values[texels.clone()];
            if plane.is_empty() { values.fill(0.0) } else { values.copy_from_slice(plane) }
        }
    }
}

/// Returns the noises of the wall's three octaves.
fn dirt_noise(look: &Look) -> Vec<Noise> {
    let NoiseLook { fine, middle, coarse } = look.wall.noise;
    let noise = |channel, octave: Octave| Noise::new(look.seed, channel, [octave.size_m; 2], octave.sd);
    let all = [noise(Channel::WallFine, fine), noise(Channel::WallMiddle, middle), noise(Channel::WallCoarse, coarse)];
    all.into_iter().filter(|noise| !noise.is_flat()).collect()
}

impl<'a> WallLayout<'a> {
    fn over(painter: &'a WallPainter<'_>, strip: &FaceStrip, window: &TexelWindow) -> WallLayout<'a> {
        let WallPainter { law, stains, sums, .. } = painter;
        let touches = std::array::from_fn(|n| {
            let over = || {
                TouchFields::over(window, strip, sums, Cause::WALL[n], law.evens_out().then_some(stains[n].spread_m))
            };
            law.takes(n).then(over).flatten()
        });
        let splash = painter.splash.over(window, strip);
        let low_m = (window.j0 as f64 + 0.5) / window.texels_per_metre;
        let chips = painter.chips.over(window, strip);
        let dirty =
            splash.is_some() || !chips.is_empty() || touches.iter().any(Option::is_some) || law.dust_from(low_m as f32);
        let noise = |noise: &Noise| noise.over_strip(window, strip.salt, strip.width, strip.closed);
        WallLayout {
            plaster: painter.plaster.over(&window.with_neighbours(), strip),
            touches,
            splash,
            chips,
            noise: if dirty { painter.noise.iter().map(noise).collect() } else { Vec::new() },
            dirty,
        }
    }

    /// The heights of the row below the window.
    fn plaster_below(&mut self, known: &mut WallShadeInput) -> Vec<f32> {
        self.plaster.begin_row(0);
        self.plaster.read(&mut known.plaster);
        std::mem::take(&mut known.plaster.height)
    }

    fn begin_row(&mut self, row: usize) {
        self.plaster.begin_row(row + 1);
        for touches in self.touches.iter_mut().flatten() {
            touches.begin_row(row);
        }
        if let Some(splash) = &mut self.splash {
            splash.begin_row(row);
        }
        for field in &mut self.noise {
            field.begin_row(row);
        }
    }

    /// Collects the shader's inputs for the current row.
    fn gather(&self, law: &WallShader, window: &TexelWindow, row: usize, buffers: &mut WallBuffers) {
        let WallBuffers { known, .. } = buffers;
        self.plaster.read(&mut known.plaster);
        known.plaster.drop_first();
        known.height_m = ((window.j0 + row as i64) as f64 + 0.5) as f32 / window.texels_per_metre as f32;
        let unit = 1.0 / DENSITY_ONE;
        for ((touches, single), expected) in self.touches.iter().zip(&mut known.single).zip(&mut known.expected) {
            single.clear();
            expected.clear();
            if let Some(touches) = touches {
                let sums = &touches.single[row * window.width..][..window.width];
                expected.resize(window.width, 0.0);
                touches.expected(expected);
                if sums.iter().any(|&sum| sum > 0) || expected.iter().any(|&expected| expected > 0.0) {
                    single.extend(sums.iter().map(|&sum| sum as f32 * unit));
                }
            }
        }
        known.splash.clear();
        if let Some(splash) = &self.splash {
            known.splash.resize(window.width, 0.0);
            splash.read(law.splash, &mut known.splash);
            if known.splash.iter().all(|&density| density == 0.0) {
                known.splash.clear();
            }
        }
        known.chips.clear();
        let chips = self.chips.get(row * window.width..(row + 1) * window.width);
        if let Some(chips) = chips.filter(|chips| chips.iter().any(|&density| density > 0.0)) {
            known.chips.extend_from_slice(chips);
        }
        known.uneven.clear();
        known.uneven.resize(if self.noise.is_empty() { 0 } else { window.width }, 0.0);
        for field in &self.noise {
            field.add_to(0, &mut known.uneven);
        }
    }
}
