use super::Limits;

/// A value of an option that is not allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OptionError {
    /// A number is out of its range.
    #[error("{key} is {value}, allowed is {limits}")]
    OutOfRange {
        /// The key with its sections, as in `stop.0.reach`; entries of lists count from 0.
        key: String,
        /// The number.
        value: f64,
        /// The range.
        limits: Limits,
    },
    /// A quantity that differs from person to person is wrong in itself or out of its range.
    #[error("{key}: {problem}")]
    Spread {
        /// The key.
        key: String,
        /// The problem.
        problem: String,
    },
    /// A value does not go with others.
    #[error("{key}: {problem}")]
    Unfit {
        /// The key.
        key: String,
        /// The problem, with the names of the keys.
        problem: String,
        /// A remedy.
        hint: Option<String>,
    },
}

impl OptionError {
    /// A value that does not go with others.
    pub(crate) fn unfit(key: &str, problem: impl Into<String>) -> OptionError {
        OptionError::Unfit { key: key.to_string(), problem: problem.into(), hint: None }
    }

    /// A number out of its range, where the key is not known yet.
    pub(crate) fn beyond(value: f64, limits: Limits) -> OptionError {
        OptionError::OutOfRange { key: String::new(), value, limits }
    }

    /// The same with a remedy.
    pub(crate) fn with_hint(mut self, remedy: &str) -> OptionError {
        if let OptionError::Unfit { hint, .. } = &mut self {
            *hint = Some(remedy.to_string());
        }
        self
    }

    /// The same of a key within a table or a list.
    pub(crate) fn within(mut self, outer: &str) -> OptionError {
        let (OptionError::OutOfRange { key, .. } | OptionError::Spread { key, .. } | OptionError::Unfit { key, .. }) =
            &mut self;
        *key = if key.is_empty() { outer.to_string() } else { format!("{outer}.{key}") };
        self
    }

    /// The key with its sections, as in `stop.0.reach`.
    pub fn key(&self) -> &str {
        let (OptionError::OutOfRange { key, .. } | OptionError::Spread { key, .. } | OptionError::Unfit { key, .. }) =
            self;
        key
    }

    /// The problem, for a reader who sees where it is.
    pub fn problem(&self) -> String {
        let name = self.key().rsplit('.').find(|part| part.parse::<usize>().is_err()).unwrap_or_default();
        match self {
            OptionError::OutOfRange { value, limits, .. } => format!("`{name}` is {value}, allowed is {limits}"),
            OptionError::Spread { problem, .. } => format!("`{name}`: {problem}"),
            OptionError::Unfit { problem, .. } => problem.clone(),
        }
    }

    /// A remedy, if there is one.
    pub fn hint(&self) -> Option<String> {
        match self {
            OptionError::OutOfRange { .. } => None,
            OptionError::Spread { .. } => Some(
                "write a number, a range [0.28, 0.36], or { mean = 1.34, sd = 0.26, min = 0.6, max = 2.1 }".to_string(),
            ),
            OptionError::Unfit { hint, .. } => hint.clone(),
        }
    }
}
