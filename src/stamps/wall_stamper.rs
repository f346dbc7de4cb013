//! Rasterises contacts on unrolled wall faces.

use super::lanes::SumCell;
use super::linear::Linear;
use super::noise::{NOISE_ONE, NoiseTile};
use super::stamper::MOST_DENSITY;
use super::wall_plate::{WallPattern, WallPlate, bits_of, whole};
use super::wall_variation::{ContactVariation, drag};
use super::window::{TexelBounds, TexelWindow, WINDOW, floor};
use super::{DENSITY_ONE, FaceSpan, StampOptions, StampsError, WallGrid};
use crate::marks::Contact;
use crate::math::{SplitMix64, sin_cos};
use crate::patterns::{Cause, PatternLibrary};

/// Standard deviation of the texel filter, texels; as on the floor.
const TEXEL_FILTER: f64 = 0.45;

/// Smallest and largest length and breadth of a contact, metres.
const EXTENT_M: [f32; 2] = [0.001, 10.0];

/// Largest distance of a contact from its face's start and from the floor, metres.
const FARTHEST_M: f64 = 1e6;

/// Largest number of turns of a stain around a closed face.
const MOST_TURNS: f64 = 64.0;

/// Factor on [`StampOptions::blur_m`] for skin and cloth.
const SOFT: f64 = 2.5;

/// Largest blur of a stain, as a share of its smaller extent.
const MOST_BLUR: f64 = 0.15;

/// Sizes of blotches, metres: uneven dirt on a hand.
const BLOTCHES_M: [f64; 3] = [0.06, 0.02, 0.007];

/// Standard deviation of the blotches, as a share of [`StampOptions::noise`].
const BLOTCHY: f64 = 1.2;

/// Sizes of the wall's micro texture, metres: grain of a paint roller.
const GRAIN_M: [f64; 2] = [0.005, 0.002];

/// Standard deviation of the grain, as a share of [`StampOptions::noise`].
const GRAINY: f64 = 0.8;

/// Share of the grain's contrast hidden at full coverage: a faint touch marks only the grain's peaks.
const FILLED: f32 = 0.6;

/// Aspect ratio of the blotches of a drag.
const STREAKS: f32 = 4.0;

/// Rasterises contacts on wall faces, for one pattern library, grid and set of options.
///
/// A stain is a pure function of its contact, its pattern and the grid: a stain cut by a block's border gives the same
/// integers on both sides as an uncut one. It ends at the floor, the ceiling and the ends of an open face; on a closed
/// face it continues across the seam.
#[derive(Debug)]
pub struct WallStamper {
    grid: WallGrid,
    options: StampOptions,
    /// By pattern index; `None` for floor patterns.
    patterns: Vec<Option<WallPattern>>,
    blotches: NoiseTile,
    grain: NoiseTile,
    dither: NoiseTile,
    /// Largest factor of blotches and grain.
    noise_peak: f32,
}

/// A valid contact, placed on the strip of its face.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedStain<'a> {
    pub(crate) cause: Cause,
    pub(crate) face: u32,
    /// Texels of the strip that the stain can touch.
    pub(crate) bounds: TexelBounds,
    /// Upper bound on its value in a texel.
    pub(crate) peak: u16,
    plate: &'a WallPlate,
    /// Origin of the stain's texel coordinates.
    origin: [i64; 2],
    /// Position of a texel's centre along and across the stain, with its half extents, metres.
    axes_m: [StainAxis; 2],
    /// Position in samples of the plate.
    samples: [Linear; 2],
    bend: StainBend,
    /// Optical density at full coverage, in the unit of sums.
    density: Linear,
    /// Position in texels of the blotches.
    blotches: [Linear; 2],
    blotches_at: [u32; 2],
    /// Offsets in the tiles of grain and dither.
    grain_at: [u32; 2],
    dither_at: [u32; 2],
}

/// A linear function of texel coordinates, and the stain's half extent.
#[derive(Clone, Copy, Debug)]
struct StainAxis {
    at_origin: f64,
    per_i: f64,
    per_j: f64,
    half: f64,
}

/// Bend of a stain: displacement across as a cubic of the position along, both in samples.
#[derive(Clone, Copy, Debug)]
struct StainBend {
    middle: f32,
    share_per_sample: f32,
    factors: [f32; 4],
}

impl WallStamper {
    /// Prepares a stamper for a library's wall patterns; uses `blur_m`, `pressure` and `noise`.
    ///
    /// # Errors
    /// An option is out of range, see [`StampOptions::check`].
    pub fn new(library: &PatternLibrary, grid: &WallGrid, options: &StampOptions) -> Result<WallStamper, StampsError> {
        options.check()?;
        let texels_per_metre = grid.texels_per_metre;
        // About a metre, within the limits of a tile's size.
        let size = ((0.8 * texels_per_metre) as usize).clamp(64, 512).next_power_of_two();
        let noise = |scales_m: &[f64], share: f64, seed: u64| {
            NoiseTile::of_scales(size, texels_per_metre, scales_m, options.noise * share, seed)
        };
        let (blotches, grain) = (noise(&BLOTCHES_M, BLOTCHY, 11), noise(&GRAIN_M, GRAINY, 17));
        Ok(WallStamper {
            patterns: library.patterns.iter().map(WallPattern::new).collect(),
            noise_peak: blotches.peak() * grain.peak().max(1.0),
            dither: NoiseTile::dither(texels_per_metre),
            blotches,
            grain,
            grid: grid.clone(),
            options: options.clone(),
        })
    }

    /// Texel grid of the stamps.
    pub fn grid(&self) -> &WallGrid {
        &self.grid
    }

    /// Places the stains of a contact: one, plus one per crossing of a closed face's seam.
    ///
    /// Empty for an invalid contact: its pattern is not in the library or has another cause, its face is not in the
    /// grid, or its position, size, direction or strength is out of range.
    pub(crate) fn place(&self, contact: &Contact) -> Vec<PlacedStain<'_>> {
        let (Some(pattern), Some(face)) = (self.pattern(contact), self.grid.faces.get(contact.face as usize)) else {
            return Vec::new();
        };
        let [least, most] = EXTENT_M;
        let sound = contact.along_m.abs() < FARTHEST_M
            && contact.height_m.abs() < FARTHEST_M
            && contact.direction_rad.is_finite()
            && contact.strength > 0.0
            && [contact.length_m, contact.breadth_m].iter().all(|extent| (least..=most).contains(extent));
        if !sound {
            return Vec::new();
        }
        let shape = StainShape::new(self, contact, pattern);
        places_m(contact.along_m, face, shape.reach_m[0], self.grid.texel_m())
            .into_iter()
            .filter_map(|along_m| self.stain(contact, &shape, face, along_m))
            .collect()
    }

    fn pattern(&self, contact: &Contact) -> Option<&WallPattern> {
        self.patterns.get(usize::from(contact.pattern))?.as_ref().filter(|p| p.cause == contact.cause)
    }

    /// Places a stain with its middle at `along_m` on the strip; `None` if it misses the strip.
    fn stain<'a>(
        &self,
        contact: &Contact,
        shape: &StainShape<'a>,
        face: &FaceSpan,
        along_m: f64,
    ) -> Option<PlacedStain<'a>> {
        let (t, texel_m) = (self.grid.texels_per_metre, self.grid.texel_m());
        let place_m = [along_m, contact.height_m];
        let ends = [i64::from(face.width), i64::from(self.grid.height)];
        let range = |k: usize| {
            let low = floor((place_m[k] - shape.reach_m[k]) * t).max(0);
            (low, (floor((place_m[k] + shape.reach_m[k]) * t) + 1).min(ends[k]))
        };
        let ((i0, i1), (j0, j1)) = (range(0), range(1));
        if i0 >= i1 || j0 >= j1 {
            return None;
        }
        let origin = place_m.map(|m| floor(m * t));
        let from_place = |k: usize| (origin[k] as f64 + 0.5) * texel_m - place_m[k];
        let (dx, dy) = (from_place(0), from_place(1));
        let axes_m: [StainAxis; 2] = std::array::from_fn(|k| {
            let [x, y] = shape.axes[k];
            StainAxis { at_origin: dx * x + dy * y, per_i: x * texel_m, per_j: y * texel_m, half: shape.half_m[k] }
        });
        let middle = shape.plate.middle();
        let samples = std::array::from_fn(|k| axes_m[k].linear(shape.samples_per_m[k], middle[k]));
        let v = &shape.variation;
        let [length_m, breadth_m] = shape.extent_m;
        let unit = f64::from(shape.unit);
        let density = axes_m[0]
            .linear(unit * f64::from(v.along) / length_m, unit)
            .plus(axes_m[1].linear(unit * f64::from(v.across) / breadth_m, 0.0));
        let streaks = f64::from(1.0 + (STREAKS - 1.0) * shape.drag);
        let on_face = SplitMix64::new(u64::from(contact.face)).next_u64();
        Some(PlacedStain {
            cause: contact.cause,
            face: contact.face,
            bounds: TexelBounds { i0, j0, i1, j1 },
            peak: shape.peak,
            plate: shape.plate,
            origin,
            axes_m,
            samples,
            bend: shape.bend,
            density,
            blotches: [axes_m[0].linear(t / streaks, 0.5), axes_m[1].linear(t, 0.5)],
            blotches_at: v.blotches_at,
            grain_at: [on_face as u32, (on_face >> 32) as u32],
            dither_at: v.dither_at,
        })
    }

    /// Adds a stain to the cells of a window of its face's strip.
    pub(crate) fn add<C: SumCell>(&self, stain: &PlacedStain, window: TexelWindow, cells: &mut [C]) {
        let mut texels = TexelRow::new();
        let rows = stain.bounds.j0.max(window.j0)..stain.bounds.j1.min(window.j0 + WINDOW as i64);
        for j in rows {
            let from = (j - window.j0) as usize * WINDOW;
            self.add_row(stain, [window.i0, j], &mut texels, &mut cells[from..from + WINDOW]);
        }
    }

    /// Adds a row of a stain to at most [`WINDOW`] cells, starting at texel `[i, j]`.
    pub(super) fn add_row<C: SumCell>(
        &self,
        stain: &PlacedStain,
        [i, j]: [i64; 2],
        texels: &mut TexelRow,
        cells: &mut [C],
    ) {
        let dj = (j - stain.origin[1]) as i32;
        let [from, to] = stain.span(dj);
        let (first, last) = (from.max(i), to.min(i + cells.len() as i64));
        if first < last {
            let cells = &mut cells[(first - i) as usize..(last - i) as usize];
            let di = (first - stain.origin[0]) as i32;
            texels.cut(cells.len()).read(self, stain, [first, j], [di, dj]);
            texels.cut(cells.len()).add_to(stain, [di, dj], cells);
        }
    }
}

/// Buffers for a row of texels, as separate arrays for vectorisation.
#[derive(Debug)]
pub(super) struct TexelRow {
    along: [f32; WINDOW],
    across: [f32; WINDOW],
    quads: [u32; WINDOW],
    blotches: [u32; WINDOW],
    grain: [u16; WINDOW],
    rounding: [u16; WINDOW],
}

/// The first texels of the buffers.
struct TexelRowSlices<'a> {
    along: &'a mut [f32],
    across: &'a mut [f32],
    quads: &'a mut [u32],
    blotches: &'a mut [u32],
    grain: &'a mut [u16],
    rounding: &'a mut [u16],
}

impl TexelRow {
    pub(super) fn new() -> TexelRow {
        TexelRow {
            along: [0.0; WINDOW],
            across: [0.0; WINDOW],
            quads: [0; WINDOW],
            blotches: [0; WINDOW],
            grain: [0; WINDOW],
            rounding: [0; WINDOW],
        }
    }

    fn cut(&mut self, count: usize) -> TexelRowSlices<'_> {
        TexelRowSlices {
            along: &mut self.along[..count],
            across: &mut self.across[..count],
            quads: &mut self.quads[..count],
            blotches: &mut self.blotches[..count],
            grain: &mut self.grain[..count],
            rounding: &mut self.rounding[..count],
        }
    }
}

impl TexelRowSlices<'_> {
    /// Reads the row from texel `[i, j]` on, which is `[di, dj]` from the stain's origin.
    #[inline]
    fn read(self, stamper: &WallStamper, stain: &PlacedStain, [i, j]: [i64; 2], [di, dj]: [i32; 2]) {
        let [along, across] = stain.samples;
        let (u, v) = (along.in_row(dj), across.in_row(dj));
        let [blotch_i, blotch_j] = stain.blotches;
        let (bi, bj) = (blotch_i.in_row(dj), blotch_j.in_row(dj));
        let [start_i, start_j] = stain.blotches_at;
        let raster = stamper.blotches.raster();
        let places = self.along.iter_mut().zip(&mut *self.across).zip(&mut *self.blotches);
        for (k, ((sample, other), blotch)) in (0i32..).zip(places) {
            let x = di.wrapping_add(k) as f32;
            *sample = u + x * along.per_i;
            *other = v + x * across.per_i + stain.bend.at(*sample);
            let column = start_i.wrapping_add(bits_of(whole(bi + x * blotch_i.per_i)));
            let row = start_j.wrapping_add(bits_of(whole(bj + x * blotch_j.per_i)));
            *blotch = raster.place(column, row);
        }
        stain.plate.find(self.along, self.across, self.quads);
        self.blotches.iter_mut().for_each(|blotch| *blotch = raster.at(*blotch).into());
        let at = |at: [u32; 2]| (at[0].wrapping_add(i as u32), at[1].wrapping_add(j as u32));
        let ((gi, gj), (ri, rj)) = (at(stain.grain_at), at(stain.dither_at));
        stamper.grain.raster().copy_row(gi, gj, self.grain);
        stamper.dither.raster().copy_row(ri, rj, self.rounding);
    }

    /// Adds the row to the cells.
    #[inline]
    fn add_to<C: SumCell>(self, stain: &PlacedStain, [di, dj]: [i32; 2], cells: &mut [C]) {
        let (density, per_i) = (stain.density.in_row(dj), stain.density.per_i);
        let peak = f32::from(stain.peak);
        let places = self.along.iter().zip(&*self.across);
        let noise = self.blotches.iter().zip(&*self.grain).zip(&*self.rounding);
        let texels = self.quads.iter_mut().zip(places).zip(noise);
        for (k, ((amount, (&along, &across)), ((&blotch, &grain), &rounding))) in (0i32..).zip(texels) {
            let coverage = stain.plate.between(*amount, along, across);
            let density = (density + di.wrapping_add(k) as f32 * per_i).max(0.0);
            let grain = f32::from(grain) * (1.0 / NOISE_ONE) - 1.0;
            let caught = 1.0 + (1.0 - FILLED * coverage.min(1.0)) * grain;
            let left = coverage * density * (blotch as i32 as f32 * (1.0 / NOISE_ONE)) * caught;
            let rounding = f32::from(rounding) * (1.0 / 65_536.0) - 0.5;
            *amount = bits_of((left + rounding).max(0.0).min(peak));
        }
        cells.iter_mut().zip(&*self.quads).for_each(|(cell, &amount)| cell.add(amount as u16));
    }
}

/// Positions of a stain's middle on its face's strip: one per turn of a closed face that touches it.
fn places_m(along_m: f64, face: &FaceSpan, reach_m: f64, texel_m: f64) -> Vec<f64> {
    // NaN must be refused.
    if !(face.closed && face.length_m > 0.0 && face.length_m.is_finite()) {
        return vec![along_m];
    }
    let first = along_m.rem_euclid(face.length_m);
    let end_m = f64::from(face.width) * texel_m;
    let turns = |m: f64| (m / face.length_m).clamp(-MOST_TURNS, MOST_TURNS);
    let (low, high) = (turns(-reach_m - first).ceil() as i32, turns(end_m + reach_m - first).floor() as i32);
    (low..=high).map(|turn| first + f64::from(turn) * face.length_m).collect()
}

/// A stain without position.
struct StainShape<'a> {
    plate: &'a WallPlate,
    variation: ContactVariation,
    drag: f32,
    /// Unit vectors along and across, in strip coordinates.
    axes: [[f64; 2]; 2],
    /// Length and breadth, metres.
    extent_m: [f64; 2],
    /// Half extents along and across, metres.
    half_m: [f64; 2],
    /// Half extents horizontally and vertically, metres.
    reach_m: [f64; 2],
    /// Samples of the plate per metre of wall.
    samples_per_m: [f64; 2],
    bend: StainBend,
    /// Optical density at full coverage in the middle of the stain, in the unit of sums.
    unit: f32,
    peak: u16,
}

impl<'a> StainShape<'a> {
    fn new(stamper: &WallStamper, contact: &Contact, pattern: &'a WallPattern) -> StainShape<'a> {
        let drag = drag(contact.length_m, contact.breadth_m);
        let variation = ContactVariation::new(contact.variation, drag, &stamper.options);
        let extent_m = [contact.length_m, contact.breadth_m].map(f64::from);
        let scales = [extent_m[0] / pattern.length_m, extent_m[1] / pattern.breadth_m];
        let filter_m = stamper.filter_m(contact.cause, variation.blur, extent_m);
        let plate = pattern.plate(scales.map(|scale| filter_m / scale));
        let samples_per_m: [f64; 2] = std::array::from_fn(|k| 1.0 / (plate.pitch_m[k] * scales[k]));
        let mut half_m: [f64; 2] = std::array::from_fn(|k| plate.half_extent_m[k] * scales[k]);
        let bend = StainBend::new(&variation, extent_m[0], samples_per_m, plate.middle()[0] as f32);
        half_m[1] += variation.aside_at_most() * extent_m[0];

        let (sin, cos) = sin_cos(f64::from(contact.direction_rad));
        // Image rows run to the right of the drag: downwards for a drag to the right.
        let side = if contact.mirrored { -1.0 } else { 1.0 };
        let axes = [[cos, sin], [side * sin, -side * cos]];
        let reach = |k: usize| half_m[0] * axes[0][k].abs() + half_m[1] * axes[1][k].abs();

        // Sloped pressure has mean 1 over the coverage.
        let slopes = [variation.along, variation.across];
        let mean = 1.0 + slopes[0] * pattern.centroid[0] as f32 + slopes[1] * pattern.centroid[1] as f32;
        let unit = contact.strength.min(MOST_DENSITY) * DENSITY_ONE / mean;
        let slope = |k: usize| slopes[k].abs() * (half_m[k] / extent_m[k]) as f32;
        let most = unit * (1.0 + slope(0) + slope(1)) * plate.peak * stamper.noise_peak;
        StainShape {
            plate,
            drag,
            axes,
            extent_m,
            half_m,
            reach_m: [reach(0), reach(1)],
            samples_per_m,
            bend,
            unit,
            peak: (most + 2.0) as u16,
            variation,
        }
    }
}

impl WallStamper {
    /// Standard deviation of a stain's filter, metres: texel filter and blur.
    fn filter_m(&self, cause: Cause, blur: f32, extent_m: [f64; 2]) -> f64 {
        let [least, most] = self.options.blur_m;
        let softness = match cause {
            Cause::Hand | Cause::Arm | Cause::Shoulder => SOFT,
            Cause::Bag | Cause::Shoe | Cause::Sole | Cause::Heel => 1.0,
        };
        let blur_m = softness * (least + (most - least) * f64::from(blur));
        let blur_m = blur_m.min(MOST_BLUR * extent_m[0].min(extent_m[1]));
        let texel_m = TEXEL_FILTER * self.grid.texel_m();
        (texel_m * texel_m + blur_m * blur_m).sqrt()
    }
}

impl ContactVariation {
    /// Upper bound on the bend of the stain, shares of its length.
    fn aside_at_most(&self) -> f64 {
        f64::from(self.bow.abs()) / 6.0 + f64::from(self.wave.abs()) * 0.2
    }
}

impl StainBend {
    fn new(v: &ContactVariation, length_m: f64, samples_per_m: [f64; 2], middle: f32) -> StainBend {
        let across = (length_m * samples_per_m[1]) as f32;
        let factors = [-v.bow / 12.0, -v.wave, v.bow, 4.0 * v.wave].map(|factor| factor * across);
        StainBend { middle, share_per_sample: (1.0 / (length_m * samples_per_m[0])) as f32, factors }
    }

    #[inline]
    fn at(&self, sample: f32) -> f32 {
        // Beyond the stain's ends the bend is constant.
        let share = ((sample - self.middle) * self.share_per_sample).clamp(-0.5, 0.5);
        let [a, b, c, d] = self.factors;
        a + share * (b + share * (c + share * d))
    }
}

impl StainAxis {
    /// `offset + factor * self`, in single precision.
    fn linear(&self, factor: f64, offset: f64) -> Linear {
        Linear {
            at_origin: (self.at_origin * factor + offset) as f32,
            per_i: (self.per_i * factor) as f32,
            per_j: (self.per_j * factor) as f32,
        }
    }
}

impl PlacedStain<'_> {
    /// Range of columns of a row that the stain can touch, from the strip's start.
    fn span(&self, dj: i32) -> [i64; 2] {
        let mut span = [self.bounds.i0 as f64, self.bounds.i1 as f64];
        for axis in &self.axes_m {
            let start = axis.at_origin + f64::from(dj) * axis.per_j - axis.per_i * self.origin[0] as f64;
            // One texel more on either side, for rounding.
            let half = axis.half + axis.per_i.abs();
            let [low, high] = if axis.per_i.abs() > 1e-9 {
                let [a, b] = [(-half - start) / axis.per_i, (half - start) / axis.per_i];
                [a.min(b), a.max(b)]
            } else if start.abs() <= half {
                [f64::NEG_INFINITY, f64::INFINITY]
            } else {
                [0.0, -1.0]
            };
            span = [span[0].max(low), span[1].min(high)];
        }
        [floor(span[0]).max(self.bounds.i0), (floor(span[1]) + 1).min(self.bounds.i1)]
    }
}
