//! Limits on the size and the scale of plans.

/// Limit on the side of a plan image, pixels.
pub const LARGEST_SIDE_PX: u32 = 20_000;
/// Limit on the area of a plan image, pixels.
pub const LARGEST_AREA_PX: u64 = 268_435_456;
/// Finest allowed scale, metres per pixel.
pub const SMALLEST_M_PER_PX: f64 = 0.0005;
/// Coarsest allowed scale, metres per pixel.
pub const LARGEST_M_PER_PX: f64 = 10.0;
/// Limit on the side of a plan, metres.
pub const LARGEST_SIDE_M: f64 = 4000.0;
/// Default scale, metres per pixel: the usual one of indoor maps.
pub const ASSUMED_M_PER_PX: f64 = 0.05;
/// Limit on a coordinate that a scenario names, metres or pixels either way from 0.
pub const LARGEST_COORDINATE: f64 = 1e7;
/// Limit on the numbers of a ROS map's origin, metres or radians either way from 0.
pub const LARGEST_ORIGIN_M: f64 = 1e9;
