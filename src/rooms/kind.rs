use serde::{Deserialize, Serialize};

use crate::options::names;

/// What a room is, by its shape and by what stands in it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RoomKind {
    /// A room like others.
    #[default]
    Room,
    /// Long and narrow, or with many doors: people pass through.
    Corridor,
    /// Large.
    Hall,
    /// Small, or with a WC or a basin.
    Toilet,
    /// Stairs.
    Stairs,
}

names!(RoomKind);

/// Measures of a room, by which its kind is told. Lengths in metres.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Measures {
    /// With furniture, and without.
    pub(super) area_m2: f64,
    pub(super) free_m2: f64,
    /// Four times the mean distance from walls: of a long corridor its width, of a square two thirds of its side.
    pub(super) width_m: f64,
    /// Twice the greatest distance from walls and furniture.
    pub(super) widest_m: f64,
    /// Sides of the box around it.
    pub(super) box_m: [f64; 2],
    pub(super) doors: usize,
    pub(super) fixtures_m2: f64,
    pub(super) stairs_m2: f64,
}

/// Largest area of a room that is a toilet by its size alone, and of one with fixtures, square metres.
const TOILET_M2: [f64; 2] = [5.0, 16.0];
/// Least area of fixtures in a toilet: a WC or a basin, square metres; and their least share of a larger one, with a row of them.
const FIXTURE_M2: f64 = 0.12;
const FIXTURES_SHARE: f64 = 0.035;
/// Widest corridor, metres, and its least area in squares of its width: by its shape alone, and with many doors.
const CORRIDOR_M: f64 = 4.5;
const CORRIDOR_SQUARES: [f64; 2] = [4.5, 3.4];
/// Least share of its box that a room fills whose furniture alone makes its ways narrow.
const FILLS_BOX: f64 = 0.6;
/// Least area of furniture with which people live in a room, and largest area of one that few doors lead to, square metres;
/// least width of a place in others, metres: an open living room goes on into the hall.
const LIVED_IN_M2: [f64; 2] = [2.5, 40.0];
const LIVED_IN_M: f64 = 2.6;
/// Doors of a room that many pass through.
const MANY_DOORS: usize = 4;
/// Least area of a hall, square metres.
const HALL_M2: f64 = 80.0;
/// Least share of stairs in a staircase.
const STAIRS_SHARE: f64 = 0.3;

impl RoomKind {
    pub(super) fn of(measures: &Measures) -> RoomKind {
        let Measures { area_m2, free_m2, width_m, widest_m, box_m: [w, h], doors, fixtures_m2, stairs_m2 } = *measures;
        let squares = free_m2 / (width_m * width_m).max(0.01);
        let long =
            squares >= CORRIDOR_SQUARES[0] && doors >= 2 || squares >= CORRIDOR_SQUARES[1] && doors >= MANY_DOORS;
        let is_own = doors <= 2 && area_m2 <= LIVED_IN_M2[1];
        let is_lived_in = area_m2 - free_m2 >= LIVED_IN_M2[0] && (widest_m >= LIVED_IN_M || is_own);
        let is_wide = w.min(h) > CORRIDOR_M && area_m2 >= FILLS_BOX * w * h;
        if stairs_m2 >= STAIRS_SHARE * area_m2 && stairs_m2 > 0.0 {
            RoomKind::Stairs
        } else if fixtures_m2 >= FIXTURE_M2 && (area_m2 <= TOILET_M2[1] || fixtures_m2 >= FIXTURES_SHARE * area_m2) {
            RoomKind::Toilet
        } else if width_m <= CORRIDOR_M && long && !is_wide && !is_lived_in {
            RoomKind::Corridor
        } else if area_m2 <= TOILET_M2[0] && doors <= 1 {
            RoomKind::Toilet
        } else if area_m2 >= HALL_M2 {
            RoomKind::Hall
        } else {
            RoomKind::Room
        }
    }

    /// Its name, as scenarios write it.
    pub fn name(self) -> &'static str {
        match self {
            RoomKind::Room => "room",
            RoomKind::Corridor => "corridor",
            RoomKind::Hall => "hall",
            RoomKind::Toilet => "toilet",
            RoomKind::Stairs => "stairs",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_large_room_with_a_row_of_fixtures_is_a_toilet() {
        // Three WCs in 17 square metres, and one basin in an office of that size.
        let wcs =
            Measures { area_m2: 17.0, free_m2: 16.0, width_m: 3.0, doors: 1, fixtures_m2: 0.8, ..Measures::default() };
        assert_eq!(RoomKind::of(&wcs), RoomKind::Toilet);
        assert_eq!(RoomKind::of(&Measures { fixtures_m2: 0.2, ..wcs }), RoomKind::Room);
    }

    #[test]
    fn tables_make_no_corridor_of_a_wide_room() {
        // A dining room of 12 m with tables, and a ring of corridors of 2 m about a core.
        let dining = Measures {
            area_m2: 136.0,
            free_m2: 108.0,
            width_m: 2.6,
            box_m: [11.8; 2],
            doors: 3,
            ..Measures::default()
        };
        assert_eq!(RoomKind::of(&dining), RoomKind::Hall);
        let ring = Measures { area_m2: 80.0, free_m2: 80.0, width_m: 2.0, box_m: [12.0; 2], ..dining };
        assert_eq!(RoomKind::of(&ring), RoomKind::Corridor);
        // A living room with a table, a sofa and a kitchen, and the hall that it goes on into; the same with two shelves.
        let with = |[area_m2, free_m2, width_m, widest_m]: [f64; 4], doors: usize, box_m: [f64; 2]| Measures {
            area_m2,
            free_m2,
            width_m,
            widest_m,
            doors,
            box_m,
            ..Measures::default()
        };
        let flat = with([48.0, 41.0, 2.6, 3.4], 5, [12.0, 9.0]);
        assert_eq!(RoomKind::of(&flat), RoomKind::Room);
        assert_eq!(RoomKind::of(&Measures { free_m2: 47.0, ..flat }), RoomKind::Corridor);
        // A hotel's room goes round its bath.
        let hotel = with([18.3, 14.6, 1.6, 2.0], 2, [3.8, 6.2]);
        assert_eq!(RoomKind::of(&hotel), RoomKind::Room);
    }
}
