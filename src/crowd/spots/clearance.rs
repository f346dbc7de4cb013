//! Clearance of a unit: whether it keeps off walls, the viewer and other people.

use super::path::{BlendedPath, LOOK_S};
use super::playback::Playback;
use crate::crowd::agents::AgentSnapshot;
use crate::math::Vec2;
use crate::units::{LEAST_APART_M, SpotFrame, Unit};
use crate::walls::Walls;

/// Least distance of performers from walls, metres.
const WALL_M: f64 = 0.22;
/// Least distance of performers from the edge of the viewer's body, metres.
const BODY_M: f64 = 0.2;
/// Time over which the motion of others is foreseen, seconds.
const FORESEEN_S: f64 = 1.2;
/// Least distance of others within that time, and of performers of another unit to its end, metres.
const FORESEEN_M: f64 = 0.42;
/// Distance beyond which others are left out, metres: more than they walk within [`FORESEEN_S`].
const FAR_M: f64 = 20.0;

/// Obstacles of a unit that begins now.
pub(super) struct Clearance<'a> {
    pub(super) frame: &'a SpotFrame,
    /// Radius of the viewer's body, metres; 0 without a body.
    pub(super) radius_m: f64,
    pub(super) walls: &'a Walls,
    /// Units that are played at the spot.
    pub(super) playing: Vec<(&'a Playback, &'a Unit)>,
    /// Time since the start, seconds.
    pub(super) time_s: f64,
}

impl Clearance<'_> {
    /// Whether these paths into a unit keep off each other, other people, the viewer and walls.
    pub(super) fn has(&self, unit: &Unit, ways: &[(u32, BlendedPath)], people: &[AgentSnapshot]) -> bool {
        self.are_apart(unit, ways)
            && self.keep_off(unit, ways, people)
            && self.keep_off_who_play(unit, ways)
            && self.cross_nothing(unit, ways)
    }

    /// Whether performers keep off each other and the viewer while they move over.
    fn are_apart(&self, unit: &Unit, ways: &[(u32, BlendedPath)]) -> bool {
        let over_s = ways.iter().map(|(_, way)| way.over_s).fold(0.0, f64::max);
        let viewer_m = viewer_m(self.radius_m);
        looks(over_s + LOOK_S).all(|time_s| {
            let places: Vec<Vec2> = ways.iter().map(|(_, way)| way.at(unit, time_s).place_m).collect();
            places.iter().enumerate().all(|(k, place)| {
                place.length() >= viewer_m && places[..k].iter().all(|other| other.distance(*place) >= LEAST_APART_M)
            })
        })
    }

    /// Whether performers keep off people who walk by the model.
    fn keep_off(&self, unit: &Unit, ways: &[(u32, BlendedPath)], people: &[AgentSnapshot]) -> bool {
        let known = |id: u32| {
            let performers = self.playing.iter().flat_map(|(play, _)| &play.performers);
            ways.iter().any(|(other, _)| *other == id) || performers.into_iter().any(|part| part.id == id)
        };
        let near = |p: &&AgentSnapshot| {
            ways.iter().any(|(_, way)| {
                let from_m = self.frame.to_plan(way.at(unit, 0.0).place_m);
                p.position_m.distance(from_m) < FAR_M
            })
        };
        let others: Vec<&AgentSnapshot> = people.iter().filter(near).filter(|person| !known(person.id)).collect();
        looks(FORESEEN_S).all(|time_s| {
            ways.iter().all(|(_, way)| {
                let (place_m, _) = way.on_plan(unit, time_s, self.frame);
                let there = |other: &&AgentSnapshot| other.position_m + other.velocity_m_s * time_s;
                others.iter().all(|other| there(other).distance(place_m) >= FORESEEN_M)
            })
        })
    }

    /// Whether performers keep off those of other units here, to the end of either.
    fn keep_off_who_play(&self, unit: &Unit, ways: &[(u32, BlendedPath)]) -> bool {
        self.playing.iter().all(|(play, other)| {
            let since_s = self.time_s - play.began_s;
            looks(unit.duration_s.min(other.duration_s - since_s)).all(|time_s| {
                let there: Vec<Vec2> =
                    play.performers.iter().map(|part| part.way.at(other, since_s + time_s).place_m).collect();
                let mut places = ways.iter().map(|(_, way)| way.at(unit, time_s).place_m);
                places.all(|place| there.iter().all(|other| other.distance(place) >= FORESEEN_M))
            })
        })
    }

    /// Whether all paths keep off walls, to the unit's end.
    fn cross_nothing(&self, unit: &Unit, ways: &[(u32, BlendedPath)]) -> bool {
        let on_plan = |way: &BlendedPath, time_s: f64| way.on_plan(unit, time_s, self.frame).0;
        ways.iter().all(|(_, way)| is_clear(|time_s| on_plan(way, time_s), unit.duration_s, self.walls))
    }
}

/// Whether a unit's own paths, mirrored or not, keep off walls and off the viewer.
pub(super) fn fits(unit: &Unit, frame: &SpotFrame, radius_m: f64, walls: &Walls) -> bool {
    let place = |member: usize, time_s: f64, mirrored: bool| unit.moment(member, time_s, mirrored).place_m;
    let is_seen = |member: usize| {
        looks(unit.duration_s).all(|time_s| place(member, time_s, false).length() >= viewer_m(radius_m))
    };
    let is_free = |member: usize, mirrored: bool| {
        is_clear(|time_s| frame.to_plan(place(member, time_s, mirrored)), unit.duration_s, walls)
    };
    let mut members = 0..unit.members.len();
    members.clone().all(is_seen)
        && [false, true].iter().any(|&mirrored| members.clone().all(|member| is_free(member, mirrored)))
        && members.next().is_some()
}

/// Least distance of performers from the viewer's place, metres.
fn viewer_m(radius_m: f64) -> f64 {
    if radius_m > 0.0 { radius_m + BODY_M } else { 0.0 }
}

/// Times at which paths are checked, seconds, without 0.
fn looks(until_s: f64) -> impl Iterator<Item = f64> {
    (1..=(until_s.max(0.0) / LOOK_S) as usize).map(|k| k as f64 * LOOK_S)
}

/// Whether a path keeps off walls and crosses none.
fn is_clear(at: impl Fn(f64) -> Vec2, duration_s: f64, walls: &Walls) -> bool {
    let start = at(0.0);
    let mut before = start;
    // A path may begin close to a wall and lead away from it.
    walls.is_inside(start)
        && looks(duration_s).all(|time_s| {
            let place_m = at(time_s);
            let free =
                walls.nearest(place_m, WALL_M).is_none() && walls.is_inside(place_m) && walls.sight(before, place_m);
            before = place_m;
            free
        })
}
