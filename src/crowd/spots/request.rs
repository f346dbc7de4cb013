use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::crowd::CrowdError;
use crate::crowd::environment::Environment;
use crate::math::{Vec2, sin_cos, vec2};
use crate::plan::PlanPoint;
use crate::units::{Areas, SpotFrame};

/// Least distance of a spot from walls, metres.
const LEAST_CLEARANCE_M: f64 = 0.2;
/// Radius within which a hint names the nearest floor, metres.
const HINT_REACH_M: f64 = 5.0;

/// A spot where a viewer stands and people nearby play units, as a scenario writes it.
///
/// Lengths in metres, times in seconds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpotRequest {
    /// Name; left out: by its number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Place of the viewer.
    pub at: PlanPoint,
    /// A point that the viewer looks at.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub facing: Option<PlanPoint>,
    /// Or the direction in which the viewer looks, degrees counter-clockwise from +x.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heading_deg: Option<f64>,
    /// Folder with own units; left out: the built-in ones.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub folder: Option<PathBuf>,
    /// Interval at which units are looked for, 0.05 to 60 s.
    #[serde(default = "every")]
    pub every: f64,
    /// Time for which those who have played a unit are left alone, 0 to 3600 s.
    #[serde(default = "pause")]
    pub pause: f64,
    /// Width and depth of the area in front in which people are counted.
    #[serde(default = "judged")]
    pub front: [f64; 2],
    /// Width and depth of the area behind in which people are counted.
    #[serde(default = "judged")]
    pub rear: [f64; 2],
    /// Width and depth of the area in front in which units are played; larger units are left out.
    #[serde(default = "played")]
    pub area: [f64; 2],
    /// Radius of the viewer's body, which people walk around, 0 to 2 m; 0 without a body.
    #[serde(default = "radius")]
    pub radius: f64,
    /// Whether units are played; if not, people there are only measured.
    #[serde(default = "play")]
    pub play: bool,
}

fn every() -> f64 {
    0.2
}

fn pause() -> f64 {
    1.0
}

fn judged() -> [f64; 2] {
    Areas::default().front_m
}

fn played() -> [f64; 2] {
    Areas::default().played_m
}

fn radius() -> f64 {
    0.25
}

fn play() -> bool {
    true
}

impl SpotRequest {
    /// A spot at a place with a viewer who looks in a direction, degrees; the rest by default.
    pub fn new(at: PlanPoint, heading_deg: f64) -> SpotRequest {
        SpotRequest {
            name: None,
            at,
            facing: None,
            heading_deg: Some(heading_deg),
            folder: None,
            every: every(),
            pause: pause(),
            front: judged(),
            rear: judged(),
            area: played(),
            radius: radius(),
            play: play(),
        }
    }

    /// Areas in which people are counted and units are played.
    pub fn areas(&self) -> Areas {
        Areas { front_m: self.front, rear_m: self.rear, played_m: self.area }
    }

    /// Checks every value; an error holds the key and the problem.
    ///
    /// # Errors
    /// The first value that is not finite, out of its range, or at odds with another.
    pub fn check(&self) -> Result<(), (&'static str, String)> {
        let [front_x, front_y] = self.front;
        let [rear_x, rear_y] = self.rear;
        let [area_x, area_y] = self.area;
        let numbers = [
            ("every", Some(self.every), 0.05, 60.0),
            ("pause", Some(self.pause), 0.0, 3600.0),
            ("heading_deg", self.heading_deg, -360.0, 360.0),
            ("front", Some(front_x), 0.5, 20.0),
            ("front", Some(front_y), 0.5, 20.0),
            ("rear", Some(rear_x), 0.0, 20.0),
            ("rear", Some(rear_y), 0.0, 20.0),
            ("area", Some(area_x), 1.0, 20.0),
            ("area", Some(area_y), 1.0, 40.0),
            ("radius", Some(self.radius), 0.0, 2.0),
        ];
        for (key, value, low, high) in numbers {
            if let Some(value) = value.filter(|value| !(*value >= low && *value <= high)) {
                return Err((key, format!("`{key}` is {value}, allowed is {low} to {high}")));
            }
        }
        match (&self.facing, self.heading_deg) {
            (Some(_), Some(_)) => Err(("heading_deg", "the unit's spot has both `facing` and `heading_deg`".into())),
            (None, None) => {
                Err(("at", "the direction in which the viewer looks is missing: give `facing` or `heading_deg`".into()))
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
        if let Err((_, problem)) = self.check() {
            return wrong(problem, "see [[unit]] in the scenario".to_string());
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
