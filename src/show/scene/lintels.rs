//! Lintels: the walls above doors.

use super::builder::SceneBuilder;
use super::model::SceneSurface;
use super::region::PolygonSet;
use super::tops::{add_level, add_underside, add_upright};
use crate::math::Vec2;
use crate::walls::{Doorway, Walls};

/// How far a doorway reaches into its jambs before it is cut to the gap, metres: jambs need not be square.
const INTO_JAMB_M: f64 = 0.05;
/// Thinnest wall, metres: plans show walls as lines.
const THINNEST_M: f64 = 0.02;
/// How far beyond a side of a lintel is looked whether there is wall or air, metres.
const PROBE_M: f64 = 0.002;

/// The floor in the gaps of doorways, which lintels span.
pub(super) fn gaps<'d>(floor: &PolygonSet, doorways: impl Iterator<Item = &'d Doorway>) -> PolygonSet {
    floor.intersection(&PolygonSet::inside_right(doorways.filter_map(gap)))
}

/// Adds lintels over gaps, from a door's height to the walls'.
pub(super) fn add(gaps: &PolygonSet, walls: &Walls, [door_m, height_m]: [f64; 2], scene: &mut SceneBuilder) {
    add_underside(gaps, door_m, scene.part(SceneSurface::Lintel));
    for points in gaps.loops() {
        let points: Vec<Vec2> = points.collect();
        for (k, &a) in points.iter().enumerate() {
            let b = points[(k + 1) % points.len()];
            let outward = (b - a).normalized().map_or(Vec2::ZERO, |direction| -direction.left());
            if walls.is_inside(a.lerp(b, 0.5) + outward * PROBE_M) {
                add_upright([a, b], [door_m, height_m], scene.part(SceneSurface::Lintel));
            }
        }
    }
    add_level(gaps, height_m, scene.part(SceneSurface::WallTop));
}

/// The gap of a doorway, a little wider than it is, clockwise.
fn gap(doorway: &Doorway) -> Option<[Vec2; 4]> {
    let [from, to] = doorway.jambs_m;
    let across = (to - from).normalized()?;
    let into = across * INTO_JAMB_M;
    let half = across.left() * (doorway.depth_m.max(THINNEST_M) * 0.5);
    let corners = [from - into - half, from - into + half, to + into + half, to + into - half];
    corners.iter().all(|p| p.is_finite()).then_some(corners)
}
