use std::f64::consts::TAU;

use super::centred;
use crate::math::{Vec2, sin_cos, vec2};

/// Polylines along which people stand, metres.
pub(in super::super) type Strokes = Vec<Vec<Vec2>>;

/// Columns and rows of a nearly square block of people.
pub(in super::super) fn grid_of(people: usize) -> [usize; 2] {
    let mut columns = 1;
    while columns * columns < people {
        columns += 1;
    }
    [columns, people.div_ceil(columns)]
}

/// A grid: rows one behind the other, the first in front, each from left to right; an incomplete last row is centred.
pub(in super::super) fn grid(people: usize, columns: usize, spacing_m: f64) -> Vec<Vec2> {
    let rows = (0..people).collect::<Vec<_>>();
    let lengths = rows.chunks(columns.max(1)).map(|row| (row.len(), 0.0));
    ranks(lengths, spacing_m, spacing_m)
}

/// Rows of one, two, three, ...: a triangle whose tip is in front.
pub(in super::super) fn ranks_of_triangle(people: usize, spacing_m: f64) -> Vec<Vec2> {
    let mut left = people;
    let rows = (1..).map_while(move |wanted| {
        let row = wanted.min(left);
        left -= row;
        // Those who do not fill the last row stand in it where others would, half a place beside the middle.
        (row > 0).then_some((row, if (wanted - row) % 2 == 1 { 0.5 } else { 0.0 }))
    });
    // Rows of an equilateral triangle.
    ranks(rows, spacing_m, spacing_m * 3.0_f64.sqrt() / 2.0)
}

/// Rows of given lengths one behind the other, each centred with an offset in places.
fn ranks(rows: impl Iterator<Item = (usize, f64)>, spacing_m: f64, depth_m: f64) -> Vec<Vec2> {
    let mut places = Vec::new();
    for (row, (length, beside)) in rows.enumerate() {
        let first_m = (beside - 0.5 * (length as f64 - 1.0)) * spacing_m;
        places.extend((0..length).map(|k| vec2(first_m + k as f64 * spacing_m, -(row as f64) * depth_m)));
    }
    let (top, bottom) = (0.0, places.last().map_or(0.0, |last| last.y));
    places.iter().map(|&place| place - vec2(0.0, (top + bottom) / 2.0)).collect()
}

/// A line of people side by side, from left to right.
pub(in super::super) fn line(people: usize, spacing_m: f64) -> Vec<Vec2> {
    grid(people, people, spacing_m)
}

/// A wedge: one person in front, the others behind to the left and right in turn; `angle_rad` between the two lines.
pub(in super::super) fn wedge(people: usize, spacing_m: f64, angle_rad: f64) -> Vec<Vec2> {
    let (sin, cos) = sin_cos(angle_rad / 2.0);
    let place = |k: usize| {
        let (behind_m, side) = (k.div_ceil(2) as f64 * spacing_m, if k % 2 == 1 { -1.0 } else { 1.0 });
        vec2(side * sin * behind_m, -cos * behind_m)
    };
    centred(&(0..people).map(place).collect::<Vec<_>>())
}

/// Concentric rings, the outermost first, with people in proportion to their length.
///
/// Each ring starts in front and goes clockwise. Without a radius, neighbours are `spacing_m` apart.
pub(in super::super) fn rings(people: usize, rings: usize, spacing_m: f64, radius_m: Option<f64>) -> Vec<Vec2> {
    let rings = rings.clamp(1, people.max(1));
    // Radii as 1, 2, 3, ...: the people of a ring are in proportion to it.
    let weights = rings * (rings + 1) / 2;
    let mut places = Vec::new();
    let mut weight_left = weights;
    for ring in (1..=rings).rev() {
        let left = people - places.len();
        let here = if ring == 1 { left } else { ((left * ring) as f64 / weight_left as f64).round() as usize };
        weight_left -= ring;
        let outer_m = radius_m.unwrap_or_else(|| ring_radius_m(people * rings / weights, spacing_m));
        let radius_m = outer_m * ring as f64 / rings as f64;
        places.extend((0..here).map(|k| {
            let (sin, cos) = sin_cos(TAU * k as f64 / here as f64);
            vec2(sin, cos) * if here == 1 && rings == 1 { 0.0 } else { radius_m }
        }));
    }
    places
}

/// Radius of a ring with a distance between neighbours, metres.
fn ring_radius_m(people: usize, spacing_m: f64) -> f64 {
    if people < 2 { spacing_m } else { spacing_m / (2.0 * sin_cos(TAU / 2.0 / people as f64).0) }
}

/// People evenly in a disc, the first at the centre (Vogel 1979, *A better way to construct the sunflower
/// head*, doi 10.1016/0025-5564(79)90080-4). Without a radius, each person has an area of `spacing_m` squared.
pub(in super::super) fn disc(people: usize, spacing_m: f64, radius_m: Option<f64>) -> Vec<Vec2> {
    const GOLDEN_ANGLE_RAD: f64 = 2.399_963_229_728_653;
    let radius_m = radius_m.unwrap_or_else(|| spacing_m * (people as f64 * 2.0 / TAU).sqrt());
    let place = |k: usize| {
        let (sin, cos) = sin_cos(GOLDEN_ANGLE_RAD * k as f64);
        vec2(sin, cos) * (radius_m * ((k as f64 + 0.5) / people as f64).sqrt())
    };
    centred(&(0..people).map(place).collect::<Vec<_>>())
}

/// A regular polygon on a circle, with one corner in front.
pub(in super::super) fn polygon(corners: usize, radius_m: f64) -> Vec<Vec2> {
    let corner = |k: usize| {
        let (sin, cos) = sin_cos(TAU * (k % corners) as f64 / corners as f64);
        vec2(sin, cos) * radius_m
    };
    (0..=corners).map(corner).collect()
}

/// A star with one point in front, whose inner corners are at `inner` times the radius.
pub(in super::super) fn star(points: usize, inner: f64, radius_m: f64) -> Vec<Vec2> {
    let count = 2 * points;
    let corner = |k: usize| {
        let (sin, cos) = sin_cos(TAU * (k % count) as f64 / count as f64);
        vec2(sin, cos) * if k.is_multiple_of(2) { radius_m } else { radius_m * inner }
    };
    (0..=count).map(corner).collect()
}

/// People evenly along a closed line, the first on its first corner; `spacing_m` scales the line to that spacing.
pub(in super::super) fn outline(people: usize, corners: &[Vec2], spacing_m: Option<f64>) -> Vec<Vec2> {
    let length_m: f64 = corners.windows(2).map(|side| side[0].distance(side[1])).sum();
    let scale = match spacing_m {
        Some(spacing_m) if length_m > 0.0 => spacing_m * people as f64 / length_m,
        _ => 1.0,
    };
    let mut places = Vec::with_capacity(people);
    let (mut side, mut behind_m) = (0, 0.0);
    for k in 0..people {
        let at_m = length_m * k as f64 / people as f64;
        while side + 2 < corners.len() && at_m > behind_m + corners[side].distance(corners[side + 1]) {
            behind_m += corners[side].distance(corners[side + 1]);
            side += 1;
        }
        let side_m = corners[side].distance(corners[side + 1]);
        let share = if side_m > 0.0 { (at_m - behind_m) / side_m } else { 0.0 };
        places.push(corners[side].lerp(corners[side + 1], share) * scale);
    }
    places
}

#[cfg(test)]
mod tests {
    use super::super::nearest_m;
    use super::*;

    #[test]
    fn a_grid_is_rows_from_the_front_left() {
        let places = grid(5, 2, 1.5);
        let expected = [[-0.75, 1.5], [0.75, 1.5], [-0.75, 0.0], [0.75, 0.0], [0.0, -1.5]];
        assert_eq!(places, expected.map(Vec2::from));
        assert_eq!(grid_of(9), [3, 3]);
        assert_eq!(grid_of(10), [4, 3]);
        assert_eq!(line(2, 2.0), [vec2(-1.0, 0.0), vec2(1.0, 0.0)]);
    }

    #[test]
    fn neighbours_are_as_far_apart_as_asked_for() {
        for people in [2, 3, 7, 40] {
            for places in [
                rings(people, 1, 0.8, None),
                ranks_of_triangle(people, 0.8),
                wedge(people, 0.8, 1.6),
                line(people, 0.8),
                grid(people, 3, 0.8),
            ] {
                assert_eq!(places.len(), people);
                assert!((nearest_m(&places) - 0.8).abs() < 1e-9, "{people}: {}", nearest_m(&places));
            }
        }
    }

    #[test]
    fn rings_discs_and_stars_have_all_people() {
        for people in 1..60 {
            assert_eq!(disc(people, 1.0, None).len(), people);
            for count in 1..5 {
                assert_eq!(rings(people, count, 1.0, Some(4.0)).len(), people);
            }
            let places = outline(people, &star(5, 0.4, 3.0), Some(1.0));
            assert_eq!(places.len(), people);
            assert!(places.iter().all(|place| place.is_finite()));
        }
        assert!(nearest_m(&disc(200, 1.0, None)) > 0.7);
    }

    #[test]
    fn people_stand_evenly_along_an_outline() {
        let square = polygon(4, 1.0);
        let places = outline(8, &square, None);
        let expected = [[0.0, 1.0], [0.5, 0.5], [1.0, 0.0], [0.5, -0.5], [0.0, -1.0]].map(Vec2::from);
        for (place, expected) in places.iter().zip(expected) {
            assert!(place.distance(expected) < 1e-12, "{place:?}");
        }
        let wide = outline(8, &square, Some(2.0));
        assert!((wide[0].distance(wide[1]) - 2.0).abs() < 1e-12);
    }
}
