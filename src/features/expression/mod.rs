//! Arithmetic that a user writes: `2.0`, `sin(2*pi*t/5)`.
//!
//! A text becomes a list of steps for a machine with a stack, so that evaluating it neither recurses nor allocates.
//! Functions are those of [`math`](crate::math) and the `libm` crate: the same value on every machine.

use std::fmt;

mod error;
mod function;
mod parse;
mod tokens;

pub use error::{ExpressionError, Mistake};
use function::Function;

/// Longest expression, bytes.
pub const LONGEST_EXPRESSION: usize = 1000;

/// What an expression may speak of.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Variables {
    /// `t`: seconds since the start.
    pub t: f64,
    /// `duration`: seconds from the start to the end.
    pub duration: f64,
    /// `i`: the component's number, from 1 on.
    pub i: f64,
    /// `c`: the component's coefficient at that moment, metres.
    pub c: f64,
    /// `sd`: the standard deviation of the component's coefficient over time, metres.
    pub sd: f64,
}

/// One of the [`Variables`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Variable {
    T,
    Duration,
    I,
    C,
    Sd,
}

impl Variable {
    const ALL: [(&str, Variable); 5] = [
        ("t", Variable::T),
        ("duration", Variable::Duration),
        ("i", Variable::I),
        ("c", Variable::C),
        ("sd", Variable::Sd),
    ];

    fn of(self, variables: &Variables) -> f64 {
        match self {
            Variable::T => variables.t,
            Variable::Duration => variables.duration,
            Variable::I => variables.i,
            Variable::C => variables.c,
            Variable::Sd => variables.sd,
        }
    }
}

/// Constants by name.
const CONSTANTS: [(&str, f64); 3] =
    [("pi", std::f64::consts::PI), ("tau", std::f64::consts::TAU), ("e", std::f64::consts::E)];

/// A step of the evaluation.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Step {
    /// Puts a number on the stack.
    Number(f64),
    /// Puts a variable on the stack.
    Variable(Variable),
    /// Takes the uppermost value and puts its negative there.
    Negate,
    /// Takes two values and puts one there.
    Binary(Binary),
    /// Takes a function's arguments and puts its value there.
    Call(Function),
}

/// An operator between two values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    Power,
}

impl Binary {
    fn of(self, a: f64, b: f64) -> f64 {
        match self {
            Binary::Add => a + b,
            Binary::Subtract => a - b,
            Binary::Multiply => a * b,
            Binary::Divide => a / b,
            // As in most languages for this use, of the divisor's sign: `t % 5` is a saw tooth before 0 too.
            Binary::Remainder => a - b * (a / b).floor(),
            Binary::Power => crate::math::pow(a, b),
        }
    }
}

/// A formula of `t` and other [`Variables`], parsed.
///
/// Numbers (`2`, `0.5`, `1e-3`), `+ - * / % ^`, brackets, the constants `pi`, `tau`, `e`, the variables `t`, `duration`,
/// `i`, `c`, `sd`, and the functions `sin cos tan asin acos atan sinh cosh tanh exp ln sqrt abs sign floor ceil round`
/// of one, `min max` of two or more, and `clamp(x, low, high)`. `^` binds tightest and to the right, `-2^2` is -4.
/// Angles are radians.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    text: String,
    steps: Vec<Step>,
}

impl Expression {
    /// Reads an expression.
    ///
    /// # Errors
    /// Text that is none, with the column of what is wrong; text of more than [`LONGEST_EXPRESSION`] bytes or with too
    /// many brackets in each other.
    pub fn parse(text: &str) -> Result<Expression, ExpressionError> {
        let steps = parse::steps(text)?;
        Ok(Expression { text: text.trim().to_string(), steps })
    }

    /// Its value; NaN or infinite where arithmetic says so, as in `1/0`.
    pub fn value(&self, variables: &Variables) -> f64 {
        let mut stack: Vec<f64> = Vec::with_capacity(self.steps.len());
        self.value_with(variables, &mut stack)
    }

    /// The same with a stack that is used again and again.
    pub(super) fn value_with(&self, variables: &Variables, stack: &mut Vec<f64>) -> f64 {
        stack.clear();
        for step in &self.steps {
            let value = match *step {
                Step::Number(number) => number,
                Step::Variable(variable) => variable.of(variables),
                Step::Negate => -stack.pop().unwrap_or(f64::NAN),
                Step::Binary(binary) => {
                    let (b, a) = (stack.pop().unwrap_or(f64::NAN), stack.pop().unwrap_or(f64::NAN));
                    binary.of(a, b)
                }
                Step::Call(function) => {
                    let from = stack.len().saturating_sub(function.arguments());
                    let value = function.of(&stack[from..]);
                    stack.truncate(from);
                    value
                }
            };
            stack.push(value);
        }
        stack.pop().unwrap_or(f64::NAN)
    }

    /// Whether it is the same whatever the moment and the coefficient.
    pub fn is_constant(&self) -> bool {
        !self.steps.iter().any(|step| matches!(step, Step::Variable(_)))
    }
}

impl fmt::Display for Expression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

#[cfg(test)]
mod tests;
