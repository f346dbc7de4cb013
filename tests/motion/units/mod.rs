//! Crowd units on the sample plaza: 72 people walk under social forces, and near the viewer they do what units show.

mod drawn;
mod played;
mod refused;
mod scene;
mod shoved;
mod spliced;
