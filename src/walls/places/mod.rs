//! Corners and doorways of walls.

mod corners;
mod doorways;
mod rays;
#[cfg(test)]
mod tests;

use super::Walls;
use crate::math::Vec2;

pub use corners::Corner;
pub use doorways::{DOOR_HEAD_M, Doorway};

impl Walls {
    /// Corners of all faces: turns of more than 20 degrees, by face and arc length.
    ///
    /// Vertices within a few centimetres form one corner with the sum of their turns: the end of a thin wall is one
    /// corner of 180 degrees; steps of one pixel and the small turns of a curved wall do not count.
    pub fn corners(&self) -> Vec<Corner> {
        let mut corners = Vec::new();
        for (number, face) in self.faces.iter().enumerate() {
            corners::of_face(number, face, &mut corners);
        }
        corners
    }

    /// Doorways of the plan, by face and arc length of the first jamb.
    ///
    /// Gaps of 0.7 to 2.0 m through walls of up to 0.65 m, with room on both sides. Corridors do not count, nor gaps
    /// beside pillars, except the middle post of a double door.
    pub fn doorways(&self) -> Vec<Doorway> {
        doorways::find(self)
    }

    /// Returns the doorway at a given place: the gap across it of about the clear width `width_m`. Any floor may be on
    /// either side. `None` without two jambs, each within `width_m` of `at_m`.
    pub fn doorway_at(&self, at_m: Vec2, width_m: f64) -> Option<Doorway> {
        doorways::across(self, at_m, width_m)
    }
}
