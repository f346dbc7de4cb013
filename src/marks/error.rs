//! Errors of the marks.

/// Error in the options of the marks, or in the places of contacts.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MarksError {
    /// An option is not allowed.
    #[error(transparent)]
    Option(#[from] crate::options::OptionError),
    /// The pattern library has no sole.
    #[error("the pattern library holds no sole, which footprints need")]
    NoSole,
    /// The sole that all people should wear is not in the library.
    #[error("marks.shoe is \"{name}\", but the pattern library has no sole of this name")]
    UnknownShoe {
        /// Name of the shoe.
        name: String,
        /// Names of the library's soles.
        soles: Vec<String>,
    },
    /// A door or a fixture does not fit the plan.
    #[error("{list} {}: {key}: {problem}", called(.name, *.index))]
    Place {
        /// `door` or `fixture`.
        list: &'static str,
        /// Index in the scenario's list.
        index: usize,
        /// Name in the scenario.
        name: Option<String>,
        /// Key in a scenario.
        key: String,
        /// The problem.
        problem: String,
        /// Hint for the user.
        hint: Option<String>,
    },
}

/// Label of a list entry in messages: its name, or its number from 1.
fn called(name: &Option<String>, index: usize) -> String {
    name.as_ref().map_or_else(|| (index + 1).to_string(), |name| format!("\"{name}\""))
}

impl MarksError {
    /// Hint for the user.
    pub fn hint(&self) -> Option<String> {
        match self {
            MarksError::UnknownShoe { name, soles } => {
                let near = |sole: &&String| strsim::jaro_winkler(name, sole);
                let nearest = soles.iter().max_by(|a, b| near(a).total_cmp(&near(b)))?;
                Some(format!("did you mean \"{nearest}\"? There are: {}", soles.join(", ")))
            }
            MarksError::NoSole => Some("list at least one pattern with cause = \"sole\"".to_owned()),
            MarksError::Place { hint, .. } => hint.clone(),
            MarksError::Option(error) => error.hint(),
        }
    }
}
