//! What buildings are for, and what people do in them: one table.

use serde::{Deserialize, Serialize};

use super::find::{Room, Rooms};
use super::kind::RoomKind;
use crate::math::vec2;
use crate::options::names;
use crate::plan::{FurniturePiece, PlanClass};

/// What a building is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[allow(missing_docs)]
pub enum Use {
    Office,
    School,
    Station,
    Shop,
    Museum,
    Hospital,
    Home,
    Hall,
}

names!(Use);

/// What people do in a building.
///
/// Stays are far shorter than those of life: a floor wears by steps, and an hour at a desk has hardly more of them than a
/// minute. What counts is how often people come, where they stand, and the ways between.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Habits {
    /// Share of people who only pass from one entrance to another, where there are several.
    pub(crate) pass: f64,
    /// Least and largest number of rooms that a person visits.
    pub(crate) visits: [usize; 2],
    pub(crate) room: RoomHabits,
    pub(crate) corridor: RoomHabits,
    pub(crate) hall: RoomHabits,
    pub(crate) toilet: RoomHabits,
    pub(crate) stairs: RoomHabits,
    /// People who come in each sixth of the day, relative to each other.
    pub(crate) day: [f64; 6],
    /// Shares of people alone, in pairs, in threes and fours, where people walk in groups.
    pub(crate) groups: [f64; 4],
    /// Share of people with a bag.
    pub(crate) bags: f64,
    /// Shares of those who pull a bag on wheels, and of those who push a trolley, a pram or a wheelchair.
    pub(crate) wheels: [f64; 2],
    /// Share of children.
    pub(crate) children: f64,
    /// Share of the film that a cleaning takes.
    pub(crate) mop: f32,
}

/// What people do in rooms of a kind.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RoomHabits {
    /// How many go there, relative to rooms of other kinds of the same size.
    pub(crate) draws: f64,
    /// Mean length of a stay, seconds.
    pub(crate) stay_s: f64,
    /// Spots at which a person stays, one after the other.
    pub(crate) spots: usize,
}

const fn habits(draws: f64, stay_s: f64, spots: usize) -> RoomHabits {
    RoomHabits { draws, stay_s, spots }
}

/// A corridor draws nobody by itself: a few stop at a board or wait at a door.
const PASSED: RoomHabits = habits(0.15, 2.0, 1);
/// From so many rooms with a toilet of their own on, a building is a hospital.
const LEAST_PATIENTS_ROOMS: usize = 6;
/// From so many racks between aisles on, of so many square metres each, a building is a shop, if they take this share of
/// its largest room.
const LEAST_RACKS: usize = 6;
const LEAST_RACK_M2: f64 = 3.0;
const RACKS_SHARE: f64 = 0.08;
/// A room of this area and share of all is a hall for sports, fairs or machines, if it has fewer tables or seats.
const EMPTY_HALL_M2: f64 = 400.0;
const EMPTY_HALL_SHARE: f64 = 0.4;
const EMPTY_HALL_PLACES_PER_M2: f64 = 0.02;
/// From so many classrooms on a building is a school, and what a classroom is: its area, and tables or seats in it.
const LEAST_CLASSROOMS: usize = 3;
const LEAST_CLASSROOM_M2: f64 = 35.0;
const PUPILS_PER_M2: f64 = 0.2;
/// How far from a piece of furniture people are at it, metres.
const BESIDE_M: f64 = 0.15;
/// Stairs are passed: people go up, and others come down.
const CLIMBED: RoomHabits = habits(1.0, 2.0, 1);

impl Use {
    /// All uses, in the order in which they are told.
    pub const ALL: [Use; 8] =
        [Use::Office, Use::School, Use::Station, Use::Shop, Use::Museum, Use::Hospital, Use::Home, Use::Hall];

    /// Its name, as scenarios write it.
    pub fn name(self) -> &'static str {
        match self {
            Use::Office => "office",
            Use::School => "school",
            Use::Station => "station",
            Use::Shop => "shop",
            Use::Museum => "museum",
            Use::Hospital => "hospital",
            Use::Home => "home",
            Use::Hall => "hall",
        }
    }

    /// What people do there.
    pub(crate) fn habits(self) -> Habits {
        match self {
            // A desk, then a colleague, a meeting or the kitchen; a toilet is small and draws as much as an office.
            Use::Office => Habits {
                pass: 0.05,
                visits: [1, 3],
                room: habits(1.0, 9.0, 1),
                corridor: PASSED,
                hall: habits(0.8, 5.0, 2),
                toilet: habits(1.5, 5.0, 1),
                stairs: CLIMBED,
                // Most come before nine, and after lunch.
                day: [3.0, 1.5, 0.7, 2.0, 0.8, 0.5],
                groups: [0.8, 0.15, 0.04, 0.01],
                bags: 0.7,
                wheels: [0.05, 0.02],
                children: 0.0,
                mop: 0.4,
            },
            // One classroom, sometimes a second; everybody comes before the bell.
            Use::School => Habits {
                pass: 0.05,
                visits: [1, 2],
                room: habits(1.0, 12.0, 1),
                corridor: PASSED,
                hall: habits(0.8, 6.0, 2),
                toilet: habits(1.5, 5.0, 1),
                stairs: CLIMBED,
                day: [4.0, 0.5, 1.5, 0.5, 1.5, 0.5],
                groups: [0.3, 0.35, 0.2, 0.15],
                bags: 0.9,
                wheels: [0.03, 0.01],
                children: 0.9,
                mop: 0.35,
            },
            // Two of three go from door to door; others wait, buy something or look for a train.
            Use::Station => Habits {
                pass: 0.67,
                visits: [1, 2],
                // A shop or an office for tickets draws far more than as much of the hall.
                room: habits(4.0, 7.0, 1),
                corridor: habits(0.3, 5.0, 1),
                hall: habits(1.0, 9.0, 1),
                toilet: habits(1.5, 5.0, 1),
                stairs: habits(2.0, 2.0, 1),
                day: [2.0, 1.0, 0.8, 0.8, 2.0, 1.0],
                groups: [0.7, 0.2, 0.06, 0.04],
                bags: 0.8,
                wheels: [0.18, 0.03],
                children: 0.05,
                mop: 0.45,
            },
            // From shelf to shelf, most in the largest room.
            Use::Shop => Habits {
                pass: 0.05,
                visits: [2, 3],
                room: habits(0.6, 4.0, 2),
                corridor: habits(0.4, 4.0, 1),
                hall: habits(1.5, 3.0, 4),
                toilet: habits(0.5, 5.0, 1),
                stairs: CLIMBED,
                day: [0.7, 1.0, 1.5, 1.0, 1.5, 0.7],
                groups: [0.6, 0.3, 0.06, 0.04],
                bags: 0.8,
                wheels: [0.04, 0.2],
                children: 0.08,
                mop: 0.45,
            },
            // Room after room, a few works in each.
            Use::Museum => Habits {
                pass: 0.02,
                visits: [3, 5],
                room: habits(1.0, 3.0, 2),
                corridor: habits(0.4, 3.0, 1),
                hall: habits(1.2, 4.0, 2),
                toilet: habits(0.5, 5.0, 1),
                stairs: CLIMBED,
                day: [0.7, 1.5, 1.2, 1.5, 1.0, 0.2],
                groups: [0.4, 0.4, 0.1, 0.1],
                bags: 0.4,
                wheels: [0.04, 0.1],
                children: 0.12,
                mop: 0.5,
            },
            // Wards and treatment; visitors and patients wait in halls and corridors.
            Use::Hospital => Habits {
                pass: 0.05,
                visits: [1, 3],
                room: habits(1.0, 5.0, 2),
                corridor: habits(0.3, 5.0, 1),
                hall: habits(1.2, 9.0, 1),
                toilet: habits(1.0, 5.0, 1),
                stairs: CLIMBED,
                day: [1.5, 1.5, 1.0, 1.5, 1.0, 0.7],
                groups: [0.6, 0.3, 0.06, 0.04],
                bags: 0.4,
                wheels: [0.1, 0.2],
                children: 0.06,
                mop: 0.65,
            },
            // All rooms in turn, many times a day.
            Use::Home => Habits {
                pass: 0.0,
                visits: [3, 5],
                room: habits(1.0, 4.0, 2),
                corridor: habits(0.3, 2.0, 1),
                hall: habits(1.0, 4.0, 2),
                toilet: habits(1.2, 4.0, 1),
                stairs: CLIMBED,
                day: [1.5, 0.7, 0.7, 1.0, 1.5, 1.5],
                groups: [0.9, 0.1, 0.0, 0.0],
                bags: 0.2,
                wheels: [0.03, 0.03],
                children: 0.25,
                mop: 0.3,
            },
            // People spread over the large rooms; the small ones serve them.
            Use::Hall => Habits {
                pass: 0.3,
                visits: [1, 2],
                room: habits(0.6, 5.0, 1),
                corridor: PASSED,
                hall: habits(2.0, 5.0, 2),
                toilet: habits(1.5, 5.0, 1),
                stairs: CLIMBED,
                day: [2.0, 2.0, 1.0, 0.5, 0.5, 0.5],
                groups: [0.5, 0.3, 0.1, 0.1],
                bags: 0.5,
                wheels: [0.12, 0.04],
                children: 0.05,
                mop: 0.35,
            },
        }
    }

    /// What a building with such rooms and furniture is for, as far as they tell.
    ///
    /// Rooms that mostly have a toilet each are a hospital's, rows of racks a shop's, rooms full of desks a school's. Few
    /// small rooms are a home, and so are many without a corridor: flats; many at corridors an office, a school (large ones,
    /// or tables side by side) or a hospital (very many); large rooms that lead into each other a museum; one large room
    /// with small ones a shop, an office if it has desks, a hall if it is very large or full of seats, or with wide openings
    /// a station. A large room with few tables or seats is a hall beside others too.
    pub(crate) fn guess(rooms: &Rooms, furniture: &[FurniturePiece]) -> Use {
        let of = |kind: RoomKind| rooms.rooms.iter().filter(move |room| room.kind == kind);
        let area_m2 = |kind: RoomKind| of(kind).map(|room| room.area_m2).sum::<f64>();
        let total_m2: f64 = rooms.rooms.iter().map(|room| room.area_m2).sum();
        let mut areas: Vec<f64> = of(RoomKind::Room).chain(of(RoomKind::Hall)).map(|room| room.area_m2).collect();
        areas.sort_by(f64::total_cmp);
        let median_m2 = areas.get(areas.len() / 2).copied().unwrap_or(0.0);
        let largest_m2 = areas.last().copied().unwrap_or(0.0);
        let wide = rooms.entrances.iter().filter(|entrance| entrance.width_m >= 2.5).count();
        let corridor_share = area_m2(RoomKind::Corridor) / total_m2.max(0.01);
        // A desk and its chairs may be one piece.
        let pieces = |class| furniture.iter().filter(|piece| piece.class == class).count() as f64;
        let (seats, tables) = (pieces(PlanClass::Seat), pieces(PlanClass::Table));
        let places_per_m2 = seats.max(tables) / areas.iter().sum::<f64>().max(0.01);
        let has_small_rooms = median_m2 < 30.0 || areas.len() >= 3 && total_m2 < 140.0;
        let is_one_flat = total_m2 < 220.0 && has_small_rooms && largest_m2 < 80.0 && corridor_share < 0.35;
        let are_flats = corridor_share < 0.08 && median_m2 < 22.0 && largest_m2 < 45.0;
        let kind = |room: usize| rooms.rooms[room].kind;
        // Doors between a room and a toilet of its own.
        let own_toilets = rooms.doors.iter().filter(|(_, ends)| {
            let toilet = ends.iter().find(|&&end| kind(end) == RoomKind::Toilet);
            toilet.is_some_and(|&end| rooms.rooms[end].doors == 1)
                && ends.iter().any(|&end| kind(end) == RoomKind::Room)
        });
        let own_toilets = own_toilets.count();
        let is_rack = |piece: &&FurniturePiece| {
            piece.class == PlanClass::Counter && piece.at_wall < 0.5 && piece.area_m2 >= LEAST_RACK_M2
        };
        let racks: Vec<f64> = furniture.iter().filter(is_rack).map(|piece| piece.area_m2).collect();
        let has_racks = racks.len() >= LEAST_RACKS && racks.iter().sum::<f64>() >= RACKS_SHARE * largest_m2;
        // Tables or seats side by side, more than an office has.
        let mut places = vec![[0.0_f64; 2]; rooms.rooms.len()];
        for piece in furniture {
            let k = match piece.class {
                PlanClass::Seat => 0,
                PlanClass::Table => 1,
                _ => continue,
            };
            // Where people stand at it.
            let (low, high) = (piece.min_m - vec2(BESIDE_M, BESIDE_M), piece.max_m + vec2(BESIDE_M, BESIDE_M));
            let beside = [low, high, vec2(low.x, high.y), vec2(high.x, low.y)];
            if let Some(room) = beside.into_iter().find_map(|place| rooms.at(place)) {
                places[room][k] += 1.0;
            }
        }
        let is_class = |(room, places): &(&Room, &[f64; 2])| {
            room.area_m2 >= LEAST_CLASSROOM_M2 && places[0].max(places[1]) >= PUPILS_PER_M2 * room.area_m2
        };
        let is_empty_hall = |(room, places): (&Room, &[f64; 2])| {
            room.area_m2 >= EMPTY_HALL_M2.max(EMPTY_HALL_SHARE * total_m2)
                && places[0].max(places[1]) < EMPTY_HALL_PLACES_PER_M2 * room.area_m2
        };
        let is_hall = rooms.rooms.iter().zip(&places).any(is_empty_hall);
        let classrooms = rooms.rooms.iter().zip(&places).filter(is_class).count();
        if own_toilets >= LEAST_PATIENTS_ROOMS && 2 * own_toilets >= areas.len() {
            Use::Hospital
        } else if has_racks {
            Use::Shop
        } else if classrooms >= LEAST_CLASSROOMS && 4 * classrooms >= areas.len() {
            Use::School
        } else if wide >= 3 && (area_m2(RoomKind::Hall) + area_m2(RoomKind::Corridor)) >= 0.5 * total_m2 {
            Use::Station
        } else if is_hall && areas.len() > 4 {
            Use::Hall
        } else if is_one_flat || are_flats {
            Use::Home
        } else if areas.len() <= 4 && largest_m2 >= 0.5 * total_m2 {
            // Guests sit around tables, clerks at desks.
            let are_desks = seats >= 10.0 && seats < 3.0 * tables;
            if total_m2 >= 600.0 || places_per_m2 >= 0.5 {
                Use::Hall
            } else if are_desks {
                Use::Office
            } else {
                Use::Shop
            }
        } else if corridor_share >= 0.08 {
            match areas.len() {
                _ if median_m2 >= 45.0 || median_m2 >= 30.0 && places_per_m2 >= 0.18 => Use::School,
                40.. if median_m2 < 25.0 => Use::Hospital,
                _ => Use::Office,
            }
        } else if median_m2 >= 40.0 {
            Use::Museum
        } else {
            Use::Office
        }
    }
}

impl Habits {
    /// What people do in rooms of a kind.
    pub(crate) fn of(&self, kind: RoomKind) -> RoomHabits {
        match kind {
            RoomKind::Room => self.room,
            RoomKind::Corridor => self.corridor,
            RoomKind::Hall => self.hall,
            RoomKind::Toilet => self.toilet,
            RoomKind::Stairs => self.stairs,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::FloorPlan;
    use crate::walls::{Walls, WallsOptions};

    /// Seven rooms of 4 x 5 m at a corridor; with toilets, each has a cell of 1.6 x 1.9 m beside its door. 0.1 m per pixel.
    fn ward(with_toilets: bool) -> Use {
        let is_floor = |x: u32, y: u32| {
            let in_room = x % 41;
            let is_door = in_room > 25 && in_room < 36 && y == 51;
            let is_room = (1..51).contains(&y) && in_room != 0;
            let is_cell_wall = in_room == 17 && y > 31 || y == 31 && in_room <= 17;
            let is_cell_door = in_room == 17 && (36..45).contains(&y);
            let is_corridor = (52..74).contains(&y) && x > 0 || (58..68).contains(&y);
            is_room && (!with_toilets || !is_cell_wall || is_cell_door) && x < 287 || is_door || is_corridor && x < 287
        };
        let mask = (0..76 * 288).map(|k: u32| u8::from(is_floor(k % 288, k / 288))).collect();
        let plan = FloorPlan::from_mask(288, 76, 0.1, mask);
        Use::guess(&Rooms::find(&plan, &Walls::trace(&plan, &WallsOptions::default())), &[])
    }

    #[test]
    fn rooms_with_a_toilet_each_are_a_hospitals() {
        assert_eq!([ward(true), ward(false)], [Use::Hospital, Use::Home]);
    }
}
