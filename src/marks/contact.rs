use crate::patterns::Cause;

/// A body part's, a bag's or a shoe's touching of a wall.
///
/// Places on a wall are `along_m`, the arc length from the start of its face (it grows to the right for who looks at the
/// wall), and the height above the floor. A drag goes on round a corner: the face is unrolled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// What leaves it: one of [`Cause::WALL`].
    pub cause: Cause,
    /// Index into [`crate::walls::Walls::faces`].
    pub face: u32,
    /// Middle of the stain along the face, metres. On a closed face it is taken modulo the face's length; at the ends of an
    /// open one it may lie beyond by half of the stain.
    pub along_m: f64,
    /// Middle of the stain above the floor, metres.
    pub height_m: f64,
    /// Where the pattern's +x (the way a drag goes) points: radians counter-clockwise for who looks at the wall, 0 to the
    /// right.
    pub direction_rad: f32,
    /// Index into [`crate::patterns::PatternLibrary::patterns`].
    pub pattern: u16,
    /// Whether the pattern is mirrored about its long axis.
    pub mirrored: bool,
    /// Real length along the pattern's x axis, metres: the pattern is stretched to it.
    pub length_m: f32,
    /// Real extent across, metres.
    pub breadth_m: f32,
    /// Optical density where the pattern covers fully.
    pub strength: f32,
    /// Expanded by the stamp into all its variation: blur, blotches, how a drag fades.
    pub variation: u64,
}
