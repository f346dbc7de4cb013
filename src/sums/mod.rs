//! Adds stamps as exact integers in sparse blocks, identical for any order or thread count.
//!
//! A batch of marks is first binned to the blocks that it touches (coarse). Then each block adds its marks (fine),
//! blocks in parallel. A stamp adds integers that depend only on the mark, its pattern, the nearby walls and the grid,
//! and integer sums do not depend on their order. Blocks are allocated on first use and hold 16 bits per texel until a
//! texel needs 32, so memory grows with the touched area.

mod add;
mod add_wall;
mod batch;
mod blocks;
mod error;
mod floor;
mod floor_sums;
mod quantity;
#[cfg(test)]
mod tests;
mod wall;

pub(crate) use blocks::BLOCK;
pub use error::{SumsError, WallsOfSums};
pub use floor_sums::FloorSums;
pub use quantity::Quantity;
pub use wall::WallSums;
