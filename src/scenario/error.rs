use std::io;
use std::path::PathBuf;

use super::snippet::Snippet;

/// Why a scenario cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ScenarioError {
    /// The file cannot be read.
    #[error("cannot read the scenario {path}: {source}", path = .path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Something in the file, shown where it stands.
    #[error(transparent)]
    Wrong(Box<Wrong>),
    /// A value that no file wrote.
    #[error("{message}")]
    Value {
        /// Which key, which value, what is allowed.
        message: String,
        /// What to write instead.
        hint: Option<String>,
    },
}

/// A mistake in a scenario file.
#[derive(Debug, thiserror::Error)]
#[error("{message}\n{snippet}")]
pub struct Wrong {
    /// What is wrong.
    pub message: String,
    /// Where.
    pub snippet: Snippet,
    /// What to write instead.
    pub hint: Option<String>,
}

impl ScenarioError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            ScenarioError::Unreadable { .. } => Some("`trodden init PLAN` writes a scenario for a plan".to_string()),
            ScenarioError::Wrong(wrong) => wrong.hint.clone(),
            ScenarioError::Value { hint, .. } => hint.clone(),
        }
    }
}
