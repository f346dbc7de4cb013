//! Doors, windows and furniture that a plan shows.

use super::{FloorPlan, PlanClass};
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

/// Gap between furniture and the wall behind it, metres: the wall is seen above a table that stands at it.
const GAP_M: f64 = 0.03;
/// Widest gap, pixels.
const MOST_GAP_PX: usize = 8;

impl FloorPlan {
    /// Moves low furniture off the walls by a gap, so that walls go on behind it and it stands as a box of its own.
    pub(super) fn set_furniture_free(&mut self) {
        let is_low = |class: PlanClass| class.height_m().is_some();
        if !self.classes.iter().any(|&class| is_low(class)) {
            return;
        }
        let gap_px = ((GAP_M / self.metres_per_pixel).round() as usize).clamp(1, MOST_GAP_PX);
        let (width, height) = (self.width_px as usize, self.height_px as usize);
        let at_wall = |at: usize| {
            let (x, y) = (at % width, at / width);
            let rows = y.saturating_sub(gap_px)..=(y + gap_px).min(height - 1);
            let is_wall = |at: usize| self.classes[at].is_solid() && !is_low(self.classes[at]);
            rows.into_iter()
                .any(|y| (x.saturating_sub(gap_px)..=(x + gap_px).min(width - 1)).any(|x| is_wall(y * width + x)))
        };
        let freed: Vec<usize> = (0..self.classes.len()).filter(|&at| is_low(self.classes[at]) && at_wall(at)).collect();
        for at in freed {
            (self.classes[at], self.floor[at], self.lightness[at]) = (PlanClass::Floor, 1, 255);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::walls::{Walls, WallsOptions};

    #[test]
    fn a_table_at_a_wall_is_a_box_before_it() {
        // A room of 5 x 4 m with a table of 2 x 1 m at its northern wall, 5 cm to a pixel.
        let table = |x: u32, y: u32| (40..80).contains(&x) && (2..22).contains(&y);
        let inside = |x: u32, y: u32| (2..102).contains(&x) && (2..82).contains(&y);
        let pixels = || (0..84).flat_map(|y| (0..104).map(move |x| (x, y)));
        let floor = pixels().map(|(x, y)| u8::from(inside(x, y) && !table(x, y))).collect();
        let mut plan = FloorPlan::from_mask(104, 84, 0.05, floor);
        for (class, (x, y)) in plan.classes.iter_mut().zip(pixels()) {
            if table(x, y) {
                *class = PlanClass::Table;
            }
        }
        assert_eq!(Walls::trace(&plan, &WallsOptions::default()).faces.len(), 1);
        plan.set_furniture_free();
        let walls = Walls::trace(&plan, &WallsOptions::default());
        let found: Vec<_> = walls.faces.iter().map(|face| (face.furniture_m, face.length_m())).collect();
        assert_eq!(found.len(), 2);
        assert!(found[0].0.is_none() && (found[0].1 - 18.0).abs() < 1e-9, "{found:?}");
        assert!(found[1].0 == Some(0.75) && (found[1].1 - 5.9).abs() < 1e-9, "{found:?}");
    }
}
