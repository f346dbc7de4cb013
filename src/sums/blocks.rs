//! Sparse blocks of one quantity.

use std::collections::BTreeMap;

use super::BLOCK;
use crate::stamps::TexelGrid;

/// Place of a block: row and column of blocks, so that keys ascend with rows.
pub(super) type BlockKey = [u32; 2];

/// TexelRow of a block, narrow until one of them needs more.
#[derive(Debug)]
pub(super) enum Cells {
    Narrow(Box<[u16]>),
    Wide(Box<[u32]>),
}

/// A square of sums.
#[derive(Debug)]
pub(super) struct Block {
    key: BlockKey,
    cells: Cells,
    /// No cell is larger than this (narrow blocks only).
    peak: u32,
}

/// The most that a narrow cell holds.
const NARROW_MOST: u32 = u16::MAX as u32;

/// A narrow block with a cell larger than this goes wide rather than look for its peak again and again.
const NARROW_ENOUGH: u32 = 48 << 10;

impl Block {
    fn new(key: BlockKey) -> Block {
        Block { key, cells: Cells::Narrow(vec![0; BLOCK * BLOCK].into_boxed_slice()), peak: 0 }
    }

    /// The cells, ready for an addition of at most `most` to each.
    pub(super) fn cells_for(&mut self, most: u32) -> &mut Cells {
        if let Cells::Narrow(cells) = &self.cells {
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

    /// The cells as 32 bits.
    pub(super) fn widen(&mut self) -> &mut [u32] {
        if let Cells::Narrow(cells) = &self.cells {
            self.cells = Cells::Wide(cells.iter().map(|&c| u32::from(c)).collect());
        }
        match &mut self.cells {
            Cells::Wide(cells) => cells,
            Cells::Narrow(_) => &mut [],
        }
    }

    pub(super) fn cells_mut(&mut self) -> &mut Cells {
        &mut self.cells
    }

    fn copy_row(&self, row: usize, columns: std::ops::Range<usize>, out: &mut [u32]) {
        let range = row * BLOCK + columns.start..row * BLOCK + columns.end;
        match &self.cells {
            Cells::Narrow(cells) => out.iter_mut().zip(&cells[range]).for_each(|(o, &c)| *o = c.into()),
            Cells::Wide(cells) => out.iter_mut().zip(&cells[range]).for_each(|(o, &c)| *o = c),
        }
    }

    fn add_row(&mut self, row: usize, columns: std::ops::Range<usize>, values: &[u32]) {
        let most = values.iter().fold(0, |a, &b| a.max(b));
        let range = row * BLOCK + columns.start..row * BLOCK + columns.end;
        match self.cells_for(most) {
            Cells::Narrow(cells) => {
                cells[range].iter_mut().zip(values).for_each(|(c, &v)| *c = c.saturating_add(v as u16));
            }
            Cells::Wide(cells) => cells[range].iter_mut().zip(values).for_each(|(c, &v)| *c = c.saturating_add(v)),
        }
    }
}

/// One quantity over the whole floor.
#[derive(Debug)]
pub(super) struct Plane {
    width: u32,
    height: u32,
    /// Numbers of blocks by place.
    numbers: BTreeMap<BlockKey, usize>,
    blocks: Vec<Block>,
}

/// The part of a rectangle that lies in one block.
struct Piece {
    key: BlockKey,
    /// Rows and columns of the block.
    rows: std::ops::Range<usize>,
    columns: std::ops::Range<usize>,
    /// Where the piece begins in the rectangle.
    row: usize,
    column: usize,
}

impl Plane {
    pub(super) fn new(grid: TexelGrid) -> Plane {
        Plane { width: grid.width, height: grid.height, numbers: BTreeMap::new(), blocks: Vec::new() }
    }

    /// Number of the block at a place, made if it is not there.
    fn number(&mut self, key: BlockKey) -> usize {
        *self.numbers.entry(key).or_insert_with(|| {
            self.blocks.push(Block::new(key));
            self.blocks.len() - 1
        })
    }

    /// The blocks of places, all different, made where they are not there; each with what its place came with.
    pub(super) fn blocks_at<T>(&mut self, places: impl Iterator<Item = (BlockKey, T)>) -> Vec<(&mut Block, T)> {
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
        let of = |block: &Block| match &block.cells {
            Cells::Narrow(cells) => cells.len() * 2,
            Cells::Wide(cells) => cells.len() * 4,
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
        let pieces: Vec<Piece> = self.pieces(at, width, height).collect();
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

    /// Splits a rectangle at the blocks' borders; what lies beyond the grid is left out.
    fn pieces(&self, at: [u32; 2], width: usize, height: usize) -> impl Iterator<Item = Piece> + use<> {
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
                Piece { key: [block_row, block_column], rows: rows.clone(), columns, row, column }
            })
        })
    }
}

impl Block {
    pub(super) fn key(&self) -> BlockKey {
        self.key
    }
}
