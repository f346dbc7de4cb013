//! Tops of walls and pillars, and outer sides of the rim.

use super::builder::{MeshBuilder, MeshVertex};
use super::region::{PolygonSet, snap};
use crate::math::{Rect, Vec2, vec2};
use crate::walls::Outline;

/// Walls between floors are closed on top up to twice this thickness, metres, also where they join the outer wall.
const CLOSED_M: f64 = 0.75;
/// How far the rim goes on past an opening before it is cut off there, metres.
const PAST_M: f64 = 4.0 * CLOSED_M;

/// The solid part of a plan as seen from above.
pub(super) struct Solid {
    /// Tops of walls.
    pub tops: PolygonSet,
    /// Floor and tops together: its outline is where the plan ends.
    pub whole: PolygonSet,
    /// The edges at which the floor goes on beyond the plan.
    openings: Vec<[Vec2; 2]>,
}

impl Solid {
    /// Walls and pillars between floors entirely, a rim of `rim_m` metres around the outer ones, nothing beyond
    /// openings.
    pub fn around(floor: &PolygonSet, outlines: &[Outline], rim_m: f64) -> Solid {
        let aprons = PolygonSet::rectangles(rectangles_beyond(outlines, 0.0, PAST_M));
        let beyond = PolygonSet::rectangles(rectangles_beyond(outlines, CLOSED_M, 2.0 * PAST_M));
        let walked = floor.union(&aprons);
        // Grown and shrunk again, what is narrow closes up; holes that are left are filled.
        let closed = walked.grown(CLOSED_M + rim_m).filled().grown(-CLOSED_M).filled();
        let tops = closed.minus(&walked).minus(&beyond);
        let whole = floor.union(&tops);
        let openings = outlines.iter().flat_map(|o| o.openings.iter().map(|&(k, _)| o.edge(k).map(snap))).collect();
        Solid { tops, whole, openings }
    }

    /// The tops, at a height.
    pub fn add_tops(&self, height_m: f64, part: &mut MeshBuilder) {
        add_level(&self.tops, height_m, part);
    }

    /// Outer sides, from the floor's level up.
    pub fn add_sides(&self, height_m: f64, part: &mut MeshBuilder) {
        for points in self.whole.loops() {
            let points: Vec<Vec2> = points.collect();
            for (k, &a) in points.iter().enumerate() {
                let b = points[(k + 1) % points.len()];
                for [a, b] in self.without_openings(a, b) {
                    add_upright([a, b], [0.0, height_m], part);
                }
            }
        }
    }

    /// The parts of an edge that are no opening.
    fn without_openings(&self, a: Vec2, b: Vec2) -> Vec<[Vec2; 2]> {
        /// Corners are rounded to a micrometre.
        const NEAR_M: f64 = 1e-5;
        let Some(direction) = (b - a).normalized() else { return Vec::new() };
        // Openings lie in the image's sides.
        if direction.x.abs().min(direction.y.abs()) > NEAR_M {
            return vec![[a, b]];
        }
        let length = a.distance(b);
        let mut rest = vec![[0.0, length]];
        for opening in &self.openings {
            let off = |p: Vec2| (p - a).cross(direction).abs();
            if off(opening[0]) > NEAR_M || off(opening[1]) > NEAR_M {
                continue;
            }
            let [p, q] = opening.map(|p| (p - a).dot(direction));
            let (from, to) = (p.min(q), p.max(q));
            let outside = |[low, high]: [f64; 2]| [[low, high.min(from)], [low.max(to), high]];
            rest = rest.into_iter().flat_map(outside).filter(|[low, high]| high - low > NEAR_M).collect();
        }
        let at = |s: f64| {
            if s == 0.0 {
                a
            } else if s == length {
                b
            } else {
                snap(a + direction * s)
            }
        };
        rest.into_iter().map(|piece| piece.map(at)).collect()
    }
}

/// Rectangles outside the plan's openings, `aside_m` wider on both sides.
fn rectangles_beyond(outlines: &[Outline], aside_m: f64, out_m: f64) -> Vec<Rect> {
    let mut rectangles = Vec::new();
    for outline in outlines {
        for &(k, side) in &outline.openings {
            let [a, b] = outline.edge(k);
            let out = side.outward();
            let aside = vec2(out.y.abs(), out.x.abs()) * aside_m;
            let along = Rect::around(a, b);
            rectangles.push(Rect::around(along.min - aside, along.max + aside + out * out_m));
        }
    }
    rectangles
}

/// A level area, seen from above.
pub(super) fn add_level(region: &PolygonSet, height_m: f64, part: &mut MeshBuilder) {
    for corners in region.triangles().corners {
        part.triangle(corners.map(|p| MeshVertex {
            position_m: [p.x, p.y, height_m],
            normal: [0.0, 0.0, 1.0],
            uv: [p.x, -p.y],
        }));
    }
}

/// A level area, seen from below.
pub(super) fn add_underside(region: &PolygonSet, height_m: f64, part: &mut MeshBuilder) {
    for corners in region.triangles().corners {
        let [a, b, c] =
            corners.map(|p| MeshVertex { position_m: [p.x, p.y, height_m], normal: [0.0, 0.0, -1.0], uv: [p.x, p.y] });
        part.triangle([a, c, b]);
    }
}

/// An upright quad over an edge, seen from its right.
pub(super) fn add_upright([a, b]: [Vec2; 2], [low, high]: [f64; 2], part: &mut MeshBuilder) {
    let Some(direction) = (b - a).normalized() else { return };
    let normal = -direction.left();
    let corner = |p: Vec2, z: f64| MeshVertex {
        position_m: [p.x, p.y, z],
        normal: [normal.x, normal.y, 0.0],
        uv: [p.dot(direction), -z],
    };
    part.polygon(&[corner(a, low), corner(b, low), corner(b, high), corner(a, high)]);
}
