//! The crowd against what is known of pedestrians: speed and density, walls, doors, counter flow, the RiMEA tests, and
//! what a crowd must keep to on any plan.
//!
//! `cargo test --test crowd -- --nocapture` prints every measured figure beside the published one.

#![allow(clippy::unwrap_used)] // a test may panic

mod capacity;
mod counter_flow;
mod hard_plans;
mod keeps;
mod life;
mod measures;
mod no_gridlock;
mod paper;
mod paper_walls;
mod reality;
mod rimea;
mod scene;
mod social_force;
mod speed_density;
mod spread;
mod stops;
mod walk;
mod walls;
