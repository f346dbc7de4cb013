//! Where the doors of a drawing stand: between which two ends of walls, whatever is drawn of leaf, swing and frame.

use super::area::Grid;
use super::piece::Piece;
use super::solid::box_along;
use crate::math::Vec2;

/// Widths of doors and gates, metres.
const WIDTH_M: std::ops::RangeInclusive<f64> = 0.45..=6.0;
/// Radii of the swings of leaves, metres.
const LEAF_M: std::ops::RangeInclusive<f64> = 0.35..=2.0;
/// Greatest distance of a door's end from the wall, metres.
const REACH_M: f64 = 0.25;
/// Greatest thickness of a wall with a door in it, metres.
const DEEPEST_M: f64 = 0.8;
/// Doors whose middles are closer than this are one, metres.
const SAME_M: f64 = 0.4;
/// Thickness of a shape that is a closed leaf or a threshold, metres.
const LEAF_THICK_M: f64 = 0.7;
/// Lightness of a pixel that is half wall.
const HALF: u8 = 128;

/// A door in a wall.
#[derive(Clone, Debug)]
pub(super) struct Opening {
    /// Its two sides.
    pub(super) jambs: [Vec2; 2],
    /// What lies between them, as thick as the wall.
    pub(super) area: Vec<Vec2>,
    /// Whether the wall is drawn through it.
    pub(super) is_walled: bool,
}

/// The walls as pixels, 255 where all is wall.
pub(super) struct Solid<'a> {
    pub(super) grid: Grid,
    pub(super) share: &'a [u8],
}

impl Solid<'_> {
    fn at(&self, p: Vec2) -> bool {
        self.grid.index(p).is_some_and(|at| self.share[at] >= HALF)
    }

    /// Whether walls stand within a distance.
    fn near(&self, p: Vec2, within_m: f64) -> bool {
        let step = self.grid.metres_per_pixel.max(0.02);
        let n = (within_m / step) as i32;
        (-n..=n).any(|i| (-n..=n).any(|j| self.at(p + Vec2 { x: f64::from(i), y: f64::from(j) } * step)))
    }

    /// How well a stretch fits between two ends of walls: the wall goes on beyond both.
    fn fit(&self, [a, b]: [Vec2; 2]) -> usize {
        let along = (b - a) / a.distance(b).max(1e-9);
        let side = along.left();
        let beyond = |end: Vec2, out: Vec2| {
            let at = |far: f64| [-0.06, 0.0, 0.06].iter().any(|off| self.at(end + out * far + side * *off));
            [0.05, 0.1, 0.15, 0.2].iter().filter(|far| at(**far)).count()
        };
        let (first, last) = (beyond(a, -along), beyond(b, along));
        // Both ends count: a leaf that stands open is at a wall with one of its ends.
        if first.min(last) == 0 { 0 } else { first + last }
    }

    /// How far wall reaches to the left and to the right of a stretch's end.
    fn depth(&self, beyond: Vec2, side: Vec2) -> [f64; 2] {
        let step = self.grid.metres_per_pixel * 0.25;
        [1.0, -1.0].map(|sign| {
            let mut far = 0.0;
            while far < DEEPEST_M && self.at(beyond + side * (sign * far)) {
                far += step;
            }
            far
        })
    }
}

/// Finds the doors that pieces named after doors stand for. Returns those, and how many pieces gave none.
pub(super) fn find(pieces: &[&Piece], solid: &Solid) -> Vec<Opening> {
    let mut stretches: Vec<[Vec2; 2]> = Vec::new();
    let arcs: Vec<Arc> =
        pieces.iter().filter_map(|piece| arc_of(piece)).filter(|a| LEAF_M.contains(&a.radius)).collect();
    for arc in &arcs {
        stretches.extend(arc.ends.map(|end| [arc.centre, end]));
    }
    // The two leaves of a double door meet in its middle.
    for (k, arc) in arcs.iter().enumerate() {
        for other in arcs[k + 1..].iter().take(200) {
            let meet = arc.ends.iter().any(|a| other.ends.iter().any(|b| a.distance(*b) < 0.06));
            if meet && arc.centre.distance(other.centre) > 0.3 {
                stretches.push([arc.centre, other.centre]);
            }
        }
    }
    stretches.extend(pieces.iter().filter(|piece| !piece.curved).flat_map(|piece| long_axis(piece)));
    let mut fitting: Vec<(usize, [Vec2; 2])> = stretches
        .into_iter()
        .filter(|[a, b]| WIDTH_M.contains(&a.distance(*b)) && solid.near(*a, REACH_M) && solid.near(*b, REACH_M))
        .map(|stretch| (solid.fit(stretch), stretch))
        .filter(|(fit, _)| *fit > 0)
        .collect();
    // The best first; of equals the wider, and then the order of the drawing.
    fitting.sort_by(|(f, [a, b]), (g, [c, d])| g.cmp(f).then(c.distance(*d).total_cmp(&a.distance(*b))));
    let mut doors: Vec<Opening> = Vec::new();
    for (_, [a, b]) in fitting {
        let middle = a.lerp(b, 0.5);
        let same = |door: &Opening| {
            let reach = SAME_M.max(0.5 * door.jambs[0].distance(door.jambs[1]));
            door.jambs[0].lerp(door.jambs[1], 0.5).distance(middle) < reach
        };
        if !doors.iter().any(same) {
            doors.push(opening(solid, a, b));
        }
    }
    doors
}

fn opening(solid: &Solid, a: Vec2, b: Vec2) -> Opening {
    let along = (b - a) / a.distance(b).max(1e-9);
    let side = along.left();
    let depths = [a - along * 0.1, b + along * 0.1].map(|beyond| solid.depth(beyond, side));
    // A wall that stands across at one end is deeper than the door's.
    let [left, right] = [0, 1].map(|k| depths[0][k].min(depths[1][k]));
    let (left, right) = if left + right < 0.02 { (0.1, 0.1) } else { (left, right) };
    let inner = (1..10).filter(|k| solid.at(a.lerp(b, f64::from(*k) / 10.0))).count();
    let area = if left + right > 1.5 * DEEPEST_M {
        box_along(a, b, 0.1)
    } else {
        vec![a - side * right, b - side * right, b + side * left, a + side * left]
    };
    Opening { jambs: [a, b], area, is_walled: inner >= 5 }
}

/// An arc that a polyline follows.
pub(super) struct Arc {
    pub(super) centre: Vec2,
    pub(super) radius: f64,
    ends: [Vec2; 2],
}

/// The circle that an open curve follows, if it follows one for an eighth to half of a turn.
pub(super) fn arc_of(piece: &Piece) -> Option<Arc> {
    let points = piece.loops.first().filter(|points| piece.curved && !piece.closed && points.len() >= 5)?;
    let (a, b, c) = (points[0], points[points.len() / 2], points[points.len() - 1]);
    let (u, v) = (b - a, c - a);
    let cross = 2.0 * u.cross(v);
    if cross.abs() < 1e-12 {
        return None;
    }
    let centre = a + (v.left() * u.length_squared() - u.left() * v.length_squared()) * (-1.0 / cross);
    let radius = centre.distance(a);
    let follows = points.iter().all(|p| (p.distance(centre) - radius).abs() < 0.02 * radius);
    let chord = a.distance(c) / radius.max(1e-12);
    // The chord of an eighth of a turn is 0.77 radii.
    (follows && chord > 0.7).then_some(Arc { centre, radius, ends: [a, c] })
}

/// The middle line of a line or of a thin shape, from one narrow end to the other.
pub(super) fn long_axis(piece: &Piece) -> Option<[Vec2; 2]> {
    let points = piece.loops.first()?;
    if let [a, b] = points[..] {
        return Some([a, b]);
    }
    let (a, b) =
        piece.segments().max_by(|p, q| p[0].distance(p[1]).total_cmp(&q[0].distance(q[1]))).map(|s| (s[0], s[1]))?;
    let along = (b - a).normalized()?;
    let range = |direction: Vec2| {
        let values = points.iter().map(move |p| (*p - a).dot(direction));
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
    };
    let ((low, high), (right, left)) = (range(along), range(along.left()));
    let middle = a + along.left() * ((right + left) * 0.5);
    (left - right < LEAF_THICK_M.min(0.7 * (high - low))).then(|| [middle + along * low, middle + along * high])
}
