//! A plate placed on the floor, sampled at texels.

use super::TexelGrid;
use super::bank::{Plate, Printer};
use super::pose::PrintPose;
use super::window::floor;

/// Fraction bits of a sample position.
const FRACTION_BITS: u32 = 10;
const FRACTION: i32 = 1 << FRACTION_BITS;

/// A placed plate. Texels are counted from the mark's texel, samples in units of 1/1024.
#[derive(Clone, Copy, Debug)]
pub(super) struct Print<'a> {
    plate: &'a Plate,
    u0: i32,
    v0: i32,
    u_per_i: i32,
    v_per_i: i32,
    u_per_j: i32,
    v_per_j: i32,
}

impl<'a> Print<'a> {
    /// Places a plate; texels are counted from `origin`.
    pub(super) fn new(
        printer: &Printer,
        plate: &'a Plate,
        pose: &PrintPose,
        grid: &TexelGrid,
        origin: [i64; 2],
    ) -> Print<'a> {
        let [along, across] = pose.along_across(grid, origin);
        let samples_per_m = 1.0 / plate.sample_m;
        let fixed = |[at_origin, per_i, per_j]: [f64; 3], extent_m: f64| {
            let first = (at_origin + extent_m * 0.5) * samples_per_m + plate.margin as f64;
            [first, per_i * samples_per_m, per_j * samples_per_m].map(|v| floor(v * f64::from(FRACTION) + 0.5) as i32)
        };
        let [u0, u_per_i, u_per_j] = fixed(along, printer.length_m);
        let [v0, v_per_i, v_per_j] = fixed(across, printer.width_m);
        Print { plate, u0, v0, u_per_i, v_per_i, u_per_j, v_per_j }
    }

    /// Finds the range of texels on the plate, within `limits`, for each row from `dj` on.
    ///
    /// Texels are counted from the origin. An empty row ends at or before its start. A row may be a texel too long; the
    /// plate's guard of empty samples absorbs that.
    #[inline]
    pub(super) fn spans(&self, dj: i32, limits: [i32; 2], spans: &mut [[i32; 2]]) {
        const SAMPLE: f32 = 1.0 / FRACTION as f32;
        const ROUND: f32 = 12_582_912.0;
        let whole = |v: f32| (v + ROUND).to_bits() as i32 - ROUND.to_bits() as i32;
        // Avoids a division by nearly zero for rows along an axis of the plate.
        let inverse = |v: i32| {
            let v = v as f32 * SAMPLE;
            1.0 / if v.abs() < 1e-3 { 1e-3 } else { v }
        };
        let (i_per_u, i_per_v) = (inverse(self.u_per_i), inverse(self.v_per_i));
        let [u_first, v_first] = [self.u0, self.v0].map(|v| v as f32 * SAMPLE);
        let [u_step, v_step] = [self.u_per_j, self.v_per_j].map(|v| v as f32 * SAMPLE);
        let [u_end, v_end] = [self.plate.columns, self.plate.rows].map(|count| count as f32 - 3.0);
        let [lowest, highest] = limits.map(|v| v as f32);
        for (k, span) in spans.iter_mut().enumerate() {
            let row = (dj + k as i32) as f32;
            let (u, v) = (u_first + row * u_step, v_first + row * v_step);
            let (ua, ub) = ((3.0 - u) * i_per_u, (u_end - u) * i_per_u);
            let (va, vb) = ((3.0 - v) * i_per_v, (v_end - v) * i_per_v);
            let low = ua.min(ub).max(va.min(vb)).max(lowest).min(highest);
            let high = ua.max(ub).min(va.max(vb)).min(highest).max(lowest);
            *span = [whole(low - 0.5), (whole(high + 0.5) + 1).min(limits[1])];
            span[0] = span[0].max(limits[0]);
        }
    }

    /// Reads the nearest samples for the texels from `di` on in row `dj`, which lie on the plate.
    #[inline]
    pub(super) fn read_nearest(&self, di: i32, dj: i32, out: &mut [u8]) {
        let Some(walk) = SampleSteps::new(self, [0, 0], di, dj) else { return };
        let mut at = walk.start;
        for coverage in out {
            *coverage = walk.samples[walk.place(at) & walk.mask];
            at = at.wrapping_add(walk.step);
        }
    }

    /// Reads bilinearly interpolated samples for the same texels.
    #[inline]
    pub(super) fn read_between(&self, di: i32, dj: i32, out: &mut [u8]) {
        const HALF: i32 = 1 << (FRACTION_BITS - 1);
        let Some(walk) = SampleSteps::new(self, [HALF, HALF], di, dj) else { return };
        let row = 1 << self.plate.pitch_bits;
        let mut at = walk.start;
        for coverage in out {
            let place = walk.place(at);
            let sample = |offset: usize| u32::from(walk.samples[(place + offset) & walk.mask]);
            let [fu, fv] = [at as u32, (at >> (32 + self.plate.pitch_bits)) as u32].map(|v| v & (FRACTION - 1) as u32);
            let lower = sample(0) * (FRACTION as u32 - fu) + sample(1) * fu;
            let upper = sample(row) * (FRACTION as u32 - fu) + sample(row + 1) * fu;
            let sum = lower * (FRACTION as u32 - fv) + upper * fv;
            *coverage = ((sum + (1 << (2 * FRACTION_BITS - 1))) >> (2 * FRACTION_BITS)) as u8;
            at = at.wrapping_add(walk.step);
        }
    }

    /// Interpolated coverage at any texel, shifted by `aside` samples across; 0 beyond the plate.
    #[inline]
    pub(super) fn read_anywhere(&self, di: i32, dj: i32, aside: f32) -> u8 {
        let u = self.u0 + di * self.u_per_i + dj * self.u_per_j;
        let v = self.v0 + di * self.v_per_i + dj * self.v_per_j + (aside * FRACTION as f32) as i32;
        let [u, v] = [u, v].map(|k| k as f32 * (1.0 / FRACTION as f32) - 0.5);
        if u < 0.0 || v < 0.0 || u >= (self.plate.columns - 1) as f32 || v >= (self.plate.rows - 1) as f32 {
            return 0;
        }
        let (column, row) = (u as usize, v as usize);
        let (fu, fv) = (u - column as f32, v - row as f32);
        let sample = |column: usize, row: usize| {
            f32::from(self.plate.samples.get((row << self.plate.pitch_bits) + column).copied().unwrap_or(0))
        };
        let lower = sample(column, row) * (1.0 - fu) + sample(column + 1, row) * fu;
        let upper = sample(column, row + 1) * (1.0 - fu) + sample(column + 1, row + 1) * fu;
        (lower * (1.0 - fv) + upper * fv + 0.5) as u8
    }
}

/// Steps over a plate's samples along a row of texels.
///
/// One word holds both coordinates: column and fraction in the lower half; row and fraction, shifted by the pitch, in
/// the upper.
struct SampleSteps<'a> {
    samples: &'a [u8],
    mask: usize,
    row_mask: u64,
    start: u64,
    step: u64,
}

impl<'a> SampleSteps<'a> {
    #[inline]
    fn new(print: &Print<'a>, before: [i32; 2], di: i32, dj: i32) -> Option<SampleSteps<'a>> {
        let samples = &print.plate.samples[..];
        // The number of samples is a power of two, so a mask keeps every index within the plate.
        let mask = samples.len().checked_sub(1)?;
        let pitch_bits = print.plate.pitch_bits;
        let u = print.u0 + di * print.u_per_i + dj * print.u_per_j - before[0];
        let v = print.v0 + di * print.v_per_i + dj * print.v_per_j - before[1];
        let word = |u: i32, v: i32| ((i64::from(v) << (32 + pitch_bits)).wrapping_add(i64::from(u))) as u64;
        let row_mask = mask as u64 & !((1 << pitch_bits) - 1);
        Some(SampleSteps { samples, mask, row_mask, start: word(u, v), step: word(print.u_per_i, print.v_per_i) })
    }

    #[inline]
    fn place(&self, at: u64) -> usize {
        ((at >> (32 + FRACTION_BITS)) & self.row_mask) as usize + (at as u32 >> FRACTION_BITS) as usize
    }
}
