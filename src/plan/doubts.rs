//! What a user should look at in a plan that was read.

use super::{FloorPlan, RegionRole};

/// Share of the white inside that nobody reaches, above which the plan was probably misread.
const UNREACHED_SHARE: f64 = 0.15;
/// Least area of a closed room that is named, square metres, and the most that are named.
const LEAST_ROOM_M2: f64 = 2.0;
const MOST_ROOMS: usize = 5;

/// Says what looks wrong: rooms that nobody can reach, much unreached white, paper as floor, doors too narrow.
pub(super) fn doubts(plan: &FloorPlan, narrowest_m: f64) -> Vec<String> {
    let mut all = Vec::new();
    let area = |role: RegionRole| plan.regions.iter().filter(|r| r.role == role).map(|r| r.area_m2).sum::<f64>();
    let (floor, unreached) = (area(RegionRole::Floor), area(RegionRole::Unreached));
    let closed: Vec<_> =
        plan.regions.iter().filter(|r| r.role == RegionRole::Unreached && r.area_m2 >= LEAST_ROOM_M2).collect();
    if !closed.is_empty() {
        let named = closed
            .iter()
            .take(MOST_ROOMS)
            .map(|r| format!("{:.1} m2 at [{:.1}, {:.1}]", r.area_m2, r.inside_m.x, r.inside_m.y));
        let named = named.collect::<Vec<_>>().join(", ");
        let more =
            if closed.len() > MOST_ROOMS { format!(" and {} more", closed.len() - MOST_ROOMS) } else { String::new() };
        all.push(format!("nobody can reach closed rooms: {named}{more}"));
    }
    if unreached > UNREACHED_SHARE * (floor + unreached) {
        let share = 100.0 * unreached / (floor + unreached);
        all.push(format!("nobody can reach {share:.0} % of the white inside: {unreached:.1} m2; are doors closed?"));
    }
    let [width, height] = [plan.width_px, plan.height_px].map(|side| side as usize);
    let corners = [0, width - 1, (height - 1) * width, height * width - 1];
    if corners.iter().filter(|&&at| plan.floor[at] != 0).count() >= 3 {
        all.push("the paper around the building may be floor: floor lies in the corners of the image".to_owned());
    }
    for door in plan.doors.iter().filter(|door| door.width_m() < narrowest_m) {
        let middle = (door.from_m + door.to_m) * 0.5;
        let (width, x, y) = (door.width_m(), middle.x, middle.y);
        all.push(format!("a door at [{x:.1}, {y:.1}] is {width:.2} m wide: too narrow for people of {narrowest_m} m"));
    }
    all
}
