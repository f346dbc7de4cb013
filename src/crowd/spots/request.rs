use std::path::PathBuf;

use crate::crowd::CrowdError;
use crate::crowd::environment::Environment;
use crate::math::{Vec2, sin_cos, vec2};
use crate::options::{OptionError, Options, options};
use crate::plan::PlanPoint;
use crate::units::{Areas, SpotFrame};

/// Least distance of a spot from walls, metres.
const LEAST_CLEARANCE_M: f64 = 0.2;
/// Radius within which a hint names the nearest floor, metres.
const HINT_REACH_M: f64 = 5.0;

options! {
    /// A spot where a viewer stands and people nearby play units, as a scenario writes it.
    ///
    /// Lengths in metres, times in seconds.
    pub struct SpotRequest {
        /// What the report calls the spot.
        name: Option<String> = None, eg "\"kiosk\"";
        /// Where the viewer stands: [x, y] in metres or { px = [x, y] }.
        at: PlanPoint = PlanPoint::Metres([0.0; 2]), eg "[12.0, 4.5]", required true;
        /// A point that the viewer looks at.
        facing: Option<PlanPoint> = None, eg "[12.0, 9.0]";
        /// Or the direction.
        heading_deg: Option<f64> = None, in -360.0..=360.0, unit "degrees counter-clockwise from +x", eg "90.0";
        /// A folder with own units, relative to this file; left out: the built-in ones.
        folder: Option<PathBuf> = None, eg "\"units\"";
        /// How often the people there are looked at.
        every: f64 = 0.2, in 0.05..=60.0, unit "s";
        /// How long those who have played are left alone.
        pause: f64 = 1.0, in 0.0..=3600.0, unit "s";
        /// Width and depth of the area in front in which people are counted.
        front: [f64; 2] = Areas::default().front_m, in 0.5..=20.0, unit "m", eg "[3.0, 3.0]";
        /// The same behind the viewer.
        rear: [f64; 2] = Areas::default().rear_m, in 0.0..=20.0, unit "m", eg "[3.0, 3.0]";
        /// Width and depth of the area in front in which units are played.
        area: [f64; 2] = Areas::default().played_m, in 1.0..=40.0, unit "m", eg "[3.0, 7.0]";
        /// Of the viewer's body, which people walk around; 0: nobody stands there.
        radius: f64 = 0.25, in 0.0..=2.0, unit "m";
        /// Whether units are played; if not, people there are only measured.
        play: bool = true;
    }
}

impl SpotRequest {
    /// A spot at a place with a viewer who looks in a direction, degrees; the rest by default.
    pub fn new(at: PlanPoint, heading_deg: f64) -> SpotRequest {
        SpotRequest { at, heading_deg: Some(heading_deg), ..SpotRequest::default() }
    }

    /// Areas in which people are counted and units are played.
    pub fn areas(&self) -> Areas {
        Areas { front_m: self.front, rear_m: self.rear, played_m: self.area }
    }

    /// Checks every value.
    ///
    /// # Errors
    /// The first value that is not finite, out of its range, or at odds with another.
    pub fn check(&self) -> Result<(), OptionError> {
        self.check_ranges()?;
        match (&self.facing, self.heading_deg) {
            (Some(_), Some(_)) => {
                Err(OptionError::unfit("heading_deg", "the unit's spot has both `facing` and `heading_deg`"))
            }
            (None, None) => {
                let problem = "the direction in which the viewer looks is missing: give `facing` or `heading_deg`";
                Err(OptionError::unfit("at", problem))
            }
            _ => Ok(()),
        }
    }

    /// Name of the `index`-th spot in messages and the report.
    pub(super) fn title(&self, index: usize) -> String {
        self.name.clone().unwrap_or_else(|| format!("spot {}", index + 1))
    }

    /// Finds the spot on the floor.
    pub(super) fn resolve(&self, index: usize, environment: &Environment<'_>) -> Result<SpotFrame, CrowdError> {
        let (plan, walls, ground) = (environment.plan, environment.walls, environment.ground());
        let at_m = self.at.to_m(plan);
        let wrong = |problem: String, hint: String| {
            Err(CrowdError::Spot { spot: self.title(index), x: at_m.x, y: at_m.y, problem, hint })
        };
        if let Err(error) = self.check() {
            return wrong(error.problem(), "see [[unit]] in the scenario".to_string());
        }
        let clearance_m = walls.nearest(at_m, 1.0).map_or(1.0, |nearest| nearest.distance_m);
        if !at_m.is_finite() || !walls.is_inside(at_m) || clearance_m < LEAST_CLEARANCE_M {
            let near = ground.walkable_near(at_m, HINT_REACH_M).map(|cell| ground.lattice.centre(cell));
            let hint = match near {
                Some(Vec2 { x, y }) => format!("the nearest floor to stand on is at [{x:.2}, {y:.2}]"),
                None => format!("there is no floor to stand on within {HINT_REACH_M} m: choose another `at`"),
            };
            let problem = match at_m.is_finite() && walls.is_inside(at_m) {
                true => format!("is {clearance_m:.2} m from a wall, needed are at least {LEAST_CLEARANCE_M} m"),
                false => "lies in a wall or off the floor".to_string(),
            };
            return wrong(problem, hint);
        }
        let ahead = match (&self.facing, self.heading_deg) {
            (Some(point), _) => (point.to_m(plan) - at_m).normalized(),
            (None, degrees) => {
                let (sin, cos) = sin_cos(degrees.unwrap_or_default().to_radians());
                Some(vec2(cos, sin))
            }
        };
        match ahead.filter(|ahead| ahead.is_finite()) {
            Some(ahead) => Ok(SpotFrame { at_m, ahead }),
            None => wrong("looks at its own place".to_string(), "let `facing` be another point".to_string()),
        }
    }
}
