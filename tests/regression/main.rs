//! One function per bug that a user could meet, with the smallest input that shows it.

// A test that cannot go on fails.
#![allow(clippy::unwrap_used)]

#[path = "../support/sandbox.rs"]
mod sandbox;

mod bounds;
mod files;
mod hangs;
mod programs;
