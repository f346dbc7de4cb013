//! What a crowd walks in: plan, walls, routes, and what was measured of them.

use crate::math::Vec2;
use crate::plan::FloorPlan;
use crate::routes::{Ground, Navigation, Route};
use crate::walls::Walls;

/// A plan with its walls and routes.
pub(super) struct Environment<'a> {
    pub(super) plan: &'a FloorPlan,
    pub(super) walls: &'a Walls,
    pub(super) routes: &'a [Route],
    pub(super) navigation: Navigation,
}

impl Environment<'_> {
    /// The walkable floor in cells.
    #[inline]
    pub(super) fn ground(&self) -> &Ground {
        &self.navigation.ground
    }

    /// Whether the straight line from `a` to `b` meets no wall.
    #[inline]
    pub(super) fn sight(&self, a: Vec2, b: Vec2) -> bool {
        self.ground().sight(self.walls, a, b)
    }

    /// Whether a body can walk straight from `a` to `b` and keep `margin_m` off walls.
    pub(super) fn is_free(&self, a: Vec2, b: Vec2, margin_m: f64) -> bool {
        self.ground().is_free(self.walls, a, b, margin_m)
    }
}
