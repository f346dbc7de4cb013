use super::legs::{LegEnd, leg_ends};
use super::{Place, RouteLife, RouteStop, Timetable};

/// A route with its places, before its path is found.
#[derive(Clone, Debug)]
pub(super) struct RouteDraft {
    pub(super) name: String,
    /// Names of start, via places and goal, for messages.
    pub(super) place_names: Vec<String>,
    pub(super) start: Place,
    pub(super) via: Vec<Place>,
    pub(super) stops: Vec<RouteStop>,
    pub(super) arrivals: Option<Timetable>,
    pub(super) life: Option<RouteLife>,
    pub(super) goal: Place,
    pub(super) share: f64,
}

impl RouteDraft {
    pub(super) fn legs(&self) -> impl Iterator<Item = LegEnd> {
        leg_ends(self.via.iter().copied(), self.goal)
    }
}
