//! What became of everybody.

use std::path::Path;

use super::spots::SpotReport;
use super::stops::StopTally;
use crate::math::Vec2;
use crate::routes::Route;

/// Of those who got stuck, so many are named one by one.
const NAMED: usize = 5;

/// What became of everybody.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// How many entered.
    pub entered: u64,
    /// How many reached their goal.
    pub arrived: u64,
    /// Who made no way any more and was taken out.
    pub stuck: Vec<Stuck>,
    /// What happened at each stop, in the order in which routes first name them.
    pub stops: Vec<StopTally>,
    /// How units were played at each spot.
    pub spots: Vec<SpotReport>,
}

impl Tally {
    /// Says who got stuck where, which picture shows it, and at which stops more people came than find room.
    pub fn describe(&self, routes: &[Route], picture: Option<&Path>) -> Vec<String> {
        let mut lines: Vec<String> = self.stuck.iter().take(NAMED).map(|stuck| stuck.describe(routes)).collect();
        if !self.stuck.is_empty() {
            let others = self.stuck.len().saturating_sub(NAMED);
            let others = if others > 0 { format!("{others} others got stuck too; ") } else { String::new() };
            let place = picture.map_or("the picture of --paths FILE".to_string(), |path| path.display().to_string());
            lines.push(format!("{others}{place} marks the places where people got stuck"));
        }
        lines.extend(self.stops.iter().filter_map(StopTally::warning));
        lines.extend(self.spots.iter().filter_map(SpotReport::warning));
        lines
    }
}

/// Somebody who made no way any more.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Stuck {
    /// Who.
    pub id: u32,
    /// Where, metres.
    pub place_m: Vec2,
    /// Index of the route.
    pub route: usize,
    /// Name of the stop where they were, or where they wanted to go.
    pub stop: Option<String>,
}

impl Stuck {
    /// Says who and where.
    pub fn describe(&self, routes: &[Route]) -> String {
        let route = routes.get(self.route).map_or("unknown", |route| &route.name);
        let stop = self.stop.as_ref().map_or(String::new(), |stop| format!(", for the stop \"{stop}\""));
        let Vec2 { x, y } = self.place_m;
        format!("person {} of route \"{route}\" got stuck at [{x:.2}, {y:.2}]{stop}", self.id)
    }
}
