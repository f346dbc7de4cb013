use super::{RouteStop, Timetable};
use crate::math::Vec2;

/// A segment across the shortest way, as wide as people can use around it: not a point, because they spread out.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Gate {
    /// End on the left of those who walk the route, metres.
    pub left_m: Vec2,
    /// End on the right, metres.
    pub right_m: Vec2,
}

impl Gate {
    /// The point at this share of the way from the left end to the right one.
    pub fn at(&self, share: f64) -> Vec2 {
        self.left_m.lerp(self.right_m, share)
    }

    /// Width, metres.
    pub fn width_m(&self) -> f64 {
        self.left_m.distance(self.right_m)
    }
}

/// Where people appear or vanish.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Place {
    /// An opening in an image side, by its index in `FloorPlan::openings`: beyond the floor's edge.
    Opening(usize),
    /// Anywhere within a rectangle of floor, metres: `[min, max]`.
    Area([Vec2; 2]),
}

/// A place between start and goal.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Via {
    /// Where it is.
    pub place: Place,
    /// Index of the gate at it.
    pub gate: usize,
}

/// A way from a start to a goal.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Route {
    /// What the scenario or the program calls it, such as `west to north`.
    pub name: String,
    /// Where people appear.
    pub start: Place,
    /// Places to pass on the way, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub via: Vec<Via>,
    /// Places where some of the people stop, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stops: Vec<RouteStop>,
    /// When people come, if the route has a timetable of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arrivals: Option<Timetable>,
    /// Where they vanish.
    pub goal: Place,
    /// Which share of all people takes it; the shares of all routes sum up to 1.
    pub share: f64,
    /// Gates across the shortest way, in order; in halls and between pillars people also pass beside them.
    pub gates: Vec<Gate>,
    /// Length of the middle line, metres.
    pub length_m: f64,
}
