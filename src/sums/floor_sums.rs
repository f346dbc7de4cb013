//! Sums of a floor.

use super::SumsError;
use super::batch::Batch;
use super::blocks::{BLOCK, SparsePlane};
use super::floor::FloorMasks;
use super::quantity::Quantity;
use crate::stamps::TexelGrid;

/// Sums of a floor: saturating `u32` fixed point per quantity, in sparse blocks.
///
/// Sums are zero outside the floor. A texel that is partly floor holds the full value of its floor part.
#[derive(Debug)]
pub struct FloorSums {
    pub(super) grid: TexelGrid,
    pub(super) presence_grid: TexelGrid,
    pub(super) planes: [SparsePlane; Quantity::ALL.len()],
    /// Floor masks in texels.
    pub(super) texel_floor: FloorMasks,
    /// Floor masks in cells of the presence grid.
    pub(super) cell_floor: FloorMasks,
    /// Buffers of [`FloorSums::add`].
    pub(super) batch: Batch,
}

impl FloorSums {
    /// Creates empty sums; blocks are allocated on first use.
    pub fn new(grid: TexelGrid) -> FloorSums {
        let presence_grid = grid.presence_grid();
        FloorSums {
            grid,
            presence_grid,
            planes: Quantity::ALL
                .map(|quantity| SparsePlane::new(if quantity.is_coarse() { presence_grid } else { grid })),
            texel_floor: FloorMasks::new(grid),
            cell_floor: FloorMasks::new(presence_grid),
            batch: Batch::default(),
        }
    }

    /// Texel grid of all quantities except the coarse ones.
    pub fn grid(&self) -> TexelGrid {
        self.grid
    }

    /// Grid of the coarse quantities such as `presence`, with cells of about 4 cm: a whole number of texels per side, at least one.
    pub fn presence_grid(&self) -> TexelGrid {
        self.presence_grid
    }

    /// Grid of a quantity's sums.
    pub fn grid_of(&self, quantity: Quantity) -> TexelGrid {
        if quantity.is_coarse() { self.presence_grid } else { self.grid }
    }

    /// Copies a rectangle of sums, row 0 lowest: texels, of coarse quantities cells. Zero outside the grid.
    pub fn read(&self, quantity: Quantity, i0: u32, j0: u32, width: usize, height: usize, out: &mut [u32]) {
        self.plane(quantity).read([i0, j0], width, height, out);
    }

    /// Whether a rectangle overlaps an allocated block; if not, it is zero.
    pub fn touched(&self, quantity: Quantity, i0: u32, j0: u32, width: usize, height: usize) -> bool {
        self.plane(quantity).touched([i0, j0], width, height)
    }

    /// Lower-left texels of all allocated blocks, by ascending row, then column.
    ///
    /// A block has `BLOCK` texels per side, fewer at the grid's end.
    pub fn blocks(&self, quantity: Quantity) -> Vec<[u32; 2]> {
        self.plane(quantity).origins()
    }

    /// Adds a rectangle of sums, row 0 lowest; ignores the part outside the grid.
    pub fn add_block(&mut self, quantity: Quantity, i0: u32, j0: u32, width: usize, height: usize, values: &[u32]) {
        self.planes[quantity as usize].add_values([i0, j0], width, height, values);
    }

    /// Adds the sums of another bake of the same floor.
    ///
    /// # Errors
    /// The grids differ.
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

    /// Memory of the sums, bytes.
    pub fn bytes(&self) -> usize {
        self.planes.iter().map(SparsePlane::bytes).sum()
    }

    fn plane(&self, quantity: Quantity) -> &SparsePlane {
        &self.planes[quantity as usize]
    }
}
