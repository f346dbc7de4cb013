//! Walls beside a body.

use crate::math::Vec2;
use crate::motion::{CarrySide, Person};
use crate::walls::{Nearest, Walls};

use super::step::{ContactStep, carries};

/// Cosine limit for two walls to lie on opposite sides.
const OPPOSITE: f64 = 0.9;
/// Reach of the wall on the opposite side from the body's middle, metres.
const OTHER_SIDE_M: f64 = 1.0;
/// Sine of a wall's direction from which it is beside the body rather than ahead or behind.
const AT_SIDE: f64 = 0.5;

/// A wall near a person.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WallSide {
    /// Distance from the body's side to the wall, metres; negative where they overlap.
    pub gap_m: f64,
    /// Distance from the body's middle, metres.
    distance_m: f64,
    /// Unit vector from the body to the wall.
    pub towards: Vec2,
    /// Sine of the wall's direction against the body's facing: 1 on the left.
    pub left: f64,
    /// Cosine of the same angle: 1 ahead.
    pub ahead: f64,
    /// Index into [`Walls::faces`]; `None` for the walls of an apron, which get no texture.
    pub face: Option<usize>,
    /// Arc length on the face, metres.
    pub along_m: f64,
}

impl WallSide {
    fn new(step: &ContactStep, near: Nearest) -> Option<WallSide> {
        let towards = (near.point_m - step.at_m).normalized()?;
        let (left, ahead) = (step.facing.cross(towards), step.facing.dot(towards));
        // The body is an ellipse as broad as the shoulders and as deep as the chest.
        let [half, depth] = [step.person.shoulder_width_m, step.person.chest_depth_m].map(|extent_m| 0.5 * extent_m);
        let body_m = ((half * left) * (half * left) + (depth * ahead) * (depth * ahead)).sqrt();
        Some(WallSide {
            gap_m: near.distance_m - body_m,
            distance_m: near.distance_m,
            towards,
            left,
            ahead,
            face: near.face,
            along_m: near.along_m,
        })
    }

    pub fn is_at_side(&self) -> bool {
        self.left.abs() >= AT_SIDE
    }

    /// Whether luggage is between the body and the wall.
    pub fn has_bag(&self, person: &Person) -> bool {
        self.is_at_side() && carries(person, self.left > 0.0)
            || self.ahead < -AT_SIDE && person.bag.is_some_and(|bag| bag.side == CarrySide::Back)
    }

    /// Unit vector along the face, towards growing arc length: the floor is on its right.
    pub fn direction(&self) -> Vec2 {
        -self.towards.left()
    }
}

/// The nearest wall, and the wall on the opposite side, if in reach.
pub(super) fn sides(walls: &Walls, step: &ContactStep, near: Nearest) -> [Option<WallSide>; 2] {
    let first = WallSide::new(step, near);
    let other = first.and_then(|first| {
        // This disc holds the reachable points on the opposite side.
        let radius_m = 0.5 * OTHER_SIDE_M;
        let far = walls.nearest(step.at_m - first.towards * radius_m, radius_m)?;
        let across = far.point_m - step.at_m;
        let distance_m = across.length();
        let is_opposite = -across.dot(first.towards) > OPPOSITE * distance_m;
        is_opposite.then(|| WallSide::new(step, Nearest { distance_m, ..far })).flatten()
    });
    [first, other]
}

/// Clear width between the walls on both sides, metres; infinite without a wall on one side.
pub(super) fn clear_width_m(sides: &[Option<WallSide>; 2]) -> f64 {
    match sides {
        [Some(near), Some(far)] => near.distance_m + far.distance_m,
        _ => f64::INFINITY,
    }
}
