use crate::progress::Interrupted;
use crate::{
    crowd, export, features, files, formation, look, marks, motion, patterns, plan, recordings, routes, scenario, show,
    stamps, sums, units, walls,
};

/// Declares [`Error`] from one list of stages, in the order of the data.
macro_rules! stages {
    ($($(#[$meaning:meta])* $Stage:ident($Error:ty) $({ $interrupted:pat })?;)*) => {
        /// Error of a stage.
        ///
        /// Messages name the problem, its place and the value; [`Error::hint`] suggests a remedy.
        #[derive(Debug, thiserror::Error)]
        #[non_exhaustive]
        pub enum Error {
            $($(#[$meaning])* #[error(transparent)] $Stage($Error),)*
            /// The user interrupted the run.
            #[error(transparent)]
            Interrupted(#[from] Interrupted),
        }

        impl Error {
            /// Suggests a remedy to the user, if there is one.
            pub fn hint(&self) -> Option<String> {
                match self {
                    $(Error::$Stage(error) => error.hint(),)*
                    Error::Interrupted(_) => None,
                }
            }

            /// The remedy of an error that is this one or that of a stage, as it comes out of a box of any error.
            pub fn hint_of(error: &(dyn std::error::Error + 'static)) -> Option<String> {
                $(if let Some(error) = error.downcast_ref::<$Error>() {
                    return error.hint();
                })*
                error.downcast_ref::<Error>()?.hint()
            }
        }

        $(impl From<$Error> for Error {
            fn from(error: $Error) -> Error {
                match error {
                    $($interrupted => Error::Interrupted(Interrupted),)?
                    error => Error::$Stage(error),
                }
            }
        })*
    };
}

stages! {
    /// A file cannot be written.
    File(files::FileError);
    /// The plan image or its scale cannot be used.
    Plan(plan::PlanError);
    /// Outlines in a manifest are invalid.
    Walls(walls::WallsError);
    /// A route leads nowhere.
    Routes(routes::RoutesError) { routes::RoutesError::Interrupted(_) };
    /// A motion cannot go on, or cannot be held.
    Motion(motion::MotionError) { motion::MotionError::Interrupted(_) };
    /// A recording cannot be read or written.
    Recording(recordings::RecordingError) { recordings::RecordingError::Interrupted(_) };
    /// Formations cannot be interpolated.
    Formation(formation::FormationError) { formation::FormationError::Interrupted(_) };
    /// Features cannot be computed or changed.
    Features(features::FeaturesError) { features::FeaturesError::Interrupted(_) };
    /// Units cannot be cut or used.
    Units(units::UnitsError) { units::UnitsError::Interrupted(_) };
    /// The crowd's options or routes are invalid.
    Crowd(crowd::CrowdError);
    /// A pattern library is missing or invalid.
    Patterns(patterns::PatternsError);
    /// The options of marks are invalid.
    Marks(marks::MarksError);
    /// The texel grid or the options of stamps are invalid.
    Stamps(stamps::StampsError);
    /// Sums are invalid.
    Sums(sums::SumsError);
    /// A look is invalid.
    Look(look::LookError);
    /// A bake cannot be written or read.
    Export(export::ExportError) { export::ExportError::Interrupted(_) };
    /// A camera is invalid.
    Camera(export::CameraError);
    /// The options of an animation are invalid.
    Animation(show::AnimationError);
    /// The options of a still are invalid.
    Still(show::still::StillError) { show::still::StillError::Export(export::ExportError::Interrupted(_)) };
    /// A scenario is invalid.
    Scenario(scenario::ScenarioError);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_boxed_error_of_any_stage_keeps_its_remedy() {
        let errors: [Box<dyn std::error::Error>; 3] = [
            Box::new(routes::RoutesError::SameStop { name: "bar".into() }),
            Box::new(Error::from(routes::RoutesError::SameStop { name: "bar".into() })),
            Box::new(std::io::Error::other("full")),
        ];
        let hints = errors.map(|error| Error::hint_of(&*error));
        let expected = Some("give each [[stop]] a name of its own".to_string());
        assert_eq!(hints, [expected.clone(), expected, None]);
    }
}
