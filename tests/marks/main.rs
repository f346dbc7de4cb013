//! Marks of shoes and bodies: where they fall, how large and how often, and the patterns that they show.

// A test that cannot go on fails.
#![allow(clippy::unwrap_used)]

mod contacts;
mod gait;
mod import;
mod patterns;
mod wheels;
