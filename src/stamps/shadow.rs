//! Shadows of walls: texels behind a wall, as seen from the foot, get no print.

use super::window::WINDOW;
use crate::math::{Rect, Vec2, vec2};
use crate::walls::Walls;

/// Walls near a position, for finding grid squares hidden behind them.
#[derive(Debug)]
pub(super) struct Shadow {
    place_m: Vec2,
    square_m: f64,
    faces: Vec<Blocking>,
}

/// A wall segment whose floor side faces the viewpoint; coordinates relative to it, metres.
#[derive(Debug)]
struct Blocking {
    /// Ends; the second is to the right as seen from the viewpoint.
    left: [f32; 2],
    right: [f32; 2],
    /// Unit normal into the wall.
    normal: [f32; 2],
    distance: f32,
    /// Half the extent of a square along the normal, metres.
    half_extent: f32,
}

/// Oriented rectangle around a print or kernel.
#[derive(Clone, Copy, Debug)]
pub(super) struct StampExtent {
    pub(super) middle_m: Vec2,
    /// Unit vector along the rectangle.
    pub(super) heading: Vec2,
    pub(super) half_along_m: f64,
    pub(super) half_across_m: f64,
}

impl StampExtent {
    /// Extent in a direction, measured from a point.
    fn farthest_m(&self, from: Vec2, direction: Vec2) -> f64 {
        let along = self.half_along_m * self.heading.dot(direction).abs();
        let across = self.half_across_m * self.heading.cross(direction).abs();
        (self.middle_m - from).dot(direction) + along + across
    }

    /// Upper bound on the distance of the corners from a point.
    pub(super) fn reach_m(&self, from: Vec2) -> f64 {
        vec2(self.half_along_m, self.half_across_m).length() + self.middle_m.distance(from)
    }
}

/// Tolerance at a shadow's edge, m^2 of the cross product: joined wall segments leave no gap.
const RIM: f32 = 1e-5;

/// Distance from a wall of a foot whose position is inside the wall, metres.
const BEFORE_WALL_M: f64 = 0.002;

/// Returns the foot's viewpoint: its position, or a point in front of the wall if inside one.
pub(super) fn foothold(walls: &Walls, place: Vec2, nearest_m: Vec2) -> Vec2 {
    match (nearest_m - place).normalized() {
        Some(out) if !walls.is_inside(place) => nearest_m + out * BEFORE_WALL_M,
        _ => place,
    }
}

impl Shadow {
    /// Shadow on squares of side `square_m` in an extent; `None` without a wall in between.
    pub(super) fn new(walls: &Walls, place_m: Vec2, extent: &StampExtent, square_m: f64) -> Option<Shadow> {
        let reach_m = extent.reach_m(place_m) + square_m;
        let mut segments = Vec::new();
        walls.segments_near(Rect { min: place_m, max: place_m }.grown(reach_m), &mut segments);
        let mut faces = Vec::new();
        for segment in segments {
            let (a, b) = (segment.a - place_m, segment.b - place_m);
            let Some(along) = (b - a).normalized() else { continue };
            // The floor is on the right of a face; walls seen from behind cast no shadow.
            let normal = along.left();
            let distance = normal.dot(a);
            let nearest = a + along * (-a.dot(along)).clamp(0.0, (b - a).length());
            let in_the_way = distance > 0.0
                && nearest.length() < reach_m
                && distance < extent.farthest_m(place_m, normal) + square_m;
            if in_the_way {
                let single = |v: Vec2| [v.x as f32, v.y as f32];
                faces.push(Blocking {
                    left: single(a),
                    right: single(b),
                    normal: single(normal),
                    distance: distance as f32,
                    half_extent: (0.5 * square_m * (normal.x.abs() + normal.y.abs())) as f32,
                });
            }
        }
        (!faces.is_empty()).then_some(Shadow { place_m, square_m, faces })
    }

    /// Visible share, 0..=1, of squares in a row from `[i, j]` on: the minimum over all faces.
    pub(super) fn reached(&self, [i, j]: [i64; 2], out: &mut [f32]) {
        let middle = |k: i64, place: f64| ((k as f64 + 0.5) * self.square_m - place) as f32;
        self.reached_from(middle(i, self.place_m.x), middle(j, self.place_m.y), out);
    }

    fn reached_from(&self, x: f32, y: f32, out: &mut [f32]) {
        out.fill(1.0);
        let step = self.square_m as f32;
        for face in &self.faces {
            let inverse = 0.5 / face.half_extent;
            for (k, share) in out.iter_mut().enumerate() {
                let x = x + k as f32 * step;
                let before = 0.5 - (face.normal[0] * x + face.normal[1] * y - face.distance) * inverse;
                let right_of_left_end = x * face.left[1] - y * face.left[0] > -RIM;
                let left_of_right_end = face.right[0] * y - face.right[1] * x > -RIM;
                let behind = if right_of_left_end & left_of_right_end { before.clamp(0.0, 1.0) } else { 1.0 };
                *share = share.min(behind);
            }
        }
    }

    /// Visible share, 0..=1, of a square around a point.
    pub(super) fn reached_at(&self, point_m: Vec2) -> f32 {
        let offset = point_m - self.place_m;
        let mut out = [0.0];
        self.reached_from(offset.x as f32, offset.y as f32, &mut out);
        out[0]
    }

    /// Sets the coverage of invisible squares from `[i, j]` on to 0. Texels cut by a wall keep theirs.
    pub(super) fn hide(&self, square: [i64; 2], coverage: &mut [u8]) {
        let mut reached = [0.0; WINDOW];
        let reached = &mut reached[..coverage.len()];
        self.reached(square, reached);
        for (c, &r) in coverage.iter_mut().zip(reached.iter()) {
            if r <= 0.0 {
                *c = 0;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::FloorPlan;
    use crate::walls::WallsOptions;

    /// Two rooms of 2 x 3 m with 0.1 m of wall between them and a gap at the top.
    fn rooms() -> Walls {
        let (width, height) = (43, 32);
        let floor = (0..width * height)
            .map(|k| {
                let (x, y) = (k % width, k / width);
                let rim = x == 0 || y == 0 || x == width - 1 || y == height - 1;
                u8::from(!rim && (x != 21 || y < 10))
            })
            .collect();
        Walls::trace(&FloorPlan::from_mask(width as u32, height as u32, 0.1, floor), &WallsOptions::default())
    }

    fn around(middle_m: Vec2, half_m: f64) -> StampExtent {
        StampExtent { middle_m, heading: vec2(1.0, 0.0), half_along_m: half_m, half_across_m: half_m }
    }

    #[test]
    fn a_wall_beside_a_narrow_extent_is_not_in_the_way() {
        let walls = rooms();
        let place = vec2(1.9, 1.0);
        let along_the_wall = StampExtent { half_across_m: 0.1, heading: vec2(0.0, 1.0), ..around(place, 0.6) };
        assert!(Shadow::new(&walls, place, &along_the_wall, 0.01).is_none());
        assert!(Shadow::new(&walls, place, &StampExtent { heading: vec2(1.0, 0.0), ..along_the_wall }, 0.01).is_some());
    }

    #[test]
    fn what_lies_behind_a_thin_wall_is_not_reached() {
        let walls = rooms();
        let place = vec2(2.0, 1.0);
        let shadow = Shadow::new(&walls, place, &around(place, 0.5), 0.01).unwrap();
        for k in 0..40 {
            let x = k as f32 * 0.01 - 0.1;
            let reached = shadow.reached_at(place + vec2(f64::from(x), 0.05));
            assert_eq!(
                reached,
                if x < 0.095 {
                    1.0
                } else if x > 0.105 {
                    0.0
                } else {
                    reached
                },
                "at {x}"
            );
        }
        assert!(Shadow::new(&walls, vec2(1.0, 1.0), &around(vec2(1.0, 1.0), 0.5), 0.01).is_none());
    }

    #[test]
    fn agrees_with_lines_of_sight_round_an_end_of_a_wall() {
        let walls = rooms();
        let place = vec2(2.0, 2.1);
        let shadow = Shadow::new(&walls, place, &around(place, 1.0), 0.001).unwrap();
        for i in -60..60 {
            for j in -60..60 {
                let offset = vec2(f64::from(i) * 0.0131 + 0.004, f64::from(j) * 0.0131 + 0.004);
                let reached = shadow.reached_at(place + offset);
                let seen = walls.sight(place, place + offset);
                // The two may differ at a shadow's edge.
                if (reached > 0.5) != seen {
                    let moved = [vec2(0.003, 0.0), vec2(-0.003, 0.0), vec2(0.0, 0.003), vec2(0.0, -0.003)];
                    assert!(moved.iter().any(|m| walls.sight(place, place + offset + *m) != seen), "{offset:?}");
                }
            }
        }
    }

    #[test]
    fn a_foot_in_a_wall_stands_before_it() {
        let walls = rooms();
        let nearest = |p| walls.nearest(p, 1.0).unwrap().point_m;
        let inside = vec2(1.0, 0.3);
        assert_eq!(foothold(&walls, inside, nearest(inside)), inside);
        let buried = vec2(1.0, 0.04);
        let stands = foothold(&walls, buried, nearest(buried));
        assert!(walls.is_inside(stands) && stands.distance(buried) < 0.07, "{stands:?}");
    }
}
