//! Heel marks: what a dragged heel or toe adds to `scuff`.

use super::DENSITY_ONE;
use super::bank::Printer;
use super::lanes::{Cell, LANES};
use super::noise::NOISE_ONE;
use super::print::{Pose, Print};
use super::sheet::Sheet;
use super::stamper::{MOST_DENSITY, Placed, Stamper, Window};
use super::variation::{HeelVariation, MOST_BEND};
use crate::marks::Mark;
use crate::patterns::Cause;
use crate::walls::Walls;

impl Stamper {
    pub(super) fn heel_pose(&self, mark: &Mark, printer: &Printer) -> Option<Pose> {
        let scale_along = f64::from(mark.length_m) / printer.length_m;
        let variation = HeelVariation::new(mark.variation);
        (0.05..=20.0).contains(&scale_along).then_some(Pose {
            place_m: mark.place_m,
            heading: mark.heading,
            scale_along,
            // The drag is as long as the mark says; how wide depends on the shoe, not on the drag.
            scale_across: f64::from(variation.width),
            mirrored: mark.mirrored,
        })
    }

    /// How far a bend carries the ends aside, metres.
    pub(super) fn bend_reach_m(&self, mark: &Mark) -> f64 {
        if mark.cause == Cause::Heel { f64::from(MOST_BEND * mark.length_m) } else { 0.0 }
    }

    /// The most that one texel of `scuff` can get from a mark.
    pub(crate) fn peak_of_scuff(&self, mark: &Mark) -> u32 {
        (mark.strength.clamp(0.0, MOST_DENSITY) * DENSITY_ONE * 1.5 * self.grain_peak) as u32 + 2
    }

    /// Adds a heel mark to the texels of a window, as optical density.
    ///
    /// Bent aside by `4 bend (x^2 - 1/12)` of its length at the share x from its middle, and fainter towards its end.
    #[allow(clippy::too_many_arguments)]
    pub(crate) fn add_scuff<C: Cell>(
        &self,
        mark: &Mark,
        placed: &Placed,
        walls: &Walls,
        window: Window,
        sheet: &mut Sheet,
        cells: &mut [C],
    ) {
        let Some(printer) = self.printer(mark) else { return };
        let Some(pose) = self.heel_pose(mark, printer) else { return };
        let variation = HeelVariation::new(mark.variation);
        let plate = printer.plate(&pose, 0.0, 0.0);
        let origin = pose.origin(&self.grid);
        let print = Print::new(printer, plate, &pose, &self.grid, origin);
        let [along, _] = pose.sole_place(printer, &self.grid);
        let at = |di: i32, dj: i32| (along.in_row(dj) + di as f32 * along.per_i).clamp(-0.6, 0.6);
        let samples_per_length = printer.length_m * pose.scale_along / pose.scale_across / plate.sample_m;
        let aside = 4.0 * variation.bend * samples_per_length as f32;
        let bounds = pose.bounds(&self.grid, printer, self.bend_reach_m(mark));
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
        let (cells, _) = cells.as_chunks_mut::<LANES>();
        for row in sheet.rows(origin, window) {
            let noise = self.grain.row(variation.noise_at, row.first_lanes, row.j as u32);
            let texels = cells[row.cells.clone()].as_flattened_mut().iter_mut().zip(row.coverage.as_flattened());
            for (di, ((cell, &c), &n)) in (row.di..).zip(texels.zip(noise.iter().flatten())) {
                let tapered = 1.0 - variation.fade * at(di, row.dj);
                cell.add((f32::from(c) * unit * tapered * f32::from(n) + 0.5) as u16);
            }
        }
    }
}
