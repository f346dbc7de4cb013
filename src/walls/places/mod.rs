//! Places of note along the walls: corners and doorways.

mod corners;
mod doorways;
mod rays;
#[cfg(test)]
mod tests;

use super::Walls;
use crate::math::Vec2;

/// A place where a face turns by more than a little.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Index into [`super::Walls::faces`].
    pub face: usize,
    /// Arc length from the face's start, metres.
    pub along_m: f64,
    /// The vertex, metres.
    pub point_m: Vec2,
    /// How far the face turns there, radians; positive at an inner corner (the floor fills less than a half turn),
    /// negative at an outer one.
    pub turn_rad: f64,
}

/// A gap between two wall ends that is as wide as a door: 0.7 to 2.0 m, with more floor on either side.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Doorway {
    /// Middles of the two jambs, metres: the line from one to the other is the threshold.
    pub jambs_m: [Vec2; 2],
    /// Index into [`super::Walls::faces`] and arc length of each jamb's middle, metres.
    pub on_faces: [(usize, f64); 2],
    /// Thickness of the wall that it goes through, metres.
    pub depth_m: f64,
    /// Unit vector through the door, across the threshold.
    pub through: Vec2,
    /// Height of its head above the floor, metres: [`DOOR_HEAD_M`] unless a scenario says otherwise.
    pub head_m: f64,
}

/// Height of a door's head above the floor that nobody tells of, metres.
pub const DOOR_HEAD_M: f64 = 2.1;

impl Doorway {
    /// Clear width, metres.
    pub fn width_m(&self) -> f64 {
        self.jambs_m[0].distance(self.jambs_m[1])
    }
}

/// Range of a door's clear width, metres.
pub const DOOR_WIDTHS_M: [f64; 2] = [0.7, 2.0];

impl Walls {
    /// Every place where a face turns by more than 20 degrees, by face and arc length.
    ///
    /// Vertices that lie within a few centimetres count as one, with the sum of their turns: the end of a thin wall is one
    /// corner of a half turn, a step of a pixel is none. The small turns of a curved wall are no corners.
    pub fn corners(&self) -> Vec<Corner> {
        let mut corners = Vec::new();
        for (number, face) in self.faces.iter().enumerate() {
            corners::of_face(number, face, &mut corners);
        }
        corners
    }

    /// Every gap that reads as a door, by face and arc length of the first jamb: 0.7 to 2.0 m wide, through a wall of up
    /// to 0.65 m, with room on both sides. A corridor is none, nor is the space beside a pillar, unless the pillar is the
    /// middle post of a double door.
    pub fn doorways(&self) -> Vec<Doorway> {
        doorways::find(self)
    }

    /// The doorway that somebody says is at a place: the gap of about this clear width across it, whatever lies on
    /// either side; `None` where there are no two jambs, both within one width of `at_m`.
    pub fn doorway_at(&self, at_m: Vec2, width_m: f64) -> Option<Doorway> {
        doorways::across(self, at_m, width_m)
    }
}
