//! `[formation]` in a scenario: read, checked, written.

use super::{parse, shown};
use crate::formation::{ExampleKind, FormationShape, Members};

const BATTLE: &str = r#"
[formation]
duration_s = 30
example = { kind = "ranks", rows = 3, columns = 3 }

[[formation.key]]
time_s = 10
shape = "star"

[[formation.crowd]]
members = [0, 4]
rider = true

[[formation.crowd.key]]
time_s = 0
shape = "triangle"

[[formation.crowd.crowd]]
example = { kind = "sway", people = 3 }
"#;

#[test]
fn a_formation_needs_no_plan_and_stands_in_itself() {
    let scenario = parse(BATTLE).unwrap_or_else(|error| panic!("{error}"));
    let formation = scenario.formation.clone().unwrap();
    assert_eq!(formation.example.kind, Some(ExampleKind::Ranks));
    assert_eq!(formation.key[0].shape, Some(FormationShape::Star));
    assert_eq!(formation.crowd[0].members, Members::List(vec![0, 4]));
    assert_eq!(formation.crowd[0].crowd[0].example.people, Some(3));
    let text = scenario.to_toml();
    assert_eq!(parse(&text).unwrap_or_else(|error| panic!("{error}\n{text}")), scenario, "{text}");
}

#[test]
fn mistakes_are_shown_where_they_stand() {
    for (from, to, line, column, says) in [
        ("duration_s = 30", "duration_s = 0", 3, 14, "`duration_s` is 0, allowed is 0.1 to 36000"),
        ("duration_s = 30", "duraton_s = 30", 3, 1, "did you mean `duration_s`?"),
        ("time_s = 10", "time_s = -1", 7, 10, "`time_s` is -1"),
        ("time_s = 10", "time_s = 31", 7, 10, "ends at 31 s, after the whole"),
        ("shape = \"star\"", "shape = \"stra\"", 8, 9, "did you mean \"star\"?"),
        ("shape = \"star\"", "shap = \"star\"", 8, 1, "did you mean `shape`?"),
        ("shape = \"star\"", "columns = 3\nshape = \"star\"", 8, 11, "to a grid only"),
        ("members = [0, 4]", "members = [0, 0]", 11, 11, "0 is named twice"),
        ("members = [0, 4]", "members = 3", 11, 11, "a list of individuals"),
        ("shape = \"triangle\"", "at = [0, 1]\nshape = \"triangle\"", 16, 6, "no position of its own"),
        ("people = 3", "people = 0", 19, 37, "`people` is 0"),
        ("people = 3", "peple = 3", 19, 28, "did you mean `people`?"),
    ] {
        let text = BATTLE.replacen(from, to, 1);
        assert_ne!(text, BATTLE);
        let message = shown(&text);
        let place = format!(" --> plans/hall.toml:{line}:{column}\n");
        assert!(message.contains(says) && message.contains(&place), "{to}:\n{message}");
    }
    let message = shown(&format!("{BATTLE}[motion]\nfile = \"paths.txt\"\n"));
    assert!(message.contains("both a recording") && message.contains("plans/hall.toml:"), "{message}");
    let message = shown("[formation]\n[formation.key]\ntime_s = 0\n");
    assert!(message.contains("hall.toml:2:"), "{message}");
    let message = shown("[[formation.key]]\nshape = \"ring\"\n");
    assert!(message.contains("`time_s` is missing") && message.contains("hall.toml:1:"), "{message}");
}

#[test]
fn what_is_wrong_in_a_list_is_said_of_that_list() {
    for (from, to, line, says) in [
        ("time_s = 10\n", "", 6, "`time_s` is missing in [[formation.key]]"),
        ("shape = \"star\"", "shap = \"star\"", 8, "[[formation.key]] has no key `shap`"),
        ("rider = true", "ridr = true", 12, "[[formation.crowd]] has no key `ridr`"),
        ("time_s = 0\n", "", 14, "`time_s` is missing in [[formation.crowd.key]]"),
        ("time_s = 0\n", "time_s = \"0\"\n", 15, "`time_s` takes a number"),
        ("shape = \"triangle\"", "shpe = \"triangle\"", 16, "[[formation.crowd.key]] has no key `shpe`"),
        ("people = 3", "peple = 3", 19, "[formation.crowd.crowd.example] has no key `peple`"),
        ("example = { kind = \"sway\", people = 3 }", "rder = true", 19, "[[formation.crowd.crowd]] has no key `rder`"),
    ] {
        let text = BATTLE.replacen(from, to, 1);
        assert_ne!(text, BATTLE);
        let message = shown(&text);
        let place = format!(" --> plans/hall.toml:{line}:");
        assert!(message.contains(says) && message.contains(&place), "{from}:\n{message}");
    }
    let message = shown("[formation]\nadjacency = [{ weight = 1 }]\n");
    assert!(
        message.contains("`members` is missing in [[formation.adjacency]]") && message.contains(":2:"),
        "{message}"
    );
}
