//! Arithmetic expressions that a user writes: `2.0`, `sin(2*pi*t/5)`.
//!
//! A text is compiled to the instructions of a stack machine, so that evaluation neither recurses nor allocates.
//! Functions are those of [`math`](crate::math) and the `libm` crate: the same value on every machine.

mod error;
mod formula;
mod function;
mod instruction;
mod parse;
mod tokens;
mod variables;

pub use error::{ExpressionError, Mistake};
pub use formula::Expression;
pub use variables::Variables;

#[cfg(test)]
mod tests;
