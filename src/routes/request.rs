use serde::{Deserialize, Serialize};

use super::{StopRequest, Timetable};
use crate::plan::PlanPoint;

/// Requested routes and stops; without routes, the default ones join the widest openings.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RoutesOptions {
    /// Requested routes; empty for the default routes.
    pub routes: Vec<RouteRequest>,
    /// Stops, which routes refer to by name.
    pub stops: Vec<StopRequest>,
}

/// A route in a scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RouteRequest {
    /// Name; default: from the names of its places.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Place where people appear.
    pub from: PlaceRequest,
    /// Place where people vanish.
    pub to: PlaceRequest,
    /// Via places and stops, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub via: Vec<ViaRequest>,
    /// Share of all people on this route, relative to the other routes' shares; at least 0.
    #[serde(default = "one")]
    pub share: f64,
    /// Timetable of its people; default: that of the whole crowd.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arrivals: Option<Timetable>,
}

fn one() -> f64 {
    1.0
}

/// A place in a scenario: an opening's name, a point, or an area.
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

/// A via place in a scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(
    untagged,
    expecting = "an opening's or a stop's name, a point [x, y], an area [[x0, y0], [x1, y1]], or { stop = \"name\", share = 0.2 }"
)]
pub enum ViaRequest {
    /// A stop for a share of the people; the others do not go there.
    Stop(SharedStop),
    /// A place to pass, or the name of a stop for all people.
    Place(PlaceRequest),
}

/// A stop of a route, and the share of people who stop.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SharedStop {
    /// The stop's name.
    pub stop: String,
    /// Share of the route's people who stop, 0 to 1.
    #[serde(default = "one")]
    pub share: f64,
}

impl ViaRequest {
    /// Name of the stop among `stops`, and the share who stop; `None` for a place to pass.
    pub fn stop<'s>(&'s self, stops: &[StopRequest]) -> Option<(&'s str, f64)> {
        match self {
            ViaRequest::Stop(SharedStop { stop, share }) => Some((stop, *share)),
            ViaRequest::Place(PlaceRequest::Opening(name)) if stops.iter().any(|stop| stop.name == *name) => {
                Some((name, 1.0))
            }
            ViaRequest::Place(_) => None,
        }
    }
}

impl From<PlaceRequest> for ViaRequest {
    fn from(place: PlaceRequest) -> ViaRequest {
        ViaRequest::Place(place)
    }
}

impl PlaceRequest {
    /// Name of the place, for messages.
    pub(super) fn describe(&self) -> String {
        match self {
            PlaceRequest::Opening(name) => name.clone(),
            PlaceRequest::Point(PlanPoint::Metres([x, y])) => format!("[{x}, {y}]"),
            PlaceRequest::Point(PlanPoint::Pixels { px: [x, y] }) => format!("px [{x}, {y}]"),
            PlaceRequest::Area([[x0, y0], [x1, y1]]) => format!("[[{x0}, {y0}], [{x1}, {y1}]]"),
        }
    }
}
