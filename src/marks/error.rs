use crate::math::DistributionError;

/// Why the `marks` stage cannot start.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MarksError {
    /// A setting beyond what it may be.
    #[error("marks.{key} is {value}, allowed is {low} to {high}")]
    OutOfRange {
        /// The setting, as a scenario writes it.
        key: &'static str,
        /// What it is.
        value: f64,
        /// Least value allowed.
        low: f64,
        /// Largest value allowed.
        high: f64,
    },
    /// A distribution that cannot be drawn from.
    #[error("marks.{key}: {problem}")]
    Distribution {
        /// The setting, as a scenario writes it.
        key: &'static str,
        /// What is wrong with it.
        problem: DistributionError,
    },
    /// A library without soles.
    #[error("the pattern library holds no sole, so nobody can wear shoes")]
    NoSole,
    /// Everybody is to wear a shoe that is not there.
    #[error("marks.shoe is \"{name}\", but the pattern library has no sole of this name")]
    UnknownShoe {
        /// The name asked for.
        name: String,
        /// The names of the library's soles.
        soles: Vec<String>,
    },
    /// A door or a fixture that a plan does not have.
    #[error("{list} {}: {key}: {problem}", called(.name, *.index))]
    Place {
        /// `door` or `fixture`.
        list: &'static str,
        /// Its place in the scenario's list.
        index: usize,
        /// What the scenario calls it.
        name: Option<String>,
        /// The key, as a scenario writes it.
        key: &'static str,
        /// What is wrong.
        problem: String,
        /// What to do about it.
        hint: Option<String>,
    },
}

/// How messages call one of a list: by its name, or by its number.
fn called(name: &Option<String>, index: usize) -> String {
    name.as_ref().map_or_else(|| (index + 1).to_string(), |name| format!("\"{name}\""))
}

impl MarksError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            MarksError::UnknownShoe { name, soles } => {
                let near = |sole: &&String| strsim::jaro_winkler(name, sole);
                let nearest = soles.iter().max_by(|a, b| near(a).total_cmp(&near(b)))?;
                Some(format!("did you mean \"{nearest}\"? There are: {}", soles.join(", ")))
            }
            MarksError::NoSole => Some("list at least one pattern with cause = \"sole\"".to_owned()),
            MarksError::Place { hint, .. } => hint.clone(),
            MarksError::OutOfRange { .. } | MarksError::Distribution { .. } => None,
        }
    }
}
