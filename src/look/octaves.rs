//! Noise settings: lognormal variation at three sizes.

use crate::options::options;

options! {
    /// Lognormal noise in three octaves.
    #[derive(Copy)]
    pub struct NoiseLook {
        /// Grain: size of a spot, deviation of the logarithm.
        fine: Octave = Octave { size_m: 0.02, sd: 0.10 }, eg "{ size_m = 0.02, sd = 0.1 }";
        /// Blotches.
        middle: Octave = Octave { size_m: 0.15, sd: 0.075 }, eg "{ size_m = 0.15, sd = 0.075 }";
        /// Clouds.
        coarse: Octave = Octave { size_m: 1.2, sd: 0.15 }, eg "{ size_m = 1.2, sd = 0.15 }";
    }
}

options! {
    /// One size of unevenness.
    #[derive(Copy)]
    pub struct Octave {
        /// Typical size of a spot.
        size_m: f64 = 0.15, in 0.002..=20.0, unit "m";
        /// Standard deviation of the logarithm.
        sd: f32 = 0.12, in 0.0..=1.0;
    }
}
