//! Turns contacts into texels of unrolled wall faces.

use super::lanes::Cell;
use super::noise::{NOISE_ONE, NoiseTile};
use super::print::Linear;
use super::stamper::{Bounds, MOST_DENSITY, WINDOW, Window, floor};
use super::wall_plate::{WallPattern, WallPlate, bits_of, whole};
use super::wall_variation::{ContactVariation, drag};
use super::{DENSITY_ONE, FaceSpan, StampOptions, WallGrid};
use crate::marks::Contact;
use crate::math::{SplitMix64, sin_cos};
use crate::patterns::{Cause, PatternLibrary};

/// Deviation of the texel's filter, texels; as on the floor.
const TEXEL_FILTER: f64 = 0.45;

/// Contacts are at least and at most so long and so broad, metres.
const EXTENT_M: [f32; 2] = [0.001, 10.0];

/// Contacts lie within this distance from a face's start and from the floor, metres.
const FARTHEST_M: f64 = 1e6;

/// A stain goes round a closed face no more often than this.
const MOST_TURNS: f64 = 64.0;

/// How much more skin and cloth blur than what is hard: a factor on [`StampOptions::blur_m`].
const SOFT: f64 = 2.5;

/// No stain is blurred by more than this share of its smaller extent.
const MOST_BLUR: f64 = 0.15;

/// Sizes of blotches, metres: how grime sticks to a hand or comes off it.
const BLOTCHES_M: [f64; 3] = [0.06, 0.02, 0.007];

/// Deviation of the blotches, as a share of [`StampOptions::noise`].
const BLOTCHY: f64 = 1.2;

/// Sizes of a wall's micro texture, metres: the grain that a paint roller leaves.
const GRAIN_M: [f64; 2] = [0.005, 0.002];

/// Deviation of what the grain catches, as a share of [`StampOptions::noise`].
const GRAINY: f64 = 0.8;

/// A full touch fills the grain, a faint one leaves something on its tops only: share of the grain's contrast that
/// full coverage loses.
const FILLED: f32 = 0.6;

/// How much longer than broad the blotches of a drag are.
const STREAKS: f32 = 4.0;

/// Turns contacts into texels for one library, one grid and one set of options.
///
/// A stain is a pure function of its contact, its pattern and the grid: a stain that is cut by a block's border gives the same
/// integers on both sides as one that is not. It is cut off at the floor, at the ceiling and at the ends of an open
/// face; on a closed face it goes on across the seam.
#[derive(Debug)]
pub struct WallStamper {
    grid: WallGrid,
    options: StampOptions,
    /// By the pattern's number; none for what floors take.
    patterns: Vec<Option<WallPattern>>,
    blotches: NoiseTile,
    grain: NoiseTile,
    dither: NoiseTile,
    /// The most that blotches and grain make of 1.
    noise_peak: f32,
}

/// A contact that was found sound, once for each time that it shows on its face's strip.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stain<'a> {
    pub(crate) cause: Cause,
    pub(crate) face: u32,
    /// Texels of the strip that it can touch; within the strip.
    pub(crate) bounds: Bounds,
    /// No texel gets more than this.
    pub(crate) peak: u16,
    plate: &'a WallPlate,
    /// The texel that the others are counted from.
    origin: [i64; 2],
    /// Place of a texel's middle on the stain, metres along and across, and how far the stain reaches.
    axes_m: [Axis; 2],
    /// The same in samples of the plate.
    samples: [Linear; 2],
    bend: Bend,
    /// Density of full coverage, in the unit of sums.
    density: Linear,
    /// The same place in texels of the blotches.
    blotches: [Linear; 2],
    blotches_at: [u32; 2],
    /// What to add to a texel for its place in the grain and in the dither.
    grain_at: [u32; 2],
    dither_at: [u32; 2],
}

/// A linear function of texels, with the range in which there is anything.
#[derive(Clone, Copy, Debug)]
struct Axis {
    at_origin: f64,
    per_i: f64,
    per_j: f64,
    half: f64,
}

/// How a stain is bent aside: a cubic of the place along, both in samples.
#[derive(Clone, Copy, Debug)]
struct Bend {
    middle: f32,
    share_per_sample: f32,
    factors: [f32; 4],
}

impl WallStamper {
    /// A stamper for the contacts that use this library. Options out of range (see [`StampOptions::check`]) are
    /// replaced by their defaults.
    ///
    /// Of the options `blur_m`, `pressure` and `noise` mean on walls what they mean on floors.
    pub fn new(library: &PatternLibrary, grid: &WallGrid, options: &StampOptions) -> WallStamper {
        let options = if options.check().is_ok() { options.clone() } else { StampOptions::default() };
        let density = grid.texels_per_metre;
        // A metre or so, as far as a tile of that many texels is small enough.
        let size = ((0.8 * density) as usize).clamp(64, 512).next_power_of_two();
        let noise = |scales_m: &[f64], share: f64, seed: u64| {
            NoiseTile::of_scales(size, density, scales_m, options.noise * share, seed)
        };
        let (blotches, grain) = (noise(&BLOTCHES_M, BLOTCHY, 11), noise(&GRAIN_M, GRAINY, 17));
        WallStamper {
            patterns: library.patterns.iter().map(WallPattern::new).collect(),
            noise_peak: blotches.peak() * grain.peak().max(1.0),
            dither: NoiseTile::dither(density),
            blotches,
            grain,
            grid: grid.clone(),
            options,
        }
    }

    /// The grid that it stamps for.
    pub fn grid(&self) -> &WallGrid {
        &self.grid
    }

    /// The stains that a contact leaves: one, or one more for each time that it crosses the seam of a closed face.
    ///
    /// None if it can leave nothing: a pattern that is not in the library or not of the contact's cause, a face that
    /// is none, a place, size, direction or strength that is no sensible number.
    pub(crate) fn place(&self, contact: &Contact) -> Vec<Stain<'_>> {
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
        let shape = Shape::new(self, contact, pattern);
        places_m(contact.along_m, face, shape.reach_m[0], self.grid.texel_m())
            .into_iter()
            .filter_map(|along_m| self.stain(contact, &shape, face, along_m))
            .collect()
    }

    fn pattern(&self, contact: &Contact) -> Option<&WallPattern> {
        self.patterns.get(usize::from(contact.pattern))?.as_ref().filter(|p| p.cause == contact.cause)
    }

    /// The stain of a contact whose middle lies here on the strip, if it touches the strip at all.
    fn stain<'a>(&self, contact: &Contact, shape: &Shape<'a>, face: &FaceSpan, along_m: f64) -> Option<Stain<'a>> {
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
        let axes_m: [Axis; 2] = std::array::from_fn(|k| {
            let [x, y] = shape.axes[k];
            Axis { at_origin: dx * x + dy * y, per_i: x * texel_m, per_j: y * texel_m, half: shape.half_m[k] }
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
        Some(Stain {
            cause: contact.cause,
            face: contact.face,
            bounds: Bounds { i0, j0, i1, j1 },
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
    pub(crate) fn add<C: Cell>(&self, stain: &Stain, window: Window, cells: &mut [C]) {
        let mut texels = Texels::new();
        let rows = stain.bounds.j0.max(window.j0)..stain.bounds.j1.min(window.j0 + WINDOW as i64);
        for j in rows {
            let from = (j - window.j0) as usize * WINDOW;
            self.add_row(stain, [window.i0, j], &mut texels, &mut cells[from..from + WINDOW]);
        }
    }

    /// Adds a row of a stain to [`WINDOW`] cells or fewer, the first of which is texel `[i, j]`.
    pub(super) fn add_row<C: Cell>(&self, stain: &Stain, [i, j]: [i64; 2], texels: &mut Texels, cells: &mut [C]) {
        let dj = (j - stain.origin[1]) as i32;
        let [from, to] = stain.span(dj);
        let (first, last) = (from.max(i), to.min(i + cells.len() as i64));
        if first < last {
            let cells = &mut cells[(first - i) as usize..(last - i) as usize];
            let di = (first - stain.origin[0]) as i32;
            texels.cut(cells.len()).read(self, stain, [first, j], [di, dj]);
            texels.cut(cells.len()).lay(stain, [di, dj], cells);
        }
    }
}

/// What is known of a row of texels before a stain is laid on them: in separate arrays, so that loops are vectorised.
#[derive(Debug)]
pub(super) struct Texels {
    along: [f32; WINDOW],
    across: [f32; WINDOW],
    quads: [u32; WINDOW],
    blotches: [u32; WINDOW],
    grain: [u16; WINDOW],
    rounding: [u16; WINDOW],
}

/// The first of them.
struct Cut<'a> {
    along: &'a mut [f32],
    across: &'a mut [f32],
    quads: &'a mut [u32],
    blotches: &'a mut [u32],
    grain: &'a mut [u16],
    rounding: &'a mut [u16],
}

impl Texels {
    pub(super) fn new() -> Texels {
        Texels {
            along: [0.0; WINDOW],
            across: [0.0; WINDOW],
            quads: [0; WINDOW],
            blotches: [0; WINDOW],
            grain: [0; WINDOW],
            rounding: [0; WINDOW],
        }
    }

    fn cut(&mut self, count: usize) -> Cut<'_> {
        Cut {
            along: &mut self.along[..count],
            across: &mut self.across[..count],
            quads: &mut self.quads[..count],
            blotches: &mut self.blotches[..count],
            grain: &mut self.grain[..count],
            rounding: &mut self.rounding[..count],
        }
    }
}

impl Cut<'_> {
    /// Reads the row that begins at texel `[i, j]`, which is `[di, dj]` as the stain counts.
    #[inline]
    fn read(self, stamper: &WallStamper, stain: &Stain, [i, j]: [i64; 2], [di, dj]: [i32; 2]) {
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

    /// Adds what was read to as many cells.
    #[inline]
    fn lay<C: Cell>(self, stain: &Stain, [di, dj]: [i32; 2], cells: &mut [C]) {
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

/// Where the middle of a stain lies on its face's strip: a closed face shows it at every turn that reaches the strip.
fn places_m(along_m: f64, face: &FaceSpan, reach_m: f64, texel_m: f64) -> Vec<f64> {
    // Written so that NaN is no length.
    if !(face.closed && face.length_m > 0.0 && face.length_m.is_finite()) {
        return vec![along_m];
    }
    let first = along_m.rem_euclid(face.length_m);
    let end_m = f64::from(face.width) * texel_m;
    let turns = |m: f64| (m / face.length_m).clamp(-MOST_TURNS, MOST_TURNS);
    let (low, high) = (turns(-reach_m - first).ceil() as i32, turns(end_m + reach_m - first).floor() as i32);
    (low..=high).map(|turn| first + f64::from(turn) * face.length_m).collect()
}

/// All about a stain but where it lies.
struct Shape<'a> {
    plate: &'a WallPlate,
    variation: ContactVariation,
    drag: f32,
    /// Unit vectors along and across, on the strip.
    axes: [[f64; 2]; 2],
    /// Length and breadth, metres.
    extent_m: [f64; 2],
    /// How far it reaches from its middle, along and across, metres.
    half_m: [f64; 2],
    /// How far it reaches from its middle, to the sides and up and down, metres.
    reach_m: [f64; 2],
    /// Samples of the plate per metre of wall.
    samples_per_m: [f64; 2],
    bend: Bend,
    /// Density in the middle of a stain of full coverage, in the unit of sums.
    unit: f32,
    peak: u16,
}

impl<'a> Shape<'a> {
    fn new(stamper: &WallStamper, contact: &Contact, pattern: &'a WallPattern) -> Shape<'a> {
        let drag = drag(contact.length_m, contact.breadth_m);
        let variation = ContactVariation::new(contact.variation, drag, &stamper.options);
        let extent_m = [contact.length_m, contact.breadth_m].map(f64::from);
        let scales = [extent_m[0] / pattern.length_m, extent_m[1] / pattern.breadth_m];
        let filter_m = stamper.filter_m(contact.cause, variation.blur, extent_m);
        let plate = pattern.plate(scales.map(|scale| filter_m / scale));
        let samples_per_m: [f64; 2] = std::array::from_fn(|k| 1.0 / (plate.pitch_m[k] * scales[k]));
        let mut half_m: [f64; 2] = std::array::from_fn(|k| plate.half_extent_m[k] * scales[k]);
        let bend = Bend::new(&variation, extent_m[0], samples_per_m, plate.middle()[0] as f32);
        half_m[1] += variation.aside_at_most() * extent_m[0];

        let (sin, cos) = sin_cos(f64::from(contact.direction_rad));
        // Image rows run to the right of the drag: downwards where it goes to the right.
        let side = if contact.mirrored { -1.0 } else { 1.0 };
        let axes = [[cos, sin], [side * sin, -side * cos]];
        let reach = |k: usize| half_m[0] * axes[0][k].abs() + half_m[1] * axes[1][k].abs();

        // Sloping pressure is 1 in the mean over what the pattern covers.
        let slopes = [variation.along, variation.across];
        let mean = 1.0 + slopes[0] * pattern.centroid[0] as f32 + slopes[1] * pattern.centroid[1] as f32;
        let unit = contact.strength.min(MOST_DENSITY) * DENSITY_ONE / mean;
        let slope = |k: usize| slopes[k].abs() * (half_m[k] / extent_m[k]) as f32;
        let most = unit * (1.0 + slope(0) + slope(1)) * plate.peak * stamper.noise_peak;
        Shape {
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
    /// Deviation of what a stain is seen through, metres: the texel's filter and its own blur.
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
    /// How far the stain is bent aside at most, shares of its length.
    fn aside_at_most(&self) -> f64 {
        f64::from(self.bow.abs()) / 6.0 + f64::from(self.wave.abs()) * 0.2
    }
}

impl Bend {
    fn new(v: &ContactVariation, length_m: f64, samples_per_m: [f64; 2], middle: f32) -> Bend {
        let across = (length_m * samples_per_m[1]) as f32;
        let factors = [-v.bow / 12.0, -v.wave, v.bow, 4.0 * v.wave].map(|factor| factor * across);
        Bend { middle, share_per_sample: (1.0 / (length_m * samples_per_m[0])) as f32, factors }
    }

    #[inline]
    fn at(&self, sample: f32) -> f32 {
        // What the filter spreads beyond the stain's ends goes on straight.
        let share = ((sample - self.middle) * self.share_per_sample).clamp(-0.5, 0.5);
        let [a, b, c, d] = self.factors;
        a + share * (b + share * (c + share * d))
    }
}

impl Axis {
    /// `offset + factor * self`, in single precision.
    fn linear(&self, factor: f64, offset: f64) -> Linear {
        Linear {
            at_origin: (self.at_origin * factor + offset) as f32,
            per_i: (self.per_i * factor) as f32,
            per_j: (self.per_j * factor) as f32,
        }
    }
}

impl Stain<'_> {
    /// The columns of a row that the stain can touch, counted from the strip's start: first and one past the last.
    fn span(&self, dj: i32) -> [i64; 2] {
        let mut span = [self.bounds.i0 as f64, self.bounds.i1 as f64];
        for axis in &self.axes_m {
            let start = axis.at_origin + f64::from(dj) * axis.per_j - axis.per_i * self.origin[0] as f64;
            // A texel more on either side, for rounding.
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
