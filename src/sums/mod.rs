//! Adds up stamps: exact integer sums in sparse blocks, the same for any order and any number of threads.
//!
//! A batch of marks is first binned to the blocks that it touches (coarse), then every block takes its marks in
//! turn (fine), blocks in parallel. Each stamp adds integers that depend on nothing but the mark, its
//! pattern, the walls around it and the grid; the sum of integers does not depend on their order. Blocks are allocated when first
//! touched and hold 16 bits a texel until a texel needs more: memory grows with the floor and the walls that people
//! touch.

use crate::marks::Mark;
use crate::stamps::{DENSITY_ONE, PASSES_ONE, PRESENCE_ONE, Stamper, TexelGrid, WINDOW};
use crate::walls::Walls;

mod add;
mod add_wall;
mod blocks;
mod error;
mod floor;
#[cfg(test)]
mod tests;
mod wall;

pub use error::{SumsError, WallsOfSums};
pub use wall::WallSums;

use add::Batch;
use blocks::Plane;
use floor::FloorMasks;

/// Side of a block, texels (`presence`: cells).
pub const BLOCK: usize = WINDOW;

/// What is summed up on a floor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Quantity {
    /// Every footfall: coverage times pressure.
    Passes,
    /// Every footfall: a soft kernel along the heading, on a coarser grid, in the same unit as passes: its
    /// expectation.
    Presence,
    /// Fresh people's footfalls: optical density of soil.
    Soil,
    /// Heel and toe marks: optical density.
    Scuff,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Quantity; 4] = [Quantity::Passes, Quantity::Presence, Quantity::Soil, Quantity::Scuff];

    /// What 1 of the quantity is as a sum: `passes` 256, `presence` 1024, `soil` and `scuff` 4096.
    ///
    /// A pass is a print of full coverage at mean pressure; soil and scuff are optical densities D, of which
    /// the surface shows `exp(-D)`.
    pub const fn one(self) -> u32 {
        match self {
            Quantity::Passes => PASSES_ONE as u32,
            Quantity::Presence => PRESENCE_ONE as u32,
            Quantity::Soil | Quantity::Scuff => DENSITY_ONE as u32,
        }
    }

    /// Its name in file and channel names.
    pub const fn name(self) -> &'static str {
        match self {
            Quantity::Passes => "passes",
            Quantity::Presence => "presence",
            Quantity::Soil => "soil",
            Quantity::Scuff => "scuff",
        }
    }
}

/// All sums of a floor, as `u32` fixed point that stays at its largest value instead of overflowing.
///
/// Sums are zero outside the floor. Nothing is scaled at its edge: a texel that floor covers in part shows what lies on that
/// part, not a share of it.
#[derive(Debug)]
pub struct FloorSums {
    grid: TexelGrid,
    presence_grid: TexelGrid,
    planes: [Plane; 4],
    /// Where there is floor, in texels.
    texel_floor: FloorMasks,
    /// Where there is floor, in cells of the presence grid.
    cell_floor: FloorMasks,
    batch: Batch,
}

impl FloorSums {
    /// Sums of nothing yet. Allocates nothing for the area.
    pub fn new(grid: TexelGrid) -> FloorSums {
        let presence_grid = grid.presence_grid();
        FloorSums {
            grid,
            presence_grid,
            planes: Quantity::ALL
                .map(|quantity| Plane::new(if quantity == Quantity::Presence { presence_grid } else { grid })),
            texel_floor: FloorMasks::new(grid),
            cell_floor: FloorMasks::new(presence_grid),
            batch: Batch::default(),
        }
    }

    /// The grid of all quantities but `presence`.
    pub fn grid(&self) -> TexelGrid {
        self.grid
    }

    /// The grid of `presence`: cells of about 4 cm, a whole number of texels a side, or texels where they are coarser.
    pub fn presence_grid(&self) -> TexelGrid {
        self.presence_grid
    }

    /// The grid that a quantity's sums lie on.
    pub fn grid_of(&self, quantity: Quantity) -> TexelGrid {
        if quantity == Quantity::Presence { self.presence_grid } else { self.grid }
    }

    /// Adds the stamps of marks, in the current rayon pool.
    ///
    /// The sums do not depend on the marks' order, on how they are split into calls or on the number of threads.
    /// Marks without sense (a pattern of another cause, no finite place) leave nothing. `stamper` must be made
    /// for the same grid, `walls` be the same in all calls.
    pub fn add(&mut self, stamper: &Stamper, walls: &Walls, marks: &[Mark]) {
        add::add(self, stamper, walls, marks);
    }

    /// Copies a rectangle of sums, row 0 lowest: of texels, or of cells for `presence`. Zeros where there is nothing
    /// and beyond the grid.
    pub fn read(&self, quantity: Quantity, i0: u32, j0: u32, width: usize, height: usize, out: &mut [u32]) {
        self.plane(quantity).read([i0, j0], width, height, out);
    }

    /// Whether anything may be other than zero in a rectangle: blocks that nobody touched need no reading.
    pub fn touched(&self, quantity: Quantity, i0: u32, j0: u32, width: usize, height: usize) -> bool {
        self.plane(quantity).touched([i0, j0], width, height)
    }

    /// Lower-left texels of all blocks that hold something, by ascending row, then column. A block is
    /// [`BLOCK`] texels a side, less where the grid ends.
    pub fn blocks(&self, quantity: Quantity) -> Vec<[u32; 2]> {
        self.plane(quantity).origins()
    }

    /// Adds a rectangle of sums that were read before, row 0 lowest. What lies beyond the grid is left out.
    pub fn add_block(&mut self, quantity: Quantity, i0: u32, j0: u32, width: usize, height: usize, values: &[u32]) {
        self.planes[quantity as usize].add_values([i0, j0], width, height, values);
    }

    /// Adds the sums of another bake of the same floor.
    ///
    /// # Errors
    /// Sums on another grid.
    pub fn merge(&mut self, other: &FloorSums) -> Result<(), SumsError> {
        if self.grid != other.grid {
            return Err(SumsError::GridsDiffer { ours: self.grid, theirs: other.grid });
        }
        let mut values = vec![0; BLOCK * BLOCK];
        for quantity in Quantity::ALL {
            for [i0, j0] in other.blocks(quantity) {
                other.read(quantity, i0, j0, BLOCK, BLOCK, &mut values);
                self.add_block(quantity, i0, j0, BLOCK, BLOCK, &values);
            }
        }
        Ok(())
    }

    /// Bytes that the sums take up.
    pub fn bytes(&self) -> usize {
        self.planes.iter().map(Plane::bytes).sum()
    }

    fn plane(&self, quantity: Quantity) -> &Plane {
        &self.planes[quantity as usize]
    }
}
