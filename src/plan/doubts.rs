//! What a user should look at in a plan that was read.

use super::{FloorPlan, Region, RegionRole};
use crate::math::{Vec2, vec2};

/// Share of the white inside that nobody reaches, above which the plan was probably misread.
const UNREACHED_SHARE: f64 = 0.15;
/// Least area of a closed room that is named, square metres.
const LEAST_ROOM_M2: f64 = 2.0;
/// Half the least width of a closed room, metres: hollow walls are narrower.
const ROOM_REACH_M: f64 = 0.4;
/// Most rooms and doors that are named.
const MOST_NAMED: usize = 5;

/// Says what looks wrong: rooms that nobody can reach, much unreached white, paper as floor, doors too narrow.
///
/// `is_plain` is a picture of walls alone, which shows shafts and cores that nobody means to reach: only many are told.
pub(super) fn doubts(plan: &FloorPlan, narrowest_m: f64, is_plain: bool) -> Vec<String> {
    let mut all = Vec::new();
    let of = |role: RegionRole| plan.regions.iter().filter(move |region| region.role == role);
    let area_m2 = |regions: &[&Region]| regions.iter().map(|region| region.area_m2).sum::<f64>();
    let floor_m2 = area_m2(&of(RegionRole::Floor).collect::<Vec<_>>());
    let closed: Vec<&Region> = of(RegionRole::Unreached).filter(|region| is_wide(plan, region)).collect();
    let rooms: Vec<String> = closed
        .iter()
        .filter(|region| region.area_m2 >= LEAST_ROOM_M2)
        .map(|r| format!("{:.1} m2 at [{:.1}, {:.1}]", r.area_m2, r.inside_m.x, r.inside_m.y))
        .collect();
    let unreached_m2 = area_m2(&closed);
    let is_much = unreached_m2 > UNREACHED_SHARE * (floor_m2 + unreached_m2);
    if !rooms.is_empty() && (is_much || !is_plain) {
        all.push(format!("nobody can reach closed rooms: {}", named(&rooms)));
    }
    if is_much {
        let share = 100.0 * unreached_m2 / (floor_m2 + unreached_m2);
        all.push(format!("nobody can reach {share:.0} % of the white inside: {unreached_m2:.1} m2; are doors closed?"));
    }
    if is_paper_floor(plan, is_plain) {
        all.push("the paper around the building may be floor: floor lies in the corners of the image".to_owned());
    }
    let drawn = plan.drawn.iter().flat_map(|drawn| drawn.doors.iter().copied());
    let doors = plan.doors.iter().map(|door| [door.from_m, door.to_m]).chain(drawn);
    let narrow: Vec<String> = doors
        .map(|[a, b]| (a.distance(b), a.lerp(b, 0.5)))
        .filter(|(width_m, _)| *width_m < narrowest_m)
        .map(|(width_m, at)| format!("{width_m:.2} m at [{:.1}, {:.1}]", at.x, at.y))
        .collect();
    if !narrow.is_empty() {
        all.push(format!("doors too narrow for people of {narrowest_m} m: {}", named(&narrow)));
    }
    all
}

/// The first few, and how many more there are.
fn named(all: &[String]) -> String {
    let first = all[..all.len().min(MOST_NAMED)].join(", ");
    if all.len() > MOST_NAMED { format!("{first} and {} more", all.len() - MOST_NAMED) } else { first }
}

/// Whether a region is as wide as a room at its widest place.
fn is_wide(plan: &FloorPlan, region: &Region) -> bool {
    let is_light = |p: Vec2| {
        let [x, y] = plan.m_to_px(p);
        let is_within = x >= 0.0 && y >= 0.0 && x < f64::from(plan.width_px) && y < f64::from(plan.height_px);
        let at = |x: f64, y: f64| y as usize * plan.width_px as usize + x as usize;
        is_within && plan.lightness[at(x, y)] >= plan.threshold
    };
    let (reach, middle) = (ROOM_REACH_M, region.inside_m);
    [vec2(reach, 0.0), vec2(-reach, 0.0), vec2(0.0, reach), vec2(0.0, -reach)].iter().all(|&d| is_light(middle + d))
}

/// Whether floor lies in the image's corners. In plans of walls alone it may: an open place; unless all walls keep off
/// the image's sides, as those of a building on paper do.
fn is_paper_floor(plan: &FloorPlan, is_plain: bool) -> bool {
    let [width, height] = [plan.width_px, plan.height_px].map(|side| side as usize);
    let corners = [0, width - 1, (height - 1) * width, height * width - 1];
    let count = corners.iter().filter(|&&at| plan.floor[at] != 0).count();
    let is_floor = |at: usize| plan.floor[at] != 0;
    let sides_are_free = || {
        (0..width).all(|x| is_floor(x) && is_floor((height - 1) * width + x))
            && (0..height).all(|y| is_floor(y * width) && is_floor(y * width + width - 1))
    };
    if is_plain { count == 4 && sides_are_free() } else { count >= 3 }
}
