//! Who leaves the crowd: those who have arrived, and those who are stuck.

use super::agents::Agents;
use super::stops::Stops;
use super::tally::{Stuck, Tally};

/// Multiple of the patience after which an idle agent is stuck even while others arrive.
const PATIENCE_LIMIT: f64 = 5.0;
/// Interval at which the crowd looks for stuck people, seconds.
const STUCK_CHECK_S: f64 = 1.0;

/// People who have walked a route to its end.
#[derive(Clone, Copy, Debug, Default)]
struct RouteArrivals {
    arrived: u64,
    last_s: f64,
}

/// Arrivals at the goals, route by route.
#[derive(Debug)]
pub(super) struct Departures(Vec<RouteArrivals>);

/// The step at whose end people leave.
#[derive(Clone, Copy)]
pub(super) struct StepEnd {
    /// Number of the step.
    pub(super) step: u64,
    /// Time step, seconds.
    pub(super) time_step_s: f64,
    /// Whether somebody has arrived in the step.
    pub(super) some_arrived: bool,
}

impl Departures {
    pub(super) fn new(routes: usize) -> Departures {
        Departures(vec![RouteArrivals::default(); routes])
    }

    /// Takes out the agents who have arrived, and those who are stuck.
    pub(super) fn let_go(
        &mut self,
        end: StepEnd,
        patience_s: f64,
        agents: &mut Agents,
        stops: &Stops,
        tally: &mut Tally,
    ) {
        let check_steps = (STUCK_CHECK_S / end.time_step_s).round().max(1.0) as u64;
        let time_s = end.step as f64 * end.time_step_s;
        let stuck = match end.step.is_multiple_of(check_steps) {
            true => self.find_stuck(time_s, patience_s, agents),
            false => Vec::new(),
        };
        if !end.some_arrived && stuck.is_empty() {
            return;
        }
        let mut keep = vec![true; agents.walks.len()];
        for (keep, walk) in keep.iter_mut().zip(&agents.walks).filter(|(_, walk)| walk.arrived) {
            *keep = false;
            tally.arrived += 1;
            let of_route = &mut self.0[walk.route as usize];
            of_route.arrived += 1;
            of_route.last_s = time_s;
        }
        let mut reports = Vec::with_capacity(stuck.len());
        for slot in stuck {
            keep[slot] = false;
            let walk = &agents.walks[slot];
            reports.push(Stuck {
                id: walk.id,
                place_m: agents.bodies[slot].position(),
                route: walk.route as usize,
                stop: walk.visit.and_then(|target| stops.name_of(&target)),
            });
        }
        reports.sort_unstable_by_key(|stuck| stuck.id);
        tally.stuck.extend(reports);
        agents.retain(&keep);
    }

    /// Slots of agents who have come no nearer to their goal for longer than their patience, while others of their route
    /// arrive either not at all, or in such numbers that their turn must have come.
    fn find_stuck(&self, time_s: f64, patience_s: f64, agents: &mut Agents) -> Vec<usize> {
        let present = agents.walks.len() as u64;
        let mut stuck = Vec::new();
        for (slot, walk) in agents.walks.iter_mut().enumerate() {
            let of_route = &self.0[walk.route as usize];
            let idle_s = time_s - walk.improved_s;
            if walk.arrived || idle_s <= patience_s {
                walk.arrived_before = of_route.arrived;
                continue;
            }
            let others_wait_too = time_s - of_route.last_s > patience_s;
            let passed_over = of_route.arrived - walk.arrived_before > present;
            if others_wait_too || passed_over && idle_s > PATIENCE_LIMIT * patience_s {
                stuck.push(slot);
            }
        }
        stuck
    }
}
