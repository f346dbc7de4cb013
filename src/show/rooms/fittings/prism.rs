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
    /// What is known of a door leaf.
    pub leaf: Option<LeafUse>,
}

/// How people use a door leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LeafUse {
    /// The hinge, at the face that people push, metres.
    pub hinge: Vec2,
    /// Length of the leaf, metres.
    pub length_m: f64,
    /// How much people walk through the door, 0 to 1.
    pub used: f32,
}
