//! Poses of prints: place, heading and size of a pattern on the floor.

use super::TexelGrid;
use super::variation::{HeelVariation, MOST_BEND};
use super::window::floor;
use crate::marks::Mark;
use crate::math::Vec2;
use crate::patterns::Cause;

/// Radius around the ball that a twist moves, soles.
pub(super) const BALL_RADIUS: f64 = 0.25;

/// Largest twist, radians; larger ones are clamped.
pub(super) const WIDEST_TWIST: f32 = 1.0;

/// Pose of a pattern on the floor: position, heading, scale.
#[derive(Clone, Copy, Debug)]
pub(super) struct PrintPose {
    /// Middle of the pattern, metres.
    pub(super) place_m: Vec2,
    /// Unit vector along the pattern.
    pub(super) heading: Vec2,
    /// Scale along the heading.
    pub(super) scale_along: f64,
    /// Scale across the heading.
    pub(super) scale_across: f64,
    /// Whether left and right are swapped.
    pub(super) mirrored: bool,
}

impl PrintPose {
    /// Returns the pose of a footfall; `None` for a scale outside 0.2 to 5.
    pub(super) fn of_sole(mark: &Mark, pattern_length_m: f64) -> Option<PrintPose> {
        let scale = f64::from(mark.length_m) / pattern_length_m;
        (0.2..=5.0).contains(&scale).then_some(PrintPose {
            place_m: mark.place_m,
            heading: mark.heading,
            scale_along: scale,
            scale_across: scale,
            mirrored: mark.mirrored,
        })
    }

    /// Returns the pose of a heel mark; `None` for a scale outside 0.05 to 20.
    pub(super) fn of_heel(mark: &Mark, pattern_length_m: f64) -> Option<PrintPose> {
        let scale_along = f64::from(mark.length_m) / pattern_length_m;
        let variation = HeelVariation::new(mark.variation);
        (0.05..=20.0).contains(&scale_along).then_some(PrintPose {
            place_m: mark.place_m,
            heading: mark.heading,
            scale_along,
            // The mark gives the drag's length; the width depends on the shoe.
            scale_across: f64::from(variation.width),
            mirrored: mark.mirrored,
        })
    }

    /// Pattern position of a texel's centre along and across, and its change along i and j, metres.
    pub(super) fn along_across(&self, grid: &TexelGrid, origin: [i64; 2]) -> [[f64; 3]; 2] {
        let texel_m = grid.texel_m();
        let from_place = |k: i64, place_m: f64| (k as f64 + 0.5) * texel_m - place_m;
        let (dx, dy) = (from_place(origin[0], self.place_m.x), from_place(origin[1], self.place_m.y));
        let h = self.heading;
        let along = 1.0 / self.scale_along;
        // Image rows run to the right of the heading.
        let across = if self.mirrored { -1.0 } else { 1.0 } / self.scale_across;
        [
            [dx * h.x + dy * h.y, h.x * texel_m, h.y * texel_m].map(|v| v * along),
            [dx * h.y - dy * h.x, h.y * texel_m, -h.x * texel_m].map(|v| v * across),
        ]
    }

    /// The texel that holds the pattern's centre, the origin of the print's texel coordinates.
    pub(super) fn origin(&self, grid: &TexelGrid) -> [i64; 2] {
        [self.place_m.x, self.place_m.y].map(|m| floor(m * grid.texels_per_metre))
    }
}

/// Distance by which a twist extends a print's outline, metres.
pub(super) fn twist_reach_m(mark: &Mark) -> f64 {
    if mark.twist_rad == 0.0 {
        return 0.0;
    }
    f64::from(mark.twist_rad.abs().min(WIDEST_TWIST)) * BALL_RADIUS * 2.0 * f64::from(mark.length_m)
}

/// Distance by which a bend displaces the ends of a heel mark, metres.
pub(super) fn bend_reach_m(mark: &Mark) -> f64 {
    if mark.cause == Cause::Heel { f64::from(MOST_BEND * mark.length_m) } else { 0.0 }
}
