use toml::{Table, Value};

use super::document::Document;
use super::error::ScenarioError;
use super::keys::{self, Allowed, KEYS, Key};
use super::{Scenario, write};
use crate::math::Distribution;

/// What a quantity that differs from person to person may be written with.
const SPREAD_PARTS: [&str; 4] = ["mean", "sd", "min", "max"];

impl Scenario {
    /// Checks every value against its range, and shows the first that is beyond it in the file that wrote it.
    pub(super) fn check(&self, document: Option<&Document<'_>>) -> Result<(), ScenarioError> {
        let wrong = |key: &str, message: String, hint: Option<String>| match document {
            Some(document) => document.wrong_value(key, message, hint),
            None => ScenarioError::Value { message, hint },
        };
        let table = write::table_of(self)
            .map_err(|error| wrong("", format!("the scenario cannot be written as TOML: {error}"), None))?;
        for key in KEYS {
            for (place, value) in values_of(&table, key) {
                if let Some(problem) = key.problem(value) {
                    return Err(wrong(&place, problem, None));
                }
            }
        }
        if self.plan.metres_per_pixel.is_some() && self.plan.scale.is_some() {
            let message = "[plan] has both metres_per_pixel and scale".to_string();
            return Err(wrong("plan.scale", message, Some("leave one of the two out".to_string())));
        }
        // The stages' own checks: for what concerns more than one key.
        let crowd = self.crowd.check().map_err(|error| ("crowd", error.to_string(), error.hint()));
        let marks = self.marks.check().map_err(|error| ("marks", error.to_string(), error.hint()));
        let stamps = self.stamps.check().map_err(|error| ("stamps", error.to_string(), error.hint()));
        let look = self.look.check().map_err(|error| ("look", error.to_string(), error.hint()));
        let all = crowd.and(marks).and(stamps).and(look);
        all.map_err(|(section, message, hint)| wrong(section, message, hint))
    }
}

impl Key {
    /// What is wrong with a value, if anything is.
    fn problem(&self, value: &Value) -> Option<String> {
        let name = self.name();
        match self.allowed {
            Allowed::Any => None,
            Allowed::Number(low, high) => numbers(value)
                .into_iter()
                // Written so that NaN is out of range.
                .find(|&number| !(number >= low && number <= high))
                .map(|number| format!("`{name}` is {number}, allowed is {low} to {high}")),
            Allowed::Below(low, high) => numbers(value)
                .into_iter()
                .find(|&number| !(number >= low && number < high))
                .map(|number| format!("`{name}` is {number}, allowed is at least {low}, and less than {high}")),
            Allowed::Spread(low, high) => {
                let parts = value.as_table().into_iter().flat_map(Table::keys);
                if let Some(unknown) = parts.into_iter().find(|part| !SPREAD_PARTS.contains(&part.as_str())) {
                    return Some(format!("`{name}` has no part `{unknown}`; it has {}", SPREAD_PARTS.join(", ")));
                }
                let spread: Distribution = value.clone().try_into().ok()?;
                spread.check(low, high).err().map(|error| format!("`{name}`: {error}"))
            }
        }
    }
}

/// All values of a key, with their places: one, none, or one per route.
fn values_of<'t>(table: &'t Table, key: &Key) -> Vec<(String, &'t Value)> {
    if key.section() != keys::ROUTE {
        return value_at(table, key.path).map(|value| (key.path.to_string(), value)).into_iter().collect();
    }
    let routes = table.get(keys::ROUTE).and_then(Value::as_array).into_iter().flatten().enumerate();
    routes
        .filter_map(|(index, route)| Some((format!("route.{index}.{}", key.name()), route.get(key.name())?)))
        .collect()
}

/// The numbers in a value: itself, or those of a list.
fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Integer(number) => vec![*number as f64],
        Value::Float(number) => vec![write::shortest(*number)],
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        _ => Vec::new(),
    }
}

/// The value of a key such as `look.film.density`.
pub(super) fn value_at<'t>(table: &'t Table, path: &str) -> Option<&'t Value> {
    match path.split_once('.') {
        None => table.get(path),
        Some((section, rest)) => value_at(table.get(section)?.as_table()?, rest),
    }
}
