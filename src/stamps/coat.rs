//! How soil comes off a sole: which part shows, how full parts compare with faint ones, where the pair is worn.

use super::lanes::{Cell, Lanes};
use super::noise::{NOISE_ONE, NoiseRow};
use super::print::Linear;
use super::sheet::SheetRow;
use super::stamper::WINDOW;
use super::variation::{SoleVariation, Wear};

/// How ragged noise makes the rim of what shows, steps of the fade.
const RAGGED: f32 = 0.4;

/// The coat of soil on one sole.
pub(super) struct Coat {
    along: Linear,
    across: Linear,
    fade: Linear,
    fade_floor: f32,
    contrast: f32,
    wear: Wear,
}

impl Coat {
    /// `sole` gives the place on the sole, in soles along and across.
    pub(super) fn new(variation: &SoleVariation, wear: u32, [along, across]: [Linear; 2]) -> Coat {
        let fade = variation.fade;
        Coat {
            along,
            across,
            fade: along.times(fade.along, fade.at_middle).plus(across.times(fade.across, 0.0)),
            fade_floor: fade.floor,
            contrast: variation.contrast,
            wear: Wear::new(wear),
        }
    }

    /// The same where texels are soles: i counts along, j across.
    pub(super) fn on_sole(variation: &SoleVariation, wear: u32) -> Coat {
        let along = Linear { at_origin: 0.0, per_i: 1.0, per_j: 0.0 };
        let across = Linear { at_origin: 0.0, per_i: 0.0, per_j: 1.0 };
        Coat::new(variation, wear, [along, across])
    }

    /// Adds a row of soil to cells: coverage times `unit`, coated, times pressure, times noise. Rounded by dither.
    #[inline]
    pub(super) fn lay<C: Cell>(
        &self,
        row: &SheetRow,
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

    /// What is left of coverage at a place on the sole, where the fade has come so far.
    #[inline]
    fn coated(&self, coverage: f32, along: f32, across: f32, progress: f32) -> f32 {
        let contrasted = coverage + coverage * self.contrast * (coverage - 1.0);
        let shown = self.fade_floor + (1.0 - self.fade_floor) * smooth_step(progress);
        contrasted * shown * self.wear.left(along, across)
    }

    /// The same at a place given in soles, for a coat made by [`Coat::on_sole`]; without noise.
    pub(super) fn coated_at(&self, coverage: f32, along: f32, across: f32) -> f32 {
        let progress = self.fade.at_origin + self.fade.per_i * along + self.fade.per_j * across;
        self.coated(coverage, along, across, progress)
    }
}

/// From 0 at 0 to 1 at 1, level at both.
#[inline]
pub(super) fn smooth_step(x: f32) -> f32 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}
