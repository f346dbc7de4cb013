use serde::{Deserialize, Serialize};

use super::CrowdError;
use super::social_force::{GroupOptions, SocialForceOptions};
use crate::math::Distribution;
use crate::motion::BodyOptions;
use crate::options::{OptionError, Options, names, options};
use crate::routes::Timetable;

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

options! {
    /// Options of a crowd. Speeds in metres per second, distances in metres.
    pub struct CrowdOptions {
        /// What moves people: "boids", or "social-force" with groups of up to four.
        model: CrowdModel = CrowdModel::Boids;
        /// How many people walk.
        ///
        /// Their arrivals are one list, which would take gigabytes for more.
        people: u32 = 1000, in 1.0..=5e6;
        /// With nobody around.
        ///
        /// Free speed of a person (Weidmann 1993: 1.34 +- 0.26).
        speed: Distribution = Distribution::normal(1.34, 0.26, 0.6, 2.1), in 0.1..=6.0, unit "m/s";
        /// How density slows people down: "weidmann" or "linear".
        speed_law: SpeedLaw = SpeedLaw::Weidmann;
        /// Bodies' middles never come nearer to each other.
        ///
        /// Of two people the mean of both counts.
        exclusion: Distribution = Distribution::Uniform([0.28, 0.36]), in 0.05..=1.5, unit "m";
        /// People make way before they come so near; shrinks with density.
        acceptable: Distribution = Distribution::Uniform([0.7, 1.1]), in 0.05..=5.0, unit "m";
        /// The same for walls; shrinks in gaps.
        wall_exclusion: Distribution = Distribution::Uniform([0.16, 0.24]), in 0.0..=2.0, unit "m";
        /// People keep this far off walls if they can; shrinks in gaps.
        wall_acceptable: Distribution = Distribution::Uniform([0.3, 0.65]), in 0.0..=5.0, unit "m";
        /// How quickly people take up the line of those who go their way, per second.
        ///
        /// Alignment as in Reynolds 1987.
        alignment: f64 = 0.6, in 0.0..=5.0;
        /// The most who enter in a second, per metre of opening.
        entry_rate: f64 = 0.3, in 1e-3..=1e3;
        /// Seconds over which people enter; left out: by the rate.
        entry_seconds: Option<f64> = None, in 0.0..=1e6, eg "600.0";
        /// Timetable of people whose route has none of its own.
        arrivals: Timetable = Timetable::default();
        /// Who makes no way for so long is stuck.
        patience_seconds: f64 = 120.0, in 5.0..=1e5;
        /// Of the simulation.
        time_step: f64 = 0.1, in 0.01..=0.2, unit "s";
        /// Ends the walk, wherever people are.
        end_seconds: Option<f64> = None, in 0.1..=1e7, eg "3600.0";
        /// Who leaves in x comes back at the other end; for measurements.
        period_x: Option<f64> = None, in 8.0..=1e5, unit "m", eg "26.0";
        /// Groups of people who walk together, under social forces.
        groups: GroupOptions = GroupOptions::default();
        /// Parameters of the social forces.
        social_force: SocialForceOptions = SocialForceOptions::default();
    }
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

names!(CrowdModel, SpeedLaw);

impl CrowdOptions {
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
            ..CrowdOptions::default()
        }
    }

    /// Finds the preset `commuters` or `paper`.
    pub fn preset(name: &str) -> Option<CrowdOptions> {
        match name {
            "commuters" => Some(CrowdOptions::default()),
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
    /// The first value that is not finite, out of its range, or does not go with others.
    pub fn check(&self) -> Result<(), CrowdError> {
        let check = || {
            self.check_ranges()?;
            self.arrivals.check().map_err(|error| error.within("arrivals"))?;
            match self.groups.shares.iter().sum::<f64>() > 0.0 {
                true => Ok(()),
                false => {
                    Err(OptionError::unfit("groups.shares", "the shares together are 0: one at least must be above 0"))
                }
            }
        };
        check().map_err(|error: OptionError| CrowdError::Option(error.within("crowd")))
    }
}
