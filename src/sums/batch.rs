//! Batches of marks, binned to blocks.

use super::blocks::BlockKey;
use super::quantity::Quantity;
use crate::stamps::PlacedMark;

/// Buffers of a batch of marks, reused from batch to batch.
#[derive(Debug, Default)]
pub(super) struct Batch {
    pub(super) placed: Vec<Option<PlacedMark>>,
    pub(super) entries: Vec<MarkEntry>,
}

/// A mark that touches a block, as one word that sorts by quantity, row, column and mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct MarkEntry(u64);

/// Bits of an entry for the mark's index; bits for each of the block's row and column.
const MARK_BITS: u32 = 16;
pub(super) const PLACE_BITS: u32 = 22;

/// Number of marks in a batch.
pub(super) const MARKS_AT_A_TIME: usize = 1 << MARK_BITS;

impl MarkEntry {
    pub(super) fn new(quantity: Quantity, [row, column]: BlockKey, mark: usize) -> MarkEntry {
        let place = u64::from(row) << PLACE_BITS | u64::from(column);
        MarkEntry(((quantity as u64) << (2 * PLACE_BITS) | place) << MARK_BITS | mark as u64)
    }

    pub(super) fn quantity(self) -> usize {
        (self.0 >> (MARK_BITS + 2 * PLACE_BITS)) as usize
    }

    pub(super) fn key(self) -> BlockKey {
        let place = |shift: u32| (self.0 >> shift) as u32 & ((1 << PLACE_BITS) - 1);
        [place(MARK_BITS + PLACE_BITS), place(MARK_BITS)]
    }

    pub(super) fn mark(self) -> usize {
        self.0 as usize & ((1 << MARK_BITS) - 1)
    }

    pub(super) fn same_block(a: &MarkEntry, b: &MarkEntry) -> bool {
        a.0 >> MARK_BITS == b.0 >> MARK_BITS
    }
}
