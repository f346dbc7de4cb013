//! Floor stamper: patterns, kernels and noise for all marks, and the placement of marks.

use super::bank::{Lump, Printer, printers};
use super::lanes::SumCell;
use super::noise::NoiseTile;
use super::pose::{PrintPose, bend_reach_m, twist_reach_m};
use super::presence::{Kernels, PlacedKernel};
use super::shadow::{Shadow, StampExtent, foothold};
use super::window::{TexelBounds, TexelWindow};
use super::{DWELL_ONE, PRESENCE_ONE, StampOptions, StampsError, TexelGrid};
use crate::marks::Mark;
use crate::math::{Vec2, vec2};
use crate::patterns::{Cause, PatternLibrary};
use crate::walls::Walls;

/// Rasterises footfalls and heel marks, for one pattern library, grid and set of options.
#[derive(Debug)]
pub struct Stamper {
    pub(super) grid: TexelGrid,
    /// Side of a presence cell, metres.
    cell_m: f64,
    pub(super) options: StampOptions,
    /// By pattern index; `None` for wall patterns.
    pub(super) printers: Vec<Option<Printer>>,
    pub(super) kernels: Kernels,
    /// Noise of `passes`: faint, since single prints cannot be distinguished.
    pub(super) faint: NoiseTile,
    /// Noise of `soil` and `scuff`.
    pub(super) grain: NoiseTile,
    pub(super) dither: NoiseTile,
    pub(super) faint_peak: f32,
    pub(super) grain_peak: f32,
}

/// Noise of `passes` relative to that of soil prints.
const FAINT: f64 = 0.4;

/// Largest strength and optical density of a mark; larger values are clamped.
pub(super) const MOST_STRENGTH: f32 = 4.0;
pub(super) const MOST_DENSITY: f32 = 3.0;

/// Largest effort of a footfall, and longest while of a mark, seconds.
const MOST_EFFORT: f32 = 20.0;
const LONGEST_S: f32 = 60.0;
/// Area of the two soles of a person who stands, square metres.
const STANDING_M2: f64 = 0.04;

/// Largest distance of a mark from the plan's origin, metres.
const FARTHEST_M: f64 = 1e6;

/// Optical density below which soil leaves no print: 1/20 of the unit of the sums.
pub(super) const LEAST_DENSITY: f32 = 0.05 / 4096.0;

/// A valid mark, placed among the walls.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedMark {
    /// Presence kernel of a footfall, dwell kernel of a while of standing; unused for heel marks.
    kernel: PlacedKernel,
    /// The same kernel, times the footfall's effort.
    grind: PlacedKernel,
    /// Offset from the mark's position to the foot's viewpoint, metres; non-zero if inside a wall.
    foothold: [f32; 2],
    /// Whether walls cut the print.
    print_cut: bool,
    /// Whether walls cut the kernel.
    kernel_cut: bool,
}

/// Texels and presence cells that a mark can touch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MarkBounds {
    /// Texels of the print.
    pub(crate) texels: TexelBounds,
    /// Cells of the presence grid; unused for heel marks.
    pub(crate) cells: TexelBounds,
    /// Whether the print leaves soil.
    pub(crate) soil: bool,
    /// Whether it does in rain.
    pub(crate) wet: bool,
}

impl Stamper {
    /// Prepares a stamper for the floor patterns of a library.
    ///
    /// # Errors
    /// An option is out of range, see [`StampOptions::check`].
    pub fn new(library: &PatternLibrary, grid: TexelGrid, options: &StampOptions) -> Result<Stamper, StampsError> {
        options.check()?;
        let texels_per_metre = grid.texels_per_metre;
        let faint = NoiseTile::grain(texels_per_metre, options.noise * FAINT, 1);
        let grain = NoiseTile::grain(texels_per_metre, options.noise, 2);
        Ok(Stamper {
            printers: printers(library, grid.texel_m(), options),
            kernels: Kernels::new(grid.presence_grid().texels_per_metre, options),
            dither: NoiseTile::dither(texels_per_metre),
            faint_peak: faint.peak(),
            grain_peak: grain.peak(),
            faint,
            grain,
            cell_m: grid.presence_grid().texel_m(),
            grid,
            options: options.clone(),
        })
    }

    /// Texel grid of the stamps.
    pub fn grid(&self) -> TexelGrid {
        self.grid
    }

    /// Places a mark among the walls.
    ///
    /// `None` for an invalid mark: its pattern is not in the library or has another cause, or its position, heading,
    /// length or strength is out of range.
    pub(crate) fn place(&self, mark: &Mark, walls: &Walls) -> Option<(PlacedMark, MarkBounds)> {
        let somewhere = mark.place_m.is_finite()
            && mark.place_m.x.abs().max(mark.place_m.y.abs()) < FARTHEST_M
            && (mark.heading.length_squared() - 1.0).abs() < 1e-3;
        if mark.stood_s > 0.0 && mark.cause == Cause::Sole {
            return somewhere.then(|| self.place_standing(mark, walls));
        }
        if mark.wheel_m > 0.0 {
            return if somewhere { self.place_wheel(mark, walls) } else { None };
        }
        let printer = self.printer(mark)?;
        let sound = somewhere && (mark.strength > 0.0 || mark.soil > 0.0) && mark.length_m > 0.0;
        if !sound {
            return None;
        }
        match mark.cause {
            Cause::Sole => self.place_sole(mark, printer, walls),
            Cause::Heel => self.place_heel(mark, printer, walls),
            Cause::Hand | Cause::Arm | Cause::Shoulder | Cause::Bag | Cause::Shoe => None,
        }
    }

    pub(super) fn printer(&self, mark: &Mark) -> Option<&Printer> {
        self.printers.get(usize::from(mark.pattern))?.as_ref().filter(|p| p.cause == mark.cause && p.mass_m2 > 0.0)
    }

    fn place_sole(&self, mark: &Mark, printer: &Printer, walls: &Walls) -> Option<(PlacedMark, MarkBounds)> {
        let pose = PrintPose::of_sole(mark, printer.length_m)?;
        let cell_m = self.cell_m;
        // The kernel is centred on the print's centroid, which is nearer to the toes than the sole's middle.
        let middle = printer.point_m(&pose, printer.centroid);
        let found = self.kernels.find(middle, mark.heading);
        let strength = mark.strength.clamp(0.0, MOST_STRENGTH);
        let mass_cells = printer.mass_m2 * pose.scale_along * pose.scale_across / (cell_m * cell_m);
        let mut amount = strength * mass_cells as f32 * PRESENCE_ONE;
        let kernel_extent = self.kernels.extent(middle, mark.heading);
        let print_extent = self.print_extent(mark, printer, &pose);
        let mut placed = PlacedMark {
            kernel: self.kernels.place(found, amount),
            grind: self.kernels.place(found, 0.0),
            foothold: [0.0; 2],
            print_cut: false,
            kernel_cut: false,
        };
        let reach = kernel_extent.reach_m(mark.place_m).max(print_extent.reach_m(mark.place_m));
        if let Some(wall) = walls.nearest(mark.place_m, reach) {
            let stands = placed.stand(foothold(walls, mark.place_m, wall.point_m), mark);
            placed.print_cut = wall.distance_m < print_extent.reach_m(mark.place_m);
            if let Some(shadow) = Shadow::new(walls, stands, &kernel_extent, cell_m) {
                let hidden = self.kernels.share_hidden(found, &shadow);
                placed.kernel_cut = hidden > 0.0;
                // The hidden share is added in front of the wall.
                amount /= (1.0 - hidden).max(0.05);
            }
            if placed.print_cut {
                amount *= self.share_left(printer, &pose, walls, stands);
            }
            placed.kernel = self.kernels.place(found, amount);
        }
        placed.grind = self.kernels.place(found, amount * mark.effort.clamp(0.0, MOST_EFFORT));
        let texels = printer.bounds(&pose, &self.grid, twist_reach_m(mark));
        let [soil, wet] = [mark.soil, mark.wet].map(|density| density > LEAST_DENSITY);
        let touched = MarkBounds { texels, cells: self.kernels.bounds(found), soil, wet };
        Some((placed, touched))
    }

    /// A while of standing: the kernel of presence, across the body, so that it is as wide as one.
    fn place_standing(&self, mark: &Mark, walls: &Walls) -> (PlacedMark, MarkBounds) {
        let found = self.kernels.find(mark.place_m, mark.heading);
        let extent = self.kernels.extent(mark.place_m, mark.heading);
        let soles_cells = (STANDING_M2 / (self.cell_m * self.cell_m)) as f32;
        let mut amount = mark.stood_s.min(LONGEST_S) * soles_cells * DWELL_ONE;
        let none = self.kernels.place(found, 0.0);
        let mut placed =
            PlacedMark { kernel: none, grind: none, foothold: [0.0; 2], print_cut: false, kernel_cut: false };
        if let Some(wall) = walls.nearest(mark.place_m, extent.reach_m(mark.place_m)) {
            let stands = placed.stand(foothold(walls, mark.place_m, wall.point_m), mark);
            if let Some(shadow) = Shadow::new(walls, stands, &extent, self.cell_m) {
                let hidden = self.kernels.share_hidden(found, &shadow);
                placed.kernel_cut = hidden > 0.0;
                amount /= (1.0 - hidden).max(0.05);
            }
        }
        placed.kernel = self.kernels.place(found, amount);
        let cells = self.kernels.bounds(found);
        (placed, MarkBounds { texels: TexelBounds { i0: 0, i1: 0, j0: 0, j1: 0 }, cells, soil: false, wet: false })
    }

    fn place_heel(&self, mark: &Mark, printer: &Printer, walls: &Walls) -> Option<(PlacedMark, MarkBounds)> {
        let pose = PrintPose::of_heel(mark, printer.length_m)?;
        let reach_m = self.print_extent(mark, printer, &pose).reach_m(mark.place_m);
        Some(self.place_flat(mark, printer.bounds(&pose, &self.grid, bend_reach_m(mark)), reach_m, walls))
    }

    /// Places a mark without kernel that reaches this far from its place.
    pub(super) fn place_flat(
        &self,
        mark: &Mark,
        texels: TexelBounds,
        reach_m: f64,
        walls: &Walls,
    ) -> (PlacedMark, MarkBounds) {
        let none = self.kernels.find(mark.place_m, mark.heading);
        let mut placed = PlacedMark {
            kernel: self.kernels.place(none, 0.0),
            grind: self.kernels.place(none, 0.0),
            foothold: [0.0; 2],
            print_cut: false,
            kernel_cut: false,
        };
        if let Some(wall) = walls.nearest(mark.place_m, reach_m) {
            placed.stand(foothold(walls, mark.place_m, wall.point_m), mark);
            placed.print_cut = true;
        }
        (placed, MarkBounds { texels, cells: self.kernels.bounds(none), soil: false, wet: false })
    }

    /// Share of a sole's print in front of walls.
    fn share_left(&self, printer: &Printer, pose: &PrintPose, walls: &Walls, from: Vec2) -> f32 {
        let lump_m = printer.lump_m() * pose.scale_along;
        let Some(shadow) = Shadow::new(walls, from, &printer.extent(pose, 0.0), lump_m) else { return 1.0 };
        let left = |lump: &Lump| lump.share * shadow.reached_at(printer.point_m(pose, lump.place));
        printer.lumps.iter().map(left).sum()
    }

    /// Upper bound on a mark's value in a cell of `presence` or `dwell`.
    pub(crate) fn peak_of_presence(&self, placed: &PlacedMark) -> u32 {
        self.kernels.peak(&placed.kernel)
    }

    /// Upper bound on a footfall's value in a cell of `grind`.
    pub(crate) fn peak_of_grind(&self, placed: &PlacedMark) -> u32 {
        self.kernels.peak(&placed.grind)
    }

    /// Adds a mark's kernel to the `presence` or `dwell` cells of a window.
    pub(crate) fn add_presence<C: SumCell>(
        &self,
        mark: &Mark,
        placed: &PlacedMark,
        walls: &Walls,
        window: TexelWindow,
        cells: &mut [C],
    ) {
        self.kernels.add(&placed.kernel, self.kernel_shadow(mark, placed, walls).as_ref(), window, cells);
    }

    /// Adds a footfall's kernel, times its effort, to the `grind` cells of a window.
    pub(crate) fn add_grind<C: SumCell>(
        &self,
        mark: &Mark,
        placed: &PlacedMark,
        walls: &Walls,
        window: TexelWindow,
        cells: &mut [C],
    ) {
        self.kernels.add(&placed.grind, self.kernel_shadow(mark, placed, walls).as_ref(), window, cells);
    }

    /// Returns the shadow of the walls that cut a kernel.
    fn kernel_shadow(&self, mark: &Mark, placed: &PlacedMark, walls: &Walls) -> Option<Shadow> {
        if !placed.kernel_cut {
            return None;
        }
        let middle = if mark.stood_s > 0.0 {
            mark.place_m
        } else {
            let printer = self.printer(mark)?;
            printer.point_m(&PrintPose::of_sole(mark, printer.length_m)?, printer.centroid)
        };
        Shadow::new(walls, placed.stands(mark), &self.kernels.extent(middle, mark.heading), self.cell_m)
    }

    /// Returns the shadow of the walls that cut a print.
    pub(super) fn print_shadow(
        &self,
        mark: &Mark,
        placed: &PlacedMark,
        printer: &Printer,
        pose: &PrintPose,
        walls: &Walls,
    ) -> Option<Shadow> {
        let extent = self.print_extent(mark, printer, pose);
        placed.print_cut.then(|| Shadow::new(walls, placed.stands(mark), &extent, self.grid.texel_m())).flatten()
    }

    fn print_extent(&self, mark: &Mark, printer: &Printer, pose: &PrintPose) -> StampExtent {
        printer.extent(pose, twist_reach_m(mark) + bend_reach_m(mark))
    }
}

impl PlacedMark {
    /// Stores the foot's viewpoint; returns it after rounding.
    fn stand(&mut self, stands: Vec2, mark: &Mark) -> Vec2 {
        let offset = stands - mark.place_m;
        self.foothold = [offset.x as f32, offset.y as f32];
        self.stands(mark)
    }

    /// Whether walls cut the print.
    pub(super) fn is_cut(&self) -> bool {
        self.print_cut
    }

    pub(super) fn stands(&self, mark: &Mark) -> Vec2 {
        mark.place_m + vec2(f64::from(self.foothold[0]), f64::from(self.foothold[1]))
    }
}
