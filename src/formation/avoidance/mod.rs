//! Collision avoidance within a formation: people who would come too near step aside, early and smoothly, and return.

mod body;
mod encounters;
mod nearby;
mod relax;
mod settings;
mod settle;
mod smooth;
mod tracks;

pub(super) use body::{BodyMember, FormationBody};
pub(super) use relax::keep_clear;
pub(super) use settings::AvoidanceSettings;

#[cfg(test)]
mod tests;
