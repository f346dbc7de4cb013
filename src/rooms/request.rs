use super::find::Rooms;
use super::kind::RoomKind;
use super::uses::Use;
use crate::math::Distribution;
use crate::options::options;
use crate::plan::{FloorPlan, PlanPoint};

options! {
    /// How people use a building: what [`Use`] it has, and whether they do beside written routes.
    pub struct LifeOptions {
        /// "office", "school", "station", "shop", "museum", "hospital", "home" or "hall"; left out: guessed from the plan.
        r#use: Option<Use> = None, eg "\"office\"";
        /// Share of people who use the rooms where routes are written too; without routes all do.
        share: f64 = 0.0, in 0.0..=1.0;
        /// Factor on all lengths of stays.
        stay: f64 = 1.0, in 0.0..=100.0;
        /// Whether rooms have the floors that are usual in such a building, where the look has no floor of its own.
        floors: bool = true;
    } with {
        /// How many people there will be: with few, each visits more rooms, so that all are used.
        people: u32 = 1000;
    }
}

options! {
    /// What a scenario says about a room.
    pub struct RoomRequest {
        /// Which room, as `trodden inspect` lists it; with `at`: what to call it.
        name: Option<String> = None, eg "\"room 3\"";
        /// Or a point in it.
        at: Option<PlanPoint> = None, eg "[12.0, 4.5]";
        /// What it is: "room", "corridor", "hall", "toilet" or "stairs".
        kind: Option<RoomKind> = None, eg "\"toilet\"";
        /// How many go there, relative to rooms of its kind and size; 0: nobody goes there.
        weight: Option<f64> = None, in 0.0..=1000.0, eg "2.0";
        /// How long one stays.
        stay: Option<Distribution> = None, in 0.0..=86400.0, unit "s", eg "{ mean = 60, sd = 20 }";
    }
}

/// A request that fits no room.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum UnfitRoom {
    /// No room has this name.
    Unknown(String),
    /// No room lies at this place, pixels of the plan.
    Nowhere([f64; 2]),
    /// Neither a name nor a place.
    Neither,
}

impl Rooms {
    /// Changes rooms as a scenario says.
    pub(crate) fn say(&mut self, plan: &FloorPlan, requests: &[RoomRequest]) -> Result<(), UnfitRoom> {
        // Names are those of the plan until all rooms are found.
        let find = |request: &RoomRequest| match (&request.name, request.at) {
            (_, Some(at)) => {
                let p = at.to_m(plan);
                self.at(p).ok_or_else(|| UnfitRoom::Nowhere(plan.m_to_px(p)))
            }
            (Some(name), None) => {
                let same = |room: &super::Room| room.name.eq_ignore_ascii_case(name.trim());
                self.rooms.iter().position(same).ok_or_else(|| UnfitRoom::Unknown(name.clone()))
            }
            (None, None) => Err(UnfitRoom::Neither),
        };
        let found: Vec<usize> = requests.iter().map(find).collect::<Result<_, _>>()?;
        for (request, index) in requests.iter().zip(found) {
            let room = &mut self.rooms[index];
            if let (Some(name), Some(_)) = (&request.name, request.at) {
                room.name.clone_from(name);
            }
            room.kind = request.kind.unwrap_or(room.kind);
            room.said.weight = request.weight.or(room.said.weight);
            room.said.stay_s = request.stay.or(room.said.stay_s);
        }
        Ok(())
    }
}
