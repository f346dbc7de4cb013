use super::{Gate, Place, RouteStop, Stop, Timetable, Via};

/// A route from a start to a goal.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Route {
    /// What the scenario or the program calls it, such as `west to north`.
    pub name: String,
    /// Where people appear.
    pub start: Place,
    /// Places to pass on the way, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub via: Vec<Via>,
    /// Places where some of the people stop, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stops: Vec<RouteStop>,
    /// When people come, if the route has a timetable of its own.
    #[serde(default, skip_serializing_if = "Option::is_none", with = "crate::options::kept")]
    pub arrivals: Option<Timetable>,
    /// Where they vanish.
    pub goal: Place,
    /// Which share of all people takes it; the shares of all routes sum up to 1.
    pub share: f64,
    /// Gates across the shortest way, in order; in halls and between pillars people also pass beside them.
    pub gates: Vec<Gate>,
    /// Length of the middle line, metres.
    pub length_m: f64,
}

impl Route {
    /// Stops of all routes, each once, in the order of the routes.
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
