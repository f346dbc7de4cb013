//! Wall faces as upright quads, one part per wall sheet.

use super::builder::{MeshVertex, SceneBuilder};
use super::model::{SceneSurface, WallStrip};
use super::region::snap;
use super::tiles::TileCuts;
use crate::math::Vec2;
use crate::walls::Face;

/// Cosine of the largest turn that belongs to a curved wall, 40 degrees; a wall that turns by more has an edge there.
const SMOOTH_COSINE: f64 = 0.766;

/// A wall this many times as long as the next piece of a curve stays flat where it runs out into it.
const FLAT_RATIO: f64 = 4.0;
/// Arc lengths closer than this are the same place, metres.
const SAME_M: f64 = 1e-6;

/// A place along a face where something ends or starts.
#[derive(Clone, Copy, Debug)]
struct PanelEdge {
    along_m: f64,
    point: Vec2,
    /// Points to the floor; of unit length.
    normal: Vec2,
}

/// Adds the walls' faces by sheet, but for those for which fittings stand. Wall without a strip becomes clean wall.
pub(super) fn add(
    faces: &[Face],
    fitted: &[bool],
    strips: &[WallStrip],
    cuts: &TileCuts,
    height_m: f64,
    scene: &mut SceneBuilder,
) {
    let mut by_face: Vec<Vec<&WallStrip>> = vec![Vec::new(); faces.len()];
    for strip in strips.iter().filter(|s| s.along_m.iter().chain(s.uv.iter().flatten()).all(|v| v.is_finite())) {
        if let Some(of_face) = by_face.get_mut(strip.face) {
            of_face.push(strip);
        }
    }
    for (((number, face), mut strips), _) in
        faces.iter().enumerate().zip(by_face).zip(fitted).filter(|(_, fitted)| !**fitted)
    {
        strips.sort_by(|a, b| a.along_m[0].total_cmp(&b.along_m[0]));
        for stretch in stretches(face) {
            for [from, to] in panels(stretch, &strips, cuts) {
                let middle_m = (from.along_m + to.along_m) * 0.5;
                let strip = strips.iter().rev().find(|s| s.along_m[0] <= middle_m && middle_m <= s.along_m[1]);
                let heights_m = [face.furniture_m.map_or(height_m, |low_m| low_m.min(height_m)), height_m];
                let corners = quad([from, to], strip.map(|s| **s), heights_m);
                match strip {
                    Some(strip) => scene.part(SceneSurface::WallSheet(strip.sheet)).wall(number, &corners),
                    None => scene.part(SceneSurface::Lintel).polygon(&corners),
                }
            }
        }
    }
}

/// The straight stretches of a face, with the normals at their ends: shared where the face curves, apart at edges.
fn stretches(face: &Face) -> Vec<[PanelEdge; 2]> {
    let points: Vec<Vec2> = face.points_m.iter().copied().map(snap).collect();
    let count = if face.closed { points.len() } else { points.len().saturating_sub(1) };
    let mut along_m = 0.0;
    let mut stretches = Vec::with_capacity(count);
    for k in 0..count {
        let next = (k + 1) % points.len();
        // Arc length is what strips count by: that of the face as it was traced.
        let length_m = face.points_m[k].distance(face.points_m[next]);
        if let Some(direction) = (points[next] - points[k]).normalized() {
            let normal = -direction.left();
            let post = |along_m, point| PanelEdge { along_m, point, normal };
            stretches.push([post(along_m, points[k]), post(along_m + length_m, points[next])]);
        }
        along_m += length_m;
    }
    smooth(&mut stretches, face.closed);
    stretches
}

fn smooth(stretches: &mut [[PanelEdge; 2]], closed: bool) {
    let count = stretches.len();
    let flat: Vec<(Vec2, f64)> = stretches.iter().map(|[a, b]| (a.normal, a.point.distance(b.point))).collect();
    for k in 0..if closed { count } else { count.saturating_sub(1) } {
        let next = (k + 1) % count;
        let ((n0, l0), (n1, l1)) = (flat[k], flat[next]);
        if next != k && n0.dot(n1) > SMOOTH_COSINE {
            let normal = if l0 > FLAT_RATIO * l1 {
                n0
            } else if l1 > FLAT_RATIO * l0 {
                n1
            } else {
                // A circle's normal lies nearer to that of the shorter chord.
                (n0 * l1 + n1 * l0).normalized().unwrap_or(n0)
            };
            stretches[k][1].normal = normal;
            stretches[next][0].normal = normal;
        }
    }
}

/// A stretch, cut where strips and floor tiles end.
fn panels(stretch: [PanelEdge; 2], strips: &[&WallStrip], cuts: &TileCuts) -> Vec<[PanelEdge; 2]> {
    let [a, b] = stretch;
    let length_m = b.along_m - a.along_m;
    let at = |along_m: f64, point: Option<Vec2>| {
        let share = if length_m > 0.0 { (along_m - a.along_m) / length_m } else { 0.0 };
        let normal = a.normal.lerp(b.normal, share).normalized().unwrap_or(a.normal);
        PanelEdge { along_m, point: point.unwrap_or_else(|| a.point.lerp(b.point, share)), normal }
    };
    let mut posts = vec![a];
    let edge = cuts.edge(a.point, b.point);
    let straight_m = a.point.distance(b.point);
    for &point in edge.iter().skip(1).take(edge.len().saturating_sub(2)) {
        posts.push(at(a.along_m + length_m * (a.point.distance(point) / straight_m), Some(point)));
    }
    // The strips are sorted and mostly lie elsewhere.
    let from = strips.partition_point(|s| s.along_m[1] <= a.along_m);
    for strip in strips[from.min(strips.len())..].iter().take_while(|s| s.along_m[0] < b.along_m) {
        for end_m in strip.along_m {
            // Strips break at corners, whose arc lengths may have been added up in another order.
            if end_m > a.along_m + SAME_M && end_m < b.along_m - SAME_M {
                posts.push(at(end_m, None));
            }
        }
    }
    posts.push(b);
    posts.sort_by(|p, q| p.along_m.total_cmp(&q.along_m));
    posts.windows(2).map(|w| [w[0], w[1]]).filter(|[p, q]| q.along_m > p.along_m).collect()
}

/// Counter-clockwise as seen from the floor, up to a height that may be less than that of its strip.
fn quad([a, b]: [PanelEdge; 2], strip: Option<WallStrip>, [height_m, strip_m]: [f64; 2]) -> [MeshVertex; 4] {
    let corner = |post: PanelEdge, top: bool| {
        let z = if top { height_m } else { 0.0 };
        let on_strip = |s: WallStrip| s.uv_at(post.along_m, z / strip_m).map(|v| v.clamp(0.0, 1.0));
        MeshVertex {
            position_m: [post.point.x, post.point.y, z],
            normal: [post.normal.x, post.normal.y, 0.0],
            uv: strip.map_or([post.along_m, -z], on_strip),
        }
    };
    [corner(a, false), corner(b, false), corner(b, true), corner(a, true)]
}
