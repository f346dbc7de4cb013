//! Areas of the plan as polygons on a fine grid: union, difference, growing, triangles.
//!
//! Corners lie on a grid of 2^-20 m, so that clipping is exact integer work (`i_overlay`, `i_triangle`): the same
//! triangles on every machine, and loops that touch or cross themselves do no harm. A coordinate on the grid is a
//! `f64` without rounding.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::{IntOverlayOptions, Overlay};
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::angle::Angle;
use i_overlay::i_float::int::point::IntPoint;
use i_overlay::mesh::int::outline::offset::IntOutlineOffset;
use i_overlay::mesh::int::style::{IntLineJoin, IntOutlineStyle};
use i_triangle::int::custom::IntCustomTriangulatable;
use i_triangle::int::validation::Validation;

use crate::math::{Rect, Vec2, vec2};

/// Steps of the grid in a metre.
const STEPS_PER_M: f64 = (1u32 << 20) as f64;
/// Coordinates beyond this are no plan's, metres.
const FARTHEST_M: f64 = 1e7;
/// The sharpest corner that keeps its tip when an area grows, as a share of a whole turn: 40 degrees.
const SHARPEST: f64 = 40.0 / 360.0;

type Point = IntPoint<i64>;

/// The nearest point of the grid, metres.
pub(super) fn snap(p: Vec2) -> Vec2 {
    metres(steps(p))
}

fn steps(p: Vec2) -> Point {
    let step = |v: f64| (v * STEPS_PER_M).round() as i64;
    Point::new(step(p.x), step(p.y))
}

fn metres(p: Point) -> Vec2 {
    vec2(p.x as f64 / STEPS_PER_M, p.y as f64 / STEPS_PER_M)
}

/// Area with holes: polygons whose outer loop (the first) goes counter-clockwise, holes clockwise.
#[derive(Clone, Debug, Default)]
pub(super) struct PolygonSet {
    shapes: Vec<Vec<Vec<Point>>>,
}

/// An area cut into triangles.
#[derive(Clone, Debug, Default)]
pub(super) struct Triangles {
    pub corners: Vec<[Vec2; 3]>,
}

impl PolygonSet {
    /// The area inside loops that have it on their **right**. Where they cross, what they enclose more than once
    /// counts once. Loops with coordinates that no plan has are left out.
    pub fn inside_right<L: IntoIterator<Item = Vec2>>(loops: impl IntoIterator<Item = L>) -> PolygonSet {
        let mut contours = Vec::new();
        for points in loops {
            let mut contour: Vec<Vec2> = points.into_iter().collect();
            contour.reverse();
            if contour.iter().all(|p| p.x.abs() <= FARTHEST_M && p.y.abs() <= FARTHEST_M) {
                contours.push(contour.into_iter().map(steps).collect());
            }
        }
        PolygonSet { shapes: vec![contours] }.tidied()
    }

    /// Rectangles, together.
    pub fn rectangles(rectangles: impl IntoIterator<Item = Rect>) -> PolygonSet {
        PolygonSet::inside_right(rectangles.into_iter().map(|r| {
            // Clockwise.
            [r.min, vec2(r.min.x, r.max.y), r.max, vec2(r.max.x, r.min.y)]
        }))
    }

    fn tidied(self) -> PolygonSet {
        let mut overlay = Overlay::from_subj_custom(&self.shapes, keep_all(), Default::default());
        PolygonSet { shapes: overlay.overlay(OverlayRule::Subject, FillRule::Positive) }
    }

    fn with(&self, other: &PolygonSet, rule: OverlayRule) -> PolygonSet {
        let mut overlay =
            Overlay::from_subj_and_clip_custom(&self.shapes, &other.shapes, keep_all(), Default::default());
        PolygonSet { shapes: overlay.overlay(rule, FillRule::Positive) }
    }

    /// The area of either.
    pub fn union(&self, other: &PolygonSet) -> PolygonSet {
        self.with(other, OverlayRule::Union)
    }

    /// The area of this one without the other.
    pub fn minus(&self, other: &PolygonSet) -> PolygonSet {
        self.with(other, OverlayRule::Difference)
    }

    /// The area that both share.
    pub fn intersection(&self, other: &PolygonSet) -> PolygonSet {
        self.with(other, OverlayRule::Intersect)
    }

    /// Grown outward and into its holes, or shrunk if negative, with corners that stay sharp.
    pub fn grown(&self, by_m: f64) -> PolygonSet {
        let join = IntLineJoin::Miter(Angle::from_bits((SHARPEST * f64::from(u32::MAX)) as u32));
        let style = IntOutlineStyle::new((by_m * STEPS_PER_M).round() as i64).line_join(join);
        // Fails for coordinates out of range only, and those were left out.
        PolygonSet { shapes: self.shapes.outline(&style).unwrap_or_default() }
    }

    /// Without its holes.
    pub fn filled(mut self) -> PolygonSet {
        self.shapes.iter_mut().for_each(|shape| shape.truncate(1));
        // An island in a filled hole is part of what is around it.
        self.tidied()
    }

    /// All loops, inside on the left.
    pub fn loops(&self) -> impl Iterator<Item = impl Iterator<Item = Vec2> + '_> + '_ {
        self.shapes.iter().flatten().map(|contour| contour.iter().copied().map(metres))
    }

    /// Counter-clockwise triangles that fill it, sharing their corners (Delaunay's, as far as the outline allows).
    pub fn triangles(&self) -> Triangles {
        let validation = Validation { fill_rule: FillRule::Positive, options: keep_all() };
        let mesh = self.shapes.custom_triangulate(validation).into_delaunay().into_triangulation::<u32>();
        let oriented = |[a, b, c]: [Point; 3]| {
            let [a, b, c] = [a, b, c].map(metres);
            let twice_area = (b - a).cross(c - a);
            (twice_area != 0.0).then_some(if twice_area > 0.0 { [a, b, c] } else { [a, c, b] })
        };
        Triangles { corners: mesh.triangles().filter_map(oriented).collect() }
    }

    /// Counter-clockwise convex polygons that fill it: Delaunay's triangles, joined where they stay convex.
    pub fn convex_pieces(&self) -> Vec<Vec<Vec2>> {
        let validation = Validation { fill_rule: FillRule::Positive, options: Default::default() };
        let pieces = self.shapes.custom_triangulate(validation).into_delaunay().to_convex_polygons();
        pieces.into_iter().map(|piece| piece.into_iter().map(metres).collect()).collect()
    }
}

/// Corners in a straight line stay: other surfaces may end there.
fn keep_all<U: i_overlay::i_float::int::number::uint::UIntNumber>() -> IntOverlayOptions<U> {
    IntOverlayOptions::keep_all_points()
}

impl Triangles {
    /// Total area, square metres.
    #[cfg(test)]
    pub fn area_m2(&self) -> f64 {
        self.corners.iter().map(|[a, b, c]| (*b - *a).cross(*c - *a) * 0.5).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, side: f64) -> PolygonSet {
        PolygonSet::rectangles([Rect { min: vec2(x, y), max: vec2(x + side, y + side) }])
    }

    #[test]
    fn a_ring_has_a_hole_that_filling_closes() {
        let ring = square(0.0, 0.0, 4.0).minus(&square(1.0, 1.0, 2.0));
        assert_eq!(ring.triangles().area_m2(), 12.0);
        assert_eq!(ring.loops().count(), 2);
        assert_eq!(ring.filled().triangles().area_m2(), 16.0);
    }

    #[test]
    fn growing_keeps_right_angles_and_shrinking_undoes_it() {
        let grown = square(0.0, 0.0, 2.0).grown(0.5);
        assert!((grown.triangles().area_m2() - 9.0).abs() < 1e-9);
        assert!((grown.grown(-0.5).triangles().area_m2() - 4.0).abs() < 1e-9);
    }

    #[test]
    fn an_island_in_a_hole_is_kept() {
        let ring = square(0.0, 0.0, 5.0).minus(&square(1.0, 1.0, 3.0)).union(&square(2.0, 2.0, 1.0));
        assert_eq!(ring.triangles().area_m2(), 25.0 - 9.0 + 1.0);
        assert_eq!(ring.loops().count(), 3);
    }

    #[test]
    fn loops_that_cross_themselves_or_are_no_numbers_do_no_harm() {
        let bow = [vec2(0.0, 0.0), vec2(0.0, 2.0), vec2(2.0, 0.0), vec2(2.0, 2.0)];
        let bad = [vec2(f64::NAN, 0.0), vec2(0.0, 1.0), vec2(1.0, 1.0), vec2(1e300, 0.0)];
        let region = PolygonSet::inside_right([bow, bad]);
        assert_eq!(region.triangles().area_m2(), 1.0);
        assert_eq!(PolygonSet::default().grown(1.0).triangles().area_m2(), 0.0);
    }
}
