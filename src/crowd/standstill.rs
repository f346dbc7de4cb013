//! Who waits where, once the crowd hardly gets on.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};

use super::agents::Agents;
use super::stops::Stops;
use crate::math::Vec2;
use crate::routes::Route;

/// Mean speed below which a crowd hardly gets on, metres per second, and the time for which it must, seconds.
const SLOW_M_S: f64 = 0.3;
const SLOW_FOR_S: f64 = 60.0;
/// Fewest people who walk, for a mean speed, and fewest who wait at a place.
const LEAST_WALKING: usize = 8;
const LEAST_WAITING: usize = 3;
/// Interval at which speeds are looked at, seconds.
const EVERY_S: f64 = 1.0;
/// Side of the cells whose people wait together, metres, and the distance within which two places are one.
const CELL_M: f64 = 2.0;
const SAME_PLACE_M: f64 = 6.0;
/// Number of routes that are named.
const NAMED: usize = 3;

/// People who wait at a place while the whole crowd hardly gets on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Standstill {
    /// When it was noticed, seconds from the start.
    pub time_s: f64,
    /// Where they wait: the place of one in their middle, metres.
    pub at_m: Vec2,
    /// Number of people who wait there.
    pub people: u64,
    /// Mean speed of the whole crowd, metres per second.
    pub mean_speed_m_s: f64,
    /// Names of their routes, or of the gates at which they wait, each with the number of people, most first.
    pub who: Vec<(String, u64)>,
}

impl Standstill {
    /// Whether both are at the same place.
    pub(super) fn is_at(&self, other: &Standstill) -> bool {
        self.at_m.distance(other.at_m) < SAME_PLACE_M
    }
}

impl fmt::Display for Standstill {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Standstill { time_s, at_m: Vec2 { x, y }, people, mean_speed_m_s, who } = self;
        let named: Vec<String> = who.iter().take(NAMED).map(|(name, count)| format!("{count} of \"{name}\"")).collect();
        let others = if who.len() > NAMED { ", others" } else { "" };
        write!(
            f,
            "at {time_s:.0} s people have hardly got on for a minute ({mean_speed_m_s:.2} m/s on average): {people} \
             wait around [{x:.1}, {y:.1}], {}{others}; let fewer come at once, or widen the way there",
            named.join(", ")
        )
    }
}

/// Watches the mean speed of a crowd.
#[derive(Debug, Default)]
pub(super) struct StandstillWatch {
    /// Since when the crowd has hardly got on, seconds.
    since_s: Option<f64>,
}

impl StandstillWatch {
    /// Notes who waits where if the crowd has hardly got on for long; each place once.
    ///
    /// Whoever stays at a stop or waits at a counter is left out: people stand there in any case.
    pub(super) fn look(
        &mut self,
        (step, time_step_s): (u64, f64),
        routes: &[Route],
        agents: &Agents,
        stops: &Stops,
        known: &mut Vec<Standstill>,
    ) {
        let every = (EVERY_S / time_step_s).round().max(1.0) as u64;
        if !step.is_multiple_of(every) {
            return;
        }
        let time_s = step as f64 * time_step_s;
        let walks = |slot: &usize| {
            let walk = &agents.walks[*slot];
            let gets_on = walk.visit.is_none_or(|target| stops.is_gate(&target));
            gets_on && !walk.led && !agents.is_onlooker(walk.id)
        };
        let speed_m_s = |slot: usize| agents.bodies[slot].velocity().length();
        let walking: Vec<usize> = (0..agents.walks.len()).filter(walks).collect();
        let mean_m_s = walking.iter().map(|&slot| speed_m_s(slot)).sum::<f64>() / walking.len().max(1) as f64;
        if walking.len() < LEAST_WALKING || mean_m_s >= SLOW_M_S {
            self.since_s = None;
            return;
        }
        if time_s - *self.since_s.get_or_insert(time_s) < SLOW_FOR_S {
            return;
        }
        let waiting = walking.into_iter().filter(|&slot| speed_m_s(slot) < SLOW_M_S).collect();
        for crowd in together(waiting, agents) {
            let place = |slot: &usize| agents.bodies[*slot].position();
            let is_known = |place_m: Vec2| known.iter().any(|other| other.at_m.distance(place_m) < SAME_PLACE_M);
            if crowd.len() < LEAST_WAITING || crowd.iter().map(place).any(is_known) {
                continue;
            }
            let middle = crowd.iter().map(place).fold(Vec2::ZERO, |sum, p| sum + p) / crowd.len() as f64;
            let distances = crowd.iter().map(place).map(|p| (p.distance(middle), p));
            let Some((_, at_m)) = distances.min_by(|a, b| a.0.total_cmp(&b.0)) else { continue };
            let mut who: BTreeMap<String, u64> = BTreeMap::new();
            for &slot in &crowd {
                let walk = &agents.walks[slot];
                let stop = walk.visit.and_then(|target| stops.name_of(&target));
                let route = routes.get(walk.route as usize).map(|route| route.name.clone());
                *who.entry(stop.or(route).unwrap_or_default()).or_default() += 1;
            }
            let mut who: Vec<(String, u64)> = who.into_iter().collect();
            who.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
            let people = crowd.len() as u64;
            known.push(Standstill { time_s, at_m, people, mean_speed_m_s: mean_m_s, who });
        }
    }
}

/// Divides people into crowds that stand apart, the largest first.
fn together(slots: Vec<usize>, agents: &Agents) -> Vec<Vec<usize>> {
    let mut cells: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
    for slot in slots {
        let p = agents.bodies[slot].position();
        cells.entry([p.x, p.y].map(|c| (c / CELL_M).floor() as i64)).or_default().push(slot);
    }
    let mut crowds = Vec::new();
    while let Some((first, people)) = cells.pop_first() {
        let (mut crowd, mut open) = (people, vec![first]);
        while let Some([x, y]) = open.pop() {
            for beside in (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y])) {
                if let Some(people) = cells.remove(&beside) {
                    crowd.extend(people);
                    open.push(beside);
                }
            }
        }
        crowd.sort_unstable_by_key(|&slot| agents.walks[slot].id);
        crowds.push(crowd);
    }
    crowds.sort_by_key(|crowd| std::cmp::Reverse(crowd.len()));
    crowds
}
