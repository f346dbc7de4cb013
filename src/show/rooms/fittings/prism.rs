use super::finish::Finish;
use crate::math::Vec2;

/// An upright prism over a convex footprint.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Fitting {
    /// Corners, counter-clockwise, metres.
    pub footprint: Vec<Vec2>,
    /// Heights of its underside and of its top, metres.
    pub span_m: [f64; 2],
    pub finish: Finish,
}
