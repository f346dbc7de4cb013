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
