use serde::{Deserialize, Serialize};

/// Unit of the lengths in a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum LengthUnit {
    /// Metres.
    #[serde(rename = "m")]
    Metre,
    /// Centimetres.
    #[serde(rename = "cm")]
    Centimetre,
    /// Millimetres.
    #[serde(rename = "mm")]
    Millimetre,
    /// Feet.
    #[serde(rename = "ft")]
    Foot,
}

impl LengthUnit {
    /// All units.
    pub const ALL: [LengthUnit; 4] =
        [LengthUnit::Metre, LengthUnit::Centimetre, LengthUnit::Millimetre, LengthUnit::Foot];

    /// Name in scenarios and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            LengthUnit::Metre => "m",
            LengthUnit::Centimetre => "cm",
            LengthUnit::Millimetre => "mm",
            LengthUnit::Foot => "ft",
        }
    }

    /// Metres per unit.
    pub const fn metres(self) -> f64 {
        match self {
            LengthUnit::Metre => 1.0,
            LengthUnit::Centimetre => 0.01,
            LengthUnit::Millimetre => 0.001,
            LengthUnit::Foot => 0.3048,
        }
    }
}
