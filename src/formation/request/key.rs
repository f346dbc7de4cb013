use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::Assign;
use crate::math::Vec2;

/// A key formation: `[[formation.key]]`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KeyRequest {
    /// Time at which people are in the formation, seconds.
    pub time_s: f64,
    /// Time for which they stay in it, seconds.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub hold_s: f64,
    /// A named shape; left out if a text, points or a file are given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<FormationShape>,
    /// Letters along whose strokes people stand.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub text: Option<String>,
    /// The position of each person, `[x, y]` in metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<Vec<Vec2>>,
    /// A picture of dots or of a shape, or points as text; relative to the scenario.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<PathBuf>,
    /// Side of a pixel of the picture, metres; left out: 0.1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub metres_per_pixel: Option<f64>,
    /// Whether people fill the shape drawn in the picture, or the inside of a polygon or star.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub filled: Option<bool>,
    /// Number of people in a row of a grid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub columns: Option<u32>,
    /// Number of concentric rings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rings: Option<u32>,
    /// Number of corners of a polygon, or of points of a star.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub corners: Option<u32>,
    /// Ratio of a star's inner to its outer radius.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inner: Option<f64>,
    /// Angle between the two lines of a wedge, degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle_deg: Option<f64>,
    /// Distance between neighbours, metres; left out: 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spacing_m: Option<f64>,
    /// Radius of rings, discs, polygons and stars, metres; left out: by the spacing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Height of letters, metres; left out: by the spacing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height_m: Option<f64>,
    /// Centroid of the formation, metres; left out: the origin, or the example's own centroid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<Vec2>,
    /// Rotation of the formation, counter-clockwise, degrees.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub turn_deg: f64,
    /// Rotation of the crowd as one body from the key formation before to this one, counter-clockwise, degrees.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub wheel_deg: f64,
    /// Scale factor.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<f64>,
    /// Assignment of people to positions; left out: the crowd's default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub assign: Option<Assign>,
}

#[allow(clippy::trivially_copy_pass_by_ref)] // serde gives a reference
fn is_zero(number: &f64) -> bool {
    *number == 0.0
}

/// A named formation. Up is forward.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FormationShape {
    /// The example's own positions at that time.
    Example,
    /// Rows one behind the other.
    Grid,
    /// A line, side by side.
    Line,
    /// A ring, or concentric rings.
    Ring,
    /// Evenly in a disc.
    Disc,
    /// Rows of one, two, three and so on, the tip in front; or, with `filled = false`, its sides.
    Triangle,
    /// Along the sides of a polygon, or in it.
    Polygon,
    /// Along the outline of a star, or in it.
    Star,
    /// A wedge: one person in front, the others behind to the left and the right.
    Wedge,
}
