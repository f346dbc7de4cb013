use std::fmt;

use super::function::FUNCTIONS;
use super::{CONSTANTS, LONGEST_EXPRESSION, Variable};

/// Longest piece of an expression that is shown, characters.
const SHOWN: usize = 80;

/// Why a text is no expression, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{mistake}\n{}", excerpt(text, *column))]
pub struct ExpressionError {
    /// The text.
    pub text: String,
    /// Column of what is wrong in characters, from 1 on.
    pub column: usize,
    /// What is wrong.
    pub mistake: Mistake,
}

/// What is wrong with an expression.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Mistake {
    /// Nothing at all.
    #[error("the expression is empty")]
    Empty,
    /// A text beyond all measure.
    #[error("the expression is longer than {LONGEST_EXPRESSION} characters")]
    TooLong,
    /// Too many brackets in brackets.
    #[error("too many brackets, signs or powers within each other")]
    TooDeep,
    /// A character that has no meaning.
    #[error("{character:?} means nothing here")]
    Character {
        /// The character.
        character: char,
    },
    /// A number that is none.
    #[error("{text} is no number")]
    Number {
        /// What is written.
        text: String,
    },
    /// A name that is none of ours.
    #[error("{name} is not known")]
    Name {
        /// What is written.
        name: String,
    },
    /// A function without its brackets.
    #[error("{name} is a function: its argument in brackets is missing")]
    NoArguments {
        /// The function.
        name: &'static str,
    },
    /// Brackets after what is no function.
    #[error("{name} is no function: an operator is missing before the bracket")]
    NotAFunction {
        /// The name before the bracket.
        name: String,
    },
    /// The wrong number of arguments.
    #[error("{name} takes {takes}, not {given}")]
    Arguments {
        /// The function.
        name: &'static str,
        /// How many it takes, in words.
        takes: &'static str,
        /// How many there are.
        given: usize,
    },
    /// Something where a value should be.
    #[error("{found} where a value should be")]
    NoValue {
        /// What stands there.
        found: String,
    },
    /// Two values side by side.
    #[error("an operator is missing before {found}")]
    NoOperator {
        /// What stands there.
        found: String,
    },
    /// A bracket that is never closed.
    #[error("this bracket is not closed")]
    NotClosed,
    /// A bracket that was never opened.
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

/// The known name that is nearest, or all of them.
fn hint_for(name: &str) -> String {
    let names = || {
        let variables = Variable::ALL.iter().map(|(name, _)| *name);
        variables.chain(CONSTANTS.iter().map(|(name, _)| *name)).chain(FUNCTIONS.iter().map(|known| known.name))
    };
    let edits = |known: &&str| strsim::damerau_levenshtein(&name.to_lowercase(), known);
    // Of equals the shortest.
    let near = names().map(|known| (edits(&known), known.len(), known)).min();
    match near {
        Some((..=1, 2.., known)) => format!("did you mean {known}?"),
        _ => format!("known are {}", names().collect::<Vec<_>>().join(" ")),
    }
}

/// The text, or a part of it, with a caret below the column.
fn excerpt(text: &str, column: usize) -> impl fmt::Display {
    let from = if column > SHOWN { column - SHOWN / 2 } else { 0 };
    let shown: String = text.chars().skip(from).take(SHOWN).map(|c| if c.is_control() { ' ' } else { c }).collect();
    format!("  {shown}\n  {}^ column {column}", " ".repeat((column - 1).saturating_sub(from).min(SHOWN)))
}
