//! The crowd under social forces: groups against what was observed of them, speed and density, walls, determinism, stops,
//! and people who are led from outside.
//!
//! `cargo test --release --test crowd social_force -- --nocapture` prints every measured figure beside the published one.

mod control;
mod density;
mod groups;
mod keeps;
mod rimea;
mod scene;

use super::scene as plans;
