//! Turns a bitmap floor plan into the dirt that people leave in it.
//!
//! A crowd walks routes through the plan, every footfall leaves a shoe print on the floor, and the result is
//! tiled floor textures for a game engine or a renderer. The stages, in the order in which the data goes:
//!
//! ```text
//! plan image ─► plan ─► walls ───────────────────────┐
//!                 │        │                          │
//!                 └─► routes ─► crowd ─┐              │
//!                                      ├─► motion ─► marks ─► stamps ─► sums ─► look ─► export
//!                                                       ▲
//!                                            patterns ──┘
//! ```
//!
//! [`mod@bake`] joins them in one function; a reader who has read only that knows the program. [`mod@walk`] does the
//! same up to the motion, which a [`Recorder`](motion::Recorder) writes down for other programs.
//!
//! Units are metres, seconds and radians counter-clockwise from +x unless a name says otherwise. The *plan
//! frame* has its origin at the lower-left corner of the lower-left pixel, x right, y up.
pub mod files;
pub mod math;

pub mod bake;
pub mod crowd;
mod error;
pub mod export;
pub mod features;
pub mod formation;
pub mod look;
pub mod marks;
pub mod motion;
pub mod patterns;
pub mod plan;
mod progress;
pub mod recordings;
pub mod routes;
pub mod scenario;
pub mod show;
pub mod source;
pub mod stamps;
pub mod sums;
pub mod units;
pub mod walk;
pub mod walls;

pub use error::Error;
pub use progress::{Interrupted, Progress, Silent, Stage, Stopwatch};
