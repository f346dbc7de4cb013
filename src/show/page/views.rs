//! Where to stand at first.

use super::Viewpoint;
use super::field::Field;
use super::lamps;
use crate::math::{self, Vec2};
use crate::walls::Walls;

/// How far inside an opening one stands, metres.
const INSIDE_M: f64 = 1.2;
/// Farther than that nobody makes anything out, metres.
const FAR_M: f64 = 40.0;
const STEP_M: f64 = 0.5;
/// Directions that are tried.
const DIRECTIONS: u32 = 32;
/// Places that are tried, at most.
const MOST_PLACES: usize = 200;
/// Down to the floor, which is what there is to see, radians.
const PITCH_RAD: f64 = -0.16;

/// The longest view of all openings and lamps; the first of those that are alike.
pub(super) fn longest(walls: &Walls) -> Viewpoint {
    let mut best = Viewpoint { at_m: walls.bounds_m().centre(), heading_rad: 0.0, pitch_rad: PITCH_RAD };
    let mut best_m = 0.0;
    for at_m in openings(walls).into_iter().chain(lamp_places(walls)).take(MOST_PLACES) {
        for k in 0..DIRECTIONS {
            let heading_rad = f64::from(k) * std::f64::consts::TAU / f64::from(DIRECTIONS);
            let seen_m = seen(walls, at_m, heading_rad);
            if seen_m > best_m + STEP_M {
                (best, best_m) = (Viewpoint { at_m, heading_rad, ..best }, seen_m);
            }
        }
    }
    best
}

/// How far one sees from the middle of the way, its sides free: a view past a door's edge is none.
fn seen(walls: &Walls, from: Vec2, heading_rad: f64) -> f64 {
    const BESIDE_M: f64 = 0.4;
    let (sine, cosine) = math::sin_cos(heading_rad);
    let along = Vec2 { x: cosine, y: sine };
    let free = |length_m: f64| {
        [-BESIDE_M, 0.0, BESIDE_M].iter().all(|&beside| {
            let start = from + along.left() * beside;
            let end = start + along * length_m;
            walls.bounds_m().contains(end) && walls.is_inside(end) && walls.sight(start, end)
        })
    };
    let mut length_m = 0.0;
    while length_m < FAR_M && free(length_m + STEP_M) {
        length_m += STEP_M;
    }
    length_m
}

/// Inside the middles of all openings, widest first.
fn openings(walls: &Walls) -> Vec<Vec2> {
    let mut places = Vec::new();
    for outline in walls.outlines() {
        for &(edge, _) in &outline.openings {
            let [a, b] = outline.edge(edge);
            let Some(along) = (b - a).normalized() else { continue };
            // The floor lies on the right.
            let inside = a.lerp(b, 0.5) - along.left() * INSIDE_M;
            if walls.is_inside(inside) && walls.nearest(inside, 0.4).is_none() {
                places.push((a.distance(b), inside));
            }
        }
    }
    places.sort_by(|a, b| b.0.total_cmp(&a.0));
    places.into_iter().map(|(_, place)| place).collect()
}

fn lamp_places(walls: &Walls) -> Vec<Vec2> {
    lamps::hang(walls, &Field::of(walls)).iter().map(|lamp| lamp.centre_m).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::FloorPlan;
    use crate::walls::WallsOptions;

    fn walls(rows: &[&str]) -> Walls {
        let floor = rows.iter().flat_map(|row| row.bytes()).map(|c| u8::from(c == b'.')).collect();
        let plan = FloorPlan::from_mask(rows[0].len() as u32, rows.len() as u32, 1.0, floor);
        Walls::trace(&plan, &WallsOptions::default())
    }

    #[test]
    fn one_looks_down_the_corridor() {
        let view = longest(&walls(&["################", "................", "................", "################"]));
        assert!((view.at_m.y - 2.0).abs() < 0.8, "{view:?}");
        let towards_the_middle = (8.0 - view.at_m.x) * math::sin_cos(view.heading_rad).1;
        assert!(towards_the_middle > 6.0, "{view:?}");
    }

    #[test]
    fn a_closed_room_has_a_view_too() {
        let walls = walls(&["########", "#......#", "#......#", "########"]);
        let view = longest(&walls);
        assert!(walls.is_inside(view.at_m) && walls.nearest(view.at_m, 0.3).is_none(), "{view:?}");
    }
}
