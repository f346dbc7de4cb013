//! Sums of walls.

use std::collections::BTreeMap;

use super::SumsError;
use super::blocks::{BLOCK, SparsePlane};
use crate::patterns::Cause;
use crate::stamps::{TexelGrid, WallGrid};

/// Sums of a plan's walls: optical density per cause and face, in sparse blocks.
///
/// Values are saturating `u32` fixed point in units of `crate::stamps::DENSITY_ONE`. Untouched walls use no memory.
#[derive(Debug)]
pub struct WallSums {
    pub(super) grid: WallGrid,
    /// Strips with stains.
    pub(super) strips: BTreeMap<StripKey, SparsePlane>,
}

/// Key of a strip: indices of its cause in [`Cause::WALL`] and of its face.
pub(super) type StripKey = (usize, u32);

impl WallSums {
    /// Creates empty sums; blocks are allocated on first use.
    pub fn new(grid: WallGrid) -> WallSums {
        WallSums { grid, strips: BTreeMap::new() }
    }

    /// Texel grid of the walls.
    pub fn grid(&self) -> &WallGrid {
        &self.grid
    }

    /// Copies a rectangle of a face's sums, row 0 lowest. Zero outside the face.
    ///
    /// Sums of causes outside [`Cause::WALL`] are zero.
    #[allow(clippy::too_many_arguments)]
    pub fn read(&self, cause: Cause, face: usize, i0: u32, j0: u32, width: usize, height: usize, out: &mut [u32]) {
        match self.strip(cause, face) {
            Some(strip) => strip.read([i0, j0], width, height, out),
            None => out.fill(0),
        }
    }

    /// Whether a rectangle of a face overlaps an allocated block; if not, it is zero.
    pub fn touched(&self, cause: Cause, face: usize, i0: u32, j0: u32, width: usize, height: usize) -> bool {
        self.strip(cause, face).is_some_and(|strip| strip.touched([i0, j0], width, height))
    }

    /// Faces and lower-left texels of a cause's allocated blocks, by ascending face, row, column.
    ///
    /// A block has `BLOCK` texels per side, fewer at the strip's end.
    pub fn blocks(&self, cause: Cause) -> Vec<(usize, [u32; 2])> {
        let Some(number) = cause.on_wall() else { return Vec::new() };
        let strips = self.strips.range((number, 0)..=(number, u32::MAX));
        strips.flat_map(|(&(_, face), strip)| strip.origins().into_iter().map(move |at| (face as usize, at))).collect()
    }

    /// Adds a rectangle of sums, row 0 lowest; ignores the part outside the face.
    pub fn add_block(
        &mut self,
        cause: Cause,
        face: usize,
        i0: u32,
        j0: u32,
        [width, height]: [usize; 2],
        values: &[u32],
    ) {
        let Some(number) = cause.on_wall() else { return };
        if face < self.grid.faces.len() && values.iter().any(|&value| value > 0) {
            self.strip_mut((number, face as u32)).add_values([i0, j0], width, height, values);
        }
    }

    /// Adds the sums of another bake of the same walls.
    ///
    /// # Errors
    /// The grids differ.
    pub fn merge(&mut self, other: &WallSums) -> Result<(), SumsError> {
        if self.grid != other.grid {
            return Err(SumsError::walls_differ(&self.grid, &other.grid));
        }
        let mut values = vec![0; BLOCK * BLOCK];
        for cause in Cause::WALL {
            for (face, [i0, j0]) in other.blocks(cause) {
                other.read(cause, face, i0, j0, BLOCK, BLOCK, &mut values);
                self.add_block(cause, face, i0, j0, [BLOCK, BLOCK], &values);
            }
        }
        Ok(())
    }

    /// Memory of the sums, bytes.
    pub fn bytes(&self) -> usize {
        self.strips.values().map(SparsePlane::bytes).sum()
    }

    fn strip(&self, cause: Cause, face: usize) -> Option<&SparsePlane> {
        self.strips.get(&(cause.on_wall()?, u32::try_from(face).ok()?))
    }

    /// Returns a strip, allocated on first use. The face must be in the grid.
    pub(super) fn strip_mut(&mut self, key: StripKey) -> &mut SparsePlane {
        let WallGrid { texels_per_metre, height, faces, .. } = &self.grid;
        let (texels_per_metre, width, height) = (*texels_per_metre, faces[key.1 as usize].width, *height);
        self.strips.entry(key).or_insert_with(|| SparsePlane::new(TexelGrid { texels_per_metre, width, height }))
    }
}
