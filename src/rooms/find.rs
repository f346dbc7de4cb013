use serde::Serialize;

use super::divide::{self, NONE};
use super::entrances::{self, Entrance};
use super::grid::{FIXTURE, Grid, STAIRS};
use super::kind::{Measures, RoomKind};
use crate::math::{Rect, Vec2};
use crate::plan::FloorPlan;
use crate::walls::Walls;

/// A room: floor that doors divide from other floor.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Room {
    /// "room 1", ... from the top left, row by row.
    pub name: String,
    /// What it is.
    pub kind: RoomKind,
    /// Area of its floor, furniture included, square metres.
    pub area_m2: f64,
    /// Number of doors to other rooms and to the outside.
    pub doors: usize,
    /// The place in it that is farthest from walls, metres.
    pub inside_m: Vec2,
    /// Its extent, metres.
    #[serde(skip)]
    pub bounds_m: Rect,
    /// Length of stay, seconds, and weight among rooms of its kind, where a scenario says so.
    #[serde(skip)]
    pub(super) said: Said,
}

/// What a scenario says about a room.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Said {
    pub(super) stay_s: Option<crate::math::Distribution>,
    pub(super) weight: Option<f64>,
}

impl Room {
    /// How many go there, relative to rooms of its kind and size: 1 unless a scenario says otherwise.
    pub(crate) fn weight(&self) -> f64 {
        self.said.weight.unwrap_or(1.0)
    }

    /// Length of a stay, seconds, where a scenario says it.
    pub(crate) fn stay_s(&self) -> Option<crate::math::Distribution> {
        self.said.stay_s
    }
}

/// All rooms of a plan, and its entrances.
#[derive(Clone, Debug)]
pub struct Rooms {
    /// Rooms, from the top left, row by row.
    pub rooms: Vec<Room>,
    /// Entrances: openings at the image's sides, then doors to the outside.
    pub entrances: Vec<Entrance>,
    /// Doors between two rooms: middle, metres, and indices of the rooms.
    pub doors: Vec<(Vec2, [usize; 2])>,
    pub(super) grid: Grid,
    pub(super) room: Vec<u16>,
    /// Distance of each cell from the nearest wall, in cells.
    pub(super) clearance: Vec<f32>,
}

impl Rooms {
    /// Divides the floor of a plan into rooms.
    ///
    /// # Example
    /// ```
    /// use trodden::{plan::FloorPlan, rooms::Rooms, walls::Walls};
    ///
    /// // Two rooms of 4 x 4 m, and a door of 1 m between them.
    /// let wall = |x: u32, y: u32| x % 42 < 2 || y % 42 < 2 && !(x / 42 == 1 && x % 42 == 0);
    /// let floor = (0..86 * 44).map(|k: u32| (k % 86, k / 86));
    /// let floor = floor.map(|(x, y)| u8::from(!wall(x, y) || (42..44).contains(&x) && (16..26).contains(&y)));
    /// let plan = FloorPlan::from_mask(86, 44, 0.1, floor.collect());
    /// let rooms = Rooms::find(&plan, &Walls::trace(&plan, &Default::default()));
    /// assert_eq!((rooms.rooms.len(), rooms.doors.len()), (2, 1));
    /// ```
    pub fn find(plan: &FloorPlan, walls: &Walls) -> Rooms {
        let grid = Grid::of(plan);
        let clearance = grid.clearances();
        let divide::Division { room, rooms: count, doors } = divide::divide(&grid, walls);
        let entrances = entrances::find(plan, &grid, &room);
        let cell_m2 = grid.cell_m * grid.cell_m;
        let mut measures = vec![Measures::default(); count];
        let mut clear_m = vec![0.0; count];
        let mut deepest: Vec<Option<usize>> = vec![None; count];
        let mut bounds: Vec<Option<Rect>> = vec![None; count];
        for cell in (0..grid.len()).filter(|&cell| room[cell] != NONE) {
            let own = usize::from(room[cell]);
            measures[own].free_m2 += cell_m2;
            clear_m[own] += f64::from(clearance[cell]) * grid.cell_m * cell_m2;
            measures[own].stairs_m2 += if grid.has(cell, STAIRS) { cell_m2 } else { 0.0 };
            if deepest[own].is_none_or(|best| clearance[cell] > clearance[best]) {
                deepest[own] = Some(cell);
            }
            let p = grid.centre(cell);
            let b = bounds[own].get_or_insert(Rect { min: p, max: p });
            b.min = Vec2 { x: b.min.x.min(p.x), y: b.min.y.min(p.y) };
            b.max = Vec2 { x: b.max.x.max(p.x), y: b.max.y.max(p.y) };
        }
        for (cell, own) in divide::with_furniture(&grid, &room).into_iter().enumerate().filter(|(_, own)| *own != NONE)
        {
            let measures = &mut measures[usize::from(own)];
            measures.area_m2 += cell_m2;
            measures.fixtures_m2 += if grid.has(cell, FIXTURE) { cell_m2 } else { 0.0 };
        }
        let doors: Vec<(Vec2, [usize; 2])> = doors.into_iter().map(|(at, ends)| (at, ends.map(usize::from))).collect();
        doors.iter().flat_map(|door| door.1).for_each(|end| measures[end].doors += 1);
        entrances.iter().for_each(|entrance| measures[entrance.room].doors += 1);
        let rooms = (0..count).filter_map(|index| {
            let (deepest, measures) = (deepest[index]?, &mut measures[index]);
            measures.width_m = 4.0 * clear_m[index] / measures.free_m2;
            measures.widest_m = 2.0 * f64::from(clearance[deepest]) * grid.cell_m;
            let bounds_m =
                bounds[index].map_or(Rect { min: Vec2::ZERO, max: Vec2::ZERO }, |b| b.grown(0.5 * grid.cell_m));
            measures.box_m = [bounds_m.max.x - bounds_m.min.x, bounds_m.max.y - bounds_m.min.y];
            Some(Room {
                name: format!("room {}", index + 1),
                kind: RoomKind::of(measures),
                area_m2: (measures.area_m2 * 100.0).round() / 100.0,
                doors: measures.doors,
                inside_m: grid.centre(deepest),
                bounds_m,
                said: Said::default(),
            })
        });
        Rooms { rooms: rooms.collect(), entrances, doors, grid, room, clearance }
    }

    /// Index of the room at a place, metres.
    pub fn at(&self, p: Vec2) -> Option<usize> {
        let cell = self.grid.cell_at(p)?;
        (self.room[cell] != NONE).then(|| usize::from(self.room[cell]))
    }

    /// The largest connected part of the floor that is as far as this from all walls, metres, cell by cell.
    pub(crate) fn wide_part(&self, clear_m: f64) -> Vec<bool> {
        let is_wide =
            |cell: usize| self.room[cell] != NONE && f64::from(self.clearance[cell]) * self.grid.cell_m >= clear_m;
        let parts = self.grid.groups(is_wide, |cell| self.grid.beside(cell));
        // Of equally large ones, the first.
        let largest = parts.into_iter().rev().max_by_key(Vec::len).unwrap_or_default();
        let mut wide = vec![false; self.grid.len()];
        largest.into_iter().for_each(|cell| wide[cell] = true);
        wide
    }

    /// Whether a part of the floor comes within a distance of a place, metres.
    pub(crate) fn comes_near(&self, part: &[bool], p: Vec2, reach_m: f64) -> bool {
        let reach = (reach_m / self.grid.cell_m).ceil() as usize;
        self.grid.cell_at(p).is_some_and(|cell| part[cell] || self.grid.around(cell, reach).any(|near| part[near]))
    }
}
