use crate::math::DistributionError;

/// Errors of the crowd stage.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CrowdError {
    /// Number of people out of its range.
    #[error("crowd: {people} people are requested, allowed is 1 to {most}")]
    People {
        /// Number of people requested.
        people: u32,
        /// The limit.
        most: u32,
    },
    /// A distribution with invalid parameters.
    #[error("crowd: {name}: {source}")]
    Distribution {
        /// The option.
        name: &'static str,
        /// The problem.
        source: DistributionError,
    },
    /// A number out of its range.
    #[error("crowd: {name} is {value}, allowed is {low} to {high}")]
    Number {
        /// The option.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Least value allowed.
        low: f64,
        /// Largest value allowed.
        high: f64,
    },
    /// An invalid timetable.
    #[error("crowd: arrivals: {key}: {problem}")]
    Timetable {
        /// The key, as a scenario writes it.
        key: &'static str,
        /// The problem.
        problem: String,
    },
    /// Empty list of routes.
    #[error("crowd: there is no route to walk")]
    NoRoutes,
    /// A spot for units without room for its viewer.
    #[error("crowd: {spot} at [{x:.2}, {y:.2}] {problem}")]
    Spot {
        /// Name of the spot.
        spot: String,
        /// Place in x, metres.
        x: f64,
        /// Place in y, metres.
        y: f64,
        /// The problem.
        problem: String,
        /// A remedy.
        hint: String,
    },
    /// Invalid units.
    #[error(transparent)]
    Units(#[from] crate::units::UnitsError),
    /// Invalid routes.
    #[error(transparent)]
    Routes(#[from] crate::routes::RoutesError),
}

impl CrowdError {
    /// A remedy in words, if there is one.
    pub fn hint(&self) -> Option<String> {
        match self {
            CrowdError::People { .. } => Some("give a whole number of people, such as 1000".into()),
            CrowdError::Distribution { .. } => {
                Some("write a number, a range [0.28, 0.36], or { mean = 1.34, sd = 0.26, min = 0.6, max = 2.1 }".into())
            }
            CrowdError::Spot { hint, .. } => Some(hint.clone()),
            CrowdError::Units(e) => e.hint(),
            CrowdError::Routes(e) => e.hint(),
            CrowdError::Number { .. } | CrowdError::Timetable { .. } | CrowdError::NoRoutes => None,
        }
    }
}
