//! Turns a bitmap floor plan into the dirt that people leave in it.
//!
//! A crowd walks routes through the plan, and every footfall leaves a shoe print on the floor. The result is tiled
//! floor textures for a game engine or a renderer. The stages, in the order of the data:
//!
//! ```text
//! plan image ─► plan ─► walls ───────────────────────────────┐
//!                 │        │                                  │
//!                 └─► routes ─► crowd ─┐                      │
//!                                      ├─► motion ─► marks ─► stamps ─► sums ─► look ─► export, show
//!    recordings, formation, features, ─┘               ▲
//!    units                                  patterns ──┘
//! ```
//!
//! [`mod@bake`] runs all stages in one function; read it first. [`mod@walk`] runs the stages up to the motion, which a
//! [`Recorder`](recordings::Recorder) writes for other programs.
//!
//! Units are metres, seconds and radians counter-clockwise from +x unless a name says otherwise. The *plan
//! frame* has its origin at the lower-left corner of the lower-left pixel, x right, y up.
#![warn(unnameable_types)]

// In the order of the data: a module uses the modules above it.
mod progress;
pub mod files;
pub mod options;
pub mod math;
pub mod plan;
pub mod walls;
pub mod rooms;
pub mod routes;
pub mod motion;
pub mod recordings;
pub mod formation;
pub mod features;
pub mod units;
pub mod crowd;
pub mod patterns;
pub mod marks;
pub mod stamps;
pub mod sums;
pub mod look;
pub mod export;
pub mod show;
pub mod scenario;
mod error;
pub mod source;
pub mod walk;
pub mod bake;

pub use error::Error;
pub use progress::{Interrupted, Progress, Silent, Stage, Stopwatch};
