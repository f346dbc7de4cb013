//! Patterns from photographs: photographs of known stains are made, and what is imported is compared with them.

#![allow(clippy::unwrap_used)] // a test may panic

mod photograph;
mod refused;
mod saved;
mod stains;
