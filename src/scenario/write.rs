use std::fmt::Write;
use std::path::PathBuf;

use toml::{Table, Value};

use super::keys;
use super::model::Scenario;
use crate::options::{self, Field, write_parts};

/// Comments begin in this column where the value leaves room.
const COMMENT_COLUMN: usize = 36;
/// Lines are not longer than this where a comment can stand above instead.
const WIDTH: usize = 118;
/// Keys of a table on one line, in the order in which people say them.
const PAIR_ORDER: [&str; 9] = ["kind", "mean", "size_m", "sd", "min", "max", "from", "to", "metres"];
/// What stands above the sections that may be missing or come several times.
const ABOUT: [(&str, &str); 7] = [
    (
        keys::FORMATION,
        "Formations that a crowd takes up one after another, in the place of one that walks. Key formations stand\n\
         # each in a [[formation.key]], small crowds in the places of individuals each in a [[formation.crowd]]:",
    ),
    (
        keys::ROUTE,
        "Routes, each in a [[route]] of its own. Without any, people use all rooms; a single space they cross:",
    ),
    (keys::STOP, "Places where people stop, each in a [[stop]] of its own; routes name them in `via`:"),
    (keys::ROOM, "What is known of rooms, each in a [[room]] of its own; what is left out the plan tells:"),
    (keys::DOOR, "Doors, each in a [[door]] of its own. Gaps of 0.7 to 2.0 m in walls are found without:"),
    (
        keys::FIXTURE,
        "What people touch on walls, each in a [[fixture]] of its own; counters, machines and benches of stops are found:",
    ),
    (keys::UNIT, "Spots that are looked at closely, each in a [[unit]] of its own: people near them play crowd units:"),
];

impl Scenario {
    /// The scenario as a file: every key with its value and what it means, ready to be edited.
    ///
    /// Reading the text back gives the same scenario.
    pub fn to_toml(&self) -> String {
        let table = table_of(self);
        let mut text = String::new();
        for section in keys::section_names().filter_map(keys::section).map(|(section, _)| section) {
            match ABOUT.iter().find(|(name, _)| *name == section.name) {
                None => push_section(&mut text, section, section.name, &table),
                Some((_, about)) => {
                    let _ = writeln!(text, "\n# {about}");
                    push_explained(&mut text, section, section.name);
                    let own =
                        table.get(section.name).filter(|value| value.as_array().is_none_or(|list| !list.is_empty()));
                    push_list(&mut text, section, own);
                }
            }
        }
        text
    }

    /// All values, for a manifest that is the same wherever the files lie: of paths only the names are left.
    pub fn settings(&self) -> serde_json::Value {
        let name = |path: &PathBuf| path.file_name().map(PathBuf::from).unwrap_or_default();
        let mut scenario = self.clone();
        scenario.image = self.image.as_ref().map(name);
        scenario.plan.paint = self.plan.paint.as_ref().map(name);
        scenario.motion_file = self.motion_file.as_ref().map(name);
        scenario.pattern_folder = self.pattern_folder.as_ref().map(name);
        for image in scenario.look.images().into_iter().flatten() {
            *image = name(image);
        }
        for timetable in scenario.timetables() {
            timetable.file = timetable.file.as_ref().map(name);
        }
        for spot in &mut scenario.units {
            spot.folder = spot.folder.as_ref().map(name);
        }
        // Only numbers that JSON cannot hold stop it, and those were refused when the scenario was read.
        serde_json::to_value(table_of(&scenario)).unwrap_or_default()
    }
}

/// A section with its values, then those within it.
fn push_section(text: &mut String, section: &Field, path: &str, around: &Table) {
    let Some((fields, _)) = section.section() else { return };
    let none = Table::new();
    let table = around.get(section.name).and_then(Value::as_table).unwrap_or(&none);
    let gap = if text.is_empty() { "" } else { "\n" };
    push_commented(text, &format!("{gap}[{path}]"), &section.about());
    for field in fields.fields().filter(|field| field.section().is_none()) {
        let line = match table.get(field.name) {
            Some(value) => format!("{} = {}", field.name, inline(value)),
            None => format!("# {} = {}", field.name, field.example),
        };
        push_commented(text, &line, &comment(field));
    }
    for field in fields.fields().filter(|field| field.section().is_some()) {
        let inner = format!("{path}.{}", field.name);
        match field.section() {
            Some((_, true)) => {
                push_explained(text, field, &inner);
                // Items of an inner list, behind what they may have.
                let own = table.get(field.name).filter(|list| list.as_array().is_some_and(|list| !list.is_empty()));
                let nested = own.map(|list| {
                    inner
                        .rsplit('.')
                        .fold(list.clone(), |value, name| Table::from_iter([(name.to_string(), value)]).into())
                });
                if let Some(nested) = nested {
                    let _ = write!(text, "\n{}", toml::to_string(&nested).unwrap_or_default());
                }
            }
            _ => push_section(text, field, &inner, table),
        }
    }
}

/// What the keys of a section mean that need not be there, then those within it.
fn push_explained(text: &mut String, section: &Field, path: &str) {
    let Some((fields, is_list)) = section.section() else { return };
    let heading = if is_list { format!("[[{path}]]") } else { format!("[{path}]") };
    text.push_str("#\n");
    push_commented(text, &format!("# {heading}"), &section.about());
    for field in fields.fields().filter(|field| field.section().is_none()) {
        let default = || (field.default)().as_ref().map_or_else(String::new, inline);
        let value = if field.example.is_empty() { default() } else { field.example.to_string() };
        push_commented(text, &format!("# {} = {value}", field.name), &comment(field));
    }
    for field in fields.fields().filter(|field| field.section().is_some()) {
        push_explained(text, field, &format!("{path}.{}", field.name));
    }
}

/// The values of such a section, if there are any.
fn push_list(text: &mut String, section: &Field, value: Option<&Value>) {
    match value {
        Some(Value::Array(items)) => {
            let Some((fields, _)) = section.section() else { return };
            for item in items {
                let _ = writeln!(text, "\n[[{}]]", section.name);
                for field in fields.fields() {
                    if let Some(value) = item.get(field.name) {
                        let _ = writeln!(text, "{} = {}", field.name, inline(value));
                    }
                }
            }
        }
        Some(value) => {
            let whole = Table::from_iter([(section.name.to_string(), value.clone())]);
            let _ = write!(text, "\n{}", toml::to_string(&whole).unwrap_or_default());
        }
        None => {}
    }
}

/// What a key is, and what it may be.
fn comment(field: &Field) -> String {
    match field.limits {
        None => field.about(),
        Some(options::Limits { low, high, open: false }) => format!("{}, {low} to {high}", field.about()),
        Some(options::Limits { low, high, open: true }) => format!("{}, {low} <= h < {high}", field.about()),
    }
}

fn push_commented(text: &mut String, line: &str, comment: &str) {
    let column = line.chars().count().max(COMMENT_COLUMN - 2) + 2;
    let _ = if comment.is_empty() {
        writeln!(text, "{line}")
    } else if column + 2 + comment.chars().count() <= WIDTH {
        writeln!(text, "{line:<width$}# {comment}", width = column)
    } else {
        writeln!(text, "# {comment}\n{line}")
    };
}

/// A value on one line.
fn inline(value: &Value) -> String {
    match value {
        Value::Float(number) if !number.is_finite() => number.to_string().to_lowercase(),
        Value::Float(number) => format!("{number:?}"),
        Value::Array(items) => format!("[{}]", items.iter().map(inline).collect::<Vec<_>>().join(", ")),
        Value::Table(table) => {
            let mut pairs: Vec<_> = table.iter().collect();
            pairs.sort_by_key(|(key, _)| PAIR_ORDER.iter().position(|known| known == key));
            let pairs: Vec<_> = pairs.iter().map(|(key, value)| format!("{key} = {}", inline(value))).collect();
            format!("{{ {} }}", pairs.join(", "))
        }
        other => other.to_string(),
    }
}

/// All values as one TOML table, in sections as a file has them.
pub(super) fn table_of(scenario: &Scenario) -> Table {
    let mut scenario = scenario.clone();
    let mut table = Table::new();
    for (name, parts) in scenario.sections(&mut None) {
        let values = parts.iter().map(|(field, value)| (*field, &**value));
        table.insert(name.to_string(), Value::Table(write_parts(values)));
    }
    let lists = scenario.lists().into_iter().filter_map(|(name, value)| Some((name.to_string(), value.write()?)));
    table.extend(lists);
    table
}
