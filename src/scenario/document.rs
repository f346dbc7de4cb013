use std::ops::Range;
use std::path::{Path, PathBuf};

use toml::de::{DeTable, DeValue};

use super::error::{ScenarioError, Wrong};
use super::keys;
use super::model::Parts;
use super::snippet::Snippet;
use crate::options::{Explanation, Mistake, Problem, Value, nearest, read_parts, value_at};

/// A scenario file as it was written, with the place of every key and value.
pub(super) struct Document<'t> {
    path: PathBuf,
    text: &'t str,
    root: DeTable<'t>,
}

impl<'t> Document<'t> {
    /// Reads TOML and checks that it has no sections but those of a scenario.
    pub fn parse(path: &Path, text: &'t str) -> Result<Document<'t>, ScenarioError> {
        let mut document = Document { path: path.to_path_buf(), text, root: DeTable::new() };
        document.root = DeTable::parse(text).map_err(|error| document.mistake(&Mistake::syntax(&error)))?.into_inner();
        for (name, value) in document.root.iter() {
            document
                .check_section(name.get_ref(), value.get_ref())
                .map_err(|wrong| document.wrong(name.span(), wrong))?;
        }
        Ok(document)
    }

    /// Checks that there is a section of this name, and whether it comes once.
    fn check_section(&self, name: &str, value: &DeValue<'_>) -> Result<(), Explanation> {
        let Some((_, is_list)) = keys::section(name) else {
            let headings = || keys::section_names().map(section_heading).collect::<Vec<_>>().join(", ");
            let hint = match (keys::with_key(name).first(), nearest(name, keys::section_names())) {
                (Some(section), _) => format!("`{name}` belongs in [{section}]"),
                (None, Some(known)) => format!("did you mean {}?", section_heading(known)),
                (None, None) => format!("its sections are {}", headings()),
            };
            return Err((format!("a scenario has no section `{name}`"), Some(hint)));
        };
        let fits = match value {
            DeValue::Array(items) if is_list => items.iter().all(|item| item.get_ref().is_table()),
            value => !is_list && value.is_table(),
        };
        match (fits, is_list) {
            (true, _) => Ok(()),
            (false, true) => {
                let hint = format!("write [[{name}]] with two brackets, once per {name}");
                Err((format!("`{name}` is a list of sections"), Some(hint)))
            }
            (false, false) => {
                let hint = format!("write [{name}] on a line of its own, its keys below");
                Err((format!("`{name}` is a section, not a value"), Some(hint)))
            }
        }
    }

    /// The value of a key, if the file writes it.
    pub fn value<T: Value>(&self, key: &str) -> Result<Option<T>, ScenarioError> {
        let read = |value| T::of(value).map_err(|mistake| self.mistake(&mistake.within(key)));
        value_at(&self.root, key).map(read).transpose()
    }

    /// Reads what a section writes over its values.
    pub fn read_section(&self, name: &str, parts: Parts<'_>) -> Result<(), ScenarioError> {
        let Some(table) = value_at(&self.root, name).and_then(|value| value.get_ref().as_table()) else {
            return Ok(());
        };
        read_parts(parts, table).map_err(|mistake| self.mistake(&mistake.within(name)))
    }

    /// Reads a section that is one value, such as a list.
    pub fn read_value(&self, name: &str, value: &mut dyn Value) -> Result<(), ScenarioError> {
        let Some(written) = value_at(&self.root, name) else { return Ok(()) };
        value.read(written).map_err(|mistake| self.mistake(&mistake.within(name)))
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
        Some(value_at(&self.root, key)?.span())
    }

    /// What is wrong with a key or a value, and where the key belongs if another section has it.
    fn mistake(&self, mistake: &Mistake) -> ScenarioError {
        let (message, mut hint) = mistake.explain(self.text);
        match &mistake.problem {
            Problem::UnknownKey(name, known) if nearest(name, known.iter().copied()).is_none() => {
                let elsewhere = keys::with_key(name);
                if (1..=3).contains(&elsewhere.len()) {
                    hint = Some(format!("`{name}` belongs in [{}]", elsewhere.join("] or [")));
                }
            }
            Problem::Syntax(message) => {
                let remedy = match message.as_str() {
                    "duplicate key" => {
                        "write each key and each section once; only [[route]], [[stop]], [[door]], [[fixture]] and [[unit]] may come again"
                    }
                    _ if self.line_at(mistake.span.start).contains('\\') => {
                        "write the path with slashes, \"plans/office.png\", or in single quotes: 'C:\\plans\\office.png'"
                    }
                    _ => "texts stand in quotes, lists in [brackets], and a section begins with its [name]",
                };
                hint = Some(remedy.to_string());
            }
            _ => {}
        }
        self.wrong(mistake.span.clone(), (message, hint))
    }

    /// The line that a place of the file lies in.
    fn line_at(&self, at: usize) -> &'t str {
        let at = self.text.floor_char_boundary(at.min(self.text.len()));
        let start = self.text[..at].rfind('\n').map_or(0, |newline| newline + 1);
        self.text[start..].lines().next().unwrap_or("")
    }

    fn wrong(&self, span: Range<usize>, (message, hint): Explanation) -> ScenarioError {
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
        || keys::section(&name).is_some()
        || !keys::with_key(&name).is_empty()
        || text[..line_start].lines().any(|line| is_header(line) && keys::section(&name_of(line)).is_some())
}

/// A section as a file begins it.
fn section_heading(name: &str) -> String {
    if keys::section(name).is_some_and(|(_, list)| list) { format!("[[{name}]]") } else { format!("[{name}]") }
}
