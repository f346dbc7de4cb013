//! Every key is explained, written, read, and refused beyond the range that is documented.

use serde_json::Value;

use super::super::keys::{keys, schema};
use super::{PLAN, parse, shown, stops};
use crate::options::{Field, Kind};
use crate::scenario::{Preset, Scenario};

/// Sections that come several times or need not be there, whose keys go with each other.
fn is_optional(path: &str) -> bool {
    let several = ["formation", "route", "stop", "door", "fixture", "unit", "room"];
    several.contains(&path.split('.').next().unwrap()) || path.starts_with("look.area.")
}

/// Every key of the file, and the keys of the small tables that are written on one line.
fn all() -> Vec<(String, &'static Field)> {
    let inner = |(path, field): &(String, &'static Field)| match (field.kind)() {
        Kind::Table(table) if path.starts_with("look.") => {
            table.fields().map(|field| (format!("{path}.{}", field.name), field)).collect()
        }
        _ => Vec::new(),
    };
    keys().into_iter().flat_map(|key| [inner(&key), vec![key]].concat()).collect()
}

/// A scenario with this value of a key, and what the key cannot be without.
fn text_with(path: &str, value: &str) -> String {
    let (section, name) = path.rsplit_once('.').unwrap();
    let plan = if section == "plan" { "" } else { PLAN };
    let image = if section == "plan" && name != "image" { "image = \"plan.png\"\n" } else { "" };
    let with = stops::companions(path);
    let is_list = is_optional(path)
        && !["formation", "example", "way", "avoid", "floor"].iter().any(|end| section.ends_with(end));
    let heading = match section {
        "look.area.floor" => "[[look.area]]\nroom = [1.0, 1.0]\n[look.area.floor]".to_string(),
        _ if is_list => format!("[[{section}]]"),
        _ => format!("[{section}]"),
    };
    // What else the section requires, as its examples write it.
    let of_section = all()
        .into_iter()
        .filter(|(key, _)| key.rsplit_once('.').unwrap() == (section, key.rsplit('.').next().unwrap()));
    let required: String = of_section
        .filter(|(key, field)| field.required && key != path)
        .map(|(_, field)| format!("{} = {}\n", field.name, field.example))
        .collect();
    format!("{plan}{heading}\n{image}{with}{required}{name} = {value}\n")
}

#[test]
fn a_written_scenario_explains_every_key() {
    let text = Scenario::of_preset(Preset::Commuters).to_toml();
    for (path, field) in keys() {
        assert!(text.contains(&format!("{} = ", field.name)), "{path} is not written");
        let about = field.about();
        assert!(about.len() > 3 && text.contains(&about), "{path} is not explained: {about}");
    }
}

#[test]
fn every_example_of_a_key_without_a_default_reads() {
    let files = ["look.file", "crowd.arrivals.file"];
    for (path, field) in all() {
        if field.example.is_empty() || is_optional(&path) || files.contains(&path.as_str()) {
            continue;
        }
        parse(&text_with(&path, field.example)).unwrap_or_else(|error| panic!("{error}"));
    }
}

/// No key lets a value through that the stage refuses, and none refuses the ends of the range that is documented.
#[test]
fn limits_are_allowed_and_what_lies_beyond_is_not() {
    let mut tested = 0;
    for (path, field) in all() {
        let Some(limits) = field.limits else { continue };
        let kind = (field.kind)();
        let (item, count) = match &kind {
            Kind::List(item, Some(count)) => ((**item).clone(), *count),
            kind => (kind.clone(), 1),
        };
        let whole = matches!(item, Kind::Whole(..));
        let text = |value: f64| {
            let number = if whole { format!("{value}") } else { format!("{value:?}").to_lowercase() };
            let list = format!("[{}]", vec![number.as_str(); count].join(", "));
            text_with(&path, if count > 1 { &list } else { &number })
        };
        let step = if whole { 1.0 } else { 1e-6 };
        for end in [limits.low, if limits.open { limits.high - step } else { limits.high }] {
            // Each share may be 0, not all of them; a formation with one wrong key is not one with a wrong range.
            let may_not_fit = is_optional(&path) || path == "crowd.groups.shares";
            if let Err(error) = parse(&text(end)) {
                let message = error.to_string();
                assert!(may_not_fit && !message.contains("allowed"), "{path} = {end}: {message}");
            }
        }
        let above = if limits.open { limits.high } else { limits.high * 1.001 + step };
        for beyond in [limits.low - step, above, -1e300, 1e300, f64::NAN, f64::INFINITY] {
            let message = shown(&text(beyond));
            assert!(
                message.contains(field.name) && message.contains(" --> plans/hall.toml:"),
                "{path} = {beyond}: {message}"
            );
        }
        tested += 1;
    }
    assert!(tested > 180, "{tested} keys with a range");
}

#[test]
fn the_schema_is_what_the_declarations_give() {
    let mut text = serde_json::to_string_pretty(&schema()).unwrap();
    text.push('\n');
    snapbox::assert_data_eq!(text, snapbox::file!["../../../docs/scenario.schema.json"].raw());
}

#[test]
fn the_schema_takes_what_is_written_and_refuses_what_is_refused() {
    let schema = schema();
    let wrong = |text: &str| {
        let value = serde_json::to_value(toml::from_str::<toml::Table>(text).unwrap()).unwrap();
        refused(&schema, &schema, &value, "")
    };
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let scenarios = std::fs::read_dir(folder.join("floorplans")).unwrap().map(|entry| entry.unwrap().path());
    let scenarios = scenarios.filter(|path| path.extension().is_some_and(|ending| ending == "toml"));
    let texts: Vec<String> = scenarios
        .chain([folder.join("docs/scenario.toml")])
        .map(|path| std::fs::read_to_string(path).unwrap())
        .collect();
    assert!(texts.len() > 5);
    for text in texts {
        assert_eq!(wrong(&text), None, "{text}");
    }
    for text in [
        "[crowd]\npeple = 3",
        "[crowd]\npeople = 0",
        "[crowd]\nspeed = [9, 10]",
        "[plan]\nwall_height = 3.5",
        "[texture]\ntarget = \"maya\"",
        "[[stop]]\nname = \"bench\"",
        "[[formation.crowd]]\n[[formation.crowd.crowd]]\nsigma_m = 0",
        "[look.noise]\nfine = { sd = 2 }",
    ] {
        assert!(wrong(text).is_some(), "{text}");
        shown(text);
    }
}

/// What a schema refuses in a value: the part of JSON Schema that ours uses.
fn refused(root: &Value, schema: &Value, value: &Value, path: &str) -> Option<String> {
    if let Some(reference) = schema["$ref"].as_str() {
        return refused(root, root.pointer(reference.trim_start_matches('#')).unwrap(), value, path);
    }
    if let Some(kinds) = schema["anyOf"].as_array() {
        let all = kinds.iter().map(|kind| refused(root, kind, value, path)).collect::<Option<Vec<_>>>()?;
        return Some(all.join(", "));
    }
    if let Some(names) = schema["enum"].as_array() {
        return (!names.contains(value)).then(|| format!("{path}: {value}"));
    }
    let fits = match schema["type"].as_str().unwrap() {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "integer" => value.is_i64(),
        "number" => value.is_number(),
        "boolean" => value.is_boolean(),
        "string" => value.is_string(),
        other => panic!("{other}"),
    };
    if !fits {
        return Some(format!("{path}: {value} is no {}", schema["type"]));
    }
    if let Some(number) = value.as_f64() {
        let limit = |name: &str| schema[name].as_f64();
        let within = limit("minimum").is_none_or(|low| number >= low)
            && limit("maximum").is_none_or(|high| number <= high)
            && limit("exclusiveMaximum").is_none_or(|high| number < high);
        return (!within).then(|| format!("{path}: {number}"));
    }
    let count = |name: &str| schema[name].as_u64().map(|count| count as usize);
    let items = value.as_array().into_iter().flatten();
    if value.as_array().is_some_and(|items| count("minItems").is_some_and(|count| count != items.len())) {
        return Some(format!("{path}: too many or too few"));
    }
    let required = schema["required"].as_array().into_iter().flatten();
    if let Some(missing) = required.into_iter().find(|name| value.get(name.as_str().unwrap()).is_none()) {
        return Some(format!("{path}: {missing} is missing"));
    }
    let inner = value.as_object().into_iter().flatten();
    items
        .enumerate()
        .find_map(|(index, item)| refused(root, &schema["items"], item, &format!("{path}/{index}")))
        .or_else(|| {
            inner.into_iter().find_map(|(name, value)| match schema["properties"].get(name) {
                Some(schema) => refused(root, schema, value, &format!("{path}/{name}")),
                None => Some(format!("{path}/{name} is unknown")),
            })
        })
}
