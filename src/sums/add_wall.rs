//! Adds batches of contacts: coarse (stains to blocks), then fine (texels of a block).

use rayon::prelude::*;

use super::blocks::{BLOCK, BlockCells, BlockKey, SumBlock};
use super::wall::{StripKey, WallSums};
use crate::marks::Contact;
use crate::stamps::{PlacedStain, TexelWindow, WallStamper};

/// Number of contacts in a batch: limits the memory of their stains.
const CONTACTS_AT_A_TIME: usize = 1 << 14;

/// A stain that touches a block; sorts by strip, block and stain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct StainEntry {
    strip: StripKey,
    block: BlockKey,
    stain: usize,
}

impl WallSums {
    /// Adds the stamps of contacts, in parallel in the current rayon pool.
    ///
    /// The sums do not depend on the order of contacts, their split into calls or the number of threads. Invalid
    /// contacts (pattern of another cause, face outside the grid, non-finite position) are skipped. A stamper with
    /// another grid adds nothing.
    pub fn add(&mut self, stamper: &WallStamper, contacts: &[Contact]) {
        add(self, stamper, contacts);
    }
}

fn add(sums: &mut WallSums, stamper: &WallStamper, contacts: &[Contact]) {
    if stamper.grid() != &sums.grid {
        return;
    }
    for contacts in contacts.chunks(CONTACTS_AT_A_TIME) {
        let stains: Vec<PlacedStain> = contacts.par_iter().flat_map_iter(|contact| stamper.place(contact)).collect();
        let mut entries: Vec<StainEntry> =
            stains.iter().enumerate().flat_map(|(k, stain)| entries_of(stain, k)).collect();
        entries.par_sort_unstable();
        tasks(sums, &entries).into_par_iter().with_max_len(1).for_each(|(block, entries)| {
            entries.iter().for_each(|entry| stamp(stamper, &stains[entry.stain], block));
        });
    }
}

/// Returns the blocks that a stain touches.
fn entries_of(stain: &PlacedStain, number: usize) -> impl Iterator<Item = StainEntry> + use<> {
    let strip = (stain.cause.on_wall().unwrap_or(0), stain.face);
    let blocks = |low: i64, high: i64| (low / BLOCK as i64) as u32..(high as u64).div_ceil(BLOCK as u64) as u32;
    let (rows, columns) = (blocks(stain.bounds.j0, stain.bounds.j1), blocks(stain.bounds.i0, stain.bounds.i1));
    rows.flat_map(move |row| {
        columns.clone().map(move |column| StainEntry { strip, block: [row, column], stain: number })
    })
}

/// Pairs blocks with their entries; allocates missing blocks.
fn tasks<'a>(sums: &'a mut WallSums, entries: &'a [StainEntry]) -> Vec<(&'a mut SumBlock, &'a [StainEntry])> {
    let mut of_strips = entries.chunk_by(|a, b| a.strip == b.strip).peekable();
    for entries in of_strips.clone() {
        sums.strip_mut(entries[0].strip);
    }
    let mut tasks = Vec::new();
    for (&key, strip) in &mut sums.strips {
        if let Some(entries) = of_strips.next_if(|entries| entries[0].strip == key) {
            let of_blocks = entries.chunk_by(|a, b| a.block == b.block);
            tasks.extend(strip.blocks_at(of_blocks.map(|entries| (entries[0].block, entries))));
        }
    }
    tasks
}

/// Adds a stain to a block.
fn stamp(stamper: &WallStamper, stain: &PlacedStain, block: &mut SumBlock) {
    let [row, column] = block.key();
    let window = TexelWindow { i0: i64::from(column) * BLOCK as i64, j0: i64::from(row) * BLOCK as i64 };
    match block.cells_for(stain.peak.into()) {
        BlockCells::Narrow(cells) => stamper.add(stain, window, cells),
        BlockCells::Wide(cells) => stamper.add(stain, window, cells),
    }
}
