//! What a bake leaves: textures, sums, scene, stills and page; the same bytes on any number of threads.

// A test that cannot go on fails.
#![allow(clippy::unwrap_used)]

mod bake;
mod ceiling;
mod days;
mod empty_walls;
mod export;
mod floorplans;
mod floors;
mod hashes;
mod looks;
mod masks;
mod page;
mod sdf;
#[path = "../support/golden.rs"]
mod golden;
mod view;
mod walls;
