use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

use super::error::{ScenarioError, Wrong};
use super::explain;
use super::keys;
use super::snippet::Snippet;

/// A scenario file as it was written, with the place of every key and value.
pub(super) struct Document<'t> {
    path: PathBuf,
    text: &'t str,
    root: DeTable<'t>,
}

/// A table of the file, on its way into an options struct.
pub(super) struct Section<'d, 't> {
    document: &'d Document<'t>,
    name: &'static str,
    table: DeTable<'t>,
    span: Range<usize>,
    taken: Vec<&'static str>,
}

impl<'t> Document<'t> {
    /// Reads TOML and checks that it has no sections but those of a scenario.
    pub fn parse(path: &Path, text: &'t str) -> Result<Document<'t>, ScenarioError> {
        let mut document = Document { path: path.to_path_buf(), text, root: DeTable::new() };
        document.root = DeTable::parse(text).map_err(|error| document.syntax(&error))?.into_inner();
        for (name, value) in document.root.iter() {
            let name_text = name.get_ref().as_ref();
            if !keys::SECTIONS.contains(&name_text) {
                return Err(document.wrong(name.span(), explain::unknown_section(name_text)));
            }
            let wants_list = keys::LISTS.contains(&name_text);
            let is_list = value.get_ref().as_array().is_some_and(|a| a.iter().all(|v| v.get_ref().is_table()));
            if wants_list && !is_list {
                return Err(document.wrong(name.span(), explain::not_a_list(name_text)));
            }
            if !wants_list && !value.get_ref().is_table() {
                return Err(document.wrong(name.span(), explain::not_a_section(name_text)));
            }
        }
        Ok(document)
    }

    /// Whether the file has a section.
    pub fn has(&self, name: &str) -> bool {
        find(&self.root, name).is_some()
    }

    /// A section, empty if the file does not have it.
    pub fn section(&self, name: &'static str) -> Section<'_, 't> {
        let found = self.root.iter().find(|(key, _)| key.get_ref() == name);
        let (table, span) = match found {
            Some((_, value)) => (value.get_ref().as_table().cloned().unwrap_or_default(), value.span()),
            None => (DeTable::new(), 0..0),
        };
        Section { document: self, name, table, span, taken: Vec::new() }
    }

    /// The list of tables of this name, empty if the file has none.
    pub fn list<T: DeserializeOwned>(&self, name: &'static str) -> Result<Vec<T>, ScenarioError> {
        let Some((_, value)) = self.root.iter().find(|(key, _)| key.get_ref() == name) else { return Ok(Vec::new()) };
        let value = value.clone();
        Vec::<T>::deserialize(ValueDeserializer::from(value)).map_err(|error| self.of_value(&error, name, &[]))
    }

    /// What is wrong with the value of a key such as `crowd.people`, shown where the file writes it; without a place
    /// where the file does not.
    pub fn wrong_value(&self, key: &str, message: String, hint: Option<String>) -> ScenarioError {
        match self.span_of(key) {
            Some(span) => self.wrong(span, (message, hint)),
            None => ScenarioError::Value { message: format!("{}: {message}", self.path.display()), hint },
        }
    }

    /// Text of the value of a key, as the file writes it.
    pub fn text_of(&self, key: &str) -> Option<&'t str> {
        self.text.get(self.span_of(key)?)
    }

    fn span_of(&self, key: &str) -> Option<Range<usize>> {
        let mut parts = key.split('.');
        let mut value = find(&self.root, parts.next()?)?;
        for part in parts {
            value = match value.get_ref() {
                DeValue::Table(table) => find(table, part)?,
                DeValue::Array(items) => items.get(part.parse::<usize>().ok()?)?,
                _ => return None,
            };
        }
        Some(value.span())
    }

    fn syntax(&self, error: &toml::de::Error) -> ScenarioError {
        self.wrong(error.span().unwrap_or(0..0), explain::syntax(error.message()))
    }

    /// What serde did not like about a value.
    fn of_value(&self, error: &toml::de::Error, section: &str, own_keys: &[&str]) -> ScenarioError {
        let span = error.span().unwrap_or(0..0);
        let found = self.text.get(span.clone()).unwrap_or("");
        let key = self.key_around(&span);
        let section = self.table_with(&span).unwrap_or_else(|| section.to_string());
        self.wrong(span, explain::value(error.message(), &section, key.as_deref(), found, own_keys))
    }

    /// Path of the table that stands at a place or has a key written there, as in `look.film`: what is wrong with a key is
    /// told at its name, a key that is missing at its table.
    fn table_with(&self, place: &Range<usize>) -> Option<String> {
        fn search(table: &DeTable<'_>, place: &Range<usize>, path: &str) -> Option<String> {
            table.iter().find_map(|(name, value)| {
                if name.span() == *place {
                    return Some(path.to_string());
                }
                let path =
                    if path.is_empty() { name.get_ref().to_string() } else { format!("{path}.{}", name.get_ref()) };
                let within = |value: &Spanned<DeValue<'_>>| {
                    let table = value.get_ref().as_table()?;
                    search(table, place, &path).or_else(|| (value.span() == *place).then(|| path.clone()))
                };
                match value.get_ref() {
                    DeValue::Array(items) => items.iter().find_map(within),
                    _ => within(value),
                }
            })
        }
        search(&self.root, place, "").filter(|path| !path.is_empty())
    }

    /// Name of the innermost key whose value covers a place.
    fn key_around(&self, span: &Range<usize>) -> Option<String> {
        fn search(value: &DeValue<'_>, span: &Range<usize>) -> Option<String> {
            let covers = |outer: Range<usize>| outer.start <= span.start && span.end <= outer.end;
            match value {
                DeValue::Table(table) => table.iter().find_map(|(key, value)| {
                    let inner = search(value.get_ref(), span);
                    inner.or_else(|| covers(value.span()).then(|| key.get_ref().to_string()))
                }),
                DeValue::Array(items) => items.iter().find_map(|item| search(item.get_ref(), span)),
                _ => None,
            }
        }
        self.root.iter().find_map(|(_, value)| search(value.get_ref(), span))
    }

    fn wrong(&self, span: Range<usize>, (message, hint): (String, Option<String>)) -> ScenarioError {
        let start = self.text.floor_char_boundary(span.start.min(self.text.len()));
        let snippet = Snippet::of(&self.path, self.text, span);
        let snippet = if is_scenario(self.text, start) { snippet } else { snippet.without_line() };
        ScenarioError::Wrong(Box::new(Wrong { message, snippet, hint }))
    }
}

/// Whether a line may be repeated in a message, as part of a scenario: a section of a scenario stands in it or above it,
/// or it begins with the name of a key or with the bracket of a section. Lines of any other file are not repeated.
fn is_scenario(text: &str, at: usize) -> bool {
    let line_start = text[..at].rfind('\n').map_or(0, |newline| newline + 1);
    let line = text[line_start..].lines().next().unwrap_or("");
    let name_of = |line: &str| -> String {
        line.trim_start_matches(['[', ' ', '\t', '"'])
            .chars()
            .take_while(|c| c.is_alphanumeric() || *c == '_')
            .collect()
    };
    let is_header = |line: &str| line.trim_start().starts_with('[');
    let name = name_of(line);
    is_header(line)
        || keys::SECTIONS.contains(&name.as_str())
        || !keys::sections_with(&name).is_empty()
        || text[..line_start].lines().any(|line| is_header(line) && keys::SECTIONS.contains(&name_of(line).as_str()))
}

fn find<'d, 't>(table: &'d DeTable<'t>, key: &str) -> Option<&'d Spanned<DeValue<'t>>> {
    table.iter().find(|(name, _)| name.get_ref() == key).map(|(_, value)| value)
}

/// Lays written keys over those of a table, within its tables too; a quantity that differs from person to person is
/// one value, however it is written.
fn laid_over(mut below: toml::Table, above: toml::Table, path: &str) -> toml::Table {
    for (key, value) in above {
        let path = format!("{path}.{key}");
        let merged = match (below.remove(&key), value) {
            (Some(toml::Value::Table(old)), toml::Value::Table(new)) if !keys::is_one_value(&path) => {
                toml::Value::Table(laid_over(old, new, &path))
            }
            (_, value) => value,
        };
        below.insert(key, merged);
    }
    below
}

impl Section<'_, '_> {
    /// Takes one key out, which the scenario reads for itself and not for a stage.
    pub fn take<T: DeserializeOwned>(&mut self, key: &'static str) -> Result<Option<T>, ScenarioError> {
        self.taken.push(key);
        let Some((_, value)) = self.table.remove_entry(key) else { return Ok(None) };
        T::deserialize(ValueDeserializer::from(value))
            .map(Some)
            .map_err(|error| self.document.of_value(&error, self.name, &self.taken))
    }

    /// What is left, as plain values.
    pub fn into_table<T: DeserializeOwned>(self) -> Result<toml::Table, ScenarioError> {
        let rest = |table| ValueDeserializer::from(Spanned::new(self.span.clone(), DeValue::Table(table)));
        // First into the options alone: only there do errors know their place.
        T::deserialize(rest(self.table.clone()))
            .and_then(|_| toml::Table::deserialize(rest(self.table.clone())))
            .map_err(|error| self.document.of_value(&error, self.name, &self.taken))
    }

    /// What is left, for options that start from nothing.
    pub fn into_options<T: DeserializeOwned>(self) -> Result<T, ScenarioError> {
        let value = ValueDeserializer::from(Spanned::new(self.span.clone(), DeValue::Table(self.table)));
        T::deserialize(value).map_err(|error| self.document.of_value(&error, self.name, &self.taken))
    }

    /// Lays what is left over `base`: keys that the file does not write keep their values.
    pub fn over<T: Serialize + DeserializeOwned>(self, base: &T) -> Result<T, ScenarioError> {
        let (document, name) = (self.document, self.name);
        let written = self.into_table::<T>()?;
        let merged = toml::Table::try_from(base).map(|table| laid_over(table, written, name));
        merged
            .map_err(|error| error.to_string())
            .and_then(|table| T::deserialize(table).map_err(|error| error.message().to_string()))
            .map_err(|message| document.wrong_value(name, message, None))
    }
}
