use crate::math::Vec2;

/// A segment across the shortest path, as wide as people can use around it.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Gate {
    /// Left end, as seen along the route, metres.
    pub left_m: Vec2,
    /// Right end, metres.
    pub right_m: Vec2,
}

impl Gate {
    /// The point at a share of the width, from the left end (0) to the right (1).
    pub fn at(&self, share: f64) -> Vec2 {
        self.left_m.lerp(self.right_m, share)
    }

    /// Width, metres.
    pub fn width_m(&self) -> f64 {
        self.left_m.distance(self.right_m)
    }
}

/// A place where people appear or vanish.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Place {
    /// An opening in an image side, beyond the floor's edge: index into `FloorPlan::openings`.
    Opening(usize),
    /// A rectangle of floor, metres: `[min, max]`.
    Area([Vec2; 2]),
}

/// A place that a route passes between start and goal.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Via {
    /// The place.
    pub place: Place,
    /// Index of its gate.
    pub gate: usize,
}
