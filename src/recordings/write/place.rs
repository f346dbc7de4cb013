use crate::math::{Vec2, sin_cos, vec2};
use crate::motion::Walker;
use crate::plan::Pose;

/// Position, velocity and heading of a person, as written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RecordedPlace {
    pub id: u32,
    /// Map frame, metres, rounded to 0.1 mm.
    pub at: Vec2,
    /// Metres per second, map frame.
    pub velocity_m_s: Vec2,
    /// Body height, metres.
    pub height_m: f64,
    /// Heading: unit vector in the map frame.
    pub facing: Vec2,
}

/// Transform from the plan frame to the map frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct MapFrame {
    origin_m: Vec2,
    /// Cosine and sine of the rotation.
    turn: Vec2,
}

impl MapFrame {
    pub fn of(pose: &Pose) -> MapFrame {
        let (sin, cos) = sin_cos(pose.yaw_rad);
        MapFrame { origin_m: pose.origin_m, turn: vec2(cos, sin) }
    }

    pub fn point(&self, p: Vec2) -> Vec2 {
        rounded(self.origin_m + p.rotated(self.turn))
    }

    pub fn place(&self, walker: &Walker, height_m: f64) -> RecordedPlace {
        let facing = walker.heading.or_else(|| walker.velocity_m_s.normalized()).unwrap_or(vec2(1.0, 0.0));
        RecordedPlace {
            id: walker.id,
            at: self.point(walker.position_m),
            velocity_m_s: walker.velocity_m_s.rotated(self.turn),
            height_m,
            facing: rounded(facing.rotated(self.turn)),
        }
    }
}

/// Steps per unit of written values: 0.1 mm.
pub(super) const PER_UNIT: f64 = 1e4;

fn rounded(p: Vec2) -> Vec2 {
    // Adding 0.0 turns -0.0 into 0.0.
    let round = |v: f64| (v * PER_UNIT).round() / PER_UNIT + 0.0;
    vec2(round(p.x), round(p.y))
}
