//! Fixed-point units of the sums.

/// Sum of `passes` for one print of full coverage at mean pressure.
pub const PASSES_ONE: f32 = 256.0;

/// Sum of `wheels` for one wheel.
pub const WHEELS_ONE: f32 = 256.0;

/// Sum of `presence` for one pass.
pub const PRESENCE_ONE: f32 = 1024.0;

/// Sum of `dwell` for one second.
pub const DWELL_ONE: f32 = 256.0;

/// Sum of `soil`, `scuff` and wall causes for an optical density of 1.
pub const DENSITY_ONE: f32 = 4096.0;
