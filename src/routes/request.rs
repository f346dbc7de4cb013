use serde::{Deserialize, Serialize};

use crate::plan::PlanPoint;

/// Which ways people take. Without any request, routes run between the widest openings.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RoutesOptions {
    /// What is asked for; empty for the default routes.
    pub routes: Vec<RouteRequest>,
}

/// A route as a scenario writes it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RouteRequest {
    /// What to call it; made of the places if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Where people appear.
    pub from: PlaceRequest,
    /// Where they go.
    pub to: PlaceRequest,
    /// Places to pass on the way, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub via: Vec<PlaceRequest>,
    /// How many people take it, relative to the other routes' shares.
    #[serde(default = "one")]
    pub share: f64,
}

fn one() -> f64 {
    1.0
}

/// A place as a scenario writes it: an opening's name, a point, or an area.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "an opening's name, a point [x, y], or an area [[x0, y0], [x1, y1]]")]
pub enum PlaceRequest {
    /// Name of an opening, such as `west` or `north 2`.
    Opening(String),
    /// A point on the floor; people appear, pass or vanish within about a metre.
    Point(PlanPoint),
    /// A rectangle by two opposite corners, metres.
    Area([[f64; 2]; 2]),
}

impl PlaceRequest {
    /// How messages call it.
    pub(super) fn describe(&self) -> String {
        match self {
            PlaceRequest::Opening(name) => name.clone(),
            PlaceRequest::Point(PlanPoint::Metres([x, y])) => format!("[{x}, {y}]"),
            PlaceRequest::Point(PlanPoint::Pixels { px: [x, y] }) => format!("px [{x}, {y}]"),
            PlaceRequest::Area([[x0, y0], [x1, y1]]) => format!("[[{x0}, {y0}], [{x1}, {y1}]]"),
        }
    }
}
