use serde::{Deserialize, Serialize};

use super::{Colour, FloorPlan, PlanError};
use crate::math::{Vec2, vec2};

/// A point as a scenario writes it: `[x, y]` in metres, or `{ px = [x, y] }` in pixels from the image's top left.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum PlanPoint {
    /// Plan frame: metres from the lower-left corner, y up.
    Metres([f64; 2]),
    /// Pixels from the top left, y down.
    Pixels {
        /// `[x, y]`.
        px: [f64; 2],
    },
}

impl PlanPoint {
    /// The point in the plan frame.
    pub fn to_m(&self, plan: &FloorPlan) -> Vec2 {
        match *self {
            PlanPoint::Metres([x, y]) => vec2(x, y),
            PlanPoint::Pixels { px } => plan.px_to_m(px),
        }
    }
}

/// A known distance in the image, from which the scale follows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TwoPoints {
    /// One end; in pixels, because metres are not known yet.
    pub from: PixelPoint,
    /// The other end.
    pub to: PixelPoint,
    /// Distance between them, metres.
    pub metres: f64,
}

/// A place in the image: `{ px = [x, y] }`, pixels from the top left, y down.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PixelPoint {
    /// `[x, y]`.
    pub px: [f64; 2],
}

/// Meaning of transparent pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TransparentPolicy {
    /// White paper below an image; unknown in a ROS map, as its format defines.
    #[default]
    Auto,
    /// The image is laid on white paper.
    Paper,
    /// Pixels that are not opaque are wall.
    Wall,
    /// Pixels that are not opaque are floor.
    Floor,
}

/// Meaning of a ROS map's unknown pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum UnknownPolicy {
    /// Unknown is wall: the robot has not been there.
    #[default]
    Wall,
    /// Unknown is floor.
    Floor,
}

/// Options of reading a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PlanOptions {
    /// Side of a pixel, metres. Overrides a ROS map's.
    pub metres_per_pixel: Option<f64>,
    /// Scale by two points and their distance, instead of `metres_per_pixel`.
    pub scale: Option<TwoPoints>,
    /// Lightness, 0 to 255, at which wall ends and floor begins.
    pub threshold: Option<u8>,
    /// Colours (`"#c03030"`) that are wall although saturated colour is annotation otherwise.
    pub wall_colours: Vec<Colour>,
    /// Meaning of a ROS map's unknown pixels.
    pub unknown: UnknownPolicy,
    /// Meaning of transparent pixels.
    pub transparent: TransparentPolicy,
    /// Specks whose larger side is below this are dropped, metres: black ones in the floor, white ones in walls.
    pub speck_m: f64,
    /// Whether lettering, dashed lines and the outlines of coloured dots are dropped from drawings.
    pub drop_annotation: bool,
    /// Points of the floor: only the regions that hold them are floor. Empty: regions are chosen automatically.
    pub floor: Vec<PlanPoint>,
    /// Width of the narrowest person, metres, 0 to 5; narrower passages are unreachable.
    pub narrowest_m: f64,
}

impl Default for PlanOptions {
    fn default() -> PlanOptions {
        PlanOptions {
            metres_per_pixel: None,
            scale: None,
            threshold: None,
            wall_colours: Vec::new(),
            unknown: UnknownPolicy::default(),
            transparent: TransparentPolicy::default(),
            speck_m: 0.15,
            drop_annotation: true,
            floor: Vec::new(),
            narrowest_m: 0.4,
        }
    }
}

impl PlanOptions {
    /// Checks all ranges.
    pub(super) fn check(&self) -> Result<(), PlanError> {
        for (key, value, low, high) in
            [("speck_m", self.speck_m, 0.0, 10.0), ("narrowest_m", self.narrowest_m, 0.0, 5.0)]
        {
            if !(low..=high).contains(&value) {
                return Err(PlanError::OutOfRange { key, value, low, high });
            }
        }
        Ok(())
    }
}
