//! Turns what the TOML reader says into messages about scenarios: which key, what it takes, the nearest right one.

use super::keys;

/// A message and what to do about it.
pub(super) type Explanation = (String, Option<String>);

/// The text is not TOML.
pub(super) fn syntax(message: &str) -> Explanation {
    let hint = match message {
        "duplicate key" => {
            "write each key and each section once; only [[route]], [[stop]], [[door]], [[fixture]] and [[unit]] may come again"
        }
        _ => "texts stand in quotes, lists in [brackets], and a section begins with its [name]",
    };
    (format!("not valid TOML: {message}"), Some(hint.to_string()))
}

/// A section, or a key outside of any.
pub(super) fn unknown_section(name: &str) -> Explanation {
    let message = format!("a scenario has no section `{name}`");
    let hint = match keys::sections_with(name).first() {
        Some(section) => format!("`{name}` belongs in [{section}]"),
        None => match nearest(name, keys::SECTIONS.iter().copied()) {
            Some(known) => format!("did you mean {}?", heading(known)),
            None => format!("its sections are {}", keys::SECTIONS.map(heading).join(", ")),
        },
    };
    (message, Some(hint))
}

/// A single value where a section should be.
pub(super) fn not_a_section(name: &str) -> Explanation {
    (
        format!("`{name}` is a section, not a value"),
        Some(format!("write [{name}] on a line of its own, its keys below")),
    )
}

/// `[route]` in place of `[[route]]`.
pub(super) fn not_a_list(name: &str) -> Explanation {
    (format!("`{name}` is a list of sections"), Some(format!("write [[{name}]] with two brackets, once per {name}")))
}

/// Serde's message on a value of a section: an unknown key, a wrong type, an unknown name. `found` is the text at
/// the place, `key` the key that it belongs to, `own_keys` those that the section has beyond what serde lists.
pub(super) fn value(message: &str, section: &str, key: Option<&str>, found: &str, own_keys: &[&str]) -> Explanation {
    if message.starts_with("unknown field") {
        let known: Vec<&str> = own_keys.iter().copied().chain(in_backticks(message).skip(1)).collect();
        return unknown_key(found.trim_matches(['"', '\'']), section, &known);
    }
    let key = key.unwrap_or(section);
    let found = shortened(found);
    if message.starts_with("unknown variant") {
        let known: Vec<&str> = in_backticks(message).skip(1).collect();
        let hint = nearest(found.trim_matches(['"', '\'']), known.iter().copied());
        return (
            format!("`{key}` cannot be {found}; it is one of {}", known.join(", ")),
            hint.map(|name| format!("did you mean \"{name}\"?")),
        );
    }
    if let Some(missing) = message.strip_prefix("missing field ") {
        return (format!("{missing} is missing in {}", heading(section)), None);
    }
    let expected = match message.strip_prefix("data did not match any variant of untagged enum ") {
        Some(name) => alternatives(name),
        // What is left is "invalid type: ..., expected ...", or what an enum without tags says of itself.
        None => in_words(message.rsplit_once(", expected ").map_or(message, |(_, expected)| expected)),
    };
    (format!("`{key}` takes {expected}, not {found}"), None)
}

fn unknown_key(found: &str, section: &str, known: &[&str]) -> Explanation {
    let elsewhere = keys::sections_with(found);
    let hint = match nearest(found, known.iter().copied()) {
        Some(name) => format!("did you mean `{name}`?"),
        None if (1..=3).contains(&elsewhere.len()) => format!("`{found}` belongs in [{}]", elsewhere.join("] or [")),
        None => format!("its keys are {}", known.join(", ")),
    };
    (format!("{} has no key `{found}`", heading(section)), Some(hint))
}

/// The name that `found` was most likely meant to be, if any is near.
pub(super) fn nearest<'k>(found: &str, known: impl Iterator<Item = &'k str>) -> Option<&'k str> {
    let limit = (found.chars().count() / 3).clamp(1, 4);
    known
        .map(|name| (strsim::damerau_levenshtein(&found.to_lowercase(), name), name))
        .filter(|&(distance, _)| distance <= limit)
        .min()
        .map(|(_, name)| name)
}

fn heading(section: &str) -> String {
    let is_list = |name: &str| ["key", "crowd", "adjacency"].contains(&name);
    if keys::LISTS.contains(&section) || section.rsplit_once('.').is_some_and(|(_, name)| is_list(name)) {
        format!("[[{section}]]")
    } else {
        format!("[{section}]")
    }
}

/// What stands in backticks in a message of serde.
fn in_backticks(message: &str) -> impl Iterator<Item = &str> {
    message.split('`').skip(1).step_by(2)
}

/// What an enum without tags can be written as.
fn alternatives(name: &str) -> &'static str {
    match name {
        "Members" => "\"all\", a list of individuals from 0 on, or { every = 2, from = 0 }",
        "Choice" => "a list of people from 0 on, or a list of such lists",
        "Distribution" => "a number, a range [low, high], or { mean = .., sd = .. }",
        "PlanPoint" => "[x, y] in metres or { px = [x, y] } in pixels",
        _ => "something else",
    }
}

/// What serde expects, for readers who do not write Rust.
fn in_words(expected: &str) -> &str {
    match expected {
        "u8" => "a whole number from 0 to 255",
        "u16" | "u32" | "u64" | "usize" => "a whole number of 0 or more",
        "i32" | "i64" => "a whole number",
        "f32" | "f64" => "a number",
        "a string" | "path string" => "a text in quotes",
        "a boolean" => "true or false",
        "a sequence" => "a list in [brackets]",
        "an array of length 2" => "two numbers in brackets",
        "an array of length 3" => "three numbers in brackets",
        expected if expected.starts_with("struct ") => "a table of keys",
        expected => expected,
    }
}

/// A value as it stands in the file, on one line and not too long.
fn shortened(found: &str) -> String {
    let line = found.lines().next().unwrap_or("");
    let cut = line.chars().count() > 40 || found.lines().count() > 1;
    let mut shown: String = line.chars().filter(|c| !c.is_control()).take(40).collect();
    if cut {
        shown.push_str(" ...");
    }
    shown
}
