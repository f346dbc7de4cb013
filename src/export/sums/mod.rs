//! Exact sums as lossless files.

mod file;
mod floor;
mod walls;

pub use floor::{read_sums, write_sums};
pub use walls::{read_wall_sums, write_wall_sums};
