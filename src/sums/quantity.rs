//! Quantities that are summed up on the floor.

use crate::stamps::{DENSITY_ONE, PASSES_ONE, PRESENCE_ONE};

/// A quantity that is summed up on the floor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Quantity {
    /// All footfalls: coverage times pressure.
    Passes,
    /// All footfalls: the expectation of `passes`, a soft kernel along the heading, on a coarser grid.
    Presence,
    /// Footfalls of the last people since the floor was mopped: optical density of soil.
    Soil,
    /// Heel and toe marks: optical density.
    Scuff,
}

impl Quantity {
    /// Every quantity.
    pub const ALL: [Quantity; 4] = [Quantity::Passes, Quantity::Presence, Quantity::Soil, Quantity::Scuff];

    /// Fixed-point unit: the sum for one pass or an optical density of 1.
    ///
    /// `passes` 256, `presence` 1024, `soil` and `scuff` 4096. A pass is a print of full coverage at mean pressure; the
    /// transmittance of an optical density D is `exp(-D)`.
    pub const fn one(self) -> u32 {
        match self {
            Quantity::Passes => PASSES_ONE as u32,
            Quantity::Presence => PRESENCE_ONE as u32,
            Quantity::Soil | Quantity::Scuff => DENSITY_ONE as u32,
        }
    }

    /// Name in file and channel names.
    pub const fn name(self) -> &'static str {
        match self {
            Quantity::Passes => "passes",
            Quantity::Presence => "presence",
            Quantity::Soil => "soil",
            Quantity::Scuff => "scuff",
        }
    }
}
