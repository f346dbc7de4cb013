//! The command line as its users meet it: every case runs the program and looks at its exit code, at what it says,
//! and at what it leaves on the disk.

// A test that cannot go on fails.
#![allow(clippy::unwrap_used)]

mod bad_images;
mod bad_numbers;
mod bad_outputs;
mod batch;
mod crowd;
mod dirt;
mod edit;
mod help;
mod interrupt;
mod look_fit;
mod manifest;
mod motion;
mod motion_mistakes;
mod names;
mod parts;
mod patterns;
mod readme;
#[path = "../support/sandbox.rs"]
mod sandbox;
mod subcommands;
mod view;
mod why;
