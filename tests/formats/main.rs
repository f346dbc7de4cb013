//! Vector plans: one office of 12 rooms, written in each format, is read as it was drawn.

// A test that cannot go on fails.
#![allow(clippy::unwrap_used)]

mod building;
mod malformed;
mod measure;
mod read;
mod write;
