//! Soil coat of a sole: partial fade, contrast and worn spots.

use super::lanes::{Lanes, SumCell};
use super::linear::Linear;
use super::noise::{NOISE_ONE, NoiseRow};
use super::print_coverage::CoverageRow;
use super::variation::{SoleVariation, WornSpots};
use super::window::WINDOW;
use crate::math::smoothstep_f32;

/// Amplitude of the noise at the edge of a partial print, relative to the fade's step.
const RAGGED: f32 = 0.4;

/// Soil coat of one sole.
pub(super) struct SoilCoat {
    along: Linear,
    across: Linear,
    fade: Linear,
    fade_floor: f32,
    contrast: f32,
    wear: WornSpots,
}

impl SoilCoat {
    /// Creates the coat of a print; `[along, across]` gives the position on the sole, in soles.
    pub(super) fn new(variation: &SoleVariation, wear: u32, [along, across]: [Linear; 2]) -> SoilCoat {
        let fade = variation.fade;
        SoilCoat {
            along,
            across,
            fade: along.times(fade.along, fade.at_middle).plus(across.times(fade.across, 0.0)),
            fade_floor: fade.floor,
            contrast: variation.contrast,
            wear: WornSpots::new(wear),
        }
    }

    /// The coat with sole positions as texel coordinates: i along, j across.
    pub(super) fn on_sole(variation: &SoleVariation, wear: u32) -> SoilCoat {
        let along = Linear { at_origin: 0.0, per_i: 1.0, per_j: 0.0 };
        let across = Linear { at_origin: 0.0, per_i: 0.0, per_j: 1.0 };
        SoilCoat::new(variation, wear, [along, across])
    }

    /// Adds a row of soil to cells: coated coverage (in `unit`) times pressure times noise, dithered.
    #[inline]
    pub(super) fn add<C: SumCell>(
        &self,
        row: &CoverageRow,
        unit: f32,
        pressure: Linear,
        noise: NoiseRow,
        dither: NoiseRow,
        cells: &mut [Lanes<C>],
    ) {
        let start = |linear: Linear| linear.in_row(row.dj);
        let (along, across) = (start(self.along), start(self.across));
        let (pressure_start, fade) = (start(pressure), start(self.fade));
        let coverage = row.coverage.as_flattened();
        let (noise, dither) = (noise.to_row(coverage.len()), dither.to_row(coverage.len()));
        let mut amounts = [0.0f32; WINDOW];
        let texels = amounts.iter_mut().zip(coverage).zip(noise.iter().zip(&dither));
        for (k, ((amount, &c), (&n, &d))) in texels.enumerate() {
            let i = (row.di + k as i32) as f32;
            let n = f32::from(n);
            let progress = fade + i * self.fade.per_i + RAGGED * (n / NOISE_ONE - 1.0);
            let (along, across) = (along + i * self.along.per_i, across + i * self.across.per_i);
            let coated = self.coated(f32::from(c) * unit, along, across, progress);
            let rounding = if c > 0 { f32::from(d) * (1.0 / 65_536.0) } else { 0.0 };
            *amount = coated * (pressure_start + i * pressure.per_i) * n + rounding;
        }
        for (cell, &amount) in cells.as_flattened_mut().iter_mut().zip(&amounts) {
            cell.add(amount as u16);
        }
    }

    /// Coverage after contrast, fade and wear at a position on the sole; `progress` is the fade's.
    #[inline]
    fn coated(&self, coverage: f32, along: f32, across: f32, progress: f32) -> f32 {
        let contrasted = coverage + coverage * self.contrast * (coverage - 1.0);
        let shown = self.fade_floor + (1.0 - self.fade_floor) * smoothstep_f32(progress);
        contrasted * shown * self.wear.left(along, across)
    }

    /// Coated coverage without noise at a position in soles, for [`SoilCoat::on_sole`].
    pub(super) fn coated_at(&self, coverage: f32, along: f32, across: f32) -> f32 {
        let progress = self.fade.at_origin + self.fade.per_i * along + self.fade.per_j * across;
        self.coated(coverage, along, across, progress)
    }
}
