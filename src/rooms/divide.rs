//! Divides the floor at doors.

use std::collections::VecDeque;

use super::grid::{BLOCKED, DOOR, FIXTURE, FURNITURE, Grid, WALL};
use crate::math::Vec2;
use crate::walls::{Doorway, Walls};

/// Least area of a room, square metres: less is a niche between two doors.
const LEAST_ROOM_M2: f64 = 1.2;
/// Share of a place's rim that is drawn as door from which on the place is where a leaf swings.
const SWING_SHARE: f64 = 0.9;
/// Length by which a threshold is drawn into its jambs, metres.
const INTO_JAMBS_M: f64 = 0.12;
/// Distance beyond a threshold at which a door's rooms are looked up, metres.
const BEYOND_M: [f64; 3] = [0.25, 0.45, 0.7];
/// Distance within which two doors are one, metres.
const SAME_DOOR_M: f64 = 0.9;

/// Marks cells without a room.
pub(super) const NONE: u16 = u16::MAX;

/// The floor in rooms, and the doors between them.
pub(super) struct Division {
    /// Room of each cell, or [`NONE`].
    pub(super) room: Vec<u16>,
    pub(super) rooms: usize,
    pub(super) doors: Vec<(Vec2, [u16; 2])>,
}

/// Divides the floor at doorways of the walls, and at doors that the plan tells.
pub(super) fn divide(grid: &Grid, walls: &Walls) -> Division {
    let doorways = walls.doorways();
    let mut shut = vec![false; grid.len()];
    for door in &doorways {
        let [a, b] = door.jambs_m;
        let Some(along) = (b - a).normalized() else { continue };
        grid.line(a - along * INTO_JAMBS_M, b + along * INTO_JAMBS_M).for_each(|cell| shut[cell] = true);
    }
    shut.iter_mut().enumerate().for_each(|(cell, shut)| *shut |= grid.has(cell, DOOR));
    let is_free = |cell: usize| !grid.has(cell, BLOCKED) && !shut[cell];
    let mut room = vec![NONE; grid.len()];
    let (mut rooms, mut stack, mut members) = (0u16, Vec::new(), Vec::new());
    let mut seen = vec![false; grid.len()];
    for first in 0..grid.len() {
        if seen[first] || !is_free(first) || rooms + 1 == NONE {
            continue;
        }
        seen[first] = true;
        stack.push(first);
        members.clear();
        while let Some(cell) = stack.pop() {
            members.push(cell);
            stack.extend(grid.beside(cell).filter(|&b| is_free(b) && !std::mem::replace(&mut seen[b], true)));
        }
        let is_swing = || {
            let rim = || members.iter().flat_map(|&cell| grid.beside(cell)).filter(|&b| !is_free(b));
            let doors = rim().filter(|&b| grid.has(b, DOOR)).count();
            doors as f64 >= SWING_SHARE * rim().count() as f64
        };
        if members.len() as f64 * grid.cell_m * grid.cell_m >= LEAST_ROOM_M2 && !is_swing() {
            members.iter().for_each(|&cell| room[cell] = rooms);
            rooms += 1;
        }
    }
    // Thresholds and niches belong to the rooms beside them.
    grow(grid, &mut room, |cell| !grid.has(cell, BLOCKED));
    let doors = doors(grid, &room, &doorways);
    Division { room, rooms: usize::from(rooms), doors }
}

/// The room of each cell, with the furniture and the fixtures that stand in it.
pub(super) fn with_furniture(grid: &Grid, room: &[u16]) -> Vec<u16> {
    let mut room = room.to_vec();
    grow(grid, &mut room, |cell| grid.has(cell, FURNITURE | FIXTURE) && !grid.has(cell, WALL));
    room
}

/// Gives cells to the rooms beside them.
fn grow(grid: &Grid, room: &mut [u16], may: impl Fn(usize) -> bool) {
    let mut border: VecDeque<usize> = (0..grid.len()).filter(|&cell| room[cell] != NONE).collect();
    while let Some(cell) = border.pop_front() {
        for beside in grid.beside(cell) {
            if room[beside] == NONE && may(beside) {
                room[beside] = room[cell];
                border.push_back(beside);
            }
        }
    }
}

/// Doors between two rooms, in the order of the walls, then those that only the plan tells.
fn doors(grid: &Grid, room: &[u16], doorways: &[Doorway]) -> Vec<(Vec2, [u16; 2])> {
    let room_at = |p: Vec2| grid.cell_at(p).map_or(NONE, |cell| room[cell]);
    let mut doors: Vec<(Vec2, [u16; 2])> = Vec::new();
    for door in doorways {
        let middle = door.jambs_m[0].lerp(door.jambs_m[1], 0.5);
        let beyond = |way: Vec2| {
            let places = BEYOND_M.iter().map(|&by_m| room_at(middle + way * (0.5 * door.depth_m + by_m)));
            places.into_iter().find(|&room| room != NONE)
        };
        if let (Some(a), Some(b)) = (beyond(door.through), beyond(-door.through))
            && a != b
        {
            doors.push((middle, [a, b]));
        }
    }
    let mut seen = vec![false; grid.len()];
    let mut members = Vec::new();
    for first in 0..grid.len() {
        if !grid.has(first, DOOR) || std::mem::replace(&mut seen[first], true) {
            continue;
        }
        let mut stack = vec![first];
        members.clear();
        let mut rooms: Vec<u16> = Vec::new();
        while let Some(cell) = stack.pop() {
            members.push(cell);
            for beside in grid.beside(cell) {
                if grid.has(beside, DOOR) {
                    stack.extend((!std::mem::replace(&mut seen[beside], true)).then_some(beside));
                } else if room[beside] != NONE && !rooms.contains(&room[beside]) {
                    rooms.push(room[beside]);
                }
            }
        }
        let sum = members.iter().fold(Vec2::ZERO, |sum, &cell| sum + grid.centre(cell));
        let middle = sum / members.len() as f64;
        rooms.sort_unstable();
        let pairs = rooms.iter().enumerate().flat_map(|(k, &a)| rooms[k + 1..].iter().map(move |&b| [a, b]));
        let is_new = |pair: &[u16; 2]| {
            doors.iter().all(|(at, [a, b])| at.distance(middle) > SAME_DOOR_M || [*a.min(b), *a.max(b)] != *pair)
        };
        let fresh: Vec<_> = pairs.filter(is_new).map(|pair| (middle, pair)).collect();
        doors.extend(fresh);
    }
    doors
}
