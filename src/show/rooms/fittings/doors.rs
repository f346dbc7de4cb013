//! Door leaves that stand open.

use super::finish::Finish;
use super::prism::{Fitting, LeafUse};
use super::shape::{Block, contains};
use crate::look::WIDEST_FRAMED_M;
use crate::math::{Vec2, sin_cos};
use crate::walls::{Doorway, Walls};

/// Thickness of a leaf and gap around it, metres.
const THICK_M: f64 = 0.042;
const GAP_M: f64 = 0.008;
/// A wider door has two leaves, metres.
const ONE_LEAF_M: f64 = 1.25;
/// Deepest wall in which a leaf hangs, metres.
const DEEPEST_M: f64 = 0.7;
/// Angles at which a leaf may stand open, degrees, the likeliest first: none stands in the way.
const ANGLES_DEG: [f64; 6] = [102.0, 95.0, 112.0, 125.0, 90.0, 160.0];
/// A leaf keeps so far from walls and furniture, and from where other doors are, metres.
const CLEAR_M: f64 = 0.03;
const CLEAR_OF_DOORS_M: f64 = 0.3;
/// Cosine and sine of the directions in which it is looked along: -35, 0 and 35 degrees.
const ASLANT: [[f64; 2]; 3] = [[0.819, -0.574], [1.0, 0.0], [0.819, 0.574]];
/// How far the room behind a door is looked along, metres.
const SIGHT_M: f64 = 7.0;

/// An open leaf: its hinge, unit vectors along it and away from the way through, its length in metres.
struct Leaf {
    hinge: Vec2,
    along: Vec2,
    behind: Vec2,
    length_m: f64,
}

/// The leaves of all doors that have room for them, with their handles.
pub(super) fn leaves(walls: &Walls, doorways: &[Doorway], height_m: f64) -> Vec<Fitting> {
    let mut standing: Vec<Fitting> = Vec::new();
    for door in doorways {
        let fits = door.width_m() <= WIDEST_FRAMED_M && door.depth_m <= DEEPEST_M && door.head_m <= height_m;
        let others: Vec<&Doorway> = doorways.iter().filter(|other| *other != door).collect();
        if fits {
            let leaves = hung(walls, door, &others, &standing);
            standing.extend(leaves.iter().flat_map(|leaf| leaf.parts(door.head_m)));
        }
    }
    standing
}

/// How a door's leaves stand open: as they are drawn; else into the deeper room, hinged where a wall is nearest.
fn hung(walls: &Walls, door: &Doorway, others: &[&Doorway], standing: &[Fitting]) -> Vec<Leaf> {
    let middle = door.jambs_m[0].lerp(door.jambs_m[1], 0.5);
    let free_m = |from: Vec2, way: Vec2| {
        let steps = (1..=(SIGHT_M / 0.25) as u32).map(|k| f64::from(k) * 0.25);
        steps.take_while(|m| walls.is_inside(from + way * *m)).last().unwrap_or(0.0)
    };
    let mut sides = [door.through, -door.through];
    // Beyond the plan nothing is known.
    let inner = |way: Vec2| walls.bounds_m().contains(middle + way * (0.5 * door.depth_m + 1.0));
    // A corridor is deep only where a door stands opposite: what is seen aslant counts as well.
    let depth_m = |way: Vec2| {
        let from = middle + way * (0.5 * door.depth_m + 0.1);
        let turned = ASLANT.map(|[cosine, sine]| free_m(from, way.rotated(crate::math::vec2(cosine, sine))));
        if inner(way) { turned.into_iter().fold(f64::INFINITY, f64::min) } else { -1.0 }
    };
    sides.sort_by(|a, b| depth_m(*b).total_cmp(&depth_m(*a)));
    if let Some([hinge, end]) = door.leaf_m {
        // A stable sort: a leaf whose side is unknown leaves the order.
        sides.sort_by_key(|way| way.dot(end - hinge) < 0.0);
    }
    let is_free = |leaf: &Leaf| leaf.is_free(walls, others, standing);
    for side in sides {
        for angle_deg in ANGLES_DEG {
            let leaf = |hinge: usize, count: f64| Leaf::of(door, hinge, side, angle_deg, count);
            if door.width_m() > ONE_LEAF_M {
                let both = [leaf(0, 2.0), leaf(1, 2.0)];
                if both.iter().flatten().filter(|leaf| is_free(leaf)).count() == 2 {
                    return both.into_iter().flatten().collect();
                }
                continue;
            }
            let aside_m = |jamb: usize| {
                let way = (door.jambs_m[jamb] - middle).normalized().unwrap_or(side.left());
                free_m(door.jambs_m[jamb] + side * (0.5 * door.depth_m + 0.3), way)
            };
            let [first_m, second_m] = match door.leaf_m {
                Some([hinge, _]) => door.jambs_m.map(|jamb| jamb.distance(hinge)),
                None => [aside_m(0), aside_m(1)],
            };
            let first = usize::from(second_m < first_m);
            if let Some(leaf) = [first, 1 - first].into_iter().filter_map(|hinge| leaf(hinge, 1.0)).find(is_free) {
                return vec![leaf];
            }
        }
    }
    Vec::new()
}

impl Leaf {
    fn of(door: &Doorway, hinge: usize, side: Vec2, angle_deg: f64, count: f64) -> Option<Leaf> {
        let closed = (door.jambs_m[1 - hinge] - door.jambs_m[hinge]).normalized()?;
        let (sine, cosine) = sin_cos(angle_deg * std::f64::consts::PI / 180.0);
        Some(Leaf {
            hinge: door.jambs_m[hinge] + side * (0.5 * door.depth_m + GAP_M),
            along: closed * cosine + side * sine,
            behind: side * cosine - closed * sine,
            length_m: door.width_m() / count - 2.0 * GAP_M,
        })
    }

    /// Place at a distance from the hinge and from the leaf's front, metres.
    fn at(&self, along_m: f64, behind_m: f64) -> Vec2 {
        self.hinge + self.along * along_m + self.behind * behind_m
    }

    fn is_free(&self, walls: &Walls, others: &[&Doorway], standing: &[Fitting]) -> bool {
        let steps = (self.length_m / 0.1).ceil().max(1.0) as u32;
        let places = (0..=steps).map(|k| 0.12 + (self.length_m - 0.12) * f64::from(k) / f64::from(steps));
        let bounds = walls.bounds_m();
        places.flat_map(|along_m| [self.at(along_m, 0.0), self.at(along_m, THICK_M)]).all(|p| {
            let off_doors = others.iter().all(|other| {
                let [a, b] = other.jambs_m;
                let along = b - a;
                let share = ((p - a).dot(along) / along.length_squared().max(1e-9)).clamp(0.0, 1.0);
                p.distance(a + along * share) > CLEAR_OF_DOORS_M
            });
            bounds.contains(p)
                && walls.is_inside(p)
                && off_doors
                && walls.nearest(p, CLEAR_M).is_none()
                && !standing.iter().any(|fitting| contains(&fitting.footprint, p))
        })
    }

    /// The leaf, pushed on its front, and a handle on both of its faces.
    fn parts(&self, head_m: f64) -> Vec<Fitting> {
        let block = |[from, to]: [f64; 2], [front, back]: [f64; 2], span_m, finish| {
            let centre = self.at(0.5 * (from + to), 0.5 * (front + back));
            let half = [0.5 * (to - from), 0.5 * (back - front)];
            Fitting { footprint: Block { centre, along: self.along, half }.corners(), span_m, finish, leaf: None }
        };
        let end = self.length_m;
        let leaf = block([GAP_M, end], [0.0, THICK_M], [0.008, head_m - GAP_M], Finish::Door);
        let hung = LeafUse { hinge: self.at(GAP_M, 0.0), length_m: end - GAP_M, used: 0.0 };
        let mut parts = vec![Fitting { leaf: Some(hung), ..leaf }];
        for (plate, lever) in
            [([-0.008, 0.0], [-0.055, -0.037]), ([THICK_M, THICK_M + 0.008], [THICK_M + 0.037, THICK_M + 0.055])]
        {
            let neck = [plate[0].min(lever[0]), plate[1].max(lever[1])];
            parts.push(block([end - 0.085, end - 0.045], plate, [0.93, 1.12], Finish::Metal));
            parts.push(block([end - 0.075, end - 0.055], neck, [1.04, 1.06], Finish::Metal));
            parts.push(block([end - 0.19, end - 0.055], lever, [1.04, 1.06], Finish::Metal));
        }
        parts
    }
}
