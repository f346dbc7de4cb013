//! Doors, windows and furniture that a plan shows.

use super::PlanClass;
use crate::math::Vec2;

/// How a door is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum DoorKind {
    /// A gap in a wall.
    Open,
    /// A gap with a leaf, an arc or both.
    Leaf,
    /// A line across the gap.
    Line,
}

/// A door: a gap between two jambs that people pass.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct PlanDoor {
    /// Middle of one jamb, metres.
    pub from_m: Vec2,
    /// Middle of the other jamb, metres.
    pub to_m: Vec2,
    /// How it is drawn.
    pub(crate) kind: DoorKind,
    /// Hinge and far end of its leaf as it is drawn open, metres; of two leaves the clearer one.
    pub leaf_m: Option<[Vec2; 2]>,
}

impl PlanDoor {
    /// Width between the jambs, metres.
    pub fn width_m(&self) -> f64 {
        self.from_m.distance(self.to_m)
    }
}

/// A window: a closed gap between two jambs.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct PlanWindow {
    /// Middle of one jamb, metres.
    pub from_m: Vec2,
    /// Middle of the other jamb, metres.
    pub to_m: Vec2,
}

/// A piece of furniture, or several that touch.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct FurniturePiece {
    /// What it is.
    pub class: PlanClass,
    /// Least x and least y of its bounding rectangle, metres.
    pub min_m: Vec2,
    /// Greatest x and greatest y, metres.
    pub max_m: Vec2,
    /// Area that it covers, square metres.
    pub area_m2: f64,
    /// Height above the floor, metres; `None` up to the ceiling.
    pub height_m: Option<f64>,
    /// Share of its outline that lies at walls.
    pub at_wall: f64,
}
