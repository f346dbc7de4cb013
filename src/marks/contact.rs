//! Wall contacts.

use crate::patterns::Cause;

/// A contact: a touch of a wall by a body part, luggage or a shoe.
///
/// Faces are unrolled, so a drag continues round a corner. Arc length grows to the right for a viewer of the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Cause: one of [`Cause::WALL`].
    pub cause: Cause,
    /// Index into [`crate::walls::Walls::faces`].
    pub face: u32,
    /// Arc length of the stain's middle, metres: modulo the length of a closed face; up to half a stain beyond the ends
    /// of an open one.
    pub along_m: f64,
    /// Height of the stain's middle above the floor, metres.
    pub height_m: f64,
    /// Direction of the pattern's +x (of a drag), radians counter-clockwise for a viewer of the wall; 0 to the right.
    pub direction_rad: f32,
    /// Index into [`crate::patterns::PatternLibrary::patterns`].
    pub pattern: u16,
    /// Whether the pattern is mirrored about its long axis.
    pub mirrored: bool,
    /// Length along the pattern's x axis, metres; the pattern is stretched to it.
    pub length_m: f32,
    /// Extent across, metres.
    pub breadth_m: f32,
    /// Optical density at full coverage.
    pub strength: f32,
    /// Random word of the contact, expanded into blur, blotches and fade by the stamp.
    pub variation: u64,
}
