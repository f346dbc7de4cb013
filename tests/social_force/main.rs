//! The crowd under social forces: groups against what was observed of them, speed and density, walls, determinism, stops,
//! and people who are led from outside.
//!
//! `cargo test --release --test social_force -- --nocapture` prints every measured figure beside the published one.

// A test that cannot go on fails.
#![allow(clippy::unwrap_used)]

mod control;
mod density;
mod groups;
mod keeps;
#[allow(dead_code)]
#[path = "../crowd/scene.rs"]
mod plans;
mod rimea;
mod scene;
