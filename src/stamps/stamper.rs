//! The stamper: everything that is the same for all marks, and what a mark touches.

use super::bank::{Lump, Printer, printers};
use super::lanes::Cell;
use super::noise::NoiseTile;
use super::presence::{Kernels, PlacedKernel};
use super::print::Pose;
use super::shadow::{Extent, Shadow, foothold};
use super::{PRESENCE_ONE, StampOptions, TexelGrid};
use crate::marks::Mark;
use crate::math::{Vec2, vec2};
use crate::patterns::{Cause, PatternLibrary};
use crate::walls::Walls;

/// Side of the square of texels that stamps are added to at a time.
pub(crate) const WINDOW: usize = 128;

/// A square of [`WINDOW`] texels a side; rows run upward.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Window {
    /// First column.
    pub(crate) i0: i64,
    /// First row.
    pub(crate) j0: i64,
}

/// A half-open rectangle of texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Bounds {
    pub(crate) i0: i64,
    pub(crate) j0: i64,
    pub(crate) i1: i64,
    pub(crate) j1: i64,
}

/// The largest whole number that is not larger, for values that fit.
#[inline]
pub(super) fn floor(value: f64) -> i64 {
    let whole = value as i64;
    whole - i64::from(whole as f64 > value)
}

/// Turns marks into texels for one library, one grid and one set of options.
#[derive(Debug)]
pub struct Stamper {
    pub(super) grid: TexelGrid,
    /// Side of a presence cell, metres.
    cell_m: f64,
    pub(super) options: StampOptions,
    /// By the pattern's number; none for what walls take.
    pub(super) printers: Vec<Option<Printer>>,
    pub(super) kernels: Kernels,
    /// Noise of `passes`: faint, for prints that are seen only as a sum.
    pub(super) faint: NoiseTile,
    /// Noise of `soil` and `scuff`.
    pub(super) grain: NoiseTile,
    pub(super) dither: NoiseTile,
    pub(super) faint_peak: f32,
    pub(super) grain_peak: f32,
}

/// Deviation of the noise in `passes`, as a share of that in soil prints.
const FAINT: f64 = 0.4;

/// Strengths and densities beyond this are cut: nothing sensible comes near it.
pub(super) const MOST_STRENGTH: f32 = 4.0;
pub(super) const MOST_DENSITY: f32 = 3.0;

/// Marks lie within this distance from the plan's origin, metres.
const FARTHEST_M: f64 = 1e6;

/// Soil below this density leaves nothing: less than a twentieth of the unit that sums are counted in.
pub(super) const LEAST_DENSITY: f32 = 0.05 / 4096.0;

/// A mark that was found sound.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed {
    /// What a footfall adds to presence; of no meaning for other marks.
    kernel: PlacedKernel,
    /// Where the foot stands, metres from the mark's place: there, unless that is in a wall.
    foothold: [f32; 2],
    /// Whether walls cut the print, and the kernel.
    print_cut: bool,
    kernel_cut: bool,
}

/// What a mark touches.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touched {
    /// Texels of the print.
    pub(crate) texels: Bounds,
    /// Cells of the presence grid; of no meaning for marks other than footfalls.
    pub(crate) cells: Bounds,
    /// Whether the print leaves soil.
    pub(crate) soil: bool,
}

impl Stamper {
    /// A stamper for the marks that use this library. Options out of range (see [`StampOptions::check`]) are
    /// replaced by their defaults.
    pub fn new(library: &PatternLibrary, grid: TexelGrid, options: &StampOptions) -> Stamper {
        let options = if options.check().is_ok() { options.clone() } else { StampOptions::default() };
        let density = grid.texels_per_metre;
        let faint = NoiseTile::grain(density, options.noise * FAINT, 1);
        let grain = NoiseTile::grain(density, options.noise, 2);
        Stamper {
            printers: printers(library, grid.texel_m(), &options),
            kernels: Kernels::new(grid.presence_grid().texels_per_metre, &options),
            dither: NoiseTile::dither(density),
            faint_peak: faint.peak(),
            grain_peak: grain.peak(),
            faint,
            grain,
            cell_m: grid.presence_grid().texel_m(),
            grid,
            options,
        }
    }

    /// The grid that it stamps for.
    pub fn grid(&self) -> TexelGrid {
        self.grid
    }

    /// Looks at a mark's surroundings. `None` if it can leave nothing: a pattern that is not in the library or not of
    /// the mark's cause, a place, heading, length or strength that is no sensible number.
    pub(crate) fn place(&self, mark: &Mark, walls: &Walls) -> Option<(Placed, Touched)> {
        let printer = self.printer(mark)?;
        let sound = mark.place_m.is_finite()
            && mark.place_m.x.abs().max(mark.place_m.y.abs()) < FARTHEST_M
            && (mark.heading.length_squared() - 1.0).abs() < 1e-3
            && (mark.strength > 0.0 || mark.soil > 0.0)
            && mark.length_m > 0.0;
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

    fn place_sole(&self, mark: &Mark, printer: &Printer, walls: &Walls) -> Option<(Placed, Touched)> {
        let pose = self.sole_pose(mark, printer)?;
        let cell_m = self.cell_m;
        // The kernel lies around the middle of what the sole leaves, which is nearer to the toes than the sole's.
        let middle = pose.point_m(printer, printer.centroid);
        let found = self.kernels.find(middle, mark.heading);
        let strength = mark.strength.clamp(0.0, MOST_STRENGTH);
        let mass_cells = printer.mass_m2 * pose.scale_along * pose.scale_across / (cell_m * cell_m);
        let mut amount = strength * mass_cells as f32 * PRESENCE_ONE;
        let kernel_extent = self.kernels.extent(middle, mark.heading);
        let print_extent = self.print_extent(mark, printer, &pose);
        let mut placed = Placed {
            kernel: self.kernels.place(found, amount),
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
                // What falls behind the wall comes back in front of it.
                amount /= (1.0 - hidden).max(0.05);
            }
            if placed.print_cut {
                amount *= self.share_left(printer, &pose, walls, stands);
            }
            placed.kernel = self.kernels.place(found, amount);
        }
        let texels = pose.bounds(&self.grid, printer, self.twist_reach_m(mark));
        let touched = Touched { texels, cells: self.kernels.bounds(found), soil: mark.soil > LEAST_DENSITY };
        Some((placed, touched))
    }

    fn place_heel(&self, mark: &Mark, printer: &Printer, walls: &Walls) -> Option<(Placed, Touched)> {
        let pose = self.heel_pose(mark, printer)?;
        let none = self.kernels.find(mark.place_m, mark.heading);
        let mut placed =
            Placed { kernel: self.kernels.place(none, 0.0), foothold: [0.0; 2], print_cut: false, kernel_cut: false };
        let reach = self.print_extent(mark, printer, &pose).reach_m(mark.place_m);
        if let Some(wall) = walls.nearest(mark.place_m, reach) {
            placed.stand(foothold(walls, mark.place_m, wall.point_m), mark);
            placed.print_cut = true;
        }
        let texels = pose.bounds(&self.grid, printer, self.bend_reach_m(mark));
        Some((placed, Touched { texels, cells: self.kernels.bounds(none), soil: false }))
    }

    /// Share of a sole's print that walls leave.
    fn share_left(&self, printer: &Printer, pose: &Pose, walls: &Walls, from: Vec2) -> f32 {
        let lump_m = printer.lump_m() * pose.scale_along;
        let Some(shadow) = Shadow::new(walls, from, &printer.extent(pose, 0.0), lump_m) else { return 1.0 };
        let left = |lump: &Lump| lump.share * shadow.reached_at(pose.point_m(printer, lump.place));
        printer.lumps.iter().map(left).sum()
    }

    /// The most that one cell of `presence` can get from a footfall.
    pub(crate) fn peak_of_presence(&self, placed: &Placed) -> u32 {
        self.kernels.peak(&placed.kernel)
    }

    /// Adds a footfall's kernel to the presence cells of a window.
    pub(crate) fn add_presence<C: Cell>(
        &self,
        mark: &Mark,
        placed: &Placed,
        walls: &Walls,
        window: Window,
        cells: &mut [C],
    ) {
        let cut = placed.kernel_cut.then(|| {
            let printer = self.printer(mark)?;
            let middle = self.sole_pose(mark, printer)?.point_m(printer, printer.centroid);
            let extent = self.kernels.extent(middle, mark.heading);
            Shadow::new(walls, placed.stands(mark), &extent, self.cell_m)
        });
        let cut = cut.flatten();
        self.kernels.add(&placed.kernel, cut.as_ref(), window, cells);
    }

    /// The shadow that cuts a print.
    pub(super) fn print_shadow(
        &self,
        mark: &Mark,
        placed: &Placed,
        printer: &Printer,
        pose: &Pose,
        walls: &Walls,
    ) -> Option<Shadow> {
        let extent = self.print_extent(mark, printer, pose);
        placed.print_cut.then(|| Shadow::new(walls, placed.stands(mark), &extent, self.grid.texel_m())).flatten()
    }

    fn print_extent(&self, mark: &Mark, printer: &Printer, pose: &Pose) -> Extent {
        printer.extent(pose, self.twist_reach_m(mark) + self.bend_reach_m(mark))
    }
}

impl Placed {
    /// Keeps where the foot stands, and says where that is after rounding.
    fn stand(&mut self, stands: Vec2, mark: &Mark) -> Vec2 {
        let offset = stands - mark.place_m;
        self.foothold = [offset.x as f32, offset.y as f32];
        self.stands(mark)
    }

    fn stands(&self, mark: &Mark) -> Vec2 {
        mark.place_m + vec2(f64::from(self.foothold[0]), f64::from(self.foothold[1]))
    }
}
