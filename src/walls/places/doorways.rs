//! Finds doorways: gaps in walls with the shape of a door.
//!
//! A gap is a local minimum of the floor's width: two points on walls with no wall in the disc between them, at least
//! one of them an outer corner (between two flat walls lies a corridor). A gap is a door if its width is in range and
//! the floor widens within a wall's thickness on both sides, and stays wide.

use std::f64::consts::TAU;

use super::corners::turn_rad;
use super::rays::{Hit, Rays};
use crate::math::{Rect, Vec2, sin_cos, vec2};
use crate::walls::{Face, Segment, Walls};

/// A doorway: a gap of 0.7 to 2.0 m between two wall ends, with more floor on either side.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Doorway {
    /// Middles of the two jambs, metres: the ends of the threshold.
    pub jambs_m: [Vec2; 2],
    /// Face and arc length, metres, of each jamb; faces index [`crate::walls::Walls::faces`].
    pub on_faces: [(usize, f64); 2],
    /// Thickness of the wall, metres.
    pub depth_m: f64,
    /// Unit vector through the door, across the threshold.
    pub through: Vec2,
    /// Height of the door's head above the floor, metres; default `DOOR_HEAD_M`.
    pub head_m: f64,
    /// Hinge and far end of its open leaf, metres, where a plan or a scenario tells; both the same if the side is unknown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub leaf_m: Option<[Vec2; 2]>,
}

/// Default height of a door's head above the floor, metres.
pub const DOOR_HEAD_M: f64 = 2.1;

impl Doorway {
    /// Clear width between the jambs, metres.
    pub fn width_m(&self) -> f64 {
        self.jambs_m[0].distance(self.jambs_m[1])
    }
}

/// Smallest and largest clear width of a door, metres.
pub const DOOR_WIDTHS_M: [f64; 2] = [0.7, 2.0];

/// Tolerance of drawn widths, metres.
const DRAWN_M: f64 = 0.03;
/// Least turn of a corner that bounds a gap, radians.
const LEAST_OUTER_RAD: f64 = 0.25;
/// Radius of the free disc between the jambs, as a share of the gap's half width.
const FREE: f64 = 0.9;
/// Thickest wall with a door, metres.
const DEEPEST_M: f64 = 0.65;
/// Sampling step along the path through the door, metres.
const STEP_M: f64 = 0.05;
/// Least widening of the floor behind a gap, metres.
const WIDENS_M: f64 = 0.22;
/// Least widening if the other jamb is a straight wall, metres: the wall with the door is longer than a stub.
const WIDENS_BESIDE_WALL_M: f64 = 0.5;
/// Depths behind the door that must be free, and stay wide unless a wall comes first, metres. A corridor with doors on
/// its sides widens for less.
const ROOM_M: f64 = 0.45;
const STAYS_WIDE_M: f64 = 1.1;
/// Least widening beside a jamb, metres.
const STEPS_BACK_M: f64 = 0.05;
/// Widest gap that is a door's even where walls are too rough to tell their ends, metres.
const SINGLE_M: f64 = 1.0;
/// Cosine of the least angle between a gap and the face of a jamb that stands across it.
const SQUARE: f64 = 0.5;
/// Distances behind a jamb and beside the wall's end at which there is floor, metres.
const BEHIND_JAMB_M: f64 = 0.08;
const BESIDE_END_M: f64 = 0.12;
/// Least length of a free-standing wall beside a door, metres.
const GOES_ON_M: f64 = 0.7;
/// Widest gap between a wall's end and a straight wall, metres.
const WIDEST_BESIDE_WALL_M: f64 = 1.5;
/// Length of rays to either side, metres.
const SIGHT_M: f64 = 2.5;
/// Size below which a free-standing object is a pillar or furniture, metres. Below `POST_M` it may be the middle post
/// of a double door.
const WALL_M: f64 = 1.2;
const POST_M: f64 = 0.36;
/// Doorways closer than this share of the narrower one's width are duplicates.
const SAME: f64 = 0.6;
/// Number of directions tried for a door given by its middle.
const DIRECTIONS: u32 = 72;
/// Probe for a free disc in front of a corner: distance, metres, and directions from the bisector.
const PROBE_M: f64 = 0.3;
const PROBE_TURNS_RAD: [f64; 3] = [0.0, 0.75, -0.75];

/// An outer corner of a face.
struct Outer {
    point_m: Vec2,
    before: Vec2,
    after: Vec2,
}

/// A doorway, and the post, if any, that needs a second gap on its other side.
struct Found {
    doorway: Doorway,
    post: Option<usize>,
}

/// Size of the free-standing object inside a face, metres; `None` for the walls of a room.
fn island_m(face: &Face) -> Option<f64> {
    if !face.closed {
        return None;
    }
    let (mut area_m2, mut bounds) = (0.0, Rect { min: face.points_m[0], max: face.points_m[0] });
    for (k, &a) in face.points_m.iter().enumerate() {
        let b = face.points_m[(k + 1) % face.points_m.len()];
        area_m2 += 0.5 * a.cross(b);
        bounds.min = vec2(bounds.min.x.min(a.x), bounds.min.y.min(a.y));
        bounds.max = vec2(bounds.max.x.max(a.x), bounds.max.y.max(a.y));
    }
    // The floor is on the right: a counter-clockwise face is around a hole in it.
    (area_m2 > 0.0).then(|| bounds.width().max(bounds.height()))
}

/// Returns all doorways of a plan.
pub(super) fn find(walls: &Walls) -> Vec<Doorway> {
    let islands: Vec<Option<f64>> = walls.faces.iter().map(island_m).collect();
    let is_pillar = |face: usize| islands[face].is_some_and(|size_m| size_m < WALL_M);
    let mut gaps: Vec<[Vec2; 2]> = Vec::new();
    let mut near = Vec::new();
    for (number, face) in walls.faces.iter().enumerate() {
        // A gap beside a post is found from the opposite wall.
        if is_pillar(number) || face.furniture_m.is_some() {
            continue;
        }
        for corner in outer_corners(face) {
            gaps_at(walls, &corner, &mut near, &mut gaps);
        }
    }
    // Each gap is found from both of its ends.
    let key = |gap: &[Vec2; 2]| (gap[0].lerp(gap[1], 0.5), gap[0].distance(gap[1]));
    let ordered = |a: &[Vec2; 2], b: &[Vec2; 2]| {
        let ((pa, wa), (pb, wb)) = (key(a), key(b));
        wa.total_cmp(&wb).then(pa.x.total_cmp(&pb.x)).then(pa.y.total_cmp(&pb.y))
    };
    gaps.sort_by(ordered);
    gaps.dedup_by(|a, b| key(a).0.distance(key(b).0) < 1e-6);
    let found = gaps.iter().filter_map(|&gap| judged(walls, gap, &islands)).collect();
    let mut doorways = without_repeats(with_whole_posts(found));
    doorways.sort_by(|a, b| a.on_faces[0].0.cmp(&b.on_faces[0].0).then(a.on_faces[0].1.total_cmp(&b.on_faces[0].1)));
    doorways
}

fn outer_corners(face: &Face) -> impl Iterator<Item = Outer> {
    let n = face.points_m.len();
    let vertices = if face.closed { 0..n } else { 1..n.max(2) - 1 };
    vertices.filter_map(move |k| {
        let at = face.points_m[k];
        let before = (at - face.points_m[(k + n - 1) % n]).normalized()?;
        let after = (face.points_m[(k + 1) % n] - at).normalized()?;
        let is_outer = turn_rad(before, after) < -LEAST_OUTER_RAD;
        is_outer.then_some(Outer { point_m: at, before, after })
    })
}

/// Appends the gaps that end at a corner.
fn gaps_at(walls: &Walls, corner: &Outer, near: &mut Vec<Segment>, gaps: &mut Vec<[Vec2; 2]>) {
    let at = corner.point_m;
    // Skip corners without room for a door in front of them.
    let ahead = (corner.before - corner.after).normalized().unwrap_or(-corner.before.left());
    let has_room = PROBE_TURNS_RAD.iter().any(|&turn_rad| {
        let (sin, cos) = sin_cos(turn_rad);
        let probe = at + ahead.rotated(vec2(cos, sin)) * PROBE_M;
        walls.nearest(probe, FREE * PROBE_M).is_none()
    });
    if !has_room {
        return;
    }
    let [least_m, most_m] = [DOOR_WIDTHS_M[0] - DRAWN_M, DOOR_WIDTHS_M[1] + DRAWN_M];
    near.clear();
    walls.segments_near(Rect { min: at, max: at }.grown(most_m), near);
    for segment in near.iter() {
        if segment.face.is_none_or(|face| walls.faces[face].furniture_m.is_some()) {
            continue;
        }
        let across = closest(segment, at) - at;
        let width_m = across.length();
        if !(least_m..=most_m).contains(&width_m) {
            continue;
        }
        let along = across / width_m;
        let leaves_the_wall = along.dot(corner.before) > -0.1 && along.dot(corner.after) < 0.1;
        if leaves_the_wall && walls.nearest(at + across * 0.5, FREE * 0.5 * width_m).is_none() {
            gaps.push([at, at + across]);
        }
    }
}

fn closest(segment: &Segment, p: Vec2) -> Vec2 {
    let along = segment.b - segment.a;
    let squared = along.length_squared();
    if squared <= 0.0 { segment.a } else { segment.a + along * ((p - segment.a).dot(along) / squared).clamp(0.0, 1.0) }
}

/// The widening of the floor on one side of a gap.
struct Way {
    /// Distance from the gap's middle where the floor has widened, metres.
    from_m: f64,
    /// Widening at each end of the gap, metres.
    by_m: [f64; 2],
}

/// Returns the doorway at a gap, if the gap is one.
fn judged(walls: &Walls, [a, b]: [Vec2; 2], islands: &[Option<f64>]) -> Option<Found> {
    let (middle, width_m) = (a.lerp(b, 0.5), a.distance(b));
    let across = (b - a).normalized()?;
    let through = across.left();
    let rays = Rays::around(walls, middle, SIGHT_M + 0.5 * DOOR_WIDTHS_M[1] + 0.2);
    let [ahead, behind] = [through, -through].map(|way| widening(walls, &rays, middle, [across, way], width_m));
    let (ahead, behind) = (ahead?, behind?);
    let depth_m = ahead.from_m + behind.from_m;
    if depth_m > DEEPEST_M + STEP_M {
        return None;
    }
    // The floor widens beside a jamb on both sides of the door; the other end may be a straight wall.
    let least_m = [0, 1].map(|side| ahead.by_m[side].min(behind.by_m[side]));
    let most_m = [0, 1].map(|side| ahead.by_m[side].max(behind.by_m[side]));
    let is_jamb = least_m.map(|by_m| by_m >= STEPS_BACK_M);
    let flat = (0..2).find(|&side| most_m[side] < STEPS_BACK_M);
    let is_stub = flat.is_some_and(|side| least_m[1 - side] < WIDENS_BESIDE_WALL_M || width_m > WIDEST_BESIDE_WALL_M);
    if is_jamb == [false, false] || is_stub {
        return None;
    }
    let (doorway, along) = doorway(&rays, middle + through * (0.5 * (ahead.from_m - behind.from_m)), across, depth_m)?;
    if !(DOOR_WIDTHS_M[0] - DRAWN_M..=DOOR_WIDTHS_M[1] + DRAWN_M).contains(&doorway.width_m()) {
        return None;
    }
    let sizes_m = doorway.on_faces.map(|(face, _)| islands[face].unwrap_or(f64::INFINITY));
    let is_post = |side: usize| sizes_m[side] <= POST_M;
    // A shelf in front of a wall leaves a gap but no door: walls continue in line beyond both jambs.
    let goes_on = |side: usize| {
        let way = if side == 0 { -across } else { across };
        let is_wall = |share: f64| !walls.is_inside(doorway.jambs_m[side] + way * (share * GOES_ON_M));
        is_post(side) || [0.2, 0.4, 0.6, 0.8, 1.0].into_iter().all(is_wall)
    };
    // Between the jambs of doors that face each other across a corridor, neither is a wall's end with floor on both sides.
    let is_end = |side: usize| {
        let (outwards, along) = (if side == 0 { -across } else { across }, along[side]);
        let into_wall = if along.left().dot(outwards) > 0.0 { along.left() } else { -along.left() };
        let beyond = doorway.jambs_m[side] + into_wall * BEHIND_JAMB_M;
        let beside_m = 0.5 * depth_m + BESIDE_END_M;
        let is_free = |place: Vec2| walls.is_inside(place) || !walls.bounds_m().contains(place);
        along.dot(across).abs() < SQUARE && [-along, along].iter().all(|&way| is_free(beyond + way * beside_m))
    };
    if doorway.width_m() > SINGLE_M && !is_end(0) && !is_end(1) {
        return None;
    }
    let is_free_standing = sizes_m.iter().any(|size_m| size_m.is_finite());
    if is_free_standing && !(is_jamb == [true, true] && goes_on(0) && goes_on(1)) {
        return None;
    }
    let post = (0..2).find(|&side| sizes_m[side] < WALL_M);
    match post {
        Some(side) if sizes_m[side] > POST_M || sizes_m[1 - side] < WALL_M => None,
        post => Some(Found { post: post.map(|side| doorway.on_faces[side].0), doorway }),
    }
}

/// Returns the widening behind a gap, if it lies within a wall's thickness and stays wide.
fn widening(walls: &Walls, rays: &Rays, middle: Vec2, [across, way]: [Vec2; 2], width_m: f64) -> Option<Way> {
    let half_m = 0.5 * width_m;
    let by_m = |at_m: f64| {
        let from = middle + way * at_m;
        [-across, across].map(|side| (rays.clear_m(from, side, SIGHT_M) - half_m).max(0.0))
    };
    let area = walls.bounds_m();
    let beyond = |at_m: f64| !area.contains(middle + way * at_m);
    let steps = (DEEPEST_M / STEP_M + 1e-9) as u32;
    // Offset by half a step, so that no ray runs along a drawn line.
    let places = (0..=steps).map(|step| (f64::from(step) + 0.5) * STEP_M);
    for at_m in places {
        if beyond(at_m) {
            return Some(Way { from_m: at_m - 0.5 * STEP_M, by_m: [SIGHT_M; 2] });
        }
        let first = by_m(at_m);
        if first[0] + first[1] < WIDENS_M {
            continue;
        }
        let free_m = rays.clear_m(middle, way, SIGHT_M);
        let later = by_m(at_m + 0.5 * ROOM_M);
        let far = if free_m > at_m + STAYS_WIDE_M + STEP_M { by_m(at_m + STAYS_WIDE_M) } else { later };
        let is_wide = |by_m: [f64; 2]| by_m[0] + by_m[1] >= WIDENS_M;
        let stays = free_m >= at_m + ROOM_M && is_wide(later) && is_wide(far);
        let by_m = [first[0].min(later[0]), first[1].min(later[1])];
        return stays.then_some(Way { from_m: at_m - 0.5 * STEP_M, by_m });
    }
    None
}

/// Returns the doorway around a point, by rays to both sides, and the unit vectors along the walls that they hit; `None` unless
/// both hit a face.
fn doorway(rays: &Rays, middle: Vec2, across: Vec2, depth_m: f64) -> Option<(Doorway, [Vec2; 2])> {
    let hits: [Hit; 2] = [rays.cast(middle, -across, SIGHT_M)?, rays.cast(middle, across, SIGHT_M)?];
    let on_faces = [(hits[0].face?, hits[0].along_m), (hits[1].face?, hits[1].along_m)];
    let along = [hits[0].direction, hits[1].direction];
    let jambs_m = hits.map(|hit| hit.point_m);
    Some((Doorway { jambs_m, on_faces, depth_m, through: across.left(), head_m: DOOR_HEAD_M, leaf_m: None }, along))
}

/// Removes gaps beside a post that has no aligned gap on its other side.
fn with_whole_posts(found: Vec<Found>) -> Vec<Doorway> {
    let is_twin = |a: &Doorway, b: &Doorway| {
        let apart = middle(b) - middle(a);
        a.through.dot(b.through).abs() > 0.95 && apart.dot(a.through).abs() < 0.3 * apart.length()
    };
    let whole = |k: usize| match found[k].post {
        None => true,
        post => found.iter().enumerate().any(|(other, twin)| {
            other != k && twin.post == post && is_twin(&found[k].doorway, &twin.doorway) && {
                let apart = middle(&twin.doorway).distance(middle(&found[k].doorway));
                apart > 0.45 * (twin.doorway.width_m() + found[k].doorway.width_m())
            }
        }),
    };
    let kept: Vec<usize> = (0..found.len()).filter(|&k| whole(k)).collect();
    kept.into_iter().map(|k| found[k].doorway).collect()
}

/// Keeps the narrowest of overlapping doorways.
fn without_repeats(mut doorways: Vec<Doorway>) -> Vec<Doorway> {
    doorways.sort_by(|a, b| {
        let (pa, pb) = (middle(a), middle(b));
        // Rounded, so that rounding errors of widths do not decide.
        let width = |door: &Doorway| (door.width_m() * 1e3).round();
        width(a).total_cmp(&width(b)).then(pa.x.total_cmp(&pb.x)).then(pa.y.total_cmp(&pb.y))
    });
    let mut kept: Vec<Doorway> = Vec::new();
    for door in doorways {
        let repeats = |other: &Doorway| {
            let apart = middle(other).distance(middle(&door));
            apart < SAME * other.width_m() || cross(door.jambs_m, other.jambs_m)
        };
        if !kept.iter().any(repeats) {
            kept.push(door);
        }
    }
    kept
}

fn middle(door: &Doorway) -> Vec2 {
    door.jambs_m[0].lerp(door.jambs_m[1], 0.5)
}

fn cross([a, b]: [Vec2; 2], [c, d]: [Vec2; 2]) -> bool {
    let (ab, cd) = (b - a, d - c);
    (ab.cross(c - a) > 0.0) != (ab.cross(d - a) > 0.0) && (cd.cross(a - c) > 0.0) != (cd.cross(b - c) > 0.0)
}

/// Returns the narrowest gap across a point between two walls, each at most `width_m` away.
pub(super) fn across(walls: &Walls, at_m: Vec2, width_m: f64) -> Option<Doorway> {
    if !at_m.is_finite() || !width_m.is_finite() || !walls.is_inside(at_m) {
        return None;
    }
    let rays = Rays::around(walls, at_m, width_m.max(SIGHT_M) + 1.0);
    let gap = |k: u32| {
        let (sin, cos) = sin_cos(TAU * f64::from(k) / f64::from(2 * DIRECTIONS));
        let across = vec2(cos, sin);
        let ends = [rays.cast(at_m, -across, width_m)?, rays.cast(at_m, across, width_m)?];
        // Both must be visible walls, and one of them roughly perpendicular to the gap.
        let is_square = ends.iter().any(|end| end.direction.dot(across).abs() < 0.5);
        (is_square && ends.iter().all(|end| end.face.is_some()))
            .then(|| (ends[0].distance_m + ends[1].distance_m, across, ends))
    };
    let (_, across, ends) = (0..DIRECTIONS).filter_map(gap).min_by(|a, b| a.0.total_cmp(&b.0))?;
    let middle = ends[0].point_m.lerp(ends[1].point_m, 0.5);
    let gap_m = ends[0].point_m.distance(ends[1].point_m);
    let half = |way: Vec2| widening(walls, &rays, middle, [across, way], gap_m);
    let (ahead, behind) = (half(across.left()), half(-across.left()));
    let depth_m = match (&ahead, &behind) {
        (Some(ahead), Some(behind)) => ahead.from_m + behind.from_m,
        _ => 0.0,
    };
    doorway(&rays, middle, across, depth_m).map(|(doorway, _)| doorway)
}
