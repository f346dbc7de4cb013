//! Where people stay in rooms: zones that their middle sees, and spots in them.

use super::divide::NONE;
use super::find::Rooms;
use super::grid::{FIXTURE, FURNITURE, SEAT};
use crate::math::{Rect, Vec2, vec2};

/// Distance between the places that are looked at, metres.
const LATTICE_M: f64 = 0.3;
/// Least radius of a zone, metres, and wanted number of zones in a plan.
const ZONE_M: f64 = 6.0;
const ZONES_WANTED: f64 = 48.0;
/// Floor is left out that no zone of this share of its room sees, and of this area, square metres.
const LEAST_ZONE_M2: [f64; 2] = [1.0, 6.0];
const LEAST_ZONE_SHARE: f64 = 0.08;
/// Zones that are tried in a room: a labyrinth has corners without end.
const MOST_TRIES: usize = 80;
/// Distance of spots from walls, metres: wanted, as desks and cupboards stand there, and least.
const OFF_WALLS_M: [f64; 2] = [0.7, 0.27];
/// Distance of spots from doors, and from each other, metres.
const OFF_DOORS_M: f64 = 0.9;
const APART_M: f64 = 0.75;
/// Floor per spot, square metres, and least and largest number of spots in a zone.
const PER_SPOT_M2: f64 = 1.6;
const SPOTS: [usize; 2] = [4, 48];
/// Floor that the seat of a person takes, square metres, and most people on a bench or a sofa.
const SEAT_M2: f64 = 0.35;
const MOST_ON_SEAT: usize = 4;
/// How much nearer to a seat, as a share of how much nearer to the desk, a place has to be for people to take it.
const BEHIND: f64 = 0.5;
/// Rooms with seats: spots at other furniture, and these with spots where people stand, for each seat.
const OTHERS_PER_SEAT: [f64; 2] = [0.5, 0.75];
/// Distance from furniture within which people sit or stand at it, metres.
const AT_FURNITURE_M: f64 = 0.8;

/// A part of a room whose middle sees all of it. Rooms without corners are one.
#[derive(Clone, Debug)]
pub(crate) struct Zone {
    /// Index of the room.
    pub(crate) room: usize,
    /// The room's name, with a number from the second zone on.
    pub(crate) name: String,
    /// Its middle, which sees all of it, metres.
    pub(crate) at_m: Vec2,
    /// A rectangle of its floor around its middle, metres.
    pub(crate) area_m: [Vec2; 2],
    pub(crate) area_m2: f64,
    /// Spots where people stay: those at furniture first, each as far as possible from those before.
    pub(crate) spots: Vec<Spot>,
}

/// A spot where somebody stays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Where the person stands or sits, metres.
    pub at_m: Vec2,
    /// Unit vector towards the furniture; `None` where there is none.
    pub facing: Option<Vec2>,
}

impl Rooms {
    /// All zones, room by room.
    pub(crate) fn zones(&self) -> Vec<Zone> {
        let grid = &self.grid;
        let every = ((LATTICE_M / grid.cell_m).round() as usize).max(1);
        let mut places: Vec<Vec<usize>> = vec![Vec::new(); self.rooms.len()];
        for row in (every / 2..grid.rows).step_by(every) {
            for cell in (row * grid.columns + every / 2..(row + 1) * grid.columns).step_by(every) {
                if self.room[cell] != NONE {
                    places[usize::from(self.room[cell])].push(cell);
                }
            }
        }
        let place_m2 = (every as f64 * grid.cell_m) * (every as f64 * grid.cell_m);
        let total_m2: f64 = self.rooms.iter().map(|room| room.area_m2).sum();
        let reach_m = (total_m2 / (std::f64::consts::PI * ZONES_WANTED)).sqrt().max(ZONE_M);
        let seated = self.rooms_with_seats();
        let mut zones = Vec::new();
        for (room, mut left) in places.into_iter().enumerate() {
            let least_m2 = (LEAST_ZONE_SHARE * self.rooms[room].area_m2).clamp(LEAST_ZONE_M2[0], LEAST_ZONE_M2[1]);
            let mut number = 0;
            for _ in 0..MOST_TRIES {
                if (left.len() as f64) * place_m2 < least_m2 && number > 0 {
                    break;
                }
                let Some(middle) = self.deepest(&left) else { break };
                let (own, others) = left.iter().partition(|&&cell| self.sees(middle, cell, reach_m));
                left = others;
                let area_m2 = own.len() as f64 * place_m2;
                if number > 0 && area_m2 < least_m2 {
                    continue;
                }
                number += 1;
                let name = &self.rooms[room].name;
                let name = if number > 1 { format!("{name} ({number})") } else { name.clone() };
                let spots = self.spots(&own, middle, area_m2, seated[room]);
                let (at_m, area_m) = (self.grid.centre(middle), self.square(middle, reach_m));
                zones.push(Zone { room, name, at_m, area_m, area_m2, spots });
            }
        }
        zones
    }

    /// The place farthest from walls; among equals the one nearest to their middle.
    fn deepest(&self, places: &[usize]) -> Option<usize> {
        let sum = places.iter().fold(Vec2::ZERO, |sum, &cell| sum + self.grid.centre(cell));
        let mean = sum / places.len().max(1) as f64;
        let score = |cell: usize| {
            let room_m = f64::from(self.clearance[cell]) * self.grid.cell_m;
            self.grid.centre(cell).distance(mean) - 6.0 * room_m.min(2.0)
        };
        places.iter().copied().min_by(|&a, &b| score(a).total_cmp(&score(b)).then(a.cmp(&b)))
    }

    fn sees(&self, from: usize, to: usize, reach_m: f64) -> bool {
        let (a, b) = (self.grid.centre(from), self.grid.centre(to));
        from == to || a.distance(b) <= reach_m && self.grid.line(a, b).all(|cell| self.room[cell] == self.room[from])
    }

    /// The rectangle around a cell that its room fills, at most as wide as a zone, metres.
    fn square(&self, middle: usize, reach_m: f64) -> [Vec2; 2] {
        let grid = &self.grid;
        let room = self.room[middle];
        let [column, row] = grid.column_row(middle);
        let most = (0.7 * reach_m / grid.cell_m) as usize;
        let [mut west, mut east, mut north, mut south] = [column, column, row, row];
        let fills = |columns: std::ops::RangeInclusive<usize>, rows: std::ops::RangeInclusive<usize>| {
            let (mut own, mut all) = (0usize, 0usize);
            for row in rows {
                for column in columns.clone() {
                    let other = self.room[row * grid.columns + column];
                    if other != NONE && other != room {
                        return false;
                    }
                    own += usize::from(other == room);
                    all += 1;
                }
            }
            2 * own > all
        };
        loop {
            let before = [west, east, north, south];
            if west > 0 && column - west < most && fills(west - 1..=west - 1, north..=south) {
                west -= 1;
            }
            if east + 1 < grid.columns && east - column < most && fills(east + 1..=east + 1, north..=south) {
                east += 1;
            }
            if north > 0 && row - north < most && fills(west..=east, north - 1..=north - 1) {
                north -= 1;
            }
            if south + 1 < grid.rows && south - row < most && fills(west..=east, south + 1..=south + 1) {
                south += 1;
            }
            if before == [west, east, north, south] {
                break;
            }
        }
        let half = vec2(0.5, 0.5) * grid.cell_m;
        let area = Rect::around(grid.centre(north * grid.columns + west), grid.centre(south * grid.columns + east));
        [area.min - half, area.max + half]
    }

    /// Spots among some places.
    fn spots(&self, places: &[usize], middle: usize, area_m2: f64, is_seated: bool) -> Vec<Spot> {
        let grid = &self.grid;
        let doors: Vec<Vec2> =
            self.doors.iter().map(|door| door.0).chain(self.entrances.iter().map(|entrance| entrance.at_m)).collect();
        let clear = |cell: usize, off_m: f64| {
            let p = grid.centre(cell);
            f64::from(self.clearance[cell]) * grid.cell_m >= off_m
                && doors.iter().all(|door| door.distance(p) >= OFF_DOORS_M)
        };
        let roomy = |off_m: f64| places.iter().copied().filter(|&cell| clear(cell, off_m)).collect::<Vec<_>>();
        let mut free = roomy(OFF_WALLS_M[0]);
        if free.len() < SPOTS[0] {
            free = roomy(OFF_WALLS_M[1]);
        }
        if free.is_empty() {
            free.push(middle);
        }
        let at_furniture: Vec<(usize, Vec2)> =
            roomy(OFF_WALLS_M[1]).into_iter().filter_map(|cell| Some((cell, self.furniture_at(cell)?))).collect();
        let most = ((area_m2 / PER_SPOT_M2) as usize).clamp(SPOTS[0], SPOTS[1]);
        let mut spots: Vec<Spot> = Vec::new();
        let middle_m = grid.centre(middle);
        let facing = |cell: usize| at_furniture.iter().find(|at| at.0 == cell).map(|at| at.1);
        let beside: Vec<usize> = at_furniture.iter().map(|at| at.0).collect();
        // People go to where they sit, each from the door: that is what wears ways into a room.
        spots.extend(self.seats(&beside));
        let seats = spots.len();
        let of_seats = |part: f64| seats + ((part * seats as f64).ceil() as usize).max(1);
        let kinds = match (is_seated, beside.is_empty()) {
            (true, _) => [(&beside, of_seats(OTHERS_PER_SEAT[0])), (&free, of_seats(OTHERS_PER_SEAT[1]))],
            (false, true) => [(&free, most), (&free, most)],
            (false, false) => [(&beside, most), (&free, most * 4 / 3)],
        };
        for (places, most) in kinds {
            let mut far_m: Vec<f64> = places
                .iter()
                .map(|&cell| {
                    let p = grid.centre(cell);
                    let others = spots.iter().map(|spot| spot.at_m.distance(p));
                    // The first is the one farthest from the doors, then from the middle.
                    let off_doors = doors.iter().map(|door| door.distance(p)).reduce(f64::min);
                    others.reduce(f64::min).unwrap_or(100.0 + off_doors.unwrap_or(p.distance(middle_m)))
                })
                .collect();
            while spots.len() < most {
                let best = (0..places.len()).max_by(|&a, &b| far_m[a].total_cmp(&far_m[b]).then(b.cmp(&a)));
                let Some(best) = best.filter(|&best| far_m[best] >= APART_M) else { break };
                let at_m = grid.centre(places[best]);
                spots.push(Spot { at_m, facing: facing(places[best]) });
                for (far_m, &cell) in far_m.iter_mut().zip(places) {
                    *far_m = far_m.min(grid.centre(cell).distance(at_m));
                }
            }
        }
        spots
    }

    /// Whether any room has seats.
    pub(super) fn has_seats(&self) -> bool {
        self.rooms_with_seats().contains(&true)
    }

    /// Which rooms have seats.
    fn rooms_with_seats(&self) -> Vec<bool> {
        let reach = (AT_FURNITURE_M / self.grid.cell_m) as usize;
        let mut seated = vec![false; self.rooms.len()];
        for seat in (0..self.grid.len()).filter(|&cell| self.grid.has(cell, SEAT)) {
            for near in self.grid.around(seat, reach).filter(|&near| self.room[near] != NONE) {
                seated[usize::from(self.room[near])] = true;
            }
        }
        seated
    }

    /// Spots of those who sit, at the places beside furniture: one for each seat, some for benches and sofas.
    fn seats(&self, beside: &[usize]) -> Vec<Spot> {
        let grid = &self.grid;
        let reach = (AT_FURNITURE_M / grid.cell_m) as usize;
        let mut seen = std::collections::BTreeSet::new();
        let mut spots: Vec<Spot> = Vec::new();
        for &place in beside {
            for first in grid.around(place, reach).filter(|&cell| grid.has(cell, SEAT)) {
                if !seen.insert(first) {
                    continue;
                }
                let mut seat = vec![first];
                let mut next = 0;
                while let Some(&cell) = seat.get(next) {
                    next += 1;
                    seat.extend(grid.beside(cell).filter(|&near| grid.has(near, SEAT) && seen.insert(near)));
                }
                let area_m2 = seat.len() as f64 * grid.cell_m * grid.cell_m;
                let people = ((area_m2 / SEAT_M2) as usize).clamp(1, MOST_ON_SEAT);
                let near_m =
                    |p: Vec2| seat.iter().map(|&cell| grid.centre(cell).distance(p)).fold(f64::INFINITY, f64::min);
                // People come to a chair from behind: the desk is before it.
                let off_desk_m = |cell: usize| {
                    let desks =
                        grid.around(cell, reach).filter(|&near| grid.has(near, FURNITURE) && !grid.has(near, SEAT));
                    desks.map(|near| grid.centre(near).distance(grid.centre(cell))).fold(AT_FURNITURE_M, f64::min)
                };
                let place = |&cell: &usize| {
                    let p = grid.centre(cell);
                    let near_m = near_m(p);
                    (near_m <= AT_FURNITURE_M).then(|| (near_m - BEHIND * off_desk_m(cell), p))
                };
                let mut at: Vec<(f64, Vec2)> = beside.iter().filter_map(place).collect();
                at.sort_by(|a, b| a.0.total_cmp(&b.0));
                let before = spots.len();
                for (_, at_m) in at {
                    let is_free = spots.iter().all(|spot| spot.at_m.distance(at_m) >= APART_M);
                    if is_free && spots.len() < before + people {
                        spots.push(Spot { at_m, facing: grid.cell_at(at_m).and_then(|cell| self.furniture_at(cell)) });
                    }
                }
            }
        }
        spots
    }

    /// Direction of the furniture nearest to a cell, if there is any at hand.
    fn furniture_at(&self, cell: usize) -> Option<Vec2> {
        let grid = &self.grid;
        let p = grid.centre(cell);
        let reach = (AT_FURNITURE_M / grid.cell_m) as usize;
        let all = grid.around(cell, reach).filter(|&other| grid.has(other, FURNITURE | FIXTURE));
        let nearest = all.map(|other| grid.centre(other)).min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)))?;
        (nearest - p).normalized().filter(|_| nearest.distance(p) <= AT_FURNITURE_M)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::{FloorPlan, PlanClass};
    use crate::walls::Walls;

    /// A room of 6 x 6 m with furniture: class, and left, lower, right and upper edge, metres.
    fn spots(furniture: &[(PlanClass, [f64; 4])]) -> Vec<Spot> {
        let middle = |k: usize| vec2((k % 64) as f64 - 1.5, 61.5 - (k / 64) as f64) * 0.1;
        let class = |p: Vec2| {
            let inside = Rect { min: Vec2::ZERO, max: vec2(6.0, 6.0) }.contains(p);
            let holds = |[x, y, right, top]: [f64; 4]| Rect { min: vec2(x, y), max: vec2(right, top) }.contains(p);
            let piece = furniture.iter().find(|piece| holds(piece.1)).map_or(PlanClass::Floor, |piece| piece.0);
            if inside { piece } else { PlanClass::Wall }
        };
        let classes: Vec<PlanClass> = (0..64 * 64).map(middle).map(class).collect();
        let floor = classes.iter().map(|class| u8::from(*class == PlanClass::Floor)).collect();
        let plan = FloorPlan { classes, ..FloorPlan::from_mask(64, 64, 0.1, floor) };
        let zones = Rooms::find(&plan, &Walls::trace(&plan, &Default::default())).zones();
        zones.into_iter().flat_map(|zone| zone.spots).collect()
    }

    #[test]
    fn people_sit_at_desks_and_few_stand() {
        let chairs = [[1.0, 3.5, 1.5, 4.0], [4.5, 3.5, 5.0, 4.0]];
        let desks = [[0.5, 4.2, 2.0, 5.0], [4.0, 4.2, 5.5, 5.0]];
        let pieces = chairs.map(|c| (PlanClass::Seat, c)).into_iter().chain(desks.map(|d| (PlanClass::Table, d)));
        let spots = spots(&Vec::from_iter(pieces));
        // The plan's corner lies at (-0.2, -0.2).
        let off_m = |spot: &Spot, [x, y, right, top]: [f64; 4]| {
            let p = spot.at_m - vec2(0.2, 0.2);
            p.distance(vec2(p.x.clamp(x, right), p.y.clamp(y, top)))
        };
        for chair in chairs {
            let nearest_m = spots.iter().map(|spot| off_m(spot, chair)).fold(f64::INFINITY, f64::min);
            assert!(nearest_m < 0.5, "{nearest_m} m from the chair: {spots:?}");
        }
        let at_furniture = spots.iter().filter(|spot| spot.facing.is_some()).count();
        assert!(spots.len() <= 6 && at_furniture * 2 > spots.len(), "{spots:?}");
    }

    #[test]
    fn in_a_bare_room_people_stay_all_over() {
        let spots = spots(&[]);
        let far_m = |p: Vec2| spots.iter().map(|spot| spot.at_m.distance(p)).fold(f64::INFINITY, f64::min);
        let farthest_m = (0..36).map(|k| far_m(vec2(0.7 + (k % 6) as f64, 0.7 + (k / 6) as f64))).fold(0.0, f64::max);
        assert!(spots.len() >= 15 && farthest_m < 1.2, "{} spots, {farthest_m} m", spots.len());
    }
}
