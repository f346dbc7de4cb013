use std::fmt;

use crate::math::{Rect, Vec2, vec2};
use crate::walls::{APRON_M, Outline};

/// Walkable floor as polygons with holes: the plan's floor and an apron beyond each opening.
#[derive(Debug)]
pub(super) struct Floor {
    polygons: Vec<Polygon>,
}

#[derive(Debug)]
struct Polygon {
    /// Counter-clockwise.
    outside: Vec<Vec2>,
    /// Clockwise.
    holes: Vec<Vec<Vec2>>,
}

impl Floor {
    /// Builds the floor within these outlines; `place` must be a rotation and translation.
    pub(super) fn of(outlines: &[Outline], place: impl Fn(Vec2) -> Vec2) -> Floor {
        let loops = outlines.iter().map(|outline| {
            // Outlines have the floor on their right, polygons on their left.
            let mut points: Vec<Vec2> = walked(outline).into_iter().map(&place).collect();
            points.reverse();
            points
        });
        let (mut outsides, holes): (Vec<_>, Vec<_>) = loops.partition(|points| doubled_area(points) > 0.0);
        // A hole belongs to the smallest polygon around it: a room may lie within another's pillar.
        outsides.sort_by(|a, b| doubled_area(a).total_cmp(&doubled_area(b)));
        let mut polygons: Vec<Polygon> =
            outsides.into_iter().map(|outside| Polygon { outside, holes: Vec::new() }).collect();
        for hole in holes {
            let owner = polygons.iter().position(|polygon| lies_within(&hole, &polygon.outside));
            if let Some(owner) = owner {
                polygons[owner].holes.push(hole);
            }
        }
        polygons.reverse();
        Floor { polygons }
    }

    /// Bounding box of the floor; empty at the origin if there is no floor.
    pub(super) fn bounds(&self) -> Rect {
        let mut points = self.polygons.iter().flat_map(|polygon| &polygon.outside);
        let first = points.next().copied().unwrap_or(Vec2::ZERO);
        points.fold(Rect { min: first, max: first }, |r, p| Rect {
            min: vec2(r.min.x.min(p.x), r.min.y.min(p.y)),
            max: vec2(r.max.x.max(p.x), r.max.y.max(p.y)),
        })
    }
}

/// Writes well-known text: a `POLYGON`, or a `MULTIPOLYGON` for several pieces.
impl fmt::Display for Floor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.polygons[..] {
            [] => write!(f, "POLYGON EMPTY"),
            [polygon] => write!(f, "POLYGON {polygon}"),
            [first, others @ ..] => {
                write!(f, "MULTIPOLYGON ({first}")?;
                others.iter().try_for_each(|polygon| write!(f, ", {polygon}"))?;
                write!(f, ")")
            }
        }
    }
}

impl fmt::Display for Polygon {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "(")?;
        ring(&self.outside, f)?;
        for hole in &self.holes {
            write!(f, ", ")?;
            ring(hole, f)?;
        }
        write!(f, ")")
    }
}

/// Writes a ring, with the first point repeated at the end.
fn ring(points: &[Vec2], f: &mut fmt::Formatter<'_>) -> fmt::Result {
    for (n, p) in points.iter().chain(points.first()).enumerate() {
        write!(f, "{}{:.4} {:.4}", if n == 0 { "(" } else { ", " }, p.x, p.y)?;
    }
    write!(f, ")")
}

/// Returns the points of an outline with an apron beyond each opening.
fn walked(outline: &Outline) -> Vec<Vec2> {
    let mut points = Vec::with_capacity(outline.points_m.len() + 2 * outline.openings.len());
    for (k, &point) in outline.points_m.iter().enumerate() {
        points.push(point);
        if let Some(side) = outline.opening(k) {
            let out = side.outward() * APRON_M;
            points.extend(outline.edge(k).map(|end| end + out));
        }
    }
    points
}

/// Twice the signed area: negative for clockwise points.
fn doubled_area(points: &[Vec2]) -> f64 {
    let Some(&last) = points.last() else { return 0.0 };
    let mut before = last;
    points.iter().map(|&p| std::mem::replace(&mut before, p).cross(p)).sum()
}

/// Whether most points of a ring lie within another; where walls touch, some lie on it.
fn lies_within(ring: &[Vec2], outside: &[Vec2]) -> bool {
    2 * ring.iter().filter(|&&p| is_within(p, outside)).count() > ring.len()
}

fn is_within(p: Vec2, ring: &[Vec2]) -> bool {
    let Some(&last) = ring.last() else { return false };
    let mut a = last;
    let mut within = false;
    for &b in ring {
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) {
            within = !within;
        }
        a = b;
    }
    within
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::FloorPlan;
    use crate::walls::{Walls, WallsOptions};

    fn floor(rows: &[&str]) -> Floor {
        let mask = rows.iter().flat_map(|row| row.bytes()).map(|byte| u8::from(byte == b'.')).collect();
        let plan = FloorPlan::from_mask(rows[0].len() as u32, rows.len() as u32, 1.0, mask);
        Floor::of(Walls::trace(&plan, &WallsOptions::default()).outlines(), |p| p)
    }

    fn area(floor: &Floor) -> f64 {
        let of = |p: &Polygon| doubled_area(&p.outside) + p.holes.iter().map(|hole| doubled_area(hole)).sum::<f64>();
        floor.polygons.iter().map(of).sum::<f64>() / 2.0
    }

    #[test]
    fn a_room_with_a_pillar_is_a_polygon_with_a_hole() {
        let floor = floor(&["######", "#....#", "#.##.#", "#....#", "######"]);
        assert_eq!((floor.polygons.len(), floor.polygons[0].holes.len()), (1, 1));
        assert_eq!(area(&floor), 10.0);
        let text = floor.to_string();
        assert!(text.starts_with("POLYGON ((") && text.ends_with("))"), "{text}");
        assert_eq!(text.matches("), (").count(), 1, "{text}");
    }

    #[test]
    fn openings_have_aprons() {
        let floor = floor(&["####", "....", "####"]);
        assert_eq!(area(&floor), 4.0 + 2.0 * APRON_M);
        assert_eq!(floor.bounds(), Rect { min: vec2(-3.0, 1.0), max: vec2(7.0, 2.0) });
    }

    #[test]
    fn a_hole_belongs_to_the_innermost_floor_around_it() {
        let rows = [
            "###########",
            "#.........#",
            "#.#######.#",
            "#.#.....#.#",
            "#.#.###.#.#",
            "#.#.###.#.#",
            "#.#.....#.#",
            "#.#######.#",
            "#.........#",
            "###########",
        ];
        let floor = floor(&rows);
        assert_eq!(floor.polygons.iter().map(|p| p.holes.len()).collect::<Vec<_>>(), [1, 1]);
        assert_eq!(area(&floor), rows.concat().matches('.').count() as f64);
        assert!(floor.to_string().starts_with("MULTIPOLYGON ((("));
    }
}
