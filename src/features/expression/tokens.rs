use super::error::{ExpressionError, LONGEST_EXPRESSION, Mistake};

/// The kinds of tokens.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum TokenKind {
    Number(f64),
    Name(String),
    /// One of `+ - * / % ^ ( ) ,`.
    Sign(char),
    End,
}

/// A token and the column where it begins, in characters from 1.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Token {
    pub(super) kind: TokenKind,
    pub(super) column: usize,
}

impl Token {
    /// The token as error messages show it.
    pub(super) fn found(&self) -> String {
        match &self.kind {
            TokenKind::Number(number) => number.to_string(),
            TokenKind::Name(name) => name.clone(),
            TokenKind::Sign(sign) => sign.to_string(),
            TokenKind::End => "the end of the expression".to_string(),
        }
    }
}

/// Splits an expression into tokens; the last is [`TokenKind::End`].
pub(super) fn tokens(text: &str) -> Result<Vec<Token>, ExpressionError> {
    let wrong = |column: usize, mistake| ExpressionError { text: text.to_string(), column, mistake };
    if text.len() > LONGEST_EXPRESSION {
        let text = text.chars().take(LONGEST_EXPRESSION).collect();
        return Err(ExpressionError { text, column: LONGEST_EXPRESSION + 1, mistake: Mistake::TooLong });
    }
    let characters: Vec<char> = text.chars().collect();
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(&character) = characters.get(at) {
        let column = at + 1;
        let length = match character {
            c if c.is_whitespace() => {
                at += 1;
                continue;
            }
            '0'..='9' | '.' => number_length(&characters[at..]),
            'a'..='z' | 'A'..='Z' | '_' => {
                let inside = |c: &&char| c.is_ascii_alphanumeric() || **c == '_';
                characters[at..].iter().take_while(inside).count()
            }
            _ => 1,
        };
        let written: String = characters[at..at + length].iter().collect();
        let kind = match character {
            '0'..='9' | '.' => match written.parse::<f64>() {
                Ok(number) if number.is_finite() => TokenKind::Number(number),
                _ => return Err(wrong(column, Mistake::Number { text: written })),
            },
            'a'..='z' | 'A'..='Z' | '_' => TokenKind::Name(written),
            '+' | '-' | '*' | '/' | '%' | '^' | '(' | ')' | ',' => TokenKind::Sign(character),
            character => return Err(wrong(column, Mistake::Character { character })),
        };
        found.push(Token { kind, column });
        at += length;
    }
    found.push(Token { kind: TokenKind::End, column: characters.len() + 1 });
    Ok(found)
}

/// Number of characters of a number: digits and points, and an exponent if it has digits (`2e` is `2` and a name).
fn number_length(rest: &[char]) -> usize {
    let digits = |from: usize, point: bool| {
        rest[from..].iter().take_while(|c| c.is_ascii_digit() || (point && **c == '.')).count()
    };
    let mantissa = digits(0, true);
    if !matches!(rest.get(mantissa), Some('e' | 'E')) {
        return mantissa;
    }
    let sign = usize::from(matches!(rest.get(mantissa + 1), Some('+' | '-')));
    match digits((mantissa + 1 + sign).min(rest.len()), false) {
        0 => mantissa,
        exponent => mantissa + 1 + sign + exponent,
    }
}
