use super::component_range::ComponentsError;
use super::expression::{Expression, ExpressionError};
use crate::motion::MotionError;
use crate::progress::Interrupted;

/// Why features cannot be worked on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FeaturesError {
    /// Too few people.
    #[error("{people} people are too few; at least {least} are needed")]
    TooFew {
        /// How many there are.
        people: usize,
        /// How many are needed.
        least: usize,
    },
    /// No motion in a single moment.
    #[error("a single moment has no motion; at least 2 are needed")]
    SingleMoment,
    /// A time throughout which no two people are there.
    #[error(
        "{people} of the people are there throughout, from {from_s:.2} to {to_s:.2} s; at least 2 are needed, at 2 moments"
    )]
    NotTogether {
        /// Start of the time, seconds.
        from_s: f64,
        /// Its end, seconds.
        to_s: f64,
        /// How many are there throughout.
        people: usize,
        /// The time within it when most are together for longest.
        longest_s: Option<[f64; 2]>,
    },
    /// More than can be decomposed in sensible time and memory.
    #[error("{people} people at {moments} moments are too many places; allowed are {most}")]
    TooMany {
        /// How many people.
        people: usize,
        /// How many moments.
        moments: usize,
        /// The most places, people times moments.
        most: usize,
    },
    /// A matrix too large to decompose.
    #[error("the matrix to decompose has {size} rows, allowed are {most}")]
    TooLarge {
        /// Its rows.
        size: usize,
        /// The most.
        most: usize,
    },
    /// A place that is none.
    #[error(
        "person {id} is at {x} {y} m at {time_s:.2} s, which is no place; allowed is up to {most_m} m from the origin"
    )]
    NoPlace {
        /// Who.
        id: u32,
        /// When, seconds.
        time_s: f64,
        /// Where, metres.
        x: f64,
        /// Where, metres.
        y: f64,
        /// The largest coordinate, metres.
        most_m: f64,
    },
    /// Nobody moves relative to the middle.
    #[error("nobody moves relative to the middle of the crowd, so there are no features")]
    Still,
    /// A distance out of range.
    #[error("people within {distance_m} m of each other as neighbours; allowed is {low} to {high} m")]
    NeighbourDistance {
        /// What was asked for, metres.
        distance_m: f64,
        /// Least allowed.
        low: f64,
        /// Most allowed.
        high: f64,
    },
    /// More components than there are.
    #[error("{asked} components; there are 1 to {most}")]
    Components {
        /// How many were asked for.
        asked: usize,
        /// How many there are.
        most: usize,
    },
    /// Which components are to change cannot be understood.
    #[error(transparent)]
    Which(#[from] ComponentsError),
    /// What is to become of them cannot be understood.
    #[error(transparent)]
    Expression(#[from] ExpressionError),
    /// An expression gives no number that a coefficient could have.
    #[error(
        "{expression} gives component {component} the coefficient {value} at t = {t_s:.3} s; allowed is up to {most_m} m"
    )]
    Coefficient {
        /// The expression.
        expression: Box<Expression>,
        /// The component, from 1 on.
        component: usize,
        /// When, seconds from the start.
        t_s: f64,
        /// What became of the coefficient, metres.
        value: f64,
        /// The largest allowed, metres.
        most_m: f64,
    },
    /// Two crowds that have nothing in common.
    #[error("the two crowds cannot be mixed: {0}")]
    Mix(&'static str),
    /// Eigenvectors that cannot be found.
    #[error("the eigenvectors of a matrix of {size} rows cannot be found")]
    NotConverged {
        /// Its rows.
        size: usize,
    },
    /// The motion cannot go on, or cannot be held.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The user stopped the work.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

impl FeaturesError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            FeaturesError::Motion(error) => error.hint(),
            FeaturesError::TooFew { .. } | FeaturesError::SingleMoment => {
                Some("choose another time with --from and --to".to_string())
            }
            FeaturesError::NotTogether { longest_s: Some([from_s, to_s]), .. } => {
                Some(format!("--from {from_s:.2} --to {to_s:.2} has the most people for longest"))
            }
            FeaturesError::NotTogether { .. } => Some("choose a longer time, or leave out --from and --to".to_string()),
            FeaturesError::TooMany { .. } => {
                Some("choose a shorter time, or fewer moments per second with --rate".to_string())
            }
            FeaturesError::TooLarge { .. } => {
                Some("choose a time when fewer people are there, or fewer moments".to_string())
            }
            FeaturesError::Still => Some("people who walk side by side at one speed only move the middle".to_string()),
            FeaturesError::Which(error) => error.hint(),
            FeaturesError::Expression(error) => error.hint(),
            FeaturesError::Coefficient { .. } => Some(
                "t is the time in seconds from the start; keep divisors from 0, and roots from negatives".to_string(),
            ),
            _ => None,
        }
    }
}
