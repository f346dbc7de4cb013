//! Casts rays from a point to the walls around it.

use super::super::{Segment, Walls};
use crate::math::{Rect, Vec2, vec2};

/// Wall segments around a point.
pub(super) struct Rays {
    segments: Vec<Segment>,
}

/// Intersection of a ray and a wall.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    pub distance_m: f64,
    pub point_m: Vec2,
    /// Index of the face; `None` on an apron.
    pub face: Option<usize>,
    pub along_m: f64,
    /// Unit vector along the wall.
    pub direction: Vec2,
}

impl Rays {
    /// Collects the walls within `within_m` of a point along each axis.
    pub fn around(walls: &Walls, at_m: Vec2, within_m: f64) -> Rays {
        let reach = vec2(within_m, within_m);
        let mut segments = Vec::new();
        walls.segments_near(Rect { min: at_m - reach, max: at_m + reach }, &mut segments);
        // Doors are gaps between walls, not between tables.
        segments.retain(|segment| segment.face.is_none_or(|face| walls.faces[face].furniture_m.is_none()));
        Rays { segments }
    }

    /// Returns the first wall in a direction, a unit vector, up to `limit_m`.
    pub fn cast(&self, from_m: Vec2, direction: Vec2, limit_m: f64) -> Option<Hit> {
        let mut found: Option<(f64, &Segment, f64)> = None;
        for segment in &self.segments {
            let along = segment.b - segment.a;
            let across = direction.cross(along);
            // A ray parallel to a wall passes it.
            if across.abs() < 1e-12 {
                continue;
            }
            let to_start = segment.a - from_m;
            let distance_m = to_start.cross(along) / across;
            let share = to_start.cross(direction) / across;
            let meets = distance_m >= 0.0 && (-1e-9..=1.0 + 1e-9).contains(&share);
            if meets && found.is_none_or(|(least_m, ..)| distance_m < least_m) {
                found = Some((distance_m, segment, share));
            }
        }
        let (distance_m, segment, share) = found.filter(|found| found.0 <= limit_m)?;
        let along = segment.b - segment.a;
        Some(Hit {
            distance_m,
            point_m: from_m + direction * distance_m,
            face: segment.face,
            along_m: segment.along_m + along.length() * share.clamp(0.0, 1.0),
            direction: along.normalized().unwrap_or(direction),
        })
    }

    /// Returns the free length in a direction, at most `limit_m`.
    pub fn clear_m(&self, from_m: Vec2, direction: Vec2, limit_m: f64) -> f64 {
        self.cast(from_m, direction, limit_m).map_or(limit_m, |hit| hit.distance_m)
    }
}
