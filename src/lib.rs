//! Turns a bitmap floor plan into the dirt that people leave in it.
//!
//! A crowd walks routes through the plan, every footfall leaves a shoe print on the floor, and the result is
//! tiled floor textures for a game engine or a renderer. The stages, in the order in which the data goes:
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
//! [`mod@bake`] joins them in one function; a reader who has read only that knows the program. [`mod@walk`] does the
//! same up to the motion, which a [`Recorder`](recordings::Recorder) writes down for other programs.
//!
//! Units are metres, seconds and radians counter-clockwise from +x unless a name says otherwise. The *plan
//! frame* has its origin at the lower-left corner of the lower-left pixel, x right, y up.
// In the order of the data: a module uses those above it.
mod progress;
pub mod files;
pub mod options;
pub mod math;
pub mod plan;
pub mod walls;
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
