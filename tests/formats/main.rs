//! Vector plans: one office of 12 rooms, written in each format, is read as it was drawn. Damaged inputs of every reader.

// A test that cannot go on fails.
#![allow(clippy::unwrap_used)]

mod building;
mod malformed;
mod measure;
mod mutated;
mod read;
mod readers;
mod write;
