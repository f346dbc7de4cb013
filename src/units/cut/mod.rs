//! Cuts units out of a motion at a spot.

mod cutter;
mod groups;
mod options;
mod stretch;
mod walks;

pub use cutter::{UnitCut, UnitCuts, cut};
pub use options::CutOptions;

#[cfg(test)]
mod tests;
