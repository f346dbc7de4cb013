//! Floor masks: one bit per texel of a block.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;

use super::blocks::{BLOCK, BlockCells, BlockKey};
use crate::math::Vec2;
use crate::stamps::TexelGrid;
use crate::walls::Walls;

/// A row of a block: one bit per texel.
type RowBits = u128;

/// The floor mask of a block.
#[derive(Debug)]
pub(super) enum FloorMask {
    None,
    Part(Box<[RowBits]>),
    All,
}

/// Floor masks of all blocks used so far.
#[derive(Debug)]
pub(super) struct FloorMasks {
    grid: TexelGrid,
    masks: BTreeMap<BlockKey, FloorMask>,
    /// Blocks on the outline of the floor, computed on first use.
    rim: Option<BTreeSet<BlockKey>>,
}

impl FloorMasks {
    pub(super) fn new(grid: TexelGrid) -> FloorMasks {
        FloorMasks { grid, masks: BTreeMap::new(), rim: None }
    }

    /// Computes the missing masks of blocks.
    pub(super) fn prepare(&mut self, keys: impl Iterator<Item = BlockKey>, walls: &Walls) {
        let mut missing: Vec<BlockKey> = keys.filter(|key| !self.masks.contains_key(key)).collect();
        missing.sort_unstable();
        missing.dedup();
        if missing.is_empty() {
            return;
        }
        let grid = self.grid;
        let rim = self.rim.get_or_insert_with(|| rim(grid, walls));
        let made: Vec<(BlockKey, FloorMask)> = missing
            .into_par_iter()
            .map_init(
                || vec![0.0; BLOCK * BLOCK],
                |coverage, key| {
                    let mask =
                        if rim.contains(&key) { mask(grid, key, walls, coverage) } else { whole(grid, key, walls) };
                    (key, mask)
                },
            )
            .collect();
        self.masks.extend(made);
    }

    pub(super) fn get(&self, key: BlockKey) -> &FloorMask {
        self.masks.get(&key).unwrap_or(&FloorMask::None)
    }
}

impl FloorMask {
    pub(super) fn is_none(&self) -> bool {
        matches!(self, FloorMask::None)
    }

    /// Sets all cells outside the floor to zero.
    pub(super) fn clear_outside(&self, cells: &mut BlockCells) {
        if let FloorMask::Part(rows) = self {
            match cells {
                BlockCells::Narrow(cells) => clear(rows, cells),
                BlockCells::Wide(cells) => clear(rows, cells),
            }
        }
    }
}

fn clear<C: Default + Copy>(rows: &[RowBits], cells: &mut [C]) {
    for (&bits, cells) in rows.iter().zip(cells.chunks_exact_mut(BLOCK)) {
        // Fill each run of texels without floor.
        let mut outside = !bits;
        while outside != 0 {
            let start = outside.trailing_zeros();
            let length = (outside >> start).trailing_ones();
            cells[start as usize..(start + length) as usize].fill(C::default());
            outside &= RowBits::MAX.checked_shl(start + length).unwrap_or(0);
        }
    }
}

/// Returns the blocks on or near the floor's outline, and those at the end of the grid.
fn rim(grid: TexelGrid, walls: &Walls) -> BTreeSet<BlockKey> {
    let block_m = BLOCK as f64 / grid.texels_per_metre;
    let margin_m = 1.0 / grid.texels_per_metre;
    let count = |texels: u32| texels.div_ceil(BLOCK as u32);
    let (columns, rows) = (count(grid.width), count(grid.height));
    // Blocks between two coordinates, one texel more on either side.
    let blocks = |a: f64, b: f64, count: u32| {
        let low = ((a.min(b) - margin_m) / block_m).max(0.0) as u32;
        let high = ((a.max(b) + margin_m) / block_m).max(-1.0).floor() as i64;
        low..((high + 1).clamp(0, count.into()) as u32).max(low)
    };
    let mut rim = BTreeSet::new();
    for outline in walls.outlines() {
        for [a, b] in (0..outline.points_m.len()).map(|k| outline.edge(k)) {
            for row in blocks(a.y, b.y, rows) {
                let x_at = |y: f64| x_on([a, b], y);
                let (below, above) = (f64::from(row) * block_m - margin_m, f64::from(row + 1) * block_m + margin_m);
                let (x0, x1) = if a.y == b.y { (a.x, b.x) } else { (x_at(below), x_at(above)) };
                rim.extend(blocks(x0, x1, columns).map(|column| [row, column]));
            }
        }
    }
    if !(grid.width as usize).is_multiple_of(BLOCK) {
        rim.extend((0..rows).map(|row| [row, columns - 1]));
    }
    if !(grid.height as usize).is_multiple_of(BLOCK) {
        rim.extend((0..columns).map(|column| [rows - 1, column]));
    }
    rim
}

/// x of a non-horizontal edge at height y, clamped to its ends.
fn x_on([a, b]: [Vec2; 2], y: f64) -> f64 {
    a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)).clamp(0.0, 1.0)
}

/// Mask of a block away from the outline, from one texel.
fn whole(grid: TexelGrid, [row, column]: BlockKey, walls: &Walls) -> FloorMask {
    let middle = |k: u32| i64::from(k) * BLOCK as i64 + BLOCK as i64 / 2;
    let mut coverage = [0.0];
    walls.coverage(grid.texels_per_metre, middle(column), middle(row), 1, 1, &mut coverage);
    if coverage[0] > 0.0 { FloorMask::All } else { FloorMask::None }
}

/// Mask of any block; a texel counts as floor if any part of it is.
fn mask(grid: TexelGrid, [row, column]: BlockKey, walls: &Walls, coverage: &mut [f32]) -> FloorMask {
    let (i0, j0) = (i64::from(column) * BLOCK as i64, i64::from(row) * BLOCK as i64);
    walls.coverage(grid.texels_per_metre, i0, j0, BLOCK, BLOCK, coverage);
    let within = |first: i64, count: u32| (i64::from(count) - first).clamp(0, BLOCK as i64) as u32;
    let in_grid = RowBits::MAX.checked_shr(BLOCK as u32 - within(i0, grid.width)).unwrap_or(0);
    let last = within(j0, grid.height) as usize;
    let rows: Box<[RowBits]> = coverage
        .chunks_exact(BLOCK)
        .enumerate()
        .map(|(j, row)| if j < last { bits(row) & in_grid } else { 0 })
        .collect();
    if rows.iter().all(|&bits| bits == RowBits::MAX) {
        FloorMask::All
    } else if rows.iter().all(|&bits| bits == 0) {
        FloorMask::None
    } else {
        FloorMask::Part(rows)
    }
}

/// One bit per texel of a row that is at least partly floor.
fn bits(row: &[f32]) -> RowBits {
    let (bytes, _) = row.as_chunks::<8>();
    let byte = |texels: &[f32; 8]| texels.iter().enumerate().fold(0, |byte, (k, &c)| byte | u8::from(c > 0.0) << k);
    bytes.iter().enumerate().fold(0, |bits, (k, texels)| bits | RowBits::from(byte(texels)) << (8 * k))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec2;
    use crate::plan::FloorPlan;
    use crate::walls::WallsOptions;

    /// Masks from the outline's blocks equal masks from coverage.
    #[test]
    fn blocks_away_from_the_outline_are_all_floor_or_none() {
        let (width, height) = (90, 70);
        let floor = (0..width * height)
            .map(|k| {
                let from_middle = vec2((k % width) as f64 - 44.0, (k / width) as f64 - 30.0);
                let radius = from_middle.length();
                u8::from(radius < 28.0 && radius > 9.0 || from_middle.x.abs() < 5.0)
            })
            .collect();
        let plan = FloorPlan::from_mask(width as u32, height as u32, 0.1, floor);
        let walls = Walls::trace(&plan, &WallsOptions::default());
        for texels_per_metre in [60.0, 100.0, 331.0] {
            let size = |m: f64| (m * texels_per_metre) as u32;
            let grid = TexelGrid { texels_per_metre, width: size(9.0), height: size(7.0) };
            let keys =
                || (0..grid.height.div_ceil(128)).flat_map(|j| (0..grid.width.div_ceil(128)).map(move |i| [j, i]));
            let mut masks = FloorMasks::new(grid);
            masks.prepare(keys(), &walls);
            let mut whole = 0;
            for key in keys() {
                let expected = mask(grid, key, &walls, &mut [0.0; BLOCK * BLOCK]);
                match (masks.get(key), &expected) {
                    (FloorMask::All, FloorMask::All) | (FloorMask::None, FloorMask::None) => whole += 1,
                    (FloorMask::Part(a), FloorMask::Part(b)) => assert_eq!(a, b),
                    other => panic!("{key:?} at {texels_per_metre}: {other:?}"),
                }
            }
            assert!(whole > 0 || texels_per_metre < 100.0);
        }
    }
}
