use std::fmt;

use super::error::ExpressionError;
#[cfg(doc)]
use super::error::LONGEST_EXPRESSION;
use super::instruction::Instruction;
use super::parse::instructions;
use super::variables::Variables;

/// A parsed formula of `t` and the other [`Variables`].
///
/// Numbers (`2`, `0.5`, `1e-3`), `+ - * / % ^`, brackets, the constants `pi`, `tau`, `e`, the variables `t`, `duration`,
/// `i`, `c`, `sd`, and the functions `sin cos tan asin acos atan sinh cosh tanh exp ln sqrt abs sign floor ceil round`
/// of one, `min max` of two or more, and `clamp(x, low, high)`. `^` binds tightest and to the right, `-2^2` is -4.
/// Angles are radians.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    text: String,
    instructions: Vec<Instruction>,
}

impl Expression {
    /// Parses an expression.
    ///
    /// # Errors
    /// A syntax error, with its column; text of more than `LONGEST_EXPRESSION` bytes; brackets nested too deeply.
    pub fn parse(text: &str) -> Result<Expression, ExpressionError> {
        let instructions = instructions(text)?;
        Ok(Expression { text: text.trim().to_string(), instructions })
    }

    /// Evaluates the expression; the value may be NaN or infinite, as that of `1/0`.
    pub fn value(&self, variables: &Variables) -> f64 {
        let mut stack: Vec<f64> = Vec::with_capacity(self.instructions.len());
        self.value_with(variables, &mut stack)
    }

    /// Evaluates the expression with a stack that the caller reuses.
    pub(in super::super) fn value_with(&self, variables: &Variables, stack: &mut Vec<f64>) -> f64 {
        stack.clear();
        for instruction in &self.instructions {
            let value = match *instruction {
                Instruction::Number(number) => number,
                Instruction::Variable(variable) => variable.of(variables),
                Instruction::Negate => -stack.pop().unwrap_or(f64::NAN),
                Instruction::Binary(binary) => {
                    let (b, a) = (stack.pop().unwrap_or(f64::NAN), stack.pop().unwrap_or(f64::NAN));
                    binary.of(a, b)
                }
                Instruction::Call(function) => {
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
}

impl fmt::Display for Expression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}
