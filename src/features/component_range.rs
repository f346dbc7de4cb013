use std::fmt;
use std::str::FromStr;

/// The components that a rule changes, numbered from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ComponentRange {
    /// All components.
    All,
    /// The components from the first number to the last, both included.
    Numbers(usize, usize),
    /// The components from a number on.
    From(usize),
}

/// A text that is not a rule for components.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ComponentsError {
    /// A text without `=`.
    #[error("{text:?} has no = between components and expression")]
    NoEquals {
        /// The text as written.
        text: String,
    },
    /// A text that is neither a number nor a range.
    #[error("{text:?} is not a range of components")]
    NotARange {
        /// The text as written.
        text: String,
    },
    /// A range whose end is before its start.
    #[error("{text:?}: the range ends before it starts")]
    Backwards {
        /// The text as written.
        text: String,
    },
    /// The component number 0.
    #[error("{text:?}: components are numbered from 1")]
    Zero {
        /// The text as written.
        text: String,
    },
}

impl ComponentsError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        Some("write 1=2.0, 2..5=sin(2*pi*t/5), 3..=0 or all=2.0; a range includes both its ends".to_string())
    }
}

impl FromStr for ComponentRange {
    type Err = ComponentsError;

    /// Reads `all`, `3`, `2..5` (both included) or `2..`.
    fn from_str(text: &str) -> Result<ComponentRange, ComponentsError> {
        let text = text.trim();
        let owned = || text.to_string();
        let number = |part: &str| -> Result<usize, ComponentsError> {
            let digits = part.trim();
            let is_number = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
            match digits.parse() {
                Ok(0) => Err(ComponentsError::Zero { text: owned() }),
                Ok(number) if is_number => Ok(number),
                _ => Err(ComponentsError::NotARange { text: owned() }),
            }
        };
        if text.eq_ignore_ascii_case("all") {
            return Ok(ComponentRange::All);
        }
        match text.split_once("..") {
            None => number(text).map(|only| ComponentRange::Numbers(only, only)),
            Some((first, "")) => number(first).map(ComponentRange::From),
            Some((first, last)) => match (number(first)?, number(last)?) {
                (first, last) if first <= last => Ok(ComponentRange::Numbers(first, last)),
                _ => Err(ComponentsError::Backwards { text: owned() }),
            },
        }
    }
}

impl fmt::Display for ComponentRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ComponentRange::All => f.write_str("all"),
            ComponentRange::Numbers(first, last) if first == last => write!(f, "{first}"),
            ComponentRange::Numbers(first, last) => write!(f, "{first}..{last}"),
            ComponentRange::From(first) => write!(f, "{first}.."),
        }
    }
}

impl ComponentRange {
    /// Whether a component, numbered from 1, is in the range.
    pub fn contains(&self, number: usize) -> bool {
        match *self {
            ComponentRange::All => true,
            ComponentRange::Numbers(first, last) => number >= first && number <= last,
            ComponentRange::From(first) => number >= first,
        }
    }

    /// The largest number that the range needs to exist.
    pub(super) fn largest(&self) -> usize {
        match *self {
            ComponentRange::All => 1,
            ComponentRange::Numbers(_, last) => last,
            ComponentRange::From(first) => first,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_read_and_written() {
        for (text, range) in [
            ("all", ComponentRange::All),
            ("3", ComponentRange::Numbers(3, 3)),
            ("2..5", ComponentRange::Numbers(2, 5)),
            ("4..", ComponentRange::From(4)),
        ] {
            assert_eq!(text.parse(), Ok(range));
            assert_eq!(range.to_string(), text);
        }
        for text in ["", "0", "0..3", "x", "-1", "+1", "5..2", "..4", "1..x", "1...3", "99999999999999999999999"] {
            assert!(text.parse::<ComponentRange>().is_err(), "{text}");
        }
    }
}
