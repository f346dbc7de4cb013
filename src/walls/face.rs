//! Wall faces, their segments, and nearest points on walls.

use crate::math::Vec2;

/// Length of an apron, metres: untextured floor beyond an opening, where people appear and vanish.
pub const APRON_M: f64 = 3.0;

/// A wall face: a polyline with the floor on its **right**.
///
/// Arc length grows to the right for a viewer who stands on the floor and looks at the wall.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Face {
    /// Whether the last point joins the first, as in rooms and around pillars. The first is not repeated.
    pub closed: bool,
    /// Vertices, metres. A closed face starts at its vertex of least (y, x).
    #[serde(rename = "points")]
    pub points_m: Vec<Vec2>,
    /// Height of the furniture that it belongs to, metres; `None` for walls, up to the ceiling.
    #[serde(rename = "height_m", skip_serializing_if = "Option::is_none")]
    pub furniture_m: Option<f64>,
}

/// Lower furniture stands on legs, metres: tables and seats.
pub(crate) const TABLES_M: f64 = 0.8;
/// Furniture of this height and higher is a counter, metres.
pub(crate) const COUNTER_M: f64 = 0.95;
/// A counter that is narrower is a gate's cabinet, metres.
const GATE_M: f64 = 0.5;

impl Face {
    /// Whether it is of a counter or a gate.
    pub(crate) fn is_counter(&self) -> bool {
        self.furniture_m.is_some_and(|top_m| top_m >= COUNTER_M)
    }

    /// Whether it is of furniture on legs: the floor goes on beneath.
    pub(crate) fn is_on_legs(&self) -> bool {
        self.furniture_m.is_some_and(|top_m| top_m < TABLES_M)
    }

    /// Whether it is of a gate's cabinet: a narrow counter.
    pub(crate) fn is_gate(&self) -> bool {
        // Breadth of the rectangle with its length and its area.
        let half = 0.25 * self.length_m();
        let next = self.points_m.iter().cycle().skip(1);
        let area: f64 = self.points_m.iter().zip(next).map(|(a, b)| 0.5 * (a.x * b.y - b.x * a.y)).sum();
        let breadth_m = half - (half * half - area.abs()).max(0.0).sqrt();
        self.closed && self.is_counter() && breadth_m < GATE_M
    }

    /// Length of the polyline, metres.
    pub fn length_m(&self) -> f64 {
        let open: f64 = self.points_m.windows(2).map(|w| w[0].distance(w[1])).sum();
        match (self.closed, self.points_m.first(), self.points_m.last()) {
            (true, Some(&first), Some(&last)) => open + last.distance(first),
            _ => open,
        }
    }
}

/// The point on a wall nearest to a given point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Distance to the wall, metres, at least 0; see [`Walls::is_inside`](super::Walls::is_inside).
    pub distance_m: f64,
    /// The point on the wall, metres.
    pub point_m: Vec2,
    /// Index into [`Walls::faces`](super::Walls::faces), or `None` for the walls of an apron.
    pub face: Option<usize>,
    /// Arc length from the face's start to the point, metres.
    pub along_m: f64,
}

/// A straight wall segment with the floor on its right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Start, metres.
    pub a: Vec2,
    /// End, metres.
    pub b: Vec2,
    /// Index into [`Walls::faces`](super::Walls::faces), or `None` for the walls of an apron.
    pub face: Option<usize>,
    /// Arc length from the face's start to `a`, metres; 0 on an apron.
    pub along_m: f64,
}
