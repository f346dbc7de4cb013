//! All tests in one program: its threads take the next test from any folder, so that none waits for the slowest of another.
//!
//! Each folder is a program of its own as well, for those who work on one: `cargo test --test crowd`.

// Folders share `support`.
#![allow(clippy::duplicate_mod)]

#[path = "cli/main.rs"]
mod cli;
#[path = "crowd/main.rs"]
mod crowd;
#[path = "formats/main.rs"]
mod formats;
#[path = "marks/main.rs"]
mod marks;
#[path = "motion/main.rs"]
mod motion;
#[path = "plans/main.rs"]
mod plans;
#[path = "regression/main.rs"]
mod regression;
#[path = "results/main.rs"]
mod results;
