//! Adds batches of marks: coarse (marks to blocks), then fine (texels of a block).

use rayon::prelude::*;

use super::batch::{Batch, MARKS_AT_A_TIME, MarkEntry, PLACE_BITS};
use super::blocks::{BLOCK, BlockCells, SumBlock};
use super::floor::FloorMask;
use super::floor_sums::FloorSums;
use super::quantity::Quantity;
use crate::marks::Mark;
use crate::patterns::Cause;
use crate::stamps::{MarkBounds, PlacedMark, PrintCoverage, Stamper, SumCell, TexelBounds, TexelGrid, TexelWindow};
use crate::walls::Walls;

/// A block and the marks that touch it.
struct Task<'a> {
    quantity: Quantity,
    block: &'a mut SumBlock,
    floor: &'a FloorMask,
    entries: &'a [MarkEntry],
}

/// The marks of a batch, placed among the walls.
struct BatchMarks<'a> {
    stamper: &'a Stamper,
    walls: &'a Walls,
    marks: &'a [Mark],
    placed: &'a [Option<PlacedMark>],
}

impl FloorSums {
    /// Adds the stamps of marks, in parallel in the current rayon pool.
    ///
    /// The sums do not depend on the order of marks, their split into calls or the number of threads. Invalid marks
    /// (pattern of another cause, non-finite position) are skipped. `stamper` must have the same grid; `walls` must be
    /// the same in all calls.
    pub fn add(&mut self, stamper: &Stamper, walls: &Walls, marks: &[Mark]) {
        add(self, stamper, walls, marks);
    }
}

/// Effort below which a footfall wears as any other, passes.
const LEAST_EFFORT: f32 = 0.05;

/// Number of marks that a thread places per task.
const MARKS_OF_A_THREAD: usize = 1 << 12;

fn add(sums: &mut FloorSums, stamper: &Stamper, walls: &Walls, marks: &[Mark]) {
    let mut batch = std::mem::take(&mut sums.batch);
    for marks in marks.chunks(MARKS_AT_A_TIME) {
        bin(sums, stamper, walls, marks, &mut batch);
        let of = |coarse: bool| {
            let is_wanted = move |e: &MarkEntry| Quantity::ALL[e.quantity()].is_coarse() == coarse;
            batch
                .entries
                .chunk_by(MarkEntry::same_block)
                .map(|entries| entries[0])
                .filter(is_wanted)
                .map(MarkEntry::key)
        };
        sums.texel_floor.prepare(of(false), walls);
        sums.cell_floor.prepare(of(true), walls);
        let marks = BatchMarks { stamper, walls, marks, placed: &batch.placed };
        let tasks = tasks(sums, &batch.entries);
        tasks
            .into_par_iter()
            .with_max_len(1)
            .for_each_init(PrintCoverage::new, |sheet, task| fine(task, &marks, sheet));
    }
    sums.batch = batch;
}

/// Places the marks and finds the blocks that each touches; sorts the entries.
fn bin(sums: &FloorSums, stamper: &Stamper, walls: &Walls, marks: &[Mark], batch: &mut Batch) {
    let parts: Vec<(Vec<Option<PlacedMark>>, Vec<MarkEntry>)> = marks
        .par_chunks(MARKS_OF_A_THREAD)
        .enumerate()
        .map(|(part, marks)| {
            let mut entries = Vec::with_capacity(4 * marks.len());
            let placed = marks.iter().enumerate().map(|(k, mark)| {
                let (placed, touched) = stamper.place(mark, walls)?;
                push_entries(sums, mark, &touched, part * MARKS_OF_A_THREAD + k, &mut entries);
                Some(placed)
            });
            (placed.collect(), entries)
        })
        .collect();
    batch.placed.clear();
    batch.entries.clear();
    for (placed, entries) in parts {
        batch.placed.extend(placed);
        batch.entries.extend(entries);
    }
    batch.entries.par_sort_unstable();
}

fn push_entries(sums: &FloorSums, mark: &Mark, touched: &MarkBounds, number: usize, entries: &mut Vec<MarkEntry>) {
    let mut push = |quantity: Quantity, grid: TexelGrid, bounds: TexelBounds| {
        let blocks = |low: i64, high: i64, count: u32| {
            let size = BLOCK as i64;
            let (low, high) = (low.max(0), high.min(count.into()).min(size << PLACE_BITS));
            if low < high { (low / size) as u32..((high - 1) / size) as u32 + 1 } else { 0..0 }
        };
        for row in blocks(bounds.j0, bounds.j1, grid.height) {
            for column in blocks(bounds.i0, bounds.i1, grid.width) {
                entries.push(MarkEntry::new(quantity, [row, column], number));
            }
        }
    };
    match mark.cause {
        Cause::Sole if mark.stood_s > 0.0 => push(Quantity::Dwell, sums.presence_grid, touched.cells),
        Cause::Sole if mark.wheel_m > 0.0 => push(Quantity::Wheels, sums.grid, touched.texels),
        Cause::Sole => {
            push(Quantity::Passes, sums.grid, touched.texels);
            push(Quantity::Presence, sums.presence_grid, touched.cells);
            if mark.effort >= LEAST_EFFORT {
                push(Quantity::Grind, sums.presence_grid, touched.cells);
            }
            if touched.soil {
                push(Quantity::Soil, sums.grid, touched.texels);
            }
            if touched.wet {
                push(Quantity::Wet, sums.grid, touched.texels);
            }
        }
        Cause::Heel => push(Quantity::Scuff, sums.grid, touched.texels),
        Cause::Hand | Cause::Arm | Cause::Shoulder | Cause::Bag | Cause::Shoe => {}
    }
}

/// Pairs blocks with their entries; allocates missing blocks on floor.
fn tasks<'a>(sums: &'a mut FloorSums, entries: &'a [MarkEntry]) -> Vec<Task<'a>> {
    let (texel_floor, cell_floor) = (&sums.texel_floor, &sums.cell_floor);
    let mut tasks = Vec::new();
    for (quantity, plane) in Quantity::ALL.into_iter().zip(&mut sums.planes) {
        let floor = if quantity.is_coarse() { cell_floor } else { texel_floor };
        let first = entries.partition_point(|e| e.quantity() < quantity as usize);
        let end = entries.partition_point(|e| e.quantity() <= quantity as usize);
        let of_blocks = entries[first..end]
            .chunk_by(MarkEntry::same_block)
            .map(|entries| (entries[0].key(), entries))
            .filter(|(key, _)| !floor.get(*key).is_none());
        tasks.extend(plane.blocks_at(of_blocks).into_iter().map(|(block, entries)| {
            let floor = floor.get(block.key());
            Task { quantity, block, floor, entries }
        }));
    }
    tasks
}

/// Adds all marks of a block to its texels.
fn fine(task: Task, marks: &BatchMarks, sheet: &mut PrintCoverage) {
    let Task { quantity, block, floor, entries } = task;
    let [row, column] = block.key();
    let window = TexelWindow { i0: i64::from(column) * BLOCK as i64, j0: i64::from(row) * BLOCK as i64 };
    for entry in entries {
        let mark = &marks.marks[entry.mark()];
        let Some(placed) = &marks.placed[entry.mark()] else { continue };
        let peak = match quantity {
            Quantity::Passes => marks.stamper.peak_of_passes(mark),
            Quantity::Presence | Quantity::Dwell => marks.stamper.peak_of_presence(placed),
            Quantity::Grind => marks.stamper.peak_of_grind(placed),
            Quantity::Soil => marks.stamper.peak_of_soil(mark.soil),
            Quantity::Wet => marks.stamper.peak_of_soil(mark.wet),
            Quantity::Scuff => marks.stamper.peak_of_scuff(mark),
            Quantity::Wheels => marks.stamper.peak_of_wheel(mark),
        };
        match block.cells_for(peak) {
            BlockCells::Narrow(cells) => stamp(quantity, mark, placed, marks, window, sheet, cells),
            BlockCells::Wide(cells) => stamp(quantity, mark, placed, marks, window, sheet, cells),
        }
    }
    floor.clear_outside(block.cells_mut());
}

/// Adds one mark to the cells of a block.
fn stamp<C: SumCell>(
    quantity: Quantity,
    mark: &Mark,
    placed: &PlacedMark,
    marks: &BatchMarks,
    window: TexelWindow,
    sheet: &mut PrintCoverage,
    cells: &mut [C],
) {
    let BatchMarks { stamper, walls, .. } = *marks;
    match quantity {
        Quantity::Passes => stamper.add_passes(mark, placed, walls, window, sheet, cells),
        Quantity::Presence | Quantity::Dwell => stamper.add_presence(mark, placed, walls, window, cells),
        Quantity::Grind => stamper.add_grind(mark, placed, walls, window, cells),
        Quantity::Soil => stamper.add_soil(mark, mark.soil, placed, walls, window, sheet, cells),
        Quantity::Wet => stamper.add_soil(mark, mark.wet, placed, walls, window, sheet, cells),
        Quantity::Scuff => stamper.add_scuff(mark, placed, walls, window, sheet, cells),
        Quantity::Wheels => stamper.add_wheel(mark, placed, walls, window, sheet, cells),
    }
}
