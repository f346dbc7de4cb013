//! Sparse blocks of sums of one quantity.

use std::collections::BTreeMap;

use crate::stamps::{TexelGrid, WINDOW};

/// Side of a block: texels, for `presence` cells.
pub const BLOCK: usize = WINDOW;

/// Row and column of a block; keys ascend with rows.
pub(super) type BlockKey = [u32; 2];

/// Cells of a block: 16 bits each until one needs 32.
#[derive(Debug)]
pub(super) enum BlockCells {
    Narrow(Box<[u16]>),
    Wide(Box<[u32]>),
}

/// A square block of sums.
#[derive(Debug)]
pub(super) struct SumBlock {
    key: BlockKey,
    cells: BlockCells,
    /// Upper bound on the cells (narrow blocks only).
    peak: u32,
}

/// Largest value of a narrow cell.
const NARROW_MOST: u32 = u16::MAX as u32;

/// Peak above which a block widens, which avoids repeated searches for the peak.
const NARROW_ENOUGH: u32 = 48 << 10;

impl SumBlock {
    fn new(key: BlockKey) -> SumBlock {
        SumBlock { key, cells: BlockCells::Narrow(vec![0; BLOCK * BLOCK].into_boxed_slice()), peak: 0 }
    }

    pub(super) fn key(&self) -> BlockKey {
        self.key
    }

    /// Returns the cells, widened if adding `most` to each could overflow.
    pub(super) fn cells_for(&mut self, most: u32) -> &mut BlockCells {
        if let BlockCells::Narrow(cells) = &self.cells {
            if self.peak.saturating_add(most) > NARROW_MOST {
                self.peak = cells.iter().fold(0, |a, &b| a.max(b)).into();
                if self.peak.saturating_add(most) > NARROW_ENOUGH {
                    self.widen();
                }
            }
            self.peak = self.peak.saturating_add(most);
        }
        &mut self.cells
    }

    /// Widens the cells to 32 bits.
    pub(super) fn widen(&mut self) -> &mut [u32] {
        if let BlockCells::Narrow(cells) = &self.cells {
            self.cells = BlockCells::Wide(cells.iter().map(|&c| u32::from(c)).collect());
        }
        match &mut self.cells {
            BlockCells::Wide(cells) => cells,
            BlockCells::Narrow(_) => &mut [],
        }
    }

    pub(super) fn cells_mut(&mut self) -> &mut BlockCells {
        &mut self.cells
    }

    fn copy_row(&self, row: usize, columns: std::ops::Range<usize>, out: &mut [u32]) {
        let range = row * BLOCK + columns.start..row * BLOCK + columns.end;
        match &self.cells {
            BlockCells::Narrow(cells) => out.iter_mut().zip(&cells[range]).for_each(|(o, &c)| *o = c.into()),
            BlockCells::Wide(cells) => out.iter_mut().zip(&cells[range]).for_each(|(o, &c)| *o = c),
        }
    }

    fn add_row(&mut self, row: usize, columns: std::ops::Range<usize>, values: &[u32]) {
        let most = values.iter().fold(0, |a, &b| a.max(b));
        let range = row * BLOCK + columns.start..row * BLOCK + columns.end;
        match self.cells_for(most) {
            BlockCells::Narrow(cells) => {
                cells[range].iter_mut().zip(values).for_each(|(c, &v)| *c = c.saturating_add(v as u16));
            }
            BlockCells::Wide(cells) => cells[range].iter_mut().zip(values).for_each(|(c, &v)| *c = c.saturating_add(v)),
        }
    }
}

/// The sparse blocks of one quantity over a grid.
#[derive(Debug)]
pub(super) struct SparsePlane {
    width: u32,
    height: u32,
    /// Indices of blocks by key.
    numbers: BTreeMap<BlockKey, usize>,
    blocks: Vec<SumBlock>,
}

/// The part of a rectangle in one block.
struct BlockPiece {
    key: BlockKey,
    /// Rows and columns within the block.
    rows: std::ops::Range<usize>,
    columns: std::ops::Range<usize>,
    /// First row and column within the rectangle.
    row: usize,
    column: usize,
}

impl SparsePlane {
    pub(super) fn new(grid: TexelGrid) -> SparsePlane {
        SparsePlane { width: grid.width, height: grid.height, numbers: BTreeMap::new(), blocks: Vec::new() }
    }

    /// Index of the block with this key; allocates a missing block.
    fn number(&mut self, key: BlockKey) -> usize {
        *self.numbers.entry(key).or_insert_with(|| {
            self.blocks.push(SumBlock::new(key));
            self.blocks.len() - 1
        })
    }

    /// Returns the blocks with these distinct keys, each with its value; allocates missing blocks.
    pub(super) fn blocks_at<T>(&mut self, places: impl Iterator<Item = (BlockKey, T)>) -> Vec<(&mut SumBlock, T)> {
        let mut numbered: Vec<(usize, T)> = places.map(|(key, with)| (self.number(key), with)).collect();
        numbered.sort_unstable_by_key(|&(number, _)| number);
        let mut numbered = numbered.into_iter().peekable();
        let blocks = self.blocks.iter_mut().enumerate();
        blocks.filter_map(|(k, block)| Some((block, numbered.next_if(|&(number, _)| number == k)?.1))).collect()
    }

    pub(super) fn origins(&self) -> Vec<[u32; 2]> {
        self.numbers.keys().map(|[row, column]| [column * BLOCK as u32, row * BLOCK as u32]).collect()
    }

    pub(super) fn bytes(&self) -> usize {
        let of = |block: &SumBlock| match &block.cells {
            BlockCells::Narrow(cells) => cells.len() * 2,
            BlockCells::Wide(cells) => cells.len() * 4,
        };
        self.blocks.iter().map(of).sum()
    }

    pub(super) fn touched(&self, at: [u32; 2], width: usize, height: usize) -> bool {
        self.pieces(at, width, height).any(|piece| self.numbers.contains_key(&piece.key))
    }

    pub(super) fn read(&self, at: [u32; 2], width: usize, height: usize, out: &mut [u32]) {
        out.fill(0);
        for piece in self.pieces(at, width, height) {
            let Some(&number) = self.numbers.get(&piece.key) else { continue };
            for (k, row) in piece.rows.clone().enumerate() {
                let start = (piece.row + k) * width + piece.column;
                if let Some(out) = out.get_mut(start..start + piece.columns.len()) {
                    self.blocks[number].copy_row(row, piece.columns.clone(), out);
                }
            }
        }
    }

    pub(super) fn add_values(&mut self, at: [u32; 2], width: usize, height: usize, values: &[u32]) {
        let pieces: Vec<BlockPiece> = self.pieces(at, width, height).collect();
        for piece in pieces {
            for (k, row) in piece.rows.clone().enumerate() {
                let start = (piece.row + k) * width + piece.column;
                let Some(values) = values.get(start..start + piece.columns.len()) else { continue };
                if values.iter().any(|&v| v > 0) {
                    let number = self.number(piece.key);
                    self.blocks[number].add_row(row, piece.columns.clone(), values);
                }
            }
        }
    }

    /// Splits a rectangle at block borders; ignores the part outside the grid.
    fn pieces(&self, at: [u32; 2], width: usize, height: usize) -> impl Iterator<Item = BlockPiece> + use<> {
        let size = BLOCK as u64;
        let [i0, j0] = at.map(u64::from);
        let i1 = (i0 + width as u64).min(self.width.into()).max(i0);
        let j1 = (j0 + height as u64).min(self.height.into()).max(j0);
        let split = move |from: u64, to: u64| {
            (from / size..to.div_ceil(size)).map(move |k| {
                let (low, high) = (from.max(k * size), to.min((k + 1) * size));
                (k as u32, (low - k * size) as usize..(high - k * size) as usize, (low - from) as usize)
            })
        };
        split(j0, j1).flat_map(move |(block_row, rows, row)| {
            split(i0, i1).filter(|(_, columns, _)| !columns.is_empty()).map(move |(block_column, columns, column)| {
                BlockPiece { key: [block_row, block_column], rows: rows.clone(), columns, row, column }
            })
        })
    }
}
