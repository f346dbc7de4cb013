//! Where the building begins: openings at the image's sides, and doors to the outside.

use serde::Serialize;

use super::divide::NONE;
use super::grid::{BLOCKED, Grid, OUTSIDE, STAIRS, WALL};
use crate::math::{Rect, Vec2, vec2};
use crate::plan::FloorPlan;

/// Widths of a door to the outside, metres.
const DOOR_M: [f64; 2] = [0.6, 8.0];
/// Distance from an opening's edge at which its room is looked up, metres.
const INSIDE_M: [f64; 3] = [0.1, 0.4, 1.0];
/// Least area of the outside that a door leads to, square metres.
const LEAST_OUTSIDE_M2: f64 = 1.0;
/// Most entrances: the widest.
const MOST: usize = 12;

/// A way into the building: an opening at the image's side, or a door to the outside; never a window.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Entrance {
    /// The name of the opening or of the painted entrance, or "door 1", ...
    pub name: String,
    /// Index into [`FloorPlan::openings`]; `None` for a painted entrance or a door to the outside.
    pub opening: Option<usize>,
    /// Its middle, metres.
    pub at_m: Vec2,
    /// Clear width, metres.
    pub width_m: f64,
    /// Index of the room that it leads into.
    pub room: usize,
}

/// Finds the entrances: openings in their order, painted entrances, then doors row by row.
pub(super) fn find(plan: &FloorPlan, grid: &Grid, room: &[u16]) -> Vec<Entrance> {
    let mut entrances = Vec::new();
    for (index, opening) in plan.openings.iter().enumerate() {
        let within = |by_m: f64| grid.cell_at(opening.centre_m() - opening.side.outward() * by_m);
        let rooms = INSIDE_M.iter().filter_map(|&by_m| within(by_m)).map(|cell| room[cell]);
        if let Some(room) = rooms.into_iter().find(|&room| room != NONE) {
            let (name, width_m) = (opening.name.clone(), opening.width_m());
            let (at_m, room) = (opening.centre_m(), usize::from(room));
            entrances.push(Entrance { name, opening: Some(index), at_m, width_m, room });
        }
    }
    for painted in &plan.painted.entrances {
        let [min, max] = painted.area_m;
        let at_m = min.lerp(max, 0.5);
        if let Some(room) = grid.cell_at(at_m).map(|cell| room[cell]).filter(|&room| room != NONE) {
            let width_m = (max.x - min.x).max(max.y - min.y);
            entrances.push(Entrance {
                name: painted.name.clone(),
                opening: None,
                at_m,
                width_m,
                room: usize::from(room),
            });
        }
    }
    let mut doors = doors(grid, room);
    doors.sort_by(|a, b| b.1.total_cmp(&a.1));
    doors.truncate(MOST.saturating_sub(entrances.len()));
    doors.sort_by_key(|door| door.3);
    for (number, (at_m, width_m, room, _)) in doors.into_iter().enumerate() {
        entrances.push(Entrance { name: format!("door {}", number + 1), opening: None, at_m, width_m, room });
    }
    let from_stairs = stairs(grid, room, &entrances);
    for (number, (at_m, width_m, room)) in from_stairs.into_iter().enumerate() {
        entrances.push(Entrance { name: format!("stairs {}", number + 1), opening: None, at_m, width_m, room });
    }
    entrances
}

/// Stairs of floors without another way in, as upper floors are: the middle of each, its width, and its room.
fn stairs(grid: &Grid, room: &[u16], entrances: &[Entrance]) -> Vec<(Vec2, f64, usize)> {
    let mut found = Vec::new();
    for floor in grid.groups(|cell| room[cell] != NONE, |cell| grid.beside(cell)) {
        let is_within = |entrance: &Entrance| floor.iter().any(|&cell| usize::from(room[cell]) == entrance.room);
        if entrances.iter().any(is_within) {
            continue;
        }
        let within: std::collections::BTreeSet<usize> = floor.into_iter().collect();
        for flight in grid.groups(|cell| within.contains(&cell) && grid.has(cell, STAIRS), |cell| grid.beside(cell)) {
            let area = bounds(grid, &flight);
            let (middle, width_m) = (area.min.lerp(area.max, 0.5), area.width().min(area.height()) + grid.cell_m);
            let nearest = flight.iter().min_by(|&&a, &&b| {
                grid.centre(a).distance(middle).total_cmp(&grid.centre(b).distance(middle)).then(a.cmp(&b))
            });
            found.extend(nearest.map(|&cell| (grid.centre(cell), width_m, usize::from(room[cell]))));
        }
    }
    found
}

/// The rectangle around the middles of cells.
fn bounds(grid: &Grid, cells: &[usize]) -> Rect {
    let first = grid.centre(cells[0]);
    cells.iter().map(|&cell| grid.centre(cell)).fold(Rect::around(first, first), |all, p| Rect {
        min: vec2(all.min.x.min(p.x), all.min.y.min(p.y)),
        max: vec2(all.max.x.max(p.x), all.max.y.max(p.y)),
    })
}

/// Gaps through which floor meets the outside: middle, width, room and first cell.
fn doors(grid: &Grid, room: &[u16]) -> Vec<(Vec2, f64, usize, usize)> {
    let may_be_out = |cell: usize| grid.has(cell, OUTSIDE) && grid.has(cell, BLOCKED) && !grid.has(cell, WALL);
    let around = |cell: usize| grid.around(cell, 1);
    // Specks in the door between two rooms are no outside.
    let mut is_out = vec![false; grid.len()];
    let least = (LEAST_OUTSIDE_M2 / (grid.cell_m * grid.cell_m)) as usize;
    for members in grid.groups(may_be_out, around).into_iter().filter(|members| members.len() >= least) {
        members.into_iter().for_each(|cell| is_out[cell] = true);
    }
    let is_edge = |cell: usize| room[cell] != NONE && grid.beside(cell).any(|beside| is_out[beside]);
    let mut doors = Vec::new();
    for members in grid.groups(is_edge, around) {
        let first = members[0];
        let bounds = bounds(grid, &members);
        let width_m = bounds.min.distance(bounds.max) + grid.cell_m;
        if !(DOOR_M[0]..=DOOR_M[1]).contains(&width_m) {
            continue;
        }
        let middle = bounds.centre();
        let nearest = members.iter().min_by(|&&a, &&b| {
            grid.centre(a).distance(middle).total_cmp(&grid.centre(b).distance(middle)).then(a.cmp(&b))
        });
        if let Some(&cell) = nearest {
            doors.push((grid.centre(cell), width_m, usize::from(room[cell]), first));
        }
    }
    doors
}
