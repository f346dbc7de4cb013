use super::document::Document;
use super::error::ScenarioError;
use super::model::Scenario;
use crate::crowd::CrowdModel;
use crate::formation::FormationRequest;
use crate::options::{OptionError, check_parts, nearest};
use crate::routes::{PlaceRequest, Timetable, ViaRequest};

impl Scenario {
    /// Checks every value against its range, and shows the first that is beyond it in the file that wrote it.
    pub(super) fn check(&self, document: Option<&Document<'_>>) -> Result<(), ScenarioError> {
        let wrong = |key: &str, message: String, hint: Option<String>| match document {
            Some(document) => document.wrong_value(key, message, hint),
            None => ScenarioError::Value { message, hint },
        };
        let refused = |error: OptionError| wrong(error.key(), error.problem(), error.hint());
        let mut scenario = self.clone();
        for (name, parts) in scenario.sections(&mut None) {
            let values = parts.iter().map(|(field, value)| (*field, &**value));
            check_parts(values).map_err(|error| refused(error.within(name)))?;
        }
        for (name, value) in scenario.lists() {
            value.check(None).map_err(|error| refused(error.within(name)))?;
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
        if self.plan.width_m.is_some() && (self.plan.metres_per_pixel.is_some() || self.plan.scale.is_some()) {
            let other = if self.plan.scale.is_some() { "scale" } else { "metres_per_pixel" };
            let message = format!("[plan] has both width_m and {other}");
            return Err(wrong("plan.width_m", message, Some("leave one of the two out".to_string())));
        }
        if self.motion_file.is_some() && self.formation.is_some() {
            let message = "the scenario has both a recording, in [motion], and a [formation]".to_string();
            let hint = "leave one of the two out; a recording can be the formation's example".to_string();
            return Err(wrong("formation", message, Some(hint)));
        }
        self.formation.as_ref().map_or(Ok(()), FormationRequest::check).map_err(refused)?;
        self.check_stops().map_err(|(key, message, hint)| wrong(&key, message, hint))?;
        self.check_places().map_err(refused)?;
        if !self.units.is_empty() && self.crowd.model != CrowdModel::SocialForce {
            let hint = "write model = \"social-force\", or leave it out".to_string();
            let message =
                "a scenario with [[unit]] needs the social force model, whose people walk in groups".to_string();
            return Err(wrong("crowd.model", message, Some(hint)));
        }
        // The stages' own checks: for what concerns more than one key.
        self.texture.check().map_err(|error| wrong("texture.tile", error.to_string(), error.hint()))?;
        use crate::{crowd::CrowdError, look::LookError, marks::MarksError, stamps::StampsError};
        match (self.crowd.check(), self.marks.check(), self.stamps.check(), self.look.check()) {
            (Err(CrowdError::Option(error)), ..)
            | (_, Err(MarksError::Option(error)), ..)
            | (_, _, Err(StampsError::Option(error)), _)
            | (.., Err(LookError::Option { error, .. })) => Err(refused(error)),
            _ => Ok(()),
        }
    }
}

/// A key, what is wrong with it, and a hint.
type Wrong = (String, String, Option<String>);

impl Scenario {
    /// Stops that are right in themselves, of different names, and routes that name them right.
    fn check_stops(&self) -> Result<(), Wrong> {
        let stops = &self.routes.stops;
        for (index, stop) in stops.iter().enumerate() {
            stop.check().map_err(|error| {
                let error = error.within(&format!("stop.{index}"));
                (error.key().to_string(), error.problem(), error.hint())
            })?;
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
                        let is_side = nearest(&side, ["north", "south", "east", "west"].into_iter()).is_some();
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
        let nearest = nearest(name, lower.iter().map(String::as_str));
        let found = nearest.and_then(|nearest| lower.iter().position(|known| known == nearest));
        let names: Vec<&str> = self.routes.stops.iter().map(|stop| stop.name.as_str()).collect();
        match found {
            Some(index) => format!("did you mean \"{}\"?", names[index]),
            None if names.is_empty() => "each [[stop]] has a `name`; routes name it in `via`".to_string(),
            None => format!("the stops are \"{}\"", names.join("\", \"")),
        }
    }

    /// Doors, fixtures, spots and timetables that are right in themselves; whether there is a wall for them the plan tells.
    fn check_places(&self) -> Result<(), OptionError> {
        fn each<T>(list: &str, items: &[T], check: impl Fn(&T) -> Result<(), OptionError>) -> Result<(), OptionError> {
            let checked = |(index, item)| check(item).map_err(|error| error.within(&format!("{list}.{index}")));
            items.iter().enumerate().try_for_each(checked)
        }
        each("door", &self.doors, |door| door.check())?;
        each("fixture", &self.fixtures, |fixture| fixture.check())?;
        each("unit", &self.units, |spot| spot.check())?;
        each("route", &self.routes.routes, |route| {
            let checked = route.arrivals.as_ref().map_or(Ok(()), Timetable::check);
            checked.map_err(|error| error.within("arrivals"))
        })
    }
}
