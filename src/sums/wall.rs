use std::collections::BTreeMap;

use super::blocks::Plane;
use super::{BLOCK, SumsError, add_wall};
use crate::marks::Contact;
use crate::patterns::Cause;
use crate::stamps::{TexelGrid, WallGrid, WallStamper};

/// All sums of a plan's walls: optical density by cause, as `u32` fixed point of [`crate::stamps::DENSITY_ONE`] that
/// stays at its largest value instead of overflowing.
///
/// A wall that nobody touched costs nothing.
#[derive(Debug)]
pub struct WallSums {
    pub(super) grid: WallGrid,
    /// The strips that somebody touched, by cause (its place in [`Cause::WALL`]) and face.
    pub(super) strips: BTreeMap<StripKey, Plane>,
}

/// A cause's place in [`Cause::WALL`] and a face.
pub(super) type StripKey = (usize, u32);

impl WallSums {
    /// Sums of nothing yet. Allocates nothing for the area.
    pub fn new(grid: WallGrid) -> WallSums {
        WallSums { grid, strips: BTreeMap::new() }
    }

    /// The raster of the walls.
    pub fn grid(&self) -> &WallGrid {
        &self.grid
    }

    /// Adds the stamps of contacts, in the current rayon pool.
    ///
    /// The sums do not depend on the contacts' order, on how they are split into calls or on the number of threads.
    /// Contacts without sense (a pattern of another cause, a face that is none, no finite place) leave nothing.
    /// `stamper` must be made for the same grid; one of another grid adds nothing.
    pub fn add(&mut self, stamper: &WallStamper, contacts: &[Contact]) {
        add_wall::add(self, stamper, contacts);
    }

    /// Copies a rectangle of a face's sums, row 0 lowest. Zeros where there is nothing and beyond the face.
    ///
    /// `cause` must be one of [`Cause::WALL`]; others have no sums here.
    #[allow(clippy::too_many_arguments)]
    pub fn read(&self, cause: Cause, face: usize, i0: u32, j0: u32, width: usize, height: usize, out: &mut [u32]) {
        match self.strip(cause, face) {
            Some(strip) => strip.read([i0, j0], width, height, out),
            None => out.fill(0),
        }
    }

    /// Whether anything may be other than zero in a rectangle of a face.
    pub fn touched(&self, cause: Cause, face: usize, i0: u32, j0: u32, width: usize, height: usize) -> bool {
        self.strip(cause, face).is_some_and(|strip| strip.touched([i0, j0], width, height))
    }

    /// Faces and lower-left texels of all blocks that hold something of a cause, by ascending face, row, column. A
    /// block is [`BLOCK`] texels a side, less where the strip ends.
    pub fn blocks(&self, cause: Cause) -> Vec<(usize, [u32; 2])> {
        let Some(number) = cause.on_wall() else { return Vec::new() };
        let strips = self.strips.range((number, 0)..=(number, u32::MAX));
        strips.flat_map(|(&(_, face), strip)| strip.origins().into_iter().map(move |at| (face as usize, at))).collect()
    }

    /// Adds a rectangle of sums that were read before, row 0 lowest. What lies beyond the face is left out.
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
    /// Sums on another grid.
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

    /// Bytes that the sums take up.
    pub fn bytes(&self) -> usize {
        self.strips.values().map(Plane::bytes).sum()
    }

    fn strip(&self, cause: Cause, face: usize) -> Option<&Plane> {
        self.strips.get(&(cause.on_wall()?, u32::try_from(face).ok()?))
    }

    /// A strip, made if nobody touched it yet. The face must be one.
    pub(super) fn strip_mut(&mut self, key: StripKey) -> &mut Plane {
        let WallGrid { texels_per_metre, height, faces, .. } = &self.grid;
        let (texels_per_metre, width, height) = (*texels_per_metre, faces[key.1 as usize].width, *height);
        self.strips.entry(key).or_insert_with(|| Plane::new(TexelGrid { texels_per_metre, width, height }))
    }
}
