use super::component_range::ComponentsError;
use super::expression::{Expression, ExpressionError};
use crate::math::NoConvergence;
use crate::motion::MotionError;
use crate::progress::Interrupted;

/// Errors of motion features.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FeaturesError {
    /// Too few people.
    #[error("{people} people are too few; at least {least} are needed")]
    TooFew {
        /// People present.
        people: usize,
        /// Least number needed.
        least: usize,
    },
    /// A motion of a single frame.
    #[error("a single frame has no motion; at least 2 are needed")]
    SingleMoment,
    /// A time span without two people who are present throughout.
    #[error(
        "{people} people are present throughout, from {from_s:.2} to {to_s:.2} s; at least 2 are needed, in 2 frames"
    )]
    NotTogether {
        /// Start of the time span, seconds.
        from_s: f64,
        /// End of the time span, seconds.
        to_s: f64,
        /// People present throughout.
        people: usize,
        /// The time span within it with the most positions, seconds.
        longest_s: Option<[f64; 2]>,
    },
    /// More positions than can be decomposed.
    #[error("{people} people in {moments} frames are too many positions; allowed are {most}")]
    TooMany {
        /// Number of people.
        people: usize,
        /// Number of frames.
        moments: usize,
        /// Largest number of positions, people times frames.
        most: usize,
    },
    /// A matrix that is too large to decompose.
    #[error("the matrix to decompose has {size} rows, allowed are {most}")]
    TooLarge {
        /// Rows of the matrix.
        size: usize,
        /// Largest number of rows.
        most: usize,
    },
    /// A position out of range.
    #[error("person {id} is at ({x}, {y}) m at {time_s:.2} s; coordinates up to {most_m} m are allowed")]
    NoPlace {
        /// The person's id.
        id: u32,
        /// Time of the frame, seconds.
        time_s: f64,
        /// The coordinate x, metres.
        x: f64,
        /// The coordinate y, metres.
        y: f64,
        /// The largest coordinate, metres.
        most_m: f64,
    },
    /// A crowd whose people do not move relative to its centroid.
    #[error("the people do not move relative to the centroid of the crowd, so there are no features")]
    Still,
    /// A neighbour distance out of range.
    #[error("the neighbour distance is {distance_m} m; allowed is {low} to {high} m")]
    NeighbourDistance {
        /// The distance, metres.
        distance_m: f64,
        /// Least distance, metres.
        low: f64,
        /// Largest distance, metres.
        high: f64,
    },
    /// A number of components out of range.
    #[error("{asked} components; there are 1 to {most}")]
    Components {
        /// The number given.
        asked: usize,
        /// Number of components found.
        most: usize,
    },
    /// A malformed range of components.
    #[error(transparent)]
    Which(#[from] ComponentsError),
    /// A malformed expression.
    #[error(transparent)]
    Expression(#[from] ExpressionError),
    /// A coefficient that an expression sets out of range.
    #[error(
        "{expression} gives component {component} the coefficient {value} at t = {t_s:.3} s; allowed is up to {most_m} m"
    )]
    Coefficient {
        /// The expression.
        expression: Box<Expression>,
        /// Number of the component, from 1.
        component: usize,
        /// Time since the start, seconds.
        t_s: f64,
        /// The coefficient, metres.
        value: f64,
        /// Largest coefficient, metres.
        most_m: f64,
    },
    /// Two crowds that cannot be mixed.
    #[error("the two crowds cannot be mixed: {problem}")]
    Mix {
        /// Why not.
        problem: &'static str,
    },
    /// An eigenvector iteration that does not converge.
    #[error(transparent)]
    NoConvergence(#[from] NoConvergence),
    /// An error of the motion.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The user stopped the calculation.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

impl FeaturesError {
    /// A remedy that the user can try.
    pub fn hint(&self) -> Option<String> {
        match self {
            FeaturesError::Motion(error) => error.hint(),
            FeaturesError::TooFew { .. } | FeaturesError::SingleMoment => Some("choose another time span".to_string()),
            FeaturesError::NotTogether { longest_s: Some([from_s, to_s]), .. } => {
                Some(format!("from {from_s:.2} to {to_s:.2} s the most people are present for longest"))
            }
            FeaturesError::NotTogether { .. } => {
                Some("choose a longer time span, or leave out its start and end".to_string())
            }
            FeaturesError::TooMany { .. } => Some("choose a shorter time span, or fewer frames per second".to_string()),
            FeaturesError::TooLarge { .. } => Some("choose a time span with fewer people, or fewer frames".to_string()),
            FeaturesError::Still => {
                Some("people who walk side by side at one speed only move the centroid".to_string())
            }
            FeaturesError::Which(error) => error.hint(),
            FeaturesError::Expression(error) => error.hint(),
            FeaturesError::Coefficient { .. } => Some(
                "t is the time in seconds from the start; keep divisors from 0, and roots from negatives".to_string(),
            ),
            _ => None,
        }
    }
}
