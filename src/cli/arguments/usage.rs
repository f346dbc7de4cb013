use clap::error::ErrorKind;

/// Arguments that contradict each other, each of them valid alone.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
pub struct WrongUsage {
    /// Names of the subcommand.
    pub command: &'static [&'static str],
    pub kind: ErrorKind,
    pub message: String,
}
