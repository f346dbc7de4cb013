//! The sections of a scenario: what stages declare, and the few keys that belong to the scenario itself.

use std::path::PathBuf;

use super::preset::Preset;
use crate::crowd::{CrowdOptions, SpotRequest};
use crate::export::TextureOptions;
use crate::formation::FormationRequest;
use crate::look::Look;
use crate::marks::{DoorRequest, FixtureRequest, MarksOptions};
use crate::motion::BodyOptions;
use crate::options::{Field, Kind, Options, Table, Value, names, options, schema_of};
use crate::plan::PlanOptions;
use crate::recordings::RecordingOptions;
use crate::rooms::{LifeOptions, RoomRequest};
use crate::routes::{RouteRequest, StopRequest};
use crate::show::Ceiling;
use crate::stamps::StampOptions;
use crate::walls::WallsOptions;

names!(Preset);

options! {
    pub(super) struct PlanKeys {
        /// The plan: PNG, JPEG, BMP, PGM, TIFF, GIF, SVG, PDF, DXF, VTT, or YAML of ROS or Open-RMF; relative to this file.
        image: Option<PathBuf> = None, eg "\"plan.png\"";
        /// Height of the walls.
        wall_height: f64 = 2.6, in 2.1 .. 3.5, unit "m";
        /// What stills and the page show over the rooms: "lamps" in a ceiling, or "none": sky and sun.
        ceiling: Ceiling = Ceiling::Lamps;
    }
}

options! {
    pub(super) struct TextureKeys {
        /// Texel density of the floor.
        floor_texels_per_metre: f64 = 100.0, in 1.0..=1000.0;
        /// Texel density of the walls.
        wall_texels_per_metre: f64 = 200.0, in 1.0..=1000.0;
    }
}

options! {
    pub(super) struct CrowdKeys {
        /// What all other keys start from: "commuters", "heavy", "wet" or "paper".
        preset: Preset = Preset::Commuters;
        /// Another number, another crowd.
        seed: u64 = 1;
        /// Days that are baked, each with as many other people at the same times; `trodden crowd` walks the first.
        days: u32 = 1, in 1.0..=1e4;
    }
}

options! {
    struct MotionKeys {
        /// A recording that takes the crowd's place; relative to this file; without a plan the floor is open ground.
        file: Option<PathBuf> = None, eg "\"paths.txt\"";
    }
}

options! {
    struct LookKeys {
        /// A look file to start from, relative to this file; leave the preset out then.
        file: Option<PathBuf> = None, eg "\"vinyl.toml\"";
    }
}

options! {
    struct PatternKeys {
        /// Own patterns with their patterns.toml, relative to this file; left out: built in.
        folder: Option<PathBuf> = None, eg "\"patterns\"";
    }
}

macro_rules! section {
    ($name:literal: $($part:ty),+) => {
        Field::plain($name, || {
            const PARTS: &[&[Field]] = &[$(<$part as Options>::TABLE.parts[0]),+];
            Kind::Table(Table { name: $name, parts: PARTS })
        }, false)
    };
}

/// All sections, in the order in which they are written.
const SECTIONS: &[Field] = &[
    section!("plan": PlanKeys, PlanOptions),
    section!("walls": WallsOptions),
    section!("texture": TextureKeys, TextureOptions),
    section!("crowd": CrowdKeys, CrowdOptions),
    section!("life": LifeOptions),
    section!("motion": MotionKeys, RecordingOptions),
    section!("bodies": BodyOptions),
    section!("marks": MarksOptions),
    section!("stamps": StampOptions),
    section!("look": LookKeys, Look),
    section!("patterns": PatternKeys),
    Field::plain(FORMATION, FormationRequest::kind, false),
    Field::plain(ROUTE, Vec::<RouteRequest>::kind, false),
    Field::plain(STOP, Vec::<StopRequest>::kind, false),
    Field::plain(ROOM, Vec::<RoomRequest>::kind, false),
    Field::plain(DOOR, Vec::<DoorRequest>::kind, false),
    Field::plain(FIXTURE, Vec::<FixtureRequest>::kind, false),
    Field::plain(UNIT, Vec::<SpotRequest>::kind, false),
];
/// The whole file.
pub(super) const ROOT: Table = Table { name: "scenario", parts: &[SECTIONS] };

/// The section that makes a crowd change from formation to formation.
pub(super) const FORMATION: &str = "formation";
/// The section that comes once per route.
pub(super) const ROUTE: &str = "route";
/// The section that comes once per stop.
pub(super) const STOP: &str = "stop";
/// The section that comes once per room that the scenario says something about.
pub(super) const ROOM: &str = "room";
/// The section that comes once per door.
pub(super) const DOOR: &str = "door";
/// The section that comes once per fixture.
pub(super) const FIXTURE: &str = "fixture";
/// The section that comes once per spot at which units are played.
pub(super) const UNIT: &str = "unit";

/// The name of every section of a file, in order.
pub(super) fn section_names() -> impl Iterator<Item = &'static str> {
    SECTIONS.iter().map(|section| section.name)
}

/// A section of that name, and whether it may come several times.
pub(super) fn section(name: &str) -> Option<(&'static Field, bool)> {
    let field = SECTIONS.iter().find(|section| section.name == name)?;
    Some((field, field.section().is_some_and(|(_, list)| list)))
}

/// Every key with its path, as in `look.film.density`; those of tables on one line are not among them.
pub(super) fn keys() -> Vec<(String, &'static Field)> {
    fn collect(table: Table, path: &str, keys: &mut Vec<(String, &'static Field)>) {
        for field in table.fields() {
            let path = if path.is_empty() { field.name.to_string() } else { format!("{path}.{}", field.name) };
            match field.section() {
                Some((inner, _)) => collect(inner, &path, keys),
                None => keys.push((path, field)),
            }
        }
    }
    let mut keys = Vec::new();
    collect(ROOT, "", &mut keys);
    keys
}

/// The sections that have a key of this name.
pub(super) fn with_key(name: &str) -> Vec<String> {
    let section = |(path, _): (String, _)| path.strip_suffix(name)?.strip_suffix('.').map(str::to_string);
    keys().into_iter().filter_map(section).collect()
}

/// The least and the largest value of a key such as `crowd.people`, where it is a number with a range.
pub fn allowed_range(path: &str) -> Option<[f64; 2]> {
    let limits = keys().into_iter().find(|(key, _)| key == path)?.1.limits?;
    Some([limits.low, limits.high])
}

/// A JSON Schema (draft 7) of scenario files, for editors that complete and check TOML.
pub fn schema() -> serde_json::Value {
    let mut schema = schema_of(ROOT);
    schema["$schema"] = "http://json-schema.org/draft-07/schema#".into();
    schema["title"] = "A scenario of trodden".into();
    schema
}
