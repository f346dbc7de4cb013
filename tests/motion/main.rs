//! Motions that are given: recordings, formations, features and units, from the file to the frames.

// A test that cannot go on fails.
#![allow(clippy::unwrap_used)]

mod choreography;
mod features;
mod formation;
mod given;
mod recordings;
mod units;
