/// Errors of the crowd stage.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CrowdError {
    /// An option is not allowed.
    #[error(transparent)]
    Option(#[from] crate::options::OptionError),
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
            CrowdError::Option(e) => e.hint(),
            CrowdError::Spot { hint, .. } => Some(hint.clone()),
            CrowdError::Units(e) => e.hint(),
            CrowdError::Routes(e) => e.hint(),
            CrowdError::NoRoutes => None,
        }
    }
}
