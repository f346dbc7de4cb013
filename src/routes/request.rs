use serde::{Deserialize, Serialize};

use super::{StopRequest, Timetable};
use crate::options::{Field, Kind, Leaf, Table, Value, options};
use crate::plan::PlanPoint;
use crate::rooms::{LifeOptions, RoomRequest};

options! {
    /// Requested routes and stops. Without any route, people use the rooms of the building; a single space they cross.
    pub struct RoutesOptions {
        /// Requested routes; empty for the default routes.
        routes: Vec<RouteRequest> = Vec::new();
        /// Places where people may stop; routes name them.
        stops: Vec<StopRequest> = Vec::new();
        /// How people use the building's rooms, where no routes are written or beside them.
        life: LifeOptions = LifeOptions::default();
        /// What the scenario says about rooms.
        rooms: Vec<RoomRequest> = Vec::new();
    }
}

options! {
    /// A route as a scenario writes it.
    pub struct RouteRequest {
        /// What to call it.
        name: Option<String> = None, eg "\"west to north\"";
        /// An opening's name, [x, y] in metres, { px = [x, y] }, or an area [[x0, y0], [x1, y1]].
        from: PlaceRequest = PlaceRequest::Opening(String::new()), eg "\"west\"", required true;
        /// As from.
        to: PlaceRequest = PlaceRequest::Opening(String::new()), eg "\"north\"", required true;
        /// Places to pass (each as from) and stops, in order; of a stop its name, or which share stops there.
        via: Vec<ViaRequest> = Vec::new(), eg "[\"ticket office\", { stop = \"bench\", share = 0.2 }]";
        /// How many take it, relative to the other routes.
        share: f64 = 1.0, in 1e-6..=1e6;
        /// When its people come, as [crowd.arrivals]; left out: as all others.
        arrivals: Option<Timetable> = None, eg "{ kind = \"bursts\", every_s = 360, people = 120, spread_s = 45 }";
    }
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
    #[serde(default = "everybody")]
    pub share: f64,
}

fn everybody() -> f64 {
    1.0
}

impl Leaf for PlaceRequest {
    fn takes() -> Kind {
        let area = Kind::List(Box::new(<[f64; 2]>::kind()), Some(2));
        let words = "an opening's name, a point [x, y], or an area [[x0, y0], [x1, y1]]";
        Kind::AnyOf(words, vec![Kind::Text, PlanPoint::kind(), area])
    }
}

impl SharedStop {
    const KEYS: Table = Table {
        name: "SharedStop",
        parts: &[&[Field::plain("stop", String::kind, true), Field::plain("share", f64::kind, false)]],
    };
}

impl Leaf for ViaRequest {
    fn takes() -> Kind {
        let words = "an opening's or a stop's name, a point [x, y], an area [[x0, y0], [x1, y1]], or \
                     { stop = \"name\", share = 0.2 }";
        Kind::AnyOf(words, vec![Kind::Table(SharedStop::KEYS), PlaceRequest::kind()])
    }
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
