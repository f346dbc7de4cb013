//! Reads a plan image and finds its floor.
//!
//! Turns an image (or a ROS map YAML) and a scale into a [`FloorPlan`]: the floor mask, the scale and the openings at
//! the image's sides.

use crate::math::{Vec2, sin_cos, vec2};

mod arcs;
mod box_doors;
mod class;
mod clearance;
mod colour;
mod colour_areas;
mod floor_pieces;
mod furnished;
mod gap_widths;
mod guess;
mod hatching;
mod components;
mod corrections;
pub(crate) mod cracks;
mod crop;
mod depths;
mod doors;
mod doubts;
mod drawing;
mod error;
mod image_file;
mod ink;
mod layer;
mod level_map;
mod lightness;
mod likely;
mod limits;
mod mask;
mod open_ground;
mod openings;
mod options;
mod paint;
mod palette;
mod parts;
mod paving;
mod pixels;
mod printed;
mod read;
mod regions;
mod ros_map;
mod scale;
mod shadow;
mod sheet;
mod similar;
mod skew;
mod spaces;
mod squared;
mod symbols;
mod thick;
mod thin_lines;
mod tones;
mod wall_tops;
mod understand;
mod vector;

pub use class::PlanClass;
pub use colour::{Colour, ColourError};
pub use error::PlanError;
pub(crate) use limits::{
    ASSUMED_M_PER_PX, LARGEST_AREA_PX, LARGEST_COORDINATE, LARGEST_M_PER_PX, LARGEST_ORIGIN_M, LARGEST_SIDE_M,
    LARGEST_SIDE_PX, SMALLEST_M_PER_PX,
};
pub use options::{
    DoorAt, DoorToOpen, PixelPoint, PlanLayers, PlanOptions, PlanPoint, TransparentPolicy, TwoPoints, UnknownPolicy,
};
pub use paint::{Paint, Painted, PaintedEntrance};
pub(crate) use parts::DoorKind;
pub use parts::{FurniturePiece, PlanDoor, PlanWindow};
pub use read::{files, picture, read};
pub use scale::{PlanScale, ScaleSource};
pub(crate) use sheet::{homography, mapped};
pub use vector::VectorFormat;

/// Least width of an opening, metres.
pub(crate) const NARROWEST_OPENING_M: f64 = 0.6;

/// A floor plan: floor mask, scale, regions and openings.
#[derive(Clone, Debug)]
pub struct FloorPlan {
    /// Image width in pixels.
    pub width_px: u32,
    /// Image height in pixels.
    pub height_px: u32,
    /// Side of a pixel in metres.
    pub metres_per_pixel: f64,
    /// Where that comes from, and how sure it is.
    pub scale: PlanScale,
    /// One byte per pixel in image order (row 0 at the top, the largest y): 1 for walkable floor.
    /// White that people cannot reach (outside, hollow walls, closed shafts) is 0.
    pub floor: Vec<u8>,
    /// Lightness of each pixel, 0 (wall) to 255 (floor), in image order. Anti-aliased edges lie in between,
    /// from which `walls` takes sub-pixel positions.
    pub lightness: Vec<u8>,
    /// What the plan shows at each pixel, in image order.
    pub classes: Vec<PlanClass>,
    /// Entrances and floor kept clean, as painted over the plan.
    pub painted: Painted,
    /// Whether a robot measured it, rather than somebody drawing it: walls are ragged, rooms partly seen.
    pub scanned: bool,
    /// Lightness at which wall ends and floor begins, 128 by default.
    pub threshold: u8,
    /// Pose of the plan frame in the map frame; the identity without a ROS map.
    pub map_from_plan: Pose,
    /// All connected white regions, largest first.
    pub regions: Vec<Region>,
    /// Openings at the image's sides.
    pub openings: Vec<Opening>,
    /// Doors: gaps between two jambs.
    pub doors: Vec<PlanDoor>,
    /// Windows, closed.
    pub windows: Vec<PlanWindow>,
    /// Furniture on the floor.
    pub furniture: Vec<FurniturePiece>,
    /// Warnings for the user, such as an assumed scale.
    pub warnings: Vec<String>,
    /// What a vector drawing tells beyond pixels; `None` for pictures.
    pub drawn: Option<Drawn>,
}

/// What a vector drawing tells beyond pixels, in the plan frame.
#[derive(Clone, Debug, Default)]
pub struct Drawn {
    /// Both jambs of each door, metres.
    pub doors: Vec<[Vec2; 2]>,
    /// Ways of robots and people, metres: the lanes of an Open-RMF building.
    pub lanes: Vec<[Vec2; 2]>,
}

impl FloorPlan {
    /// Classes of a plan of floor and walls alone: dark pixels are wall, white that is not floor is outside.
    fn plain_classes(&self) -> Vec<PlanClass> {
        let class = |(&floor, &lightness): (&u8, &u8)| match floor {
            0 if lightness < self.threshold => PlanClass::Wall,
            0 => PlanClass::Outside,
            _ => PlanClass::Floor,
        };
        self.floor.iter().zip(&self.lightness).map(class).collect()
    }

    /// Width in metres.
    pub fn width_m(&self) -> f64 {
        f64::from(self.width_px) * self.metres_per_pixel
    }

    /// Height in metres.
    pub fn height_m(&self) -> f64 {
        f64::from(self.height_px) * self.metres_per_pixel
    }

    /// Whether the pixel under a point of the plan frame is floor; false beyond the image.
    pub fn is_floor(&self, p: Vec2) -> bool {
        let [x, y] = self.m_to_px(p);
        // Comparisons are written so that NaN lands outside.
        let inside = x >= 0.0 && y >= 0.0 && x < f64::from(self.width_px) && y < f64::from(self.height_px);
        inside && self.floor[y as usize * self.width_px as usize + x as usize] != 0
    }

    /// The class under a point of the plan frame; outside beyond the image.
    pub fn class_at(&self, p: Vec2) -> PlanClass {
        let [x, y] = self.m_to_px(p);
        let inside = x >= 0.0 && y >= 0.0 && x < f64::from(self.width_px) && y < f64::from(self.height_px);
        let index = || y as usize * self.width_px as usize + x as usize;
        if inside { self.classes.get(index()).copied().unwrap_or_default() } else { PlanClass::Outside }
    }

    /// From pixels (from the top left, y down; whole numbers are pixel edges) to the plan frame.
    pub fn px_to_m(&self, [x, y]: [f64; 2]) -> Vec2 {
        Vec2 { x: x * self.metres_per_pixel, y: (f64::from(self.height_px) - y) * self.metres_per_pixel }
    }

    /// From the plan frame to pixels (from the top left, y down; whole numbers are pixel edges).
    pub fn m_to_px(&self, p: Vec2) -> [f64; 2] {
        [p.x / self.metres_per_pixel, f64::from(self.height_px) - p.y / self.metres_per_pixel]
    }
}

/// A rigid transform: rotation by `yaw_rad`, then translation.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Pose {
    /// Plan origin in the map frame, metres.
    pub origin_m: Vec2,
    /// Radians counter-clockwise.
    pub yaw_rad: f64,
}

impl Pose {
    /// The pose of a frame whose origin is at a point of this one.
    fn moved(self, to_m: Vec2) -> Pose {
        let (sine, cosine) = sin_cos(self.yaw_rad);
        Pose { origin_m: self.origin_m + to_m.rotated(vec2(cosine, sine)), ..self }
    }
}

/// A connected white region of a plan.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Region {
    /// Area in square metres.
    pub area_m2: f64,
    /// A point in it, far from its border, metres.
    pub inside_m: Vec2,
    /// Role of the region.
    pub role: RegionRole,
}

/// Role of a white region.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum RegionRole {
    /// Walkable floor.
    Floor,
    /// The paper around the building.
    Outside,
    /// Too narrow for a person, or unreachable.
    Unreached,
}

/// A side of the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
#[allow(missing_docs)]
pub enum Side {
    West,
    South,
    East,
    North,
}

impl Side {
    /// Unit vector that points out of the plan.
    pub fn outward(self) -> Vec2 {
        match self {
            Side::West => Vec2 { x: -1.0, y: 0.0 },
            Side::South => Vec2 { x: 0.0, y: -1.0 },
            Side::East => Vec2 { x: 1.0, y: 0.0 },
            Side::North => Vec2 { x: 0.0, y: 1.0 },
        }
    }
}

/// An opening: a stretch of an image side where floor continues beyond the plan, at least 0.6 m wide.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Opening {
    /// `west`, or `west 1`, `west 2`, ... (from the least x or y on) where a side has several.
    pub name: String,
    /// Side of the image.
    pub side: Side,
    /// The end of least x or y, metres.
    pub from_m: Vec2,
    /// The other end, metres.
    pub to_m: Vec2,
}

impl Opening {
    /// Width in metres.
    pub fn width_m(&self) -> f64 {
        self.from_m.distance(self.to_m)
    }

    /// Its middle.
    pub fn centre_m(&self) -> Vec2 {
        (self.from_m + self.to_m) * 0.5
    }
}
