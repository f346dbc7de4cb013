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
            MarksError::OutOfRange { .. } | MarksError::Distribution { .. } => None,
        }
    }
}
