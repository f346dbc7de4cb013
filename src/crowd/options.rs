use serde::{Deserialize, Serialize};

use super::CrowdError;
use super::social_force::{GroupOptions, SocialForceOptions};
use crate::math::Distribution;
use crate::motion::BodyOptions;
use crate::routes::Timetable;

/// Largest number of people: a longer arrival list would take gigabytes.
const MOST_PEOPLE: u32 = 5_000_000;

/// Steering model of a crowd.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CrowdModel {
    /// Boids without cohesion: everybody walks alone. The model of the Grime paper, fast, for large crowds.
    #[default]
    Boids,
    /// Social forces, with groups of up to four who walk together.
    SocialForce,
}

/// Options of a crowd. Speeds in metres per second, distances in metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CrowdOptions {
    /// Steering model.
    pub model: CrowdModel,
    /// Number of people, 1 to 5 million.
    pub people: u32,
    /// Free speed of a person (Weidmann 1993: 1.34 +- 0.26).
    pub speed: Distribution,
    /// Fall of speed with the number of people per square metre ahead.
    pub speed_law: SpeedLaw,
    /// Exclusion distance: least distance of two bodies' middles (mean of the two).
    pub exclusion: Distribution,
    /// Acceptable distance, within which people make way for others; it shrinks in a dense crowd.
    pub acceptable: Distribution,
    /// Least distance of a body's middle from walls; it shrinks in gaps.
    pub wall_exclusion: Distribution,
    /// Distance from walls that people keep if they can; it shrinks in gaps.
    pub wall_acceptable: Distribution,
    /// Alignment with those who go the same way, per second (Reynolds 1987).
    pub alignment: f64,
    /// Largest flow through an opening, people per second and metre.
    pub entry_rate: f64,
    /// Seconds over which people enter; left out, by [`CrowdOptions::entry_rate`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub entry_seconds: Option<f64>,
    /// Timetable of people whose route has none of its own.
    pub arrivals: Timetable,
    /// Seconds without progress after which a person is stuck, if no others of the route arrive either.
    pub patience_seconds: f64,
    /// Time step, seconds.
    pub time_step: f64,
    /// Ends the walk after so many seconds, wherever people are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_seconds: Option<f64>,
    /// Period in x, metres: people who leave at one end come back at the other. For measuring speed against people per
    /// square metre in an endless corridor.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub period_x: Option<f64>,
    /// Groups of people who walk together, under social forces.
    pub groups: GroupOptions,
    /// Parameters of the social forces.
    pub social_force: SocialForceOptions,
}

/// Fall of the largest speed with the number of people per square metre ahead (rho).
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

    /// Finds the preset `commuters` or `paper`.
    pub fn preset(name: &str) -> Option<CrowdOptions> {
        match name {
            "commuters" => Some(CrowdOptions::commuters()),
            "paper" => Some(CrowdOptions::paper()),
            _ => None,
        }
    }

    /// Body options that belong to a preset: the paper's people have step lengths around 0.7 m.
    pub(crate) fn preset_bodies(name: &str) -> Option<BodyOptions> {
        match name {
            "commuters" => Some(BodyOptions::default()),
            "paper" => Some(BodyOptions {
                step_length: Some(Distribution::normal(0.7, 0.05, 0.55, 0.85)),
                ..BodyOptions::default()
            }),
            _ => None,
        }
    }

    /// Checks every value against its range.
    ///
    /// # Errors
    /// The first value that is not finite or out of its range.
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
