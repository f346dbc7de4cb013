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
