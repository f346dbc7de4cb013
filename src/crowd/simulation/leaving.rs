//! Who leaves the crowd: those who have arrived, and those who never will.

use super::Crowd;
use crate::crowd::Stuck;

/// Without any way made for so many times the patience, somebody is stuck even while others arrive.
const PATIENCE_LIMIT: f64 = 5.0;
/// How often the crowd looks for stuck people, seconds.
const STUCK_CHECK_S: f64 = 1.0;

impl Crowd<'_> {
    /// Takes out those who have arrived, and those who are stuck.
    pub(in crate::crowd) fn let_go(&mut self) {
        let check_steps = (STUCK_CHECK_S / self.options.time_step).round().max(1.0) as u64;
        let stuck = if self.step.is_multiple_of(check_steps) { self.find_stuck() } else { Vec::new() };
        if !self.some_arrived && stuck.is_empty() {
            return;
        }
        self.some_arrived = false;
        let time_s = self.time_s();
        let mut keep = vec![true; self.courses.len()];
        for (keep, course) in keep.iter_mut().zip(&self.courses).filter(|(_, course)| course.arrived) {
            *keep = false;
            self.tally.arrived += 1;
            let trail = &mut self.trails[course.route as usize];
            trail.arrived += 1;
            trail.last_arrived_s = time_s;
        }
        for &slot in &stuck {
            keep[slot] = false;
        }
        let course = |slot: usize| self.courses[slot];
        let mut stuck: Vec<Stuck> = stuck
            .into_iter()
            .map(|slot| Stuck {
                id: course(slot).id,
                place_m: self.bodies[slot].position(),
                route: course(slot).route as usize,
                stop: course(slot).errand.and_then(|errand| self.stops.name_of(&errand)),
            })
            .collect();
        stuck.sort_unstable_by_key(|stuck| stuck.id);
        self.tally.stuck.extend(stuck);
        retain(&mut self.bodies, &keep);
        retain(&mut self.traits, &keep);
        retain(&mut self.courses, &keep);
    }

    /// Slots of those who have made no way for longer than their patience while nobody of their route arrives either,
    /// or while so many arrive that their turn must have come.
    fn find_stuck(&mut self) -> Vec<usize> {
        let time_s = self.time_s();
        let patience_s = self.options.patience_seconds;
        let present = self.courses.len() as u64;
        let mut stuck = Vec::new();
        for (slot, course) in self.courses.iter_mut().enumerate() {
            let trail = &self.trails[course.route as usize];
            let idle_s = time_s - course.improved_s;
            if course.arrived || idle_s <= patience_s {
                course.arrived_before = trail.arrived;
                continue;
            }
            let others_wait_too = time_s - trail.last_arrived_s > patience_s;
            let passed_over = trail.arrived - course.arrived_before > present;
            if others_wait_too || passed_over && idle_s > PATIENCE_LIMIT * patience_s {
                stuck.push(slot);
            }
        }
        stuck
    }
}

fn retain<T>(items: &mut Vec<T>, keep: &[bool]) {
    let mut keep = keep.iter();
    items.retain(|_| keep.next().copied().unwrap_or(true));
}
