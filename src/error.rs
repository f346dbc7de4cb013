/// Anything that stops a bake, by the stage that found it.
///
/// Every message says what, where and which value; [`Error::hint`] says what to do about it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The plan image or its scale cannot be used.
    #[error(transparent)]
    Plan(#[from] crate::plan::PlanError),
    /// No walls can be made of the plan.
    #[error(transparent)]
    Walls(#[from] crate::walls::WallsError),
    /// A route leads nowhere.
    #[error(transparent)]
    Routes(crate::routes::RoutesError),
    /// The crowd cannot walk.
    #[error(transparent)]
    Crowd(#[from] crate::crowd::CrowdError),
    /// A motion cannot be recorded as asked.
    #[error(transparent)]
    Motion(#[from] crate::motion::MotionError),
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] crate::files::FileError),
    /// Feet cannot leave marks as they are asked to.
    #[error(transparent)]
    Marks(#[from] crate::marks::MarksError),
    /// The floor cannot be divided into texels as asked, or a stamp's settings are wrong.
    #[error(transparent)]
    Stamps(#[from] crate::stamps::StampsError),
    /// Sums do not fit together.
    #[error(transparent)]
    Sums(#[from] crate::sums::SumsError),
    /// The pattern library is missing or wrong.
    #[error(transparent)]
    Patterns(#[from] crate::patterns::PatternsError),
    /// A look file is wrong.
    #[error(transparent)]
    Look(#[from] crate::look::LookError),
    /// The result cannot be written or an earlier one cannot be read.
    #[error(transparent)]
    Export(crate::export::ExportError),
    /// There can be no animation as asked.
    #[error(transparent)]
    Animation(#[from] crate::export::preview::AnimationError),
    /// There can be no still as asked.
    #[error(transparent)]
    Still(#[from] crate::export::preview::still::StillError),
    /// The scenario file is wrong.
    #[error(transparent)]
    Scenario(#[from] crate::scenario::ScenarioError),
    /// Stopped by the user.
    #[error("interrupted; nothing was written")]
    Interrupted,
}

impl Error {
    /// What the user can do about it, where there is something.
    pub fn hint(&self) -> Option<String> {
        match self {
            Error::Plan(e) => e.hint(),
            Error::Walls(e) => e.hint(),
            Error::Routes(e) => e.hint(),
            Error::Crowd(e) => e.hint(),
            Error::Motion(e) => e.hint(),
            Error::File(e) => e.hint(),
            Error::Patterns(e) => e.hint(),
            Error::Marks(e) => e.hint(),
            Error::Stamps(e) => e.hint(),
            Error::Sums(e) => e.hint(),
            Error::Look(e) => e.hint(),
            Error::Export(e) => e.hint(),
            Error::Animation(e) => e.hint(),
            Error::Still(e) => e.hint(),
            Error::Scenario(e) => e.hint(),
            Error::Interrupted => None,
        }
    }
}

impl From<crate::routes::RoutesError> for Error {
    fn from(error: crate::routes::RoutesError) -> Error {
        match error {
            crate::routes::RoutesError::Interrupted => Error::Interrupted,
            error => Error::Routes(error),
        }
    }
}

impl From<crate::export::ExportError> for Error {
    fn from(error: crate::export::ExportError) -> Error {
        match error {
            crate::export::ExportError::Interrupted => Error::Interrupted,
            error => Error::Export(error),
        }
    }
}
