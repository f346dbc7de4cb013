//! Where the ceiling's lamps hang: in the middle of corridors, in a grid in halls.

use std::collections::HashMap;

use super::field::DistanceField;
use crate::math::{Vec2, vec2};
use crate::walls::Walls;

/// Least distance of neighbours along either axis, metres.
const APART_M: f64 = 2.7;
/// Nearer to a wall no lamp hangs, metres.
const CLEARANCE_M: f64 = 0.42;
/// From here on more room makes no better place, metres.
const AMPLE_M: f64 = 3.6;
/// Places that differ by less are alike, metres.
const ALIKE_M: f64 = 0.12;
/// Most lamps.
const MOST: usize = 4000;

/// A lamp in the ceiling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lamp {
    pub centre_m: Vec2,
    /// Unit vector along its longer side: along the nearest wall.
    pub along: Vec2,
}

/// Hangs lamps where there is most room, apart from each other.
pub(super) fn hang(walls: &Walls, field: &DistanceField) -> Vec<Lamp> {
    let bounds = walls.bounds_m();
    let mut places: Vec<(u32, u32, u32)> = Vec::new();
    for j in 0..field.raster.height {
        for i in 0..field.raster.width {
            let room = field.distances_m[(j * field.raster.width + i) as usize].min(AMPLE_M);
            if room >= CLEARANCE_M && bounds.contains(field.raster.centre(i, j)) {
                places.push(((room / ALIKE_M) as u32, j, i));
            }
        }
    }
    // Most room first, then row by row.
    places.sort_by_key(|&(room, j, i)| (u32::MAX - room, j, i));
    let bucket = |p: Vec2| ((p.x / APART_M).floor() as i64, (p.y / APART_M).floor() as i64);
    let mut near: HashMap<(i64, i64), Vec<Vec2>> = HashMap::new();
    let mut lamps = Vec::new();
    for (_, j, i) in places {
        let p = field.raster.centre(i, j);
        let (column, row) = bucket(p);
        let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (column + dx, row + dy)));
        let taken = around.filter_map(|key| near.get(&key)).flatten().any(|&other| {
            let apart = (other.x - p.x).abs().max((other.y - p.y).abs());
            apart < APART_M - 1e-6 && walls.sight(p, other)
        });
        if taken {
            continue;
        }
        near.entry((column, row)).or_default().push(p);
        lamps.push(Lamp { centre_m: p, along: along_wall(walls, p) });
        if lamps.len() == MOST {
            break;
        }
    }
    lamps
}

/// Along the nearest wall or across, whichever way there is more room: along corridors also where they cross.
fn along_wall(walls: &Walls, p: Vec2) -> Vec2 {
    let nearest = walls.nearest(p, AMPLE_M + 0.5);
    let Some(away) = nearest.and_then(|nearest| (p - nearest.point_m).normalized()) else { return vec2(1.0, 0.0) };
    let free = |direction: Vec2| {
        let sees =
            |length_m: f64| walls.is_inside(p + direction * length_m) && walls.sight(p, p + direction * length_m);
        [1.5, 3.0, 4.5, 6.0, 8.0].iter().filter(|&&length_m| sees(length_m)).count()
            + [1.5, 3.0, 4.5, 6.0, 8.0].iter().filter(|&&length_m| sees(-length_m)).count()
    };
    if free(away) > free(away.left()) { away } else { away.left() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::FloorPlan;
    use crate::walls::WallsOptions;

    #[test]
    fn lamps_hang_in_the_middle_of_a_corridor_and_along_it() {
        let rows = ["####################", "....................", "....................", "####################"];
        let floor = rows.iter().flat_map(|row| row.bytes()).map(|c| u8::from(c == b'.')).collect();
        let walls = Walls::trace(&FloorPlan::from_mask(20, 4, 1.0, floor), &WallsOptions::default());
        let lamps = hang(&walls, &DistanceField::of(&walls));
        assert!((6..=8).contains(&lamps.len()), "{}", lamps.len());
        for lamp in &lamps {
            assert!((lamp.centre_m.y - 2.0).abs() < 0.15 && lamp.along.x.abs() > 0.99, "{lamp:?}");
        }
    }

    #[test]
    fn nothing_hangs_in_a_gap() {
        let floor = vec![0, 0, 0, 1, 1, 1, 0, 0, 0];
        let walls = Walls::trace(&FloorPlan::from_mask(3, 3, 0.5, floor), &WallsOptions::default());
        assert_eq!(hang(&walls, &DistanceField::of(&walls)), []);
    }
}
