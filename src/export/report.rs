use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::{ExportError, OutputFolder};
use crate::crowd::{Overload, SpotReport, Standstill, Stuck, Tally};
use crate::files::read_input;
use crate::math::{Vec2, vec2};
use crate::rooms::{Life, Room, RoomKind, Use};
use crate::routes::Route;

/// Largest report to read, bytes.
const LARGEST_BYTES: u64 = 512 << 20;

/// Counts and timings of a run: `report.json`, the only file that differs from run to run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Counts of people.
    pub people: PeopleReport,
    /// Warnings of the crowd, such as a queue longer than its room, with the name of the place.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    /// How people used the rooms of the building, where they lived in it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub life: Option<LifeReport>,
    /// Number of footfalls.
    pub footfalls: u64,
    /// Number of wall touches.
    #[serde(default)]
    pub contacts: u64,
    /// Wall-clock seconds as `total`. Busy seconds of each stage, summed over threads, by its name.
    pub seconds: BTreeMap<String, f64>,
    /// Peak memory, MiB; `null` where the system does not report it.
    pub peak_memory_mib: Option<f64>,
}

/// How people used a building.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LifeReport {
    /// What the building is for.
    pub r#use: Use,
    /// Whether that is a guess.
    pub guessed: bool,
    /// The rooms, from the top left, row by row.
    pub rooms: Vec<RoomReport>,
}

/// How people used a room.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RoomReport {
    /// Its name.
    pub name: String,
    /// What it is.
    pub kind: RoomKind,
    /// Area of its floor, square metres.
    pub area_m2: f64,
    /// A place in it, metres.
    pub inside_m: Vec2,
    /// Number of footfalls in it.
    pub footfalls: u64,
}

/// Number of unused rooms that are named one by one.
const NAMED: usize = 6;

impl LifeReport {
    /// A report before anybody has walked.
    pub fn of(life: &Life) -> LifeReport {
        let room = |room: &Room| RoomReport {
            name: room.name.clone(),
            kind: room.kind,
            area_m2: room.area_m2,
            inside_m: room.inside_m,
            footfalls: 0,
        };
        LifeReport { r#use: life.r#use, guessed: life.guessed, rooms: life.rooms.rooms.iter().map(room).collect() }
    }

    /// Counts footfalls at some places, metres.
    pub fn count(&mut self, life: &Life, places_m: impl Iterator<Item = Vec2>) {
        for room in places_m.filter_map(|place| life.rooms.at(place)) {
            self.rooms[room].footfalls += 1;
        }
    }

    /// A warning that names the rooms that nobody has used.
    pub fn warning(&self) -> Option<String> {
        let unused: Vec<&RoomReport> = self.rooms.iter().filter(|room| room.footfalls == 0).collect();
        let describe = |room: &&RoomReport| {
            let Vec2 { x, y } = room.inside_m;
            format!("{} ({:.1} m2 around [{x:.1}, {y:.1}])", room.name, room.area_m2)
        };
        let names: Vec<String> = unused.iter().take(NAMED).map(describe).collect();
        let others = match unused.len().saturating_sub(NAMED) {
            0 => String::new(),
            others => format!(" and {others} others"),
        };
        (!unused.is_empty()).then(|| format!("nobody used {}{others}", names.join(", ")))
    }
}

/// Counts of people who entered, arrived or got stuck.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PeopleReport {
    /// Number of people who entered.
    pub entered: u64,
    /// Number of people who reached their goal.
    pub arrived: u64,
    /// Number of people who made no progress and were removed.
    pub stuck: u64,
    /// The removed people, in the order of removal.
    #[serde(default)]
    pub stuck_people: Vec<StuckReport>,
    /// Units played at each spot.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub spots: Vec<SpotReport>,
    /// Places to which more people come than can pass, as foreseen before the walk.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub overloads: Vec<Overload>,
    /// Who waited where while the crowd hardly got on.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub standstills: Vec<Standstill>,
}

impl PeopleReport {
    /// Summarises the tally of a crowd.
    pub fn of(tally: &Tally, routes: &[Route]) -> PeopleReport {
        PeopleReport {
            entered: tally.entered,
            arrived: tally.arrived,
            stuck: tally.stuck.len() as u64,
            stuck_people: tally.stuck.iter().map(|stuck| StuckReport::of(stuck, routes)).collect(),
            spots: tally.spots.clone(),
            overloads: tally.overloads.clone(),
            standstills: tally.standstills.clone(),
        }
    }
}

/// A person who made no progress and was removed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StuckReport {
    /// Number of the person.
    pub id: u32,
    /// Name of the route.
    pub route: String,
    /// Where the person was, metres of the plan frame, rounded to millimetres.
    pub place_m: Vec2,
}

impl StuckReport {
    fn of(stuck: &Stuck, routes: &[Route]) -> StuckReport {
        let route = routes.get(stuck.route).map_or_else(String::new, |route| route.name.clone());
        let millimetres = |metres: f64| (metres * 1e3).round() / 1e3;
        let place_m = vec2(millimetres(stuck.place_m.x), millimetres(stuck.place_m.y));
        StuckReport { id: stuck.id, route, place_m }
    }
}

impl Report {
    /// File name of the report in a bake.
    pub const FILE_NAME: &str = "report.json";

    /// Reads the report of a bake.
    ///
    /// # Errors
    /// The report is missing or invalid.
    pub fn read(bake: &Path) -> Result<Report, ExportError> {
        let path = bake.join(Self::FILE_NAME);
        let json = read_input(&path, LARGEST_BYTES).map_err(ExportError::read(&path))?;
        serde_json::from_slice(&json).map_err(|e| ExportError::damaged(&path, e))
    }

    /// Writes the report. Seconds are rounded to milliseconds, memory to a tenth.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, folder: &OutputFolder) -> Result<(), ExportError> {
        let mut rounded = self.clone();
        for seconds in rounded.seconds.values_mut() {
            *seconds = (*seconds * 1e3).round() / 1e3;
        }
        rounded.peak_memory_mib = rounded.peak_memory_mib.map(|mib| (mib * 10.0).round() / 10.0);
        let mut json = serde_json::to_vec_pretty(&rounded).expect("all keys are strings and memory does not fail");
        json.push(b'\n');
        folder.write(Self::FILE_NAME, &json)
    }
}
