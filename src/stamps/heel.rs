//! Heel marks: optical density of dragged heels and toes, added to `scuff`.

use super::DENSITY_ONE;
use super::lanes::{LANES, SumCell};
use super::noise::NOISE_ONE;
use super::pose::{PrintPose, bend_reach_m};
use super::print::Print;
use super::print_coverage::PrintCoverage;
use super::stamper::{MOST_DENSITY, PlacedMark, Stamper};
use super::variation::HeelVariation;
use super::window::TexelWindow;
use crate::marks::Mark;
use crate::walls::Walls;

impl Stamper {
    /// Upper bound on a mark's value in a texel of `scuff`.
    pub(crate) fn peak_of_scuff(&self, mark: &Mark) -> u32 {
        if mark.wheel_m > 0.0 {
            return self.peak_of_wheel(mark);
        }
        (mark.strength.clamp(0.0, MOST_DENSITY) * DENSITY_ONE * 1.5 * self.grain_peak) as u32 + 2
    }

    /// Adds a heel mark to the texels of a window, as optical density.
    ///
    /// The mark bends aside by `4 bend (x^2 - 1/12)` of its length, x from -0.5 to 0.5 along it, and fades towards its
    /// end.
    #[allow(clippy::too_many_arguments)]
    pub(crate) fn add_scuff<C: SumCell>(
        &self,
        mark: &Mark,
        placed: &PlacedMark,
        walls: &Walls,
        window: TexelWindow,
        sheet: &mut PrintCoverage,
        cells: &mut [C],
    ) {
        if mark.wheel_m > 0.0 {
            return self.add_wheel(mark, placed, walls, window, sheet, cells);
        }
        let Some(printer) = self.printer(mark) else { return };
        let Some(pose) = PrintPose::of_heel(mark, printer.length_m) else { return };
        let variation = HeelVariation::new(mark.variation);
        let plate = printer.plate(&pose, 0.0, 0.0);
        let origin = pose.origin(&self.grid);
        let print = Print::new(printer, plate, &pose, &self.grid, origin);
        let [along, _] = printer.sole_place(&pose, &self.grid);
        let at = |di: i32, dj: i32| (along.in_row(dj) + di as f32 * along.per_i).clamp(-0.6, 0.6);
        let samples_per_length = printer.length_m * pose.scale_along / pose.scale_across / plate.sample_m;
        let aside = 4.0 * variation.bend * samples_per_length as f32;
        let bounds = printer.bounds(&pose, &self.grid, bend_reach_m(mark));
        let across = [bounds.i0, bounds.i1].map(|i| (i - origin[0]) as i32);
        sheet.fill(
            origin,
            bounds,
            window,
            |_, limits, spans| spans.fill([across[0].max(limits[0]), across[1].min(limits[1])]),
            |di, dj, out| {
                for (di, c) in (di..).zip(out) {
                    let x = at(di, dj);
                    *c = print.read_anywhere(di, dj, aside * (x * x - 1.0 / 12.0));
                }
            },
        );
        if let Some(shadow) = self.print_shadow(mark, placed, printer, &pose, walls) {
            sheet.hide(&shadow, window);
        }
        let unit = mark.strength.clamp(0.0, MOST_DENSITY) * DENSITY_ONE * plate.unit / NOISE_ONE;
        let amount = |di: i32, dj: i32| 1.0 - variation.fade * at(di, dj);
        self.add_along(sheet, origin, window, variation.noise_at, unit, amount, cells);
    }

    /// Adds coverage times `unit`, an amount that changes along the mark, and noise from a place of its own.
    #[allow(clippy::too_many_arguments)]
    pub(super) fn add_along<C: SumCell>(
        &self,
        sheet: &PrintCoverage,
        origin: [i64; 2],
        window: TexelWindow,
        noise_at: [u32; 2],
        unit: f32,
        amount: impl Fn(i32, i32) -> f32,
        cells: &mut [C],
    ) {
        let (cells, _) = cells.as_chunks_mut::<LANES>();
        for row in sheet.rows(origin, window) {
            let noise = self.grain.row(noise_at, row.first_lanes, row.j as u32);
            let texels = cells[row.cells.clone()].as_flattened_mut().iter_mut().zip(row.coverage.as_flattened());
            for (di, ((cell, &c), &n)) in (row.di..).zip(texels.zip(noise.iter().flatten())) {
                if c > 0 {
                    cell.add((f32::from(c) * unit * amount(di, row.dj) * f32::from(n) + 0.5) as u16);
                }
            }
        }
    }
}
