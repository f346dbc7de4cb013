//! The instructions that an expression is compiled to.

use super::function::Function;
use super::variables::Variable;

/// An instruction of the stack machine that evaluates an expression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Instruction {
    /// Pushes a number.
    Number(f64),
    /// Pushes a variable.
    Variable(Variable),
    /// Negates the top of the stack.
    Negate,
    /// Pops two values and pushes the operator's result.
    Binary(Binary),
    /// Pops a function's arguments and pushes its value.
    Call(Function),
}

/// A binary operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    Power,
}

impl Binary {
    pub(super) fn of(self, a: f64, b: f64) -> f64 {
        match self {
            Binary::Add => a + b,
            Binary::Subtract => a - b,
            Binary::Multiply => a * b,
            Binary::Divide => a / b,
            // The remainder has the divisor's sign, so `t % 5` is a saw tooth for negative `t` as well.
            Binary::Remainder => a - b * (a / b).floor(),
            Binary::Power => crate::math::pow(a, b),
        }
    }
}
