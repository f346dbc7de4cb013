use serde::{Deserialize, Serialize};

use crate::math::{Vec2, vec2};

/// The areas in front of and behind the viewer; width and depth, metres.
///
/// The viewer stands at the origin and looks along +y; +x is to the right. The front area spans `y` from 0 to its depth,
/// the rear one from 0 to minus its depth, both half of their width to either side.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Areas {
    /// Area in which people in front are matched with units.
    pub front_m: [f64; 2],
    /// Area in which people behind are matched with units.
    pub rear_m: [f64; 2],
    /// Area in front in which units are played.
    pub played_m: [f64; 2],
}

impl Default for Areas {
    /// As in the paper: 3.0 x 3.0 m in front and behind, units on 3.0 x 7.0 m.
    fn default() -> Areas {
        Areas { front_m: [3.0, 3.0], rear_m: [3.0, 3.0], played_m: [3.0, 7.0] }
    }
}

/// The area in which a person is matched with units.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AreaSide {
    /// The area in front of the viewer.
    Front,
    /// The area behind the viewer.
    Rear,
}

impl Areas {
    /// The area in which a position lies, viewer's frame; `None` outside both.
    pub fn side_of(&self, place_m: Vec2) -> Option<AreaSide> {
        let within = |[width, depth]: [f64; 2], ahead: f64| place_m.x.abs() <= 0.5 * width && ahead <= depth;
        match place_m.y >= 0.0 {
            true => within(self.front_m, place_m.y).then_some(AreaSide::Front),
            false => within(self.rear_m, -place_m.y).then_some(AreaSide::Rear),
        }
    }

    /// Whether a position lies in the area in which units are played.
    pub fn is_played(&self, place_m: Vec2) -> bool {
        let [width, depth] = self.played_m;
        place_m.x.abs() <= 0.5 * width && (0.0..=depth).contains(&place_m.y)
    }
}

/// The viewer's frame: transforms between it and the plan frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpotFrame {
    /// The viewer's place, plan frame, metres.
    pub at_m: Vec2,
    /// Unit vector in which the viewer looks.
    pub ahead: Vec2,
}

impl SpotFrame {
    /// Unit vector to the viewer's right.
    pub fn right(&self) -> Vec2 {
        -self.ahead.left()
    }

    /// Transforms a position from the viewer's frame to the plan frame.
    pub fn to_plan(&self, place_m: Vec2) -> Vec2 {
        self.at_m + self.turn_to_plan(place_m)
    }

    /// Rotates a direction or velocity from the viewer's frame to the plan frame.
    pub fn turn_to_plan(&self, v: Vec2) -> Vec2 {
        self.right() * v.x + self.ahead * v.y
    }

    /// Transforms a position from the plan frame to the viewer's frame.
    pub fn of_plan(&self, place_m: Vec2) -> Vec2 {
        self.turn_of_plan(place_m - self.at_m)
    }

    /// Rotates a direction or velocity from the plan frame to the viewer's frame.
    pub fn turn_of_plan(&self, v: Vec2) -> Vec2 {
        vec2(v.dot(self.right()), v.dot(self.ahead))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_viewer_looks_along_y_with_x_to_the_right() {
        let frame = SpotFrame { at_m: vec2(10.0, 5.0), ahead: vec2(0.0, -1.0) };
        assert_eq!(frame.to_plan(vec2(1.0, 3.0)), vec2(9.0, 2.0));
        assert_eq!(frame.of_plan(vec2(9.0, 2.0)), vec2(1.0, 3.0));
        assert_eq!(frame.turn_to_plan(vec2(0.0, 1.0)), vec2(0.0, -1.0));
    }

    #[test]
    fn areas_are_before_and_behind() {
        let areas = Areas::default();
        let at = |x, y| areas.side_of(vec2(x, y));
        assert_eq!((at(1.4, 2.9), at(-1.4, -2.9)), (Some(AreaSide::Front), Some(AreaSide::Rear)));
        assert_eq!((at(1.6, 1.0), at(0.0, 3.1), at(0.0, -3.1)), (None, None, None));
        assert!(areas.is_played(vec2(0.0, 6.9)) && !areas.is_played(vec2(0.0, -0.1)));
    }
}
