use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::Assign;
use crate::math::Vec2;

/// A formation at a time: `[[formation.key]]`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KeyRequest {
    /// When people stand so, seconds.
    pub time_s: f64,
    /// How long they stay in it.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub hold_s: f64,
    /// A named shape; left out where a text, points or a file say it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<FormationShape>,
    /// Letters that people stand along.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub text: Option<String>,
    /// A place for everybody, `[x, y]` in metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<Vec<Vec2>>,
    /// A picture of dots or of a shape, or points as text; relative to the scenario.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<PathBuf>,
    /// Side of a pixel of the picture, metres; left out: 0.1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub metres_per_pixel: Option<f64>,
    /// Whether people fill what is drawn in the picture, or the inside of a polygon or star.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub filled: Option<bool>,
    /// People side by side in a grid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub columns: Option<u32>,
    /// Rings one in the other.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rings: Option<u32>,
    /// Corners of a polygon, points of a star.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub corners: Option<u32>,
    /// Inner radius of a star over its outer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inner: Option<f64>,
    /// Angle between the two lines of a wedge, degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle_deg: Option<f64>,
    /// From one person to the next, metres; left out: 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spacing_m: Option<f64>,
    /// Radius of rings, discs, polygons and stars, metres; left out: by the spacing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Height of letters, metres; left out: by the spacing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height_m: Option<f64>,
    /// Where the middle of the formation is; left out: the origin, of the example's own places where they are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<Vec2>,
    /// How far it is turned, counter-clockwise, degrees.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub turn_deg: f64,
    /// How far the whole wheels around its middle from the key formation before to this one, counter-clockwise, degrees: as
    /// one body, whatever changes within.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub wheel_deg: f64,
    /// How many times as large.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<f64>,
    /// Who goes to which place; left out: as the whole says.
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
    /// As the example has it at that time.
    Example,
    /// Rows one behind the other.
    Grid,
    /// Side by side.
    Line,
    /// A ring, or rings one in the other.
    Ring,
    /// Evenly in a disc.
    Disc,
    /// Rows of one, two, three and so on, the tip in front; or, with `filled = false`, its sides.
    Triangle,
    /// Along the sides of a polygon, or in it.
    Polygon,
    /// Along the outline of a star, or in it.
    Star,
    /// Somebody in front, the others behind to the left and the right.
    Wedge,
}
