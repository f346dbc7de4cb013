//! Doors and fixtures as a scenario writes them.

use serde::{Deserialize, Serialize};

use crate::plan::{LARGEST_COORDINATE, PlanPoint};

/// Range of a door's clear width in a scenario, metres.
const WIDTHS_M: [f64; 2] = [0.5, 6.0];
/// Range of a door's height in a scenario, metres.
const HEIGHTS_M: [f64; 2] = [1.8, 3.5];

/// A door as a scenario writes it. Lengths in metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DoorRequest {
    /// Name in messages.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Middle of the clear width.
    pub at: PlanPoint,
    /// Clear width, metres, 0.5 to 6.
    #[serde(default = "usual_width")]
    pub width: f64,
    /// Height, metres, 1.8 to 3.5.
    #[serde(default = "usual_height")]
    pub height: f64,
    /// A point near the hinge jamb; the handle is at the other. `None` for either.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hinge: Option<PlanPoint>,
    /// Height of the handle, metres, 0.6 to 1.5.
    #[serde(default = "usual_handle")]
    pub handle: f64,
}

fn usual_width() -> f64 {
    0.9
}

fn usual_height() -> f64 {
    crate::walls::DOOR_HEAD_M
}

fn usual_handle() -> f64 {
    1.0
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

/// A fixture as a scenario writes it. Lengths in metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FixtureRequest {
    /// Name in messages.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Kind of fixture.
    pub kind: FixtureKind,
    /// Position; people touch the nearest wall within 1.5 m.
    pub at: FixtureAt,
    /// A point on the side of its users, which selects the face of a thin wall.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub facing: Option<PlanPoint>,
    /// Width along the wall of a fixture given by its middle, metres, 0.02 to 20; default by kind.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
}

/// An invalid key and its problem.
type Problem = (&'static str, String);

impl DoorRequest {
    /// Checks every value.
    ///
    /// # Errors
    /// The first key whose value is out of range, with the problem.
    pub fn check(&self) -> Result<(), Problem> {
        check_point("at", self.at)?;
        check_number("width", self.width, WIDTHS_M)?;
        check_number("height", self.height, HEIGHTS_M)?;
        check_number("handle", self.handle, [0.6, 1.5])?;
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
    /// The first key whose value is out of range, with the problem.
    pub fn check(&self) -> Result<(), Problem> {
        match self.at {
            FixtureAt::Point(point) => check_point("at", point)?,
            FixtureAt::Line([from, to]) => {
                check_point("at", from)?;
                check_point("at", to)?;
                if self.width.is_some() {
                    return Err(("width", "a fixture given by its two ends takes no `width`".into()));
                }
            }
        }
        if let Some(width) = self.width {
            check_number("width", width, [0.02, 20.0])?;
        }
        self.facing.map_or(Ok(()), |point| check_point("facing", point))
    }
}

fn check_number(key: &'static str, value: f64, [low, high]: [f64; 2]) -> Result<(), Problem> {
    // Written so that NaN is out of range.
    if value >= low && value <= high {
        Ok(())
    } else {
        Err((key, format!("`{key}` is {value}, allowed is {low} to {high}")))
    }
}

fn check_point(key: &'static str, point: PlanPoint) -> Result<(), Problem> {
    let [x, y] = match point {
        PlanPoint::Metres(at) | PlanPoint::Pixels { px: at } => at,
    };
    [x, y]
        .into_iter()
        .try_for_each(|coordinate| check_number(key, coordinate, [-LARGEST_COORDINATE, LARGEST_COORDINATE]))
}
