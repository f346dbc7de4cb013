use std::fmt;

use super::function::FUNCTIONS;
use super::variables::{CONSTANTS, Variable};

/// Longest expression, bytes.
pub const LONGEST_EXPRESSION: usize = 1000;
/// Longest piece of an expression that is shown, characters.
const SHOWN: usize = 80;

/// A syntax error in an expression, with its column.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{mistake}\n{}", excerpt(text, *column))]
pub struct ExpressionError {
    /// The expression as written.
    pub text: String,
    /// Column of the error, in characters from 1.
    pub column: usize,
    /// The kind of error.
    pub mistake: Mistake,
}

/// The kinds of syntax errors.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Mistake {
    /// An empty expression.
    #[error("the expression is empty")]
    Empty,
    /// An expression longer than `LONGEST_EXPRESSION`.
    #[error("the expression is longer than {LONGEST_EXPRESSION} characters")]
    TooLong,
    /// Brackets, signs or powers nested too deeply.
    #[error("brackets, signs or powers are nested too deeply")]
    TooDeep,
    /// An unexpected character.
    #[error("{character:?} is not expected here")]
    Character {
        /// The character.
        character: char,
    },
    /// A malformed number.
    #[error("{text} is not a number")]
    Number {
        /// The text of the number.
        text: String,
    },
    /// An unknown name.
    #[error("{name} is not a known name")]
    Name {
        /// The name.
        name: String,
    },
    /// A function without its arguments.
    #[error("{name} is a function: its arguments in brackets are missing")]
    NoArguments {
        /// The function.
        name: &'static str,
    },
    /// Brackets after a name that is not a function.
    #[error("{name} is not a function: an operator is missing before the bracket")]
    NotAFunction {
        /// The name before the bracket.
        name: String,
    },
    /// The wrong number of arguments.
    #[error("{name} takes {takes}, not {given}")]
    Arguments {
        /// The function.
        name: &'static str,
        /// The number of arguments that it takes, in words.
        takes: &'static str,
        /// The number of arguments given.
        given: usize,
    },
    /// Another token where a value is expected.
    #[error("expected a value, found {found}")]
    NoValue {
        /// The token found.
        found: String,
    },
    /// Two values without an operator between them.
    #[error("an operator is missing before {found}")]
    NoOperator {
        /// The token found.
        found: String,
    },
    /// A bracket without its closing one.
    #[error("this bracket is not closed")]
    NotClosed,
    /// A closing bracket without its opening one.
    #[error("this bracket was not opened")]
    NotOpened,
}

impl ExpressionError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        match &self.mistake {
            Mistake::Name { name } => Some(hint_for(name)),
            Mistake::NoOperator { .. } => Some("products are written with *, as 2*pi*t".to_string()),
            Mistake::Empty => Some("write a number, or a formula such as sin(2*pi*t/5)".to_string()),
            _ => None,
        }
    }
}

/// Suggests the known name nearest to this one, or lists all known names.
fn hint_for(name: &str) -> String {
    let names = || {
        let variables = Variable::ALL.iter().map(|(name, _)| *name);
        variables.chain(CONSTANTS.iter().map(|(name, _)| *name)).chain(FUNCTIONS.iter().map(|known| known.name))
    };
    let edits = |known: &&str| strsim::damerau_levenshtein(&name.to_lowercase(), known);
    // Among equally near names, the shortest.
    let near = names().map(|known| (edits(&known), known.len(), known)).min();
    match near {
        Some((..=1, 2.., known)) => format!("did you mean {known}?"),
        _ => format!("the known names are {}", names().collect::<Vec<_>>().join(" ")),
    }
}

/// The expression, or a part of it, with a caret below the column.
fn excerpt(text: &str, column: usize) -> impl fmt::Display {
    let from = if column > SHOWN { column - SHOWN / 2 } else { 0 };
    let shown: String = text.chars().skip(from).take(SHOWN).map(|c| if c.is_control() { ' ' } else { c }).collect();
    format!("  {shown}\n  {}^ column {column}", " ".repeat((column - 1).saturating_sub(from).min(SHOWN)))
}
