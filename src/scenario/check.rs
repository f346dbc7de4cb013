use toml::{Table, Value};

use super::document::Document;
use super::error::ScenarioError;
use super::explain;
use super::keys::{self, Allowed, KEYS, Key};
use super::{Scenario, write};
use crate::crowd::CrowdModel;
use crate::formation::{FormationRequest, RequestError};
use crate::math::Distribution;
use crate::routes::{PlaceRequest, ViaRequest};

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
        if self.image.is_none() && self.motion_file.is_none() && self.formation.is_none() {
            let message = "the scenario names no plan".to_string();
            let hint = "write [plan] image = \"plan.png\"; only a given motion needs no plan".to_string();
            return Err(wrong("plan.image", message, Some(hint)));
        }
        if self.plan.metres_per_pixel.is_some() && self.plan.scale.is_some() {
            let message = "[plan] has both metres_per_pixel and scale".to_string();
            return Err(wrong("plan.scale", message, Some("leave one of the two out".to_string())));
        }
        if self.motion_file.is_some() && self.formation.is_some() {
            let message = "the scenario has both a recording, in [motion], and a [formation]".to_string();
            let hint = "leave one of the two out; a recording can be the formation's example".to_string();
            return Err(wrong("formation", message, Some(hint)));
        }
        if let Some(Err(RequestError::Value { key, problem, hint })) =
            self.formation.as_ref().map(FormationRequest::check)
        {
            return Err(wrong(&key, problem, hint));
        }
        self.check_stops().map_err(|(key, message, hint)| wrong(&key, message, hint))?;
        self.check_places().map_err(|(key, message)| wrong(&key, message, None))?;
        if !self.units.is_empty() && self.crowd.model != CrowdModel::SocialForce {
            let hint = "write model = \"social-force\", or leave it out".to_string();
            let message =
                "a scenario with [[unit]] needs the social force model, whose people walk in groups".to_string();
            return Err(wrong("crowd.model", message, Some(hint)));
        }
        self.check_timetables().map_err(|(key, message)| wrong(&key, message, None))?;
        // The stages' own checks: for what concerns more than one key.
        self.texture.check().map_err(|error| wrong("texture.tile", error.to_string(), error.hint()))?;
        let crowd = self.crowd.check().map_err(|error| ("crowd", error.to_string(), error.hint()));
        let marks = self.marks.check().map_err(|error| ("marks", error.to_string(), error.hint()));
        let stamps = self.stamps.check().map_err(|error| ("stamps", error.to_string(), error.hint()));
        let look = self.look.check().map_err(|error| ("look", error.to_string(), error.hint()));
        let all = crowd.and(marks).and(stamps).and(look);
        all.map_err(|(section, message, hint)| wrong(section, message, hint))
    }
}

/// A key, what is wrong with it, and a hint.
type Wrong = (String, String, Option<String>);

impl Scenario {
    /// Stops that are right in themselves, of different names, and routes that name them right.
    fn check_stops(&self) -> Result<(), Wrong> {
        let stops = &self.routes.stops;
        for (index, stop) in stops.iter().enumerate() {
            stop.check().map_err(|(key, problem)| (format!("stop.{index}.{key}"), problem, None))?;
            if stops[..index].iter().any(|other| other.name == stop.name) {
                let hint = "give each [[stop]] a name of its own".to_string();
                let message = format!("there are two stops called \"{}\"", stop.name);
                return Err((format!("stop.{index}.name"), message, Some(hint)));
            }
        }
        for (index, route) in self.routes.routes.iter().enumerate() {
            for (number, via) in route.via.iter().enumerate() {
                let key = format!("route.{index}.via.{number}");
                let unknown = match (via.stop(stops), via) {
                    (Some((name, share)), _) => {
                        if !(0.0..=1.0).contains(&share) {
                            let message = format!("`share` is {share}, allowed is 0 to 1");
                            return Err((format!("{key}.share"), message, None));
                        }
                        Some(name).filter(|name| stops.iter().all(|stop| stop.name != *name))
                    }
                    // Openings are named after the plan's sides.
                    (None, ViaRequest::Place(PlaceRequest::Opening(name))) if !stops.is_empty() => {
                        let side = name.split_whitespace().next().unwrap_or("").to_lowercase();
                        let is_side = explain::nearest(&side, ["north", "south", "east", "west"].into_iter()).is_some();
                        Some(name.as_str()).filter(|_| !is_side)
                    }
                    (None, _) => None,
                };
                if let Some(name) = unknown {
                    return Err((key, format!("there is no stop called \"{name}\""), Some(self.stop_like(name))));
                }
            }
        }
        Ok(())
    }

    fn stop_like(&self, name: &str) -> String {
        let lower: Vec<String> = self.routes.stops.iter().map(|stop| stop.name.to_lowercase()).collect();
        let nearest = explain::nearest(name, lower.iter().map(String::as_str));
        let found = nearest.and_then(|nearest| lower.iter().position(|known| known == nearest));
        let names: Vec<&str> = self.routes.stops.iter().map(|stop| stop.name.as_str()).collect();
        match found {
            Some(index) => format!("did you mean \"{}\"?", names[index]),
            None if names.is_empty() => "each [[stop]] has a `name`; routes name it in `via`".to_string(),
            None => format!("the stops are \"{}\"", names.join("\", \"")),
        }
    }

    /// Doors, fixtures and spots that are right in themselves; whether there is a wall for them the plan tells.
    fn check_places(&self) -> Result<(), (String, String)> {
        for (index, door) in self.doors.iter().enumerate() {
            door.check().map_err(|(key, problem)| (format!("door.{index}.{key}"), problem))?;
        }
        for (index, fixture) in self.fixtures.iter().enumerate() {
            fixture.check().map_err(|(key, problem)| (format!("fixture.{index}.{key}"), problem))?;
        }
        for (index, spot) in self.units.iter().enumerate() {
            spot.check().map_err(|(key, problem)| (format!("unit.{index}.{key}"), problem))?;
        }
        Ok(())
    }

    fn check_timetables(&self) -> Result<(), (String, String)> {
        let at = |section: String| move |(key, problem): (&str, String)| (format!("{section}.{key}"), problem);
        self.crowd.arrivals.check().map_err(at("crowd.arrivals".to_string()))?;
        for (index, route) in self.routes.routes.iter().enumerate() {
            if let Some(arrivals) = &route.arrivals {
                arrivals.check().map_err(at(format!("route.{index}.arrivals")))?;
            }
        }
        Ok(())
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

/// All values of a key, with their places: one, none, or one per route or stop.
fn values_of<'t>(table: &'t Table, key: &Key) -> Vec<(String, &'t Value)> {
    let list = key.section();
    // Formations check themselves: they stand within each other.
    if keys::FORMATION_SECTIONS.contains(&list) {
        return Vec::new();
    }
    if !keys::LISTS.contains(&list) {
        return value_at(table, key.path).map(|value| (key.path.to_string(), value)).into_iter().collect();
    }
    let items = table.get(list).and_then(Value::as_array).into_iter().flatten().enumerate();
    items.filter_map(|(index, item)| Some((format!("{list}.{index}.{}", key.name()), item.get(key.name())?))).collect()
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
