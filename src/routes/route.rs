use super::{Gate, Place, RouteStop, Stop, Timetable, Via};

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
    /// Place where people vanish.
    pub goal: Place,
    /// Share of all people; the shares of all routes sum to 1.
    pub share: f64,
    /// Gates across the shortest path, in order. In halls and between pillars people also pass beside them.
    pub gates: Vec<Gate>,
    /// Length of the centre line, metres.
    pub length_m: f64,
}

impl Route {
    /// Stops of all routes, each once, in order of the routes.
    pub fn each_stop(routes: &[Route]) -> Vec<&Stop> {
        let mut each: Vec<&Stop> = Vec::new();
        for stop in routes.iter().flat_map(|route| &route.stops).map(|stop| &stop.stop) {
            if !each.iter().any(|known| known.name == stop.name) {
                each.push(stop);
            }
        }
        each
    }
}
