//! Boids without cohesion: everybody walks alone, makes way for others and falls in line with them.

mod floor;
mod model;
mod neighbourhood;
mod speed;

pub(super) use model::Boids;
