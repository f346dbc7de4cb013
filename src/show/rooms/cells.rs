//! Numbers sorted by cells of a grid.

/// Sorts pairs of a cell and a number by cell: where each cell's numbers start, and all numbers.
pub(super) fn by_cell(mut pairs: Vec<(u32, u32)>, cells: usize) -> (Vec<u32>, Vec<u32>) {
    pairs.sort_unstable();
    pairs.dedup();
    let mut starts = vec![0u32; cells + 1];
    pairs.iter().for_each(|pair| starts[pair.0 as usize + 1] += 1);
    for cell in 1..starts.len() {
        starts[cell] += starts[cell - 1];
    }
    (starts, pairs.into_iter().map(|pair| pair.1).collect())
}
