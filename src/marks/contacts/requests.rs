//! Doors and fixtures as a scenario writes them.

use serde::{Deserialize, Serialize};

use crate::options::{Kind, Leaf, Limits, OptionError, Options, Value, names, options};
use crate::plan::{DoorAt, DoorToOpen, LARGEST_COORDINATE, PlanPoint};

options! {
    /// A door as a scenario writes it. Lengths in metres.
    pub struct DoorRequest {
        /// What to call it.
        name: Option<String> = None, eg "\"office\"";
        /// Its middle, [x, y] in metres or { px = [x, y] }, or its two jambs; a door that the plan draws closed is opened.
        at: DoorAt = DoorAt::Point(PlanPoint::Metres([0.0; 2])), eg "[12.0, 4.5]", required true;
        /// Clear width, where `at` is the middle.
        width: f64 = 0.9, in 0.5..=6.0, unit "m";
        /// Height.
        height: f64 = crate::walls::DOOR_HEAD_M, in 1.8..=3.5, unit "m";
        /// A point near the jamb on which the leaf hangs: the handle is at the other; left out: either.
        hinge: Option<PlanPoint> = None, eg "[12.4, 4.5]";
        /// Height of the handle.
        handle: f64 = 1.0, in 0.6..=1.5, unit "m";
    }
}

/// Kind of fixture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FixtureKind {
    /// A light switch or a call button: finger tips around it.
    Switch,
    /// A handle, a rail, a lever: palms.
    Handle,
    /// A counter: hands on its edge, bags and toes against its front.
    Counter,
    /// A bench at a wall: heads and backs above it, heels below.
    Bench,
    /// A radiator: hands and hips that lean on it.
    Radiator,
    /// A bin: splashes and knocks around it.
    Bin,
    /// A vending or ticket machine: hands on its front, now and then a shoe.
    #[serde(alias = "vending machine")]
    Machine,
    /// Chairs along a wall: their backs rub a band.
    Chairs,
}

/// Position of a fixture, as a scenario writes it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "a point [x, y], or two of them: [[x0, y0], [x1, y1]]")]
pub enum FixtureAt {
    /// Its middle.
    Point(PlanPoint),
    /// Its two ends.
    Line([PlanPoint; 2]),
}

options! {
    /// A fixture as a scenario writes it. Lengths in metres.
    pub struct FixtureRequest {
        /// What to call it.
        name: Option<String> = None, eg "\"light switch\"";
        /// "switch", "handle", "counter", "bench", "radiator", "bin", "machine" or "chairs".
        kind: FixtureKind = FixtureKind::Switch, eg "\"switch\"", required true;
        /// Where it is at a wall: its middle, or its two ends [[x0, y0], [x1, y1]].
        at: FixtureAt = FixtureAt::Point(PlanPoint::Metres([0.0; 2])), eg "[12.8, 4.4]", required true;
        /// A point on the side from which it is reached: of a thin wall, it chooses the face.
        facing: Option<PlanPoint> = None, eg "[12.8, 6.0]";
        /// Width along the wall; left out: by the kind.
        width: Option<f64> = None, in 0.02..=20.0, unit "m", eg "0.1";
    }
}

impl Leaf for FixtureAt {
    fn takes() -> Kind {
        let line = Kind::List(Box::new(PlanPoint::kind()), Some(2));
        Kind::AnyOf("a point [x, y], or two of them: [[x0, y0], [x1, y1]]", vec![PlanPoint::kind(), line])
    }
}

names!(FixtureKind);

impl DoorRequest {
    /// The door as the plan is to have it.
    pub fn to_open(&self) -> DoorToOpen {
        DoorToOpen { at: self.at, width_m: self.width }
    }

    /// Checks every value.
    ///
    /// # Errors
    /// The first value out of its range.
    pub fn check(&self) -> Result<(), OptionError> {
        self.check_ranges()?;
        self.at.points().iter().try_for_each(|&point| check_point("at", point))?;
        self.hinge.map_or(Ok(()), |point| check_point("hinge", point))
    }
}

impl FixtureKind {
    /// Name in messages and scenarios.
    pub const fn name(self) -> &'static str {
        match self {
            FixtureKind::Switch => "switch",
            FixtureKind::Handle => "handle",
            FixtureKind::Counter => "counter",
            FixtureKind::Bench => "bench",
            FixtureKind::Radiator => "radiator",
            FixtureKind::Bin => "bin",
            FixtureKind::Machine => "machine",
            FixtureKind::Chairs => "chairs",
        }
    }

    /// Default width along the wall, metres.
    pub(super) const fn width_m(self) -> f64 {
        match self {
            FixtureKind::Switch => 0.08,
            FixtureKind::Handle => 0.15,
            FixtureKind::Counter => 1.2,
            FixtureKind::Bench => 1.5,
            FixtureKind::Radiator => 1.0,
            FixtureKind::Bin => 0.4,
            FixtureKind::Machine => 0.9,
            FixtureKind::Chairs => 1.8,
        }
    }
}

impl FixtureRequest {
    /// Checks every value.
    ///
    /// # Errors
    /// The first value that is out of its range or does not go with others.
    pub fn check(&self) -> Result<(), OptionError> {
        self.check_ranges()?;
        match self.at {
            FixtureAt::Point(point) => check_point("at", point)?,
            FixtureAt::Line([from, to]) => {
                check_point("at", from)?;
                check_point("at", to)?;
                if self.width.is_some() {
                    return Err(OptionError::unfit("width", "a fixture given by its two ends takes no `width`"));
                }
            }
        }
        self.facing.map_or(Ok(()), |point| check_point("facing", point))
    }
}

fn check_point(key: &str, point: PlanPoint) -> Result<(), OptionError> {
    let (PlanPoint::Metres(at) | PlanPoint::Pixels { px: at }) = point;
    let limits = Limits { low: -LARGEST_COORDINATE, high: LARGEST_COORDINATE, open: false };
    match at.into_iter().find(|&coordinate| !limits.hold(coordinate)) {
        Some(coordinate) => Err(OptionError::beyond(coordinate, limits).within(key)),
        None => Ok(()),
    }
}
