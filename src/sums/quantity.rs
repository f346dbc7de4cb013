//! Quantities summed on the floor.

use crate::stamps::{DENSITY_ONE, DWELL_ONE, PASSES_ONE, PRESENCE_ONE, WHEELS_ONE};

/// A quantity summed on the floor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Quantity {
    /// Coverage times pressure of all footfalls.
    Passes,
    /// Expectation of `passes`: a soft kernel along the heading per footfall, on a coarser grid.
    Presence,
    /// Optical density of soil, from footfalls of the last people since the floor was mopped.
    Soil,
    /// Optical density of heel and toe marks.
    Scuff,
    /// Seconds that soles stood, on the grid of `presence`.
    Dwell,
    /// Wear of turns, stops and starts beyond that of steps straight on, in passes, on the grid of `presence`.
    Grind,
    /// Optical density of what the shoes of the same people would leave that came in from the rain.
    Wet,
    /// Wheels that rolled over, more where they scrub in curves.
    Wheels,
}

impl Quantity {
    /// Every quantity.
    pub const ALL: [Quantity; 8] = [
        Quantity::Passes,
        Quantity::Presence,
        Quantity::Soil,
        Quantity::Scuff,
        Quantity::Dwell,
        Quantity::Grind,
        Quantity::Wet,
        Quantity::Wheels,
    ];

    /// Whether the quantity has the coarse grid of `presence`.
    pub const fn is_coarse(self) -> bool {
        matches!(self, Quantity::Presence | Quantity::Dwell | Quantity::Grind)
    }

    /// Fixed-point unit: the sum for one pass or an optical density of 1.
    ///
    /// 256 for `passes`, `dwell` and `wheels`, 1024 for `presence` and `grind`, 4096 for `soil`, `scuff` and `wet`. A pass is
    /// a print of full coverage at mean pressure; an optical density D has the transmittance `exp(-D)`.
    pub const fn one(self) -> u32 {
        match self {
            Quantity::Passes => PASSES_ONE as u32,
            Quantity::Dwell => DWELL_ONE as u32,
            Quantity::Wheels => WHEELS_ONE as u32,
            Quantity::Presence | Quantity::Grind => PRESENCE_ONE as u32,
            Quantity::Soil | Quantity::Scuff | Quantity::Wet => DENSITY_ONE as u32,
        }
    }

    /// Name of the quantity in files and channels.
    pub const fn name(self) -> &'static str {
        match self {
            Quantity::Passes => "passes",
            Quantity::Presence => "presence",
            Quantity::Soil => "soil",
            Quantity::Scuff => "scuff",
            Quantity::Dwell => "dwell",
            Quantity::Grind => "grind",
            Quantity::Wet => "wet",
            Quantity::Wheels => "wheels",
        }
    }
}
