use serde::{Deserialize, Serialize};

use super::CrowdError;
use super::social_force::{GroupOptions, SocialForceOptions};
use crate::math::Distribution;
use crate::motion::BodyOptions;
use crate::routes::Timetable;

/// More people than this are a mistake: the arrival list alone would take gigabytes.
const MOST_PEOPLE: u32 = 5_000_000;

/// Which model moves a crowd.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CrowdModel {
    /// Boids without cohesion: everybody walks alone. The model of the Grime paper, fast, for large crowds.
    #[default]
    Boids,
    /// Social forces, with groups of up to four who walk together.
    SocialForce,
}

/// How the people of a crowd walk. Speeds in metres per second, distances in metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CrowdOptions {
    /// Which model moves people.
    pub model: CrowdModel,
    /// How many people walk, 1 to 5 million.
    pub people: u32,
    /// Speed of a person with nobody around (Weidmann 1993: 1.34 +- 0.26).
    pub speed: Distribution,
    /// How speed falls with the density of people ahead.
    pub speed_law: SpeedLaw,
    /// Bodies' middles never come nearer to each other than this (mean of the two).
    pub exclusion: Distribution,
    /// People make way for others who would come nearer than this; it shrinks as density grows.
    pub acceptable: Distribution,
    /// A body's middle never comes nearer to a wall than this; it shrinks in gaps.
    pub wall_exclusion: Distribution,
    /// People keep this far off walls if they can; it shrinks in gaps.
    pub wall_acceptable: Distribution,
    /// How quickly people take up the line of those who go the same way, per second (alignment, Reynolds 1987).
    pub alignment: f64,
    /// The most people who enter in a second, per metre of opening.
    pub entry_rate: f64,
    /// Seconds over which people enter; left out, as many as [`CrowdOptions::entry_rate`] asks for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub entry_seconds: Option<f64>,
    /// When people come, unless their route has a timetable of its own.
    pub arrivals: Timetable,
    /// Whoever has made no way for so many seconds, while nobody else arrives either, is stuck.
    pub patience_seconds: f64,
    /// Time step, seconds.
    pub time_step: f64,
    /// Ends the walk after so many seconds, wherever people are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_seconds: Option<f64>,
    /// A period in x, metres: whoever leaves there comes back at the other end. For measuring speed against
    /// density in an endless corridor.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub period_x: Option<f64>,
    /// Who walks with whom, under social forces.
    pub groups: GroupOptions,
    /// How people push each other, under social forces.
    pub social_force: SocialForceOptions,
}

/// How the largest speed falls with the density of the people ahead.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SpeedLaw {
    /// `v0 (1 - rho / 4)`, the paper's "in proportion to the density".
    Linear,
    /// `v0 (1 - exp(-1.913 (1/rho - 1/5.4)))` (Weidmann 1993).
    #[default]
    Weidmann,
}

impl Default for CrowdOptions {
    fn default() -> CrowdOptions {
        CrowdOptions::commuters()
    }
}

impl CrowdOptions {
    /// People on their way through a station: free speed 1.34 +- 0.26 m/s.
    pub fn commuters() -> CrowdOptions {
        CrowdOptions {
            model: CrowdModel::Boids,
            people: 1000,
            speed: Distribution::normal(1.34, 0.26, 0.6, 2.1),
            speed_law: SpeedLaw::Weidmann,
            exclusion: Distribution::Uniform([0.28, 0.36]),
            acceptable: Distribution::Uniform([0.7, 1.1]),
            wall_exclusion: Distribution::Uniform([0.16, 0.24]),
            wall_acceptable: Distribution::Uniform([0.3, 0.65]),
            alignment: 0.6,
            entry_rate: 0.3,
            entry_seconds: None,
            arrivals: Timetable::default(),
            patience_seconds: 120.0,
            time_step: 0.1,
            end_seconds: None,
            period_x: None,
            groups: GroupOptions::default(),
            social_force: SocialForceOptions::default(),
        }
    }

    /// The experiment of the Grime paper (Takenaka, Tanaka, Sagawa): 2 to 3 m/s, exclusion distance 0.5 m,
    /// acceptable distance 0.5 to 1.5 m, of walls too.
    pub fn paper() -> CrowdOptions {
        CrowdOptions {
            speed: Distribution::Uniform([2.0, 3.0]),
            speed_law: SpeedLaw::Linear,
            exclusion: Distribution::Constant(0.5),
            acceptable: Distribution::Uniform([0.5, 1.5]),
            wall_exclusion: Distribution::Constant(0.5),
            wall_acceptable: Distribution::Uniform([0.5, 1.5]),
            ..CrowdOptions::commuters()
        }
    }

    /// The preset of this name: `commuters` or `paper`.
    pub fn preset(name: &str) -> Option<CrowdOptions> {
        match name {
            "commuters" => Some(CrowdOptions::commuters()),
            "paper" => Some(CrowdOptions::paper()),
            _ => None,
        }
    }

    /// The bodies that belong to the preset of this name: the paper's people have a stride of their own around 0.7 m.
    pub fn preset_bodies(name: &str) -> Option<BodyOptions> {
        match name {
            "commuters" => Some(BodyOptions::default()),
            "paper" => Some(BodyOptions {
                step_length: Some(Distribution::normal(0.7, 0.05, 0.55, 0.85)),
                ..BodyOptions::default()
            }),
            _ => None,
        }
    }

    /// Checks every value.
    ///
    /// # Errors
    /// The first value that is not a number or out of its range.
    pub fn check(&self) -> Result<(), CrowdError> {
        if self.people == 0 || self.people > MOST_PEOPLE {
            return Err(CrowdError::People { people: self.people, most: MOST_PEOPLE });
        }
        self.arrivals.check().map_err(|(key, problem)| CrowdError::Timetable { key, problem })?;
        let distributions = [
            ("speed", &self.speed, 0.1, 6.0),
            ("exclusion", &self.exclusion, 0.05, 1.5),
            ("acceptable", &self.acceptable, 0.05, 5.0),
            ("wall_exclusion", &self.wall_exclusion, 0.0, 2.0),
            ("wall_acceptable", &self.wall_acceptable, 0.0, 5.0),
        ];
        for (name, distribution, low, high) in distributions {
            distribution.check(low, high).map_err(|source| CrowdError::Distribution { name, source })?;
        }
        let numbers = [
            ("alignment", Some(self.alignment), 0.0, 5.0),
            ("entry_rate", Some(self.entry_rate), 1e-3, 1e3),
            ("entry_seconds", self.entry_seconds, 0.0, 1e6),
            ("patience_seconds", Some(self.patience_seconds), 5.0, 1e5),
            ("time_step", Some(self.time_step), 0.01, 0.2),
            ("end_seconds", self.end_seconds, 0.1, 1e7),
            ("period_x", self.period_x, 8.0, 1e5),
        ];
        for (name, value, low, high) in numbers {
            if let Some(value) = value.filter(|v| !(low..=high).contains(v)) {
                return Err(CrowdError::Number { name, value, low, high });
            }
        }
        self.groups.check()?;
        self.social_force.check()
    }
}
