use std::fmt::Write;
use std::path::PathBuf;

use toml::{Table, Value};

use super::Scenario;
use super::check::value_at;
use super::keys::{self, Allowed, KEYS, Key};

/// Comments begin in this column where the value leaves room.
const COMMENT_COLUMN: usize = 36;
/// Lines are not longer than this where a comment can stand above instead.
const WIDTH: usize = 118;
/// Keys of a table on one line, in the order in which people say them.
const PAIR_ORDER: [&str; 9] = ["kind", "mean", "size_m", "sd", "min", "max", "from", "to", "metres"];

impl Scenario {
    /// The scenario as a file: every key with its value and what it means, ready to be edited.
    ///
    /// Reading the text back gives the same scenario.
    pub fn to_toml(&self) -> String {
        let table = table_of(self).unwrap_or_default();
        let mut text = String::new();
        let mut section = "";
        let of_scenario = |key: &&Key| !keys::LISTS.contains(&key.section()) && !of_formation(key);
        for key in KEYS.iter().filter(of_scenario) {
            if key.section() != section {
                section = key.section();
                let gap = if text.is_empty() { "" } else { "\n" };
                let _ = writeln!(text, "{gap}[{section}]");
            }
            let line = match value_at(&table, key.path) {
                Some(value) => format!("{} = {}", key.name(), inline(value)),
                None => format!("# {} = {}", key.name(), key.example),
            };
            push_commented(&mut text, &line, &key.comment());
        }
        push_formation(&mut text, &table);
        push_list(
            &mut text,
            &table,
            keys::ROUTE,
            "Routes, each in a [[route]] of its own. Without any, routes join the widest openings:",
        );
        push_list(
            &mut text,
            &table,
            keys::STOP,
            "Places where people stop, each in a [[stop]] of its own; routes name them in `via`:",
        );
        push_list(
            &mut text,
            &table,
            keys::DOOR,
            "Doors, each in a [[door]] of its own. Gaps of 0.7 to 2.0 m in walls are found without:",
        );
        push_list(
            &mut text,
            &table,
            keys::FIXTURE,
            "What people touch on walls, each in a [[fixture]] of its own; counters, machines and benches of stops are found:",
        );
        push_list(
            &mut text,
            &table,
            keys::UNIT,
            "Spots that are looked at closely, each in a [[unit]] of its own: people near them play crowd units:",
        );
        text
    }
}

impl Scenario {
    /// All values, for a manifest that is the same wherever the files lie: of paths only the names are left.
    pub fn settings(&self) -> serde_json::Value {
        let name = |path: &PathBuf| path.file_name().map(PathBuf::from).unwrap_or_default();
        let mut scenario = self.clone();
        scenario.image = self.image.as_ref().map(name);
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
        // Only numbers that TOML cannot hold stop it, and those were refused when the scenario was read.
        table_of(&scenario).ok().and_then(|table| serde_json::to_value(table).ok()).unwrap_or_default()
    }
}

/// Whether a key belongs to formations, which stand within each other.
fn of_formation(key: &Key) -> bool {
    keys::FORMATION_SECTIONS.contains(&key.section())
}

/// Formations: what their keys mean, then what is asked for, as TOML writes it.
fn push_formation(text: &mut String, table: &Table) {
    text.push_str("\n# Formations that a crowd takes up one after another, in the place of one that walks. Key formations stand\n");
    text.push_str(
        "# each in a [[formation.key]], small crowds in the places of individuals each in a [[formation.crowd]]:\n",
    );
    for section in keys::FORMATION_SECTIONS {
        let list = section.ends_with(".key") || section.ends_with(".crowd");
        let _ = if list { writeln!(text, "#\n# [[{section}]]") } else { writeln!(text, "#\n# [{section}]") };
        for key in KEYS.iter().filter(|key| key.section() == section) {
            push_commented(text, &format!("# {} = {}", key.name(), key.example), &key.comment());
        }
    }
    if let Some(formation) = table.get(keys::FORMATION) {
        let whole = Table::from_iter([(keys::FORMATION.to_string(), formation.clone())]);
        let _ = write!(text, "\n{}", toml::to_string(&whole).unwrap_or_default());
    }
}

/// A list of sections, such as the routes; what their keys mean stands above the first.
fn push_list(text: &mut String, table: &Table, list: &str, about: &str) {
    let own_keys = || KEYS.iter().filter(|key| key.section() == list);
    let _ = writeln!(text, "\n# {about}\n#\n# [[{list}]]");
    for key in own_keys() {
        push_commented(text, &format!("# {} = {}", key.name(), key.example), &key.comment());
    }
    for item in table.get(list).and_then(Value::as_array).into_iter().flatten() {
        let _ = writeln!(text, "\n[[{list}]]");
        for key in own_keys() {
            if let Some(value) = item.get(key.name()) {
                let _ = writeln!(text, "{} = {}", key.name(), inline(value));
            }
        }
    }
}

impl Key {
    /// What it is, and what it may be.
    fn comment(&self) -> String {
        match self.allowed {
            Allowed::Any => self.about.to_string(),
            Allowed::Number(low, high) | Allowed::Spread(low, high) => format!("{}, {low} to {high}", self.about),
            Allowed::Below(low, high) => format!("{}, {low} <= h < {high}", self.about),
        }
    }
}

fn push_commented(text: &mut String, line: &str, comment: &str) {
    let column = line.chars().count().max(COMMENT_COLUMN - 2) + 2;
    let _ = if column + 2 + comment.chars().count() <= WIDTH {
        writeln!(text, "{line:<width$}# {comment}", width = column)
    } else {
        writeln!(text, "# {comment}\n{line}")
    };
}

/// A value on one line.
fn inline(value: &Value) -> String {
    match value {
        Value::Float(number) => {
            let number = shortest(*number);
            if number.is_finite() { format!("{number:?}") } else { number.to_string().to_lowercase() }
        }
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

/// The number itself, or, where it came from single precision, the decimal that was meant: 0.38, not
/// 0.3799999952316284.
pub(super) fn shortest(number: f64) -> f64 {
    let single = number as f32;
    if f64::from(single) == number { single.to_string().parse().unwrap_or(number) } else { number }
}

/// All values as one TOML table, in sections as a file has them.
pub(super) fn table_of(scenario: &Scenario) -> Result<Table, toml::ser::Error> {
    let Scenario { plan, walls, texture, crowd, bodies, marks, stamps, look, .. } = scenario;
    let mut plan = Table::try_from(plan)?;
    if let Some(image) = &scenario.image {
        plan.insert("image".to_string(), Value::try_from(image)?);
    }
    plan.insert("wall_height".to_string(), Value::Float(scenario.wall_height_m));
    let mut texture = Table::try_from(texture)?;
    texture.insert("floor_texels_per_metre".to_string(), Value::Float(scenario.floor_texels_per_metre));
    texture.insert("wall_texels_per_metre".to_string(), Value::Float(scenario.wall_texels_per_metre));
    let mut crowd = Table::try_from(crowd)?;
    crowd.insert("preset".to_string(), Value::try_from(scenario.preset)?);
    crowd.insert("seed".to_string(), Value::try_from(scenario.seed)?);
    let mut patterns = Table::new();
    if let Some(folder) = &scenario.pattern_folder {
        patterns.insert("folder".to_string(), Value::try_from(folder)?);
    }
    let mut motion = Table::try_from(&scenario.recording)?;
    if let Some(file) = &scenario.motion_file {
        motion.insert("file".to_string(), Value::try_from(file)?);
    }
    let sections = [
        ("plan", plan),
        ("walls", Table::try_from(walls)?),
        ("texture", texture),
        ("crowd", crowd),
        ("motion", motion),
        ("bodies", Table::try_from(bodies)?),
        ("marks", Table::try_from(marks)?),
        ("stamps", Table::try_from(stamps)?),
        ("look", Table::try_from(look)?),
        ("patterns", patterns),
    ];
    let mut all: Table = sections.into_iter().map(|(name, table)| (name.to_string(), Value::Table(table))).collect();
    if let Some(formation) = &scenario.formation {
        all.insert(keys::FORMATION.to_string(), Value::try_from(formation)?);
    }
    all.insert(keys::ROUTE.to_string(), Value::try_from(&scenario.routes.routes)?);
    all.insert(keys::STOP.to_string(), Value::try_from(&scenario.routes.stops)?);
    all.insert(keys::DOOR.to_string(), Value::try_from(&scenario.doors)?);
    all.insert(keys::FIXTURE.to_string(), Value::try_from(&scenario.fixtures)?);
    all.insert(keys::UNIT.to_string(), Value::try_from(&scenario.units)?);
    Ok(all)
}
