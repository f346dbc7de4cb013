use super::{ExpressionError, LONGEST_EXPRESSION, Mistake};

/// A word of an expression.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Word {
    Number(f64),
    Name(String),
    /// One of `+ - * / % ^ ( ) ,`.
    Sign(char),
    End,
}

/// A word and the column where it begins, in characters from 1 on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Token {
    pub(super) word: Word,
    pub(super) column: usize,
}

impl Token {
    /// What stands here, for messages.
    pub(super) fn found(&self) -> String {
        match &self.word {
            Word::Number(number) => number.to_string(),
            Word::Name(name) => name.clone(),
            Word::Sign(sign) => sign.to_string(),
            Word::End => "the expression ends".to_string(),
        }
    }
}

/// Cuts an expression into words; the last is [`Word::End`].
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
        let word = match character {
            '0'..='9' | '.' => match written.parse::<f64>() {
                Ok(number) if number.is_finite() => Word::Number(number),
                _ => return Err(wrong(column, Mistake::Number { text: written })),
            },
            'a'..='z' | 'A'..='Z' | '_' => Word::Name(written),
            '+' | '-' | '*' | '/' | '%' | '^' | '(' | ')' | ',' => Word::Sign(character),
            character => return Err(wrong(column, Mistake::Character { character })),
        };
        found.push(Token { word, column });
        at += length;
    }
    found.push(Token { word: Word::End, column: characters.len() + 1 });
    Ok(found)
}

/// Characters of a number: digits and points, and an exponent where digits follow it (`2e` is `2` and a name).
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
