//! Patterns from photographs: photographs of known stains are made, and what is imported is compared with them.

mod photograph;
mod refused;
mod saved;
mod stains;
