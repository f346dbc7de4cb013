//! Builds the crowd that a `[formation]` describes: examples, key formations, small crowds in the places of individuals.

mod builder;
mod example;
mod form;
mod generated;
mod heading;
mod keys;
mod path;

pub use form::form;
pub(super) use path::angles;

#[cfg(test)]
mod tests;
