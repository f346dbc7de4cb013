//! Noise settings: lognormal variation at three sizes.

use serde::{Deserialize, Serialize};

/// Lognormal noise in three octaves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct NoiseLook {
    /// Grain.
    pub fine: Octave,
    /// Blotches.
    pub middle: Octave,
    /// Clouds.
    pub coarse: Octave,
}

/// One octave of noise: size and standard deviation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Octave {
    /// Typical size of a spot, metres, 0.002 to 20.
    pub size_m: f64,
    /// Standard deviation of the logarithm, 0 to 1.
    pub sd: f32,
}

impl Default for NoiseLook {
    fn default() -> NoiseLook {
        NoiseLook {
            fine: Octave { size_m: 0.02, sd: 0.10 },
            middle: Octave { size_m: 0.15, sd: 0.12 },
            coarse: Octave { size_m: 1.2, sd: 0.15 },
        }
    }
}
