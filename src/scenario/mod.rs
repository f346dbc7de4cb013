//! The scenario: everything that a bake needs to know, as a TOML file or as a plan image alone.
//!
//! One section per stage, each the options of that stage; a few keys belong to the scenario itself. Every key has a
//! default, so that a plan image alone is a scenario too. A preset changes the defaults; keys that a file writes
//! win over the preset, and [`Overrides`] (the command line) win over the file.

mod check;
mod document;
mod error;
mod floors;
mod inputs;
mod keys;
mod model;
mod preset;
mod read;
mod snippet;
mod write;

pub use error::{ScenarioError, Wrong};
pub use keys::{allowed_range, schema};
pub use model::{Overrides, Scenario};
pub use preset::Preset;
pub use snippet::Snippet;

#[cfg(test)]
mod tests;
