//! Free spots where people stand or sit, and how they are found.

use std::collections::BTreeMap;

use super::queue_path::stands;
use crate::crowd::environment::Environment;
use crate::math::{Rect, SplitMix64, Vec2, vec2};
use crate::routes::{Facing, Stop, StopKind};

/// Spots that are tried for each size of the area.
const TRIES: usize = 48;
/// Least share of the wanted distance from others, where there is no room.
const CLOSEST: f64 = 0.7;
/// Sizes of the area that are searched in turn, as multiples of its own.
const WIDER: [f64; 4] = [1.0, 1.6, 2.5, 4.0];
/// Distance from walls, metres.
const MARGIN_M: f64 = 0.3;
/// How far from a spot of bare floor people stand at most, metres.
const ABOUT_SPOT_M: f64 = 0.35;
/// Largest turn from the wanted direction, as the sine of the angle.
const TURN: f64 = 0.2;

/// Area in which a free spot is searched.
#[derive(Clone, Copy, Debug)]
pub(super) enum SearchArea {
    /// Disc: middle and radius, metres.
    Around(Vec2, f64),
    /// Rectangle, metres.
    Within(Rect),
}

impl SearchArea {
    fn middle(self) -> Vec2 {
        match self {
            SearchArea::Around(middle, _) => middle,
            SearchArea::Within(area) => area.centre(),
        }
    }

    /// A random place in the area, enlarged `wider` times, or `None` where the draw fell beside it.
    fn draw(self, rng: &mut SplitMix64, wider: f64) -> Option<Vec2> {
        let mut side = || 2.0 * f64::from(rng.unit()) - 1.0;
        let [x, y] = [side(), side()];
        match self {
            SearchArea::Around(middle, reach_m) => {
                (x * x + y * y <= 1.0).then(|| middle + vec2(x, y) * (reach_m * wider))
            }
            SearchArea::Within(area) => {
                let half = vec2(0.5 * area.width() * x, 0.5 * area.height() * y);
                Some(area.centre() + half * wider)
            }
        }
    }

    /// Area, square metres.
    fn m2(self) -> f64 {
        match self {
            SearchArea::Around(_, reach_m) => std::f64::consts::PI * reach_m * reach_m,
            SearchArea::Within(area) => area.width() * area.height(),
        }
    }
}

/// Finds a spot for which `free` holds, about `apart_m` from others. The same draw tries the same spots.
pub(super) fn free_spot(
    environment: &Environment<'_>,
    room: SearchArea,
    apart_m: f64,
    draw: u64,
    free: impl Fn(Vec2, f64) -> bool,
) -> Option<Vec2> {
    let rng = &mut SplitMix64::new(draw);
    let middle = room.middle();
    for wider in WIDER {
        for attempt in 0..TRIES {
            let Some(spot) = room.draw(rng, wider) else { continue };
            let closer = 1.0 - (1.0 - CLOSEST) * attempt as f64 / TRIES as f64;
            if stands(environment, spot, MARGIN_M) && free(spot, apart_m * closer) && environment.sight(middle, spot) {
                return Some(spot);
            }
        }
    }
    None
}

/// Turns a unit vector by a random angle of up to about 12 degrees.
pub(super) fn about(facing: Vec2, draw: u64) -> Vec2 {
    let off = TURN * (2.0 * f64::from(SplitMix64::new(draw ^ 0x5f).unit()) - 1.0);
    (facing + facing.left() * off).normalized().unwrap_or(facing)
}

/// Moves a spot at least `keep_m` off walls, if there is such a place in sight.
pub(super) fn off_walls(environment: &Environment<'_>, spot: Vec2, keep_m: f64) -> Vec2 {
    let mut moved = spot;
    for _ in 0..4 {
        let Some(nearest) = environment.walls.nearest(moved, keep_m) else { return moved };
        let Some(away) = (moved - nearest.point_m).normalized() else { return spot };
        moved = nearest.point_m + away * (keep_m + 1e-3);
    }
    if environment.sight(spot, moved) { moved } else { spot }
}

/// A seat, or a spot in a room.
#[derive(Clone, Copy, Debug)]
struct Seat {
    place_m: Vec2,
    /// Unit vector that people face there, if it is one of its own.
    facing: Option<Vec2>,
    /// Id of who is there.
    taken: Option<u32>,
    /// Number of people who have been there.
    used: u32,
}

impl Seat {
    /// When it is this seat's turn: the least is next. Those at furniture get their turns evenly, so that people use all of
    /// them. Of bare floor people like some places more, the n-th of them by 1 / (n + 3)²: most people go the same ways,
    /// to the far corners, and few go to the rest.
    fn turn(&self, number: usize) -> u64 {
        let liked_less = if self.facing.is_some() { 1 } else { (number as u64 + 4).pow(2) };
        (u64::from(self.used) + 1) * liked_less
    }
}

/// People who stand or sit at a stop without a queue.
#[derive(Clone, Debug)]
pub(super) struct StandingArea {
    room: SearchArea,
    /// Seats or spots, from the first that is taken on.
    seats: Vec<Seat>,
    /// Spots by id, metres.
    spots: BTreeMap<u32, Vec2>,
}

impl StandingArea {
    pub(super) fn new(environment: &Environment<'_>, stop: &Stop, keep_m: f64) -> StandingArea {
        let area = Rect::around(stop.at_m[0], stop.at_m[1]);
        let middle = area.centre();
        let is_bench = stop.kind == StopKind::Bench;
        let room = match is_bench {
            // People who find no seat stand before the bench.
            true => {
                SearchArea::Around(middle + stop.facing_from(middle) * 1.6, 1.2 + 0.5 * area.width().max(area.height()))
            }
            false if area.width() > 0.0 && area.height() > 0.0 => SearchArea::Within(area),
            false => SearchArea::Around(middle, stop.reach_m),
        };
        let seats = if is_bench { stop.places_m.as_slice() } else { &[] }.iter().map(|&seat| (seat, None));
        let spots = stop.spots.iter().map(|spot| (spot.at_m, spot.facing));
        let seat = |(place_m, facing)| {
            let place_m = off_walls(environment, place_m, keep_m);
            Seat { place_m, facing, taken: None, used: 0 }
        };
        let seats = seats.chain(spots).map(seat).collect();
        StandingArea { room, seats, spots: BTreeMap::new() }
    }

    /// Largest distance of people from the middle, metres.
    pub(super) fn reach_m(&self) -> f64 {
        match self.room {
            SearchArea::Around(_, reach_m) => reach_m,
            SearchArea::Within(area) => 0.5 * area.width().max(area.height()),
        }
    }

    /// Number of people who find room: seats, or spots drawn at random with `spacing_m` between them.
    pub(super) fn room(&self, spacing_m: f64) -> usize {
        if self.seats.is_empty() {
            ((0.7 * self.room.m2() / (spacing_m * spacing_m)) as usize).max(1)
        } else {
            self.seats.len()
        }
    }

    pub(super) fn taken(&self) -> usize {
        self.spots.len()
    }

    /// Takes a spot for a person who comes from `p`; returns it and the unit vector that the person faces.
    pub(super) fn take(
        &mut self,
        environment: &Environment<'_>,
        stop: &Stop,
        id: u32,
        draw: u64,
        p: Vec2,
    ) -> (Vec2, Vec2) {
        let seats = self.seats.iter_mut().enumerate();
        let mut vacant: Vec<(usize, &mut Seat)> = seats.filter(|(_, seat)| seat.taken.is_none()).collect();
        let mut own_facing = None;
        let spot = if !vacant.is_empty() {
            let wanted = match stop.spots.is_empty() {
                true => (draw % vacant.len() as u64) as usize,
                false => (0..vacant.len()).min_by_key(|&k| vacant[k].1.turn(vacant[k].0)).unwrap_or(0),
            };
            let seat = &mut *vacant[wanted].1;
            (seat.taken, seat.used, own_facing) = (Some(id), seat.used + 1, seat.facing);
            let place_m = seat.place_m;
            let is_bare = !stop.spots.is_empty() && own_facing.is_none();
            if is_bare { self.near(environment, place_m, draw) } else { place_m }
        } else {
            let spacing_m = stop.spacing_m.max(0.7);
            let free = |spot: Vec2, apart_m: f64| {
                let seats = self.seats.iter().map(|seat| &seat.place_m);
                self.spots.values().chain(seats).all(|other| other.distance(spot) >= apart_m)
            };
            free_spot(environment, self.room, spacing_m, draw, free).unwrap_or(p)
        };
        self.spots.insert(id, spot);
        let facing = match (own_facing, stop.facing) {
            (Some(facing), _) => about(facing, draw),
            (None, Facing::Free) => any_direction(draw),
            _ => about(stop.facing_from(spot), draw),
        };
        (spot, facing)
    }

    /// A place about a spot of bare floor: two people hardly stand on the same.
    fn near(&self, environment: &Environment<'_>, spot: Vec2, draw: u64) -> Vec2 {
        let place = SearchArea::Around(spot, ABOUT_SPOT_M).draw(&mut SplitMix64::new(draw), 1.0).unwrap_or(spot);
        let is_free = self.spots.values().all(|other| other.distance(place) >= 2.0 * ABOUT_SPOT_M);
        let fits = is_free && stands(environment, place, MARGIN_M) && environment.sight(spot, place);
        if fits { place } else { spot }
    }

    pub(super) fn leave(&mut self, id: u32) {
        self.spots.remove(&id);
        self.seats.iter_mut().filter(|seat| seat.taken == Some(id)).for_each(|seat| seat.taken = None);
    }
}

fn any_direction(draw: u64) -> Vec2 {
    let rng = &mut SplitMix64::new(draw ^ 0xa7);
    for _ in 0..16 {
        let v = vec2(f64::from(rng.range(-1.0, 1.0)), f64::from(rng.range(-1.0, 1.0)));
        if (0.01..=1.0).contains(&v.length_squared()) {
            return v.normalized().unwrap_or(vec2(1.0, 0.0));
        }
    }
    vec2(1.0, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_bare_floor_some_places_are_liked_and_all_are_used_but_desks_are_used_evenly() {
        let used = |facing: Option<Vec2>| {
            let seat = Seat { place_m: Vec2::ZERO, facing, taken: None, used: 0 };
            let mut seats = vec![seat; 24];
            for _ in 0..480 {
                let next = (0..seats.len()).min_by_key(|&k| seats[k].turn(k)).unwrap();
                seats[next].used += 1;
            }
            Vec::from_iter(seats.iter().map(|seat| seat.used))
        };
        let bare = used(None);
        // Most go to four of the places, and nobody leaves one out.
        assert!(bare[0] >= 8 * bare[23] && bare[23] >= 1 && bare[..4].iter().sum::<u32>() > 480 * 3 / 5, "{bare:?}");
        assert_eq!(used(Some(vec2(1.0, 0.0))), [20; 24]);
    }
}
