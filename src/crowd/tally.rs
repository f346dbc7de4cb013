//! Counts of people who entered, arrived and got stuck.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::capacity::Overload;
use super::spots::SpotReport;
use super::standstill::Standstill;
use super::stops::StopTally;
use crate::math::Vec2;
use crate::routes::Route;

/// Number of stuck people who are named one by one.
const NAMED: usize = 5;

/// Counts of people, stops and units of a simulation.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tally {
    /// Number of people who entered.
    pub entered: u64,
    /// Number of people who reached their goal.
    pub arrived: u64,
    /// People who got stuck and were taken out.
    pub stuck: Vec<Stuck>,
    /// Counts of visits stop by stop, in the order in which routes first name them.
    pub stops: Vec<StopTally>,
    /// Reports of the units played, spot by spot.
    pub spots: Vec<SpotReport>,
    /// Places to which more people come than can pass, as foreseen; those with the longest wait first.
    pub overloads: Vec<Overload>,
    /// Who waited where while the crowd hardly got on, each place once.
    pub standstills: Vec<Standstill>,
}

impl Tally {
    /// Adds the people of another day. Stops and spots stay those of the first, and what was foreseen.
    pub fn add(&mut self, other: Tally) {
        self.entered += other.entered;
        self.arrived += other.arrived;
        self.stuck.extend(other.stuck);
        if self.stops.is_empty() && self.spots.is_empty() {
            (self.stops, self.spots) = (other.stops, other.spots);
        }
        if self.overloads.is_empty() {
            self.overloads = other.overloads;
        }
        let new = |there: &Standstill| !self.standstills.iter().any(|known| known.is_at(there));
        self.standstills.extend(other.standstills.into_iter().filter(new).collect::<Vec<_>>());
    }

    /// Warnings: who got stuck where, which picture shows it, at which stops there was not enough room.
    pub fn describe(&self, routes: &[Route], picture: Option<&Path>) -> Vec<String> {
        let mut lines: Vec<String> = self.stuck.iter().take(NAMED).map(|stuck| stuck.describe(routes)).collect();
        if !self.stuck.is_empty() {
            let others = self.stuck.len().saturating_sub(NAMED);
            let others = if others > 0 { format!("{others} others got stuck too; ") } else { String::new() };
            let place = picture.map_or("the picture of the paths".to_string(), |path| path.display().to_string());
            lines.push(format!("{others}{place} marks the places where people got stuck"));
        }
        lines.extend(self.stops.iter().filter_map(StopTally::warning));
        lines.extend(self.spots.iter().filter_map(SpotReport::warning));
        lines
    }
}

/// A person who got stuck: no progress for longer than the patience.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stuck {
    /// Number of the person.
    pub id: u32,
    /// Place, metres.
    pub place_m: Vec2,
    /// Index of the route.
    pub route: usize,
    /// Name of the stop where the person was, or was going.
    pub stop: Option<String>,
}

impl Stuck {
    /// Message: person, route, place, stop.
    pub fn describe(&self, routes: &[Route]) -> String {
        let route = routes.get(self.route).map_or("unknown", |route| &route.name);
        let stop = self.stop.as_ref().map_or(String::new(), |stop| format!(", for the stop \"{stop}\""));
        let Vec2 { x, y } = self.place_m;
        format!("person {} of route \"{route}\" got stuck at [{x:.2}, {y:.2}]{stop}", self.id)
    }
}
