use super::{Gate, Place, RouteStop, Stop, Timetable, Via};
use crate::rooms::Use;

/// Usual speed of people, metres per second, for estimates before anybody walks.
pub(crate) const USUAL_M_S: f64 = 1.25;

/// A route from a start to a goal.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Route {
    /// Name, from the scenario or the places, such as `west to north`.
    pub name: String,
    /// Place where people appear.
    pub start: Place,
    /// Via places, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub via: Vec<Via>,
    /// Stops, in order, with the share of people who stop.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stops: Vec<RouteStop>,
    /// When people come, if the route has a timetable of its own.
    #[serde(default, skip_serializing_if = "Option::is_none", with = "crate::options::kept")]
    pub arrivals: Option<Timetable>,
    /// For routes of people who live in the building, when no routes are written.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub life: Option<RouteLife>,
    /// Place where people vanish.
    pub goal: Place,
    /// Share of all people; the shares of all routes sum to 1.
    pub share: f64,
    /// Gates across the shortest path, in order. In halls and between pillars people also pass beside them.
    pub gates: Vec<Gate>,
    /// Length of the centre line, metres.
    pub length_m: f64,
}

/// What people of a default route do in the building.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct RouteLife {
    /// What the building is for.
    pub r#use: Use,
    /// Whether they come in from outside.
    pub from_outside: bool,
}

impl Route {
    /// Whether people come in from outside: through an opening or a door, rather than from a room.
    pub(crate) fn is_from_outside(&self) -> bool {
        matches!(self.start, Place::Opening(_)) || self.life.is_some_and(|life| life.from_outside)
    }

    /// Mean time that a person takes who walks one of these routes, without delays, seconds.
    pub(crate) fn mean_seconds(routes: &[Route]) -> f64 {
        let stays_s = |route: &Route| route.stops.iter().map(|on| on.share * on.stop.dwell_s.mean()).sum::<f64>();
        routes.iter().map(|route| route.share * (route.length_m / USUAL_M_S + stays_s(route))).sum()
    }

    /// Stops of all routes, each once, in order of the routes.
    pub fn each_stop(routes: &[Route]) -> Vec<&Stop> {
        Route::first_of_each_stop(routes).into_iter().map(|(_, first)| &first.stop).collect()
    }

    /// The same, as the first route has each that stops there, with the number of that route.
    pub(super) fn first_of_each_stop(routes: &[Route]) -> Vec<(usize, &RouteStop)> {
        let mut each: Vec<(usize, &RouteStop)> = Vec::new();
        for (number, route) in routes.iter().enumerate() {
            for on_route in &route.stops {
                if !each.iter().any(|(_, known)| known.stop.name == on_route.stop.name) {
                    each.push((number, on_route));
                }
            }
        }
        each
    }
}
