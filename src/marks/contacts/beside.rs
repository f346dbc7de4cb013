//! The walls at the sides of a body.

use crate::math::Vec2;
use crate::motion::{CarrySide, Person};
use crate::walls::{Nearest, Walls};

use super::{Look, carries};

/// Two walls are on both sides if they lie in directions less than this cosine from opposite.
const OPPOSITE: f64 = 0.9;
/// A wall on the other side counts from so near by the middle of the body, metres.
const OTHER_SIDE_M: f64 = 1.0;
/// A wall is at the side of a body rather than ahead or behind from this sine of its direction on.
const AT_SIDE: f64 = 0.5;

/// A wall near somebody.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beside {
    /// From the body's side to the wall, metres; negative where they would overlap.
    pub gap_m: f64,
    /// From the body's middle, metres.
    distance_m: f64,
    /// Unit vector from the body to the wall.
    pub towards: Vec2,
    /// Sine and cosine of its direction against where the body faces: 1 on the left; 1 ahead.
    pub left: f64,
    pub ahead: f64,
    /// Index into [`Walls::faces`]; none of the unseen walls of an apron.
    pub face: Option<usize>,
    pub along_m: f64,
}

impl Beside {
    fn new(look: &Look, near: Nearest) -> Option<Beside> {
        let towards = (near.point_m - look.at_m).normalized()?;
        let (left, ahead) = (look.facing.cross(towards), look.facing.dot(towards));
        // The body is an ellipse as broad as the shoulders and as deep as the chest.
        let [half, depth] = [look.person.shoulder_width_m, look.person.chest_depth_m].map(|extent_m| 0.5 * extent_m);
        let body_m = ((half * left) * (half * left) + (depth * ahead) * (depth * ahead)).sqrt();
        Some(Beside {
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

    /// Whether belongings are between the body and the wall.
    pub fn has_bag(&self, person: &Person) -> bool {
        self.is_at_side() && carries(person, self.left > 0.0)
            || self.ahead < -AT_SIDE && person.bag.is_some_and(|bag| bag.side == CarrySide::Back)
    }

    /// Unit vector along the face, towards growing arc length: the floor is on its right.
    pub fn direction(&self) -> Vec2 {
        -self.towards.left()
    }
}

/// The nearest wall, and the one on the other side, if they are in reach.
pub(super) fn sides(walls: &Walls, look: &Look, near: Nearest) -> [Option<Beside>; 2] {
    let first = Beside::new(look, near);
    let other = first.and_then(|first| {
        // All that lies straight on the other side, in reach, lies in this disc.
        let radius_m = 0.5 * OTHER_SIDE_M;
        let far = walls.nearest(look.at_m - first.towards * radius_m, radius_m)?;
        let across = far.point_m - look.at_m;
        let distance_m = across.length();
        let is_opposite = -across.dot(first.towards) > OPPOSITE * distance_m;
        is_opposite.then(|| Beside::new(look, Nearest { distance_m, ..far })).flatten()
    });
    [first, other]
}

/// Clear width between the walls on both sides, metres; infinite where there is none on one side.
pub(super) fn clear_width_m(sides: &[Option<Beside>; 2]) -> f64 {
    match sides {
        [Some(near), Some(far)] => near.distance_m + far.distance_m,
        _ => f64::INFINITY,
    }
}
