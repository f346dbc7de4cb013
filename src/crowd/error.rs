use crate::math::DistributionError;

/// Why the `crowd` stage cannot go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CrowdError {
    /// Nobody, or more people than the list can hold.
    #[error("crowd: {people} people are asked for, allowed is 1 to {most}")]
    People {
        /// How many are asked for.
        people: u32,
        /// The limit.
        most: u32,
    },
    /// A distribution that cannot be drawn from.
    #[error("crowd: {name}: {source}")]
    Distribution {
        /// The option.
        name: &'static str,
        /// What is wrong with it.
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
    /// A timetable that says nothing sensible.
    #[error("crowd: arrivals: {key}: {problem}")]
    Timetable {
        /// The key, as a scenario writes it.
        key: &'static str,
        /// What is wrong.
        problem: String,
    },
    /// No routes to walk.
    #[error("crowd: there is no route to walk")]
    NoRoutes,
    /// A spot at which units are to be played, where nobody can stand.
    #[error("crowd: {spot} at [{x:.2}, {y:.2}] {problem}")]
    Spot {
        /// What the spot is called.
        spot: String,
        /// Where it is, metres.
        x: f64,
        /// Where it is, metres.
        y: f64,
        /// What is wrong.
        problem: String,
        /// What to do about it.
        hint: String,
    },
    /// Units that cannot be used.
    #[error(transparent)]
    Units(#[from] crate::units::UnitsError),
    /// Routes that do not fit the plan.
    #[error(transparent)]
    Routes(#[from] crate::routes::RoutesError),
}

impl CrowdError {
    /// What the user can do about it.
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
