//! Formations that change into each other: what the method promises, on crowds made for it.
mod bases;
mod crowds;
mod keys;
mod mistakes;
mod motion;
mod rotations;
mod sphere;
