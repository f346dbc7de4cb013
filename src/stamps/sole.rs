//! Footfalls: prints of soles in `passes` and `soil`.

use super::bank::{Plate, Printer};
use super::lanes::{LANES, Scaling, SumCell, add_lanes, upper};
use super::linear::Linear;
use super::noise::{NOISE_ONE, NoiseTile};
use super::pose::{BALL_RADIUS, PrintPose, WIDEST_TWIST, twist_reach_m};
use super::print::Print;
use super::print_coverage::PrintCoverage;
use super::soil_coat::SoilCoat;
use super::stamper::{MOST_DENSITY, MOST_STRENGTH, PlacedMark, Stamper};
use super::variation::{MOST_PRESSURE, SoleVariation};
use super::window::TexelWindow;
use super::{DENSITY_ONE, PASSES_ONE};
use crate::marks::Mark;
use crate::math::smoothstep_f32;
use crate::math::{sin_cos, vec2};
use crate::walls::Walls;

/// Optical density above which a soil print gets all its variation, fainter ones the mean.
const READABLE_DENSITY: f32 = 0.015;

/// Longest slip of the heel, metres.
const LONGEST_SLIP_M: f32 = 0.03;

/// Distance of the ball, the pivot of a twist, from the sole's middle, soles.
const BALL: f64 = 0.22;

/// Largest number of prints that represent a twist.
const TWIST_PRINTS: usize = 8;

/// A print with its plate and variation.
struct Prepared<'a> {
    printer: &'a Printer,
    pose: PrintPose,
    plate: &'a Plate,
    variation: SoleVariation,
    origin: [i64; 2],
}

impl Stamper {
    /// Upper bound on a mark's value in a texel of `passes`.
    pub(crate) fn peak_of_passes(&self, mark: &Mark) -> u32 {
        (passes(mark) * MOST_PRESSURE * self.faint_peak) as u32 + 2
    }

    /// Upper bound on the value of a print of soil in a texel.
    pub(crate) fn peak_of_soil(&self, density: f32) -> u32 {
        (soil(density) * MOST_PRESSURE * self.grain_peak) as u32 + 2
    }

    fn prepare(&self, mark: &Mark, blurred: bool) -> Option<Prepared<'_>> {
        let printer = self.printer(mark)?;
        let pose = PrintPose::of_sole(mark, printer.length_m)?;
        let variation = SoleVariation::new(mark.variation, &self.options).over_ball(mark.forefoot);
        let smear_m = f64::from(mark.smear_m.clamp(0.0, LONGEST_SLIP_M));
        let plate = printer.plate(&pose, if blurred { variation.blur } else { 0.0 }, smear_m);
        Some(Prepared { printer, pose, plate, variation, origin: pose.origin(&self.grid) })
    }

    /// Adds a footfall's coverage times pressure to the texels of a window.
    #[allow(clippy::too_many_arguments)]
    pub(crate) fn add_passes<C: SumCell>(
        &self,
        mark: &Mark,
        placed: &PlacedMark,
        walls: &Walls,
        window: TexelWindow,
        sheet: &mut PrintCoverage,
        cells: &mut [C],
    ) {
        let Some(prepared) = self.prepare(mark, false) else { return };
        self.read(&prepared, mark, placed, walls, window, sheet);
        self.add_evenly(&prepared, passes(mark), &self.faint, window, sheet, cells);
    }

    /// Adds a footfall's soil to the texels of a window: optical density, `density` at full coverage.
    #[allow(clippy::too_many_arguments)]
    pub(crate) fn add_soil<C: SumCell>(
        &self,
        mark: &Mark,
        density: f32,
        placed: &PlacedMark,
        walls: &Walls,
        window: TexelWindow,
        sheet: &mut PrintCoverage,
        cells: &mut [C],
    ) {
        if density < READABLE_DENSITY {
            let Some(prepared) = self.prepare(mark, false) else { return };
            self.read(&prepared, mark, placed, walls, window, sheet);
            let left = prepared.printer.mean_coat(&prepared.pose, &self.options);
            self.add_evenly(&prepared, soil(density) * left, &self.grain, window, sheet, cells);
            return;
        }
        let Some(prepared) = self.prepare(mark, true) else { return };
        self.read_smoothly(&prepared, mark, placed, walls, window, sheet);
        let Prepared { printer, pose, plate, variation, origin } = &prepared;
        let sole = printer.sole_place(pose, &self.grid);
        let pressure = pressure(printer, pose, variation, sole).times(soil(density) / NOISE_ONE, 0.0);
        let coat = SoilCoat::new(variation, mark.wear, sole);
        let (cells, _) = cells.as_chunks_mut::<LANES>();
        for row in sheet.rows(*origin, window) {
            let noise = self.grain.row(variation.noise_at, row.first_lanes, row.j as u32);
            let dither = self.dither.row(variation.noise_at, row.first_lanes, row.j as u32);
            coat.add(&row, plate.unit, pressure, noise, dither, &mut cells[row.cells.clone()]);
        }
    }

    /// Reads a faint print, from the nearest samples where they suffice.
    fn read(
        &self,
        prepared: &Prepared,
        mark: &Mark,
        placed: &PlacedMark,
        walls: &Walls,
        window: TexelWindow,
        sheet: &mut PrintCoverage,
    ) {
        let Prepared { printer, pose, plate, origin, .. } = prepared;
        let print = Print::new(printer, plate, pose, &self.grid, *origin);
        let bounds = printer.bounds(pose, &self.grid, 0.0);
        let spans = |dj: i32, limits: [i32; 2], spans: &mut [[i32; 2]]| print.spans(dj, limits, spans);
        if plate.needs_smooth_reading(self.grid.texel_m(), pose.scale_along) {
            sheet.fill(*origin, bounds, window, spans, |di, dj, out| print.read_between(di, dj, out));
        } else {
            sheet.fill(*origin, bounds, window, spans, |di, dj, out| print.read_nearest(di, dj, out));
        }
        if let Some(shadow) = self.print_shadow(mark, placed, printer, pose, walls) {
            sheet.hide(&shadow, window);
        }
    }

    /// Reads a readable print: interpolated, and rotated about the ball if the foot twisted.
    fn read_smoothly(
        &self,
        prepared: &Prepared,
        mark: &Mark,
        placed: &PlacedMark,
        walls: &Walls,
        window: TexelWindow,
        sheet: &mut PrintCoverage,
    ) {
        let Prepared { printer, pose, plate, origin, .. } = prepared;
        let poses = self.twisted(mark, printer, pose);
        let prints: Vec<Print> = poses.iter().map(|p| Print::new(printer, plate, p, &self.grid, *origin)).collect();
        let bounds = printer.bounds(pose, &self.grid, twist_reach_m(mark));
        let [along, _] = printer.sole_place(pose, &self.grid);
        match &prints[..] {
            [print] => sheet.fill(
                *origin,
                bounds,
                window,
                |dj, limits, spans| print.spans(dj, limits, spans),
                |di, dj, out| print.read_between(di, dj, out),
            ),
            prints => sheet.fill(
                *origin,
                bounds,
                window,
                |dj, limits, spans| widest_spans(prints, dj, limits, spans),
                |di, dj, out| read_twisted(prints, along, di, dj, out),
            ),
        }
        if let Some(shadow) = self.print_shadow(mark, placed, printer, pose, walls) {
            sheet.hide(&shadow, window);
        }
    }

    /// Adds coverage times pressure times noise; full coverage is `amount` in the quantity's unit.
    ///
    /// Computed in 16 bits: coverage times scaled pressure, times noise. Dither makes rounding unbiased, so that a soil
    /// trail fades even below the unit of the sums.
    fn add_evenly<C: SumCell>(
        &self,
        prepared: &Prepared,
        amount: f32,
        noise: &NoiseTile,
        window: TexelWindow,
        sheet: &PrintCoverage,
        cells: &mut [C],
    ) {
        let Prepared { printer, pose, plate, variation, origin } = prepared;
        // Each of the two products drops 16 bits; coverage is in 1/257, noise in 1/2^14.
        let factor = amount * plate.unit * (262_144.0 / 257.0);
        let scaling = Scaling::for_most(factor * MOST_PRESSURE);
        let sole = printer.sole_place(pose, &self.grid);
        let pressure = pressure(printer, pose, variation, sole).times(factor * scaling.factor(), 0.5);
        let slope = pressure.per_i.round() as i32;
        let shift = scaling.shift;
        let dither_shift = (16 - shift).min(15);
        let (cells, _) = cells.as_chunks_mut::<LANES>();
        for row in sheet.rows(*origin, window) {
            let start = pressure.in_row(row.dj) as i32 + row.di * slope;
            let noise = noise.row(variation.noise_at, row.first_lanes, row.j as u32);
            let dither = self.dither.row(variation.noise_at, row.first_lanes, row.j as u32);
            let lanes = cells[row.cells.clone()].iter_mut().zip(row.coverage);
            let (mut start, slope) = (start as u16, slope as u16);
            for ((cells, coverage), (noise, dither)) in lanes.zip(noise.iter().zip(dither.iter())) {
                let amounts = std::array::from_fn(|k| {
                    // Outside the print, pressure may wrap around: coverage is 0 there.
                    let pressure = start.wrapping_add(slope.wrapping_mul(k as u16));
                    let coverage = u16::from_ne_bytes([coverage[k]; 2]);
                    let value = upper(upper(coverage, pressure), noise[k]);
                    (value + (dither[k] >> dither_shift)) >> shift
                });
                add_lanes(cells, &amounts);
                start = start.wrapping_add(slope.wrapping_mul(LANES as u16));
            }
        }
    }

    /// Poses of a foot while its ball twists on the floor; one pose if the twist is invisible.
    fn twisted(&self, mark: &Mark, printer: &Printer, pose: &PrintPose) -> Vec<PrintPose> {
        let twist = f64::from(mark.twist_rad.clamp(-WIDEST_TWIST, WIDEST_TWIST));
        let length_m = printer.length_m * pose.scale_along;
        let sweep = twist.abs() * BALL_RADIUS * length_m * self.grid.texels_per_metre;
        // NaN counts as no twist.
        if sweep.is_nan() || sweep <= 0.3 {
            return vec![*pose];
        }
        let count = (sweep.ceil() as usize + 1).clamp(2, TWIST_PRINTS);
        let ball = pose.place_m + pose.heading * (BALL * length_m);
        (0..count)
            .map(|k| {
                let (sin, cos) = sin_cos(twist * k as f64 / (count - 1) as f64);
                let heading = pose.heading.rotated(vec2(cos, sin));
                PrintPose { place_m: ball - heading * (BALL * length_m), heading, ..*pose }
            })
            .collect()
    }
}

/// Value at full coverage that a mark adds to `passes`.
fn passes(mark: &Mark) -> f32 {
    mark.strength.clamp(0.0, MOST_STRENGTH) * PASSES_ONE
}

/// Value at full coverage of a print of soil.
fn soil(density: f32) -> f32 {
    density.clamp(0.0, MOST_DENSITY) * DENSITY_ONE
}

/// Pressure over the sole, with mean 1 over its coverage: uneven pressure keeps the integral.
///
/// Slopes are reduced where coarse texels spread a print far beyond its outline.
fn pressure(printer: &Printer, pose: &PrintPose, variation: &SoleVariation, [along, across]: [Linear; 2]) -> Linear {
    let [u, v] = printer.centroid.map(|c| c as f32);
    let [hold_along, hold_across] = printer.slopes_held(pose);
    let slopes = [variation.along * hold_along, variation.across * hold_across];
    let slope = along.times(slopes[0], 0.0).plus(across.times(slopes[1], 0.0));
    slope.times(1.0, 1.0 - slopes[0] * u - slopes[1] * v)
}

/// Finds each row's range of texels that any of the prints can touch.
fn widest_spans(prints: &[Print], dj: i32, limits: [i32; 2], spans: &mut [[i32; 2]]) {
    let mut of_one = vec![[0; 2]; spans.len()];
    spans.fill([0; 2]);
    for print in prints {
        print.spans(dj, limits, &mut of_one);
        for (widest, &[low, high]) in spans.iter_mut().zip(&of_one) {
            let empty = widest[0] >= widest[1];
            if low < high {
                *widest = if empty { [low, high] } else { [widest[0].min(low), widest[1].max(high)] };
            }
        }
    }
}

/// Reads a twisting foot: the mean over all poses at the ball, the first pose elsewhere.
fn read_twisted(prints: &[Print], along: Linear, di: i32, dj: i32, out: &mut [u8]) {
    let start = along.in_row(dj);
    for (di, c) in (di..).zip(out) {
        let ball = smoothstep_f32((start + di as f32 * along.per_i + 0.1) * 5.0);
        let at = |print: &Print| f32::from(print.read_anywhere(di, dj, 0.0));
        let mean = prints.iter().map(at).sum::<f32>() / prints.len() as f32;
        let still = at(&prints[0]);
        *c = (still + (mean - still) * ball + 0.5) as u8;
    }
}
