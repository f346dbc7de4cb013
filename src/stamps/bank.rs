//! Bank of patterns, filtered for the texel density on first use.
//!
//! Each pattern is filtered once with a Gaussian of 0.45 texel; a stamp samples the result at texel centres. The
//! Gaussian passes 0.7 % of a period of one texel, so the sum over a stamp's texels does not depend on its sub-texel
//! position, at any angle. A box filter along the pattern's axes achieves this only unrotated. With four samples per
//! texel the nearest sample is at most 1/8 texel away.
//!
//! Not imageproc's Gaussian: results must not depend on its version, and it has one deviation for both axes.

use std::sync::OnceLock;

use super::float_image::{FILTER_REACH, FloatImage};
use super::linear::Linear;
use super::pose::PrintPose;
use super::shadow::StampExtent;
use super::soil_coat::SoilCoat;
use super::variation::{FARTHEST, SoleVariation};
use super::window::{TexelBounds, floor};
use super::{StampOptions, TexelGrid};
use crate::math::Vec2;
use crate::math::smoothstep_f32;
use crate::patterns::{Cause, Pattern, PatternLibrary};

/// Standard deviation of the texel filter, texels.
const TEXEL_FILTER: f64 = 0.45;

/// Samples of a plate per texel.
const SAMPLES_PER_TEXEL: f64 = 4.0;

/// Least distance of samples, metres: half a pixel of a pattern.
const FINEST_SAMPLE_M: f64 = 0.0005;

/// Largest number of samples along a pattern.
const MOST_SAMPLES: f64 = 1000.0;

/// Approximate step between smears, metres.
const SMEAR_STEP_M: f64 = 0.004;

/// Longest smear with a plate, metres of the pattern: 3 cm on a foot of half the pattern's size.
const LONGEST_SMEAR_M: f64 = 0.06;

/// Texel size above which a sole has few texels, metres.
const FEW_TEXELS_M: f64 = 0.0126;

/// Empty samples around a plate beyond the filter's reach: a row's span may be a texel too long.
const GUARD: usize = 6;

/// Number of soil coats over which the mean is taken.
const COATS: u64 = 1024;

/// Number of blur levels of soil prints.
const BLURS: usize = 3;

/// A filtered pattern: coverage samples at equal distances.
#[derive(Debug)]
pub(super) struct Plate {
    /// Samples per row.
    pub(super) columns: usize,
    /// Rows, from the outer edge of a left foot to the inner.
    pub(super) rows: usize,
    /// Samples in units of `unit`, in rows `1 << pitch_bits` apart; their number is a power of two. All 8 bits are
    /// used, even for a thin mark that covers no texel fully.
    pub(super) samples: Vec<u8>,
    pub(super) pitch_bits: u32,
    /// Coverage of a sample value of 1.
    pub(super) unit: f32,
    /// Side of a sample, metres of the pattern.
    pub(super) sample_m: f64,
    /// Empty samples before the pattern's first.
    pub(super) margin: usize,
}

impl Plate {
    /// Whether a print at this scale needs interpolation: its samples are coarse, or its texels too few for errors to
    /// cancel.
    pub(super) fn needs_smooth_reading(&self, texel_m: f64, scale: f64) -> bool {
        self.sample_m > 0.3 * texel_m / scale || texel_m > FEW_TEXELS_M
    }
}

/// A pattern with its plates of all sizes, blurs and smears.
#[derive(Debug)]
pub(super) struct Printer {
    pub(super) cause: Cause,
    /// Length of the pattern, metres.
    pub(super) length_m: f64,
    /// Width of the pattern, metres.
    pub(super) width_m: f64,
    /// Integral of the coverage at the pattern's own size, square metres.
    pub(super) mass_m2: f64,
    /// Centroid of the coverage, soles along and across.
    pub(super) centroid: [f64; 2],
    /// Coarse distribution of the coverage, for prints cut by a wall.
    pub(super) lumps: Vec<Lump>,
    coverage: FloatImage,
    sizes: Vec<SizePlates>,
}

/// Plates of a pattern for feet of similar size. On a smaller shoe a texel covers more of the pattern.
#[derive(Debug)]
struct SizePlates {
    sample_m: f64,
    /// Reach of the filter, samples.
    reach: usize,
    /// Factors on the pressure slopes that keep pressure positive within the filter's reach.
    slopes_held: [f32; 2],
    /// Samples between smears.
    smear_step: usize,
    /// Standard deviation of the filter for each blur, metres of the pattern.
    filters_m: Vec<f64>,
    filtered: Vec<OnceLock<FloatImage>>,
    plates: Vec<Vec<OnceLock<Plate>>>,
    mean_coat: OnceLock<f32>,
}

/// A cell of the coarse coverage distribution of a pattern.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lump {
    /// Middle, soles along and across.
    pub(super) place: [f64; 2],
    /// Share of the pattern's coverage.
    pub(super) share: f32,
}

/// Number of lumps along and across.
const LUMPS: [usize; 2] = [20, 8];

/// Printers of a library's floor patterns, by pattern index; `None` for wall patterns.
pub(super) fn printers(library: &PatternLibrary, texel_m: f64, options: &StampOptions) -> Vec<Option<Printer>> {
    let of_floor = |pattern: &Pattern| pattern.cause.on_wall().is_none();
    let printer = |pattern| of_floor(pattern).then(|| Printer::new(pattern, texel_m, options));
    library.patterns.iter().map(printer).collect()
}

/// Scales at which the plates change to the next size: half powers of two.
const SIZE_EDGES: [f64; 10] = [0.210, 0.297, 0.420, 0.595, 0.841, 1.189, 1.682, 2.378, 3.364, 4.757];

impl Printer {
    fn new(pattern: &Pattern, texel_m: f64, options: &StampOptions) -> Printer {
        let coverage = FloatImage::of(pattern);
        let (mass_m2, centroid) = coverage.mass_and_centroid();
        let extent_m = [coverage.width, coverage.height].map(|count| count as f64 * coverage.pixel_m);
        // Geometric middle between the edges.
        let scale = |size: usize| SIZE_EDGES.get(size).map_or(5.657, |edge| edge / 1.189);
        Printer {
            cause: pattern.cause,
            length_m: extent_m[0],
            width_m: extent_m[1],
            mass_m2,
            centroid,
            lumps: lumps(&coverage),
            sizes: (0..=SIZE_EDGES.len())
                .map(|k| SizePlates::new(texel_m / scale(k), extent_m, centroid, options))
                .collect(),
            coverage,
        }
    }

    fn size(&self, scale: f64) -> &SizePlates {
        &self.sizes[SIZE_EDGES.partition_point(|&edge| edge < scale)]
    }

    /// Length of a lump, metres of the pattern.
    pub(super) fn lump_m(&self) -> f64 {
        self.length_m / LUMPS[0] as f64
    }

    /// Half length and half width of a print including the filter's reach, metres.
    pub(super) fn half_extent_m(&self, pose: &PrintPose) -> [f64; 2] {
        let size = self.size(pose.scale_across);
        let spread_m = size.reach as f64 * size.sample_m;
        [(self.length_m * 0.5 + spread_m) * pose.scale_along, (self.width_m * 0.5 + spread_m) * pose.scale_across]
    }

    /// Factors on the pressure slopes along and across, for the print's spread by the texel filter.
    pub(super) fn slopes_held(&self, pose: &PrintPose) -> [f32; 2] {
        self.size(pose.scale_across).slopes_held
    }

    /// Mean share of full coverage that soil prints leave, over all variation.
    pub(super) fn mean_coat(&self, pose: &PrintPose, options: &StampOptions) -> f32 {
        let size = self.size(pose.scale_across);
        *size.mean_coat.get_or_init(|| {
            let filtered = size.filtered[0].get_or_init(|| self.filtered(size, size.filters_m[0]));
            let (margin, [u_pitch, v_pitch]) =
                (size.margin(), [self.length_m, self.width_m].map(|m| size.sample_m / m));
            let place = |k: usize, pitch: f64| ((k as f64 + 0.5 - margin as f64) * pitch - 0.5) as f32;
            // A few hundred positions suffice.
            let step = ((filtered.values.len() / 300) as f64).sqrt().max(1.0) as usize;
            let places: Vec<[f32; 3]> = (0..filtered.height * filtered.width)
                .map(|k| (k % filtered.width, k / filtered.width))
                .filter(|(column, row)| column % step == step / 2 && row % step == step / 2)
                .map(|(column, row)| {
                    let coverage = filtered.values[row * filtered.width + column] / 255.0;
                    [coverage, place(column, u_pitch), place(row, v_pitch)]
                })
                .filter(|place| place[0] > 0.004)
                .collect();
            let full: f32 = places.iter().map(|place| place[0]).sum();
            let left: f32 = (0..COATS)
                .map(|word| {
                    let variation = SoleVariation::new(word.wrapping_mul(0x9e37_79b9_7f4a_7c15), options);
                    let coat = SoilCoat::on_sole(&variation, word as u32);
                    places.iter().map(|&[coverage, u, v]| coat.coated_at(coverage, u, v)).sum::<f32>()
                })
                .sum();
            if full > 0.0 { left / full / COATS as f32 } else { 1.0 }
        })
    }

    /// Extent of a print, enlarged by `more_m` on every side.
    pub(super) fn extent(&self, pose: &PrintPose, more_m: f64) -> StampExtent {
        let [half_along_m, half_across_m] = self.half_extent_m(pose).map(|half| half + more_m);
        StampExtent { middle_m: pose.place_m, heading: pose.heading, half_along_m, half_across_m }
    }

    /// Floor position, metres, of a point of the pattern given in soles along and across.
    pub(super) fn point_m(&self, pose: &PrintPose, [along, across]: [f64; 2]) -> Vec2 {
        let right = pose.heading.left() * if pose.mirrored { 1.0 } else { -1.0 };
        pose.place_m
            + pose.heading * (along * self.length_m * pose.scale_along)
            + right * (across * self.width_m * pose.scale_across)
    }

    /// Texels that a print can touch, enlarged by `more_m` on every side.
    pub(super) fn bounds(&self, pose: &PrintPose, grid: &TexelGrid, more_m: f64) -> TexelBounds {
        let [half_along, half_across] = self.half_extent_m(pose).map(|half| half + more_m);
        let h = pose.heading;
        let x = half_along * h.x.abs() + half_across * h.y.abs();
        let y = half_along * h.y.abs() + half_across * h.x.abs();
        let t = grid.texels_per_metre;
        TexelBounds {
            i0: floor((pose.place_m.x - x) * t),
            j0: floor((pose.place_m.y - y) * t),
            i1: floor((pose.place_m.x + x) * t) + 1,
            j1: floor((pose.place_m.y + y) * t) + 1,
        }
    }

    /// Position on the sole, in soles along and across, as linear functions of the texel.
    pub(super) fn sole_place(&self, pose: &PrintPose, grid: &TexelGrid) -> [Linear; 2] {
        let [along, across] = pose.along_across(grid, pose.origin(grid));
        let linear = |v: [f64; 3], extent: f64| {
            let per_extent = 1.0 / extent;
            let [at_origin, per_i, per_j] = v.map(|v| (v * per_extent) as f32);
            Linear { at_origin, per_i, per_j }
        };
        [linear(along, self.length_m), linear(across, self.width_m)]
    }

    /// Returns the plate for a print. `blur`: 0..=1 from least to largest; `smear_m`: metres on the floor.
    pub(super) fn plate(&self, pose: &PrintPose, blur: f32, smear_m: f64) -> &Plate {
        let size = self.size(pose.scale_across);
        let blur = ((blur * size.filters_m.len() as f32) as usize).min(size.filters_m.len() - 1);
        let step_m = size.sample_m * size.smear_step as f64;
        let smear = (smear_m / pose.scale_along / step_m).round().max(0.0) as usize;
        let smear = smear.min(size.plates[blur].len() - 1);
        size.plates[blur][smear].get_or_init(|| {
            let filtered = size.filtered[blur].get_or_init(|| self.filtered(size, size.filters_m[blur]));
            self.smeared(filtered, size, smear * size.smear_step)
        })
    }

    /// Filters and samples the pattern with its margin.
    fn filtered(&self, size: &SizePlates, deviation_m: f64) -> FloatImage {
        let mut image = self.coverage.reduced_for(deviation_m);
        image = image.padded((FILTER_REACH * deviation_m / image.pixel_m).ceil() as usize + 1);
        image.blur(deviation_m / image.pixel_m);
        let middle = [image.width as f64 * 0.5, image.height as f64 * 0.5];
        let count = |extent_m: f64| (extent_m / size.sample_m).ceil() as usize + 2 * size.margin();
        let (columns, rows) = (count(self.length_m), count(self.width_m));
        let place = |k: usize, extent_m: f64| (k as f64 + 0.5 - size.margin() as f64) * size.sample_m - extent_m * 0.5;
        let mut values = Vec::with_capacity(columns * rows);
        for row in 0..rows {
            let y = middle[1] + place(row, self.width_m) / image.pixel_m;
            for column in 0..columns {
                let x = middle[0] + place(column, self.length_m) / image.pixel_m;
                values.push(image.at(x, y));
            }
        }
        let mut sampled = FloatImage { width: columns, height: rows, pixel_m: size.sample_m, values };
        // Restores the integral, which truncating the filter and sampling change slightly.
        let (mass, _) = sampled.mass_and_centroid();
        if mass > 0.0 {
            let factor = (self.mass_m2 / mass) as f32;
            sampled.values.iter_mut().for_each(|v| *v *= factor);
        }
        sampled
    }

    /// Smears the heel forward by the mean over shifts of 0 to `samples`; keeps the integral.
    fn smeared(&self, image: &FloatImage, size: &SizePlates, samples: usize) -> Plate {
        let weight: Vec<f32> = (0..image.width)
            .map(|column| {
                let along = (column as f64 + 0.5 - size.margin() as f64) * size.sample_m / self.length_m - 0.5;
                1.0 - smoothstep_f32((along as f32 + 0.28) / 0.12)
            })
            .collect();
        let mut values = Vec::with_capacity(image.values.len());
        for row in image.values.chunks_exact(image.width) {
            let heel: Vec<f32> = row.iter().zip(&weight).map(|(v, w)| v * w).collect();
            for column in 0..image.width {
                let rest = row[column] - heel[column];
                let trail = &heel[column.saturating_sub(samples)..=column];
                values.push(rest + trail.iter().sum::<f32>() / (samples + 1) as f32);
            }
        }
        let peak = values.iter().fold(1e-6f32, |a, &b| a.max(b));
        let pitch_bits = image.width.next_power_of_two().trailing_zeros();
        let mut samples = vec![0; image.height.next_power_of_two() << pitch_bits];
        for (row, values) in samples.chunks_exact_mut(1 << pitch_bits).zip(values.chunks_exact(image.width)) {
            row.iter_mut().zip(values).for_each(|(sample, v)| *sample = (v / peak * 255.0 + 0.5) as u8);
        }
        Plate {
            columns: image.width,
            rows: image.height,
            samples,
            pitch_bits,
            unit: peak / (255.0 * 255.0),
            sample_m: size.sample_m,
            margin: size.margin(),
        }
    }
}

impl SizePlates {
    /// Prepares plates for texels that cover `texel_m` of the pattern.
    fn new(texel_m: f64, extent_m: [f64; 2], centroid: [f64; 2], options: &StampOptions) -> SizePlates {
        let longest_m = extent_m[0].max(extent_m[1]);
        let sample_m = (texel_m / SAMPLES_PER_TEXEL).max(FINEST_SAMPLE_M).max(longest_m / MOST_SAMPLES);
        let smear_step = (SMEAR_STEP_M / sample_m).round().max(1.0) as usize;
        let smears = (LONGEST_SMEAR_M / (sample_m * smear_step as f64)).ceil() as usize + 1;
        // The texel filter hides small blurs: one level suffices.
        let [least, most] = options.blur_m;
        let blurs = if most < 0.6 * TEXEL_FILTER * texel_m { 1 } else { BLURS };
        let blur_m = |k: usize| least + (most - least) * k as f64 / (BLURS - 1) as f64;
        let filter = |blur: f64| (blur * blur + TEXEL_FILTER * TEXEL_FILTER * texel_m * texel_m).sqrt();
        let reach = (FILTER_REACH * filter(most) / sample_m).ceil() as usize;
        let farthest = |k: usize| 0.5 + reach as f64 * sample_m / extent_m[k] + centroid[k].abs();
        SizePlates {
            sample_m,
            reach,
            slopes_held: [0, 1].map(|k| (f64::from(FARTHEST) / farthest(k)).min(1.0) as f32),
            smear_step,
            filters_m: (0..blurs).map(|k| filter(blur_m(k))).collect(),
            filtered: (0..blurs).map(|_| OnceLock::new()).collect(),
            plates: (0..blurs).map(|_| (0..smears).map(|_| OnceLock::new()).collect()).collect(),
            mean_coat: OnceLock::new(),
        }
    }

    /// Number of empty samples before the pattern's first.
    fn margin(&self) -> usize {
        self.reach + GUARD
    }
}

/// Coarse distribution of a pattern's coverage.
fn lumps(coverage: &FloatImage) -> Vec<Lump> {
    let [columns, rows] = LUMPS;
    let mut sums = vec![0.0f64; columns * rows];
    for (row, line) in coverage.values.chunks_exact(coverage.width.max(1)).enumerate() {
        for (column, &value) in line.iter().enumerate() {
            sums[row * rows / coverage.height * columns + column * columns / coverage.width] += f64::from(value);
        }
    }
    let total = sums.iter().sum::<f64>().max(1e-9);
    let place = |k: usize, count: usize| (k as f64 + 0.5) / count as f64 - 0.5;
    let lump = |(k, &sum): (usize, &f64)| Lump {
        place: [place(k % columns, columns), place(k / columns, rows)],
        share: (sum / total) as f32,
    };
    sums.iter().enumerate().filter(|(_, sum)| **sum > 0.0).map(lump).collect()
}
