use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::field::Kind;

/// A value as a file writes it, with its place.
pub(crate) type Spot<'t> = Spanned<DeValue<'t>>;

/// A key or a value that cannot be read.
#[derive(Clone)]
pub(crate) struct Mistake {
    /// Its place, bytes.
    pub span: Range<usize>,
    /// Path of the table or, of a value, its key; entries of lists count from 0.
    pub path: String,
    /// What is wrong.
    pub problem: Problem,
}

/// What is wrong with a key or a value.
#[derive(Clone)]
pub(crate) enum Problem {
    /// The table has no such key, but these.
    UnknownKey(String, Vec<&'static str>),
    /// The table lacks this key.
    Missing(&'static str),
    /// The value is not what the key takes.
    Unlike(Kind),
    /// The text is not TOML.
    Syntax(String),
}

impl Mistake {
    pub fn new(value: &Spot<'_>, problem: Problem) -> Mistake {
        Mistake { span: value.span(), path: String::new(), problem }
    }

    pub fn within(mut self, outer: &str) -> Mistake {
        self.path = if self.path.is_empty() { outer.to_string() } else { format!("{outer}.{}", self.path) };
        self
    }

    /// Of a text that is not TOML.
    pub fn syntax(error: &toml::de::Error) -> Mistake {
        let problem = Problem::Syntax(error.message().to_string());
        Mistake { span: error.span().unwrap_or(0..0), path: String::new(), problem }
    }
}

/// The value of a key such as `route.0.from`.
pub(crate) fn value_at<'d, 't>(table: &'d DeTable<'t>, path: &str) -> Option<&'d Spot<'t>> {
    let find = |table: &'d DeTable<'t>, key: &str| {
        table.iter().find(|(name, _)| name.get_ref() == key).map(|(_, value)| value)
    };
    let mut parts = path.split('.');
    let mut value = find(table, parts.next()?)?;
    for part in parts {
        value = match value.get_ref() {
            DeValue::Table(table) => find(table, part)?,
            DeValue::Array(items) => items.get(part.parse::<usize>().ok()?)?,
            _ => return None,
        };
    }
    Some(value)
}
