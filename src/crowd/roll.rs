//! Everybody present in the order of ids, however they lie in memory.

use super::state::Course;

/// With more ids than this many times the people between the first and the last present, they are sorted.
const SPARSE: usize = 16;

/// Fills `slots` with everybody's slot in the order of ids.
pub(super) fn call(courses: &[Course], slots: &mut Vec<u32>) {
    let ids = || courses.iter().map(|course| course.id);
    let (first, last) = (ids().min().unwrap_or(0), ids().max().unwrap_or(0));
    let range = (last - first) as usize + 1;
    slots.clear();
    if range > SPARSE * (courses.len() + 1) {
        slots.extend(0..courses.len() as u32);
        slots.sort_unstable_by_key(|&slot| courses[slot as usize].id);
        return;
    }
    // Ids follow arrivals, so that those present lie close together: one place for each.
    slots.resize(range, u32::MAX);
    for (slot, id) in ids().enumerate() {
        slots[(id - first) as usize] = slot as u32;
    }
    slots.retain(|&slot| slot != u32::MAX);
}
