//! Reader of JuPedSim databases, versions 1 and 2.

use std::path::{Path, PathBuf};
use std::vec;

use rusqlite::types::ValueRef;
use rusqlite::{Connection, OpenFlags, params};

use super::RecordingError;
use super::layout::{HIGHEST_RATE, LARGEST};
use super::row::{ID_LIMIT, Passed, TrajectoryRow};
use crate::math::{Vec2, vec2};
use crate::motion::Statures;

/// First bytes of an SQLite file.
pub(super) const MAGIC: &[u8; 16] = b"SQLite format 3\0";
/// Rows per query.
const PAGE: i64 = 8192;

/// Properties that a database states in its metadata and schema.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct About {
    pub fps: Option<f64>,
    /// The stated rate, if it is not a valid number.
    pub bad_fps: Option<String>,
    pub orientations: bool,
    /// Largest row number.
    last: i64,
}

/// The rows of a database, in the order in which they were written.
pub(super) struct DatabaseRows {
    path: PathBuf,
    database: Connection,
    query: String,
    page: vec::IntoIter<TrajectoryRow>,
    /// Number of the last row read.
    last: i64,
    about: About,
    passed: Passed,
}

impl DatabaseRows {
    pub fn open(path: &Path) -> Result<DatabaseRows, RecordingError> {
        let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX;
        let database = Connection::open_with_flags(path, flags).map_err(|error| damaged(path, &error))?;
        let columns = columns_of(&database, "trajectory_data").map_err(|error| damaged(path, &error))?;
        let has = |name: &str| columns.iter().any(|column| column == name);
        let problem = |problem: String| RecordingError::Database { path: path.to_path_buf(), problem };
        if columns.is_empty() {
            return Err(problem("the database has no table trajectory_data".to_owned()));
        }
        if let Some(missing) = ["frame", "id", "pos_x", "pos_y"].into_iter().find(|name| !has(name)) {
            return Err(problem(format!("the table trajectory_data has no column {missing}")));
        }
        let orientations = has("ori_x") && has("ori_y");
        let facing = if orientations { "ori_x, ori_y" } else { "NULL, NULL" };
        let query = format!(
            "SELECT rowid, frame, id, pos_x, pos_y, {facing} FROM trajectory_data WHERE rowid > ? ORDER BY rowid LIMIT {PAGE}"
        );
        let fps = stated_fps(&database).map_err(|error| damaged(path, &error))?;
        let rate = |text: &String| text.trim().parse().ok().filter(|fps| *fps > 0.0 && *fps <= HIGHEST_RATE);
        let (fps, bad_fps) = match fps.as_ref().map(rate) {
            Some(Some(rate)) => (Some(rate), None),
            Some(None) => (None, fps),
            None => (None, None),
        };
        let last = database
            .query_row("SELECT max(rowid) FROM trajectory_data", [], |row| row.get::<_, Option<i64>>(0))
            .map_err(|error| damaged(path, &error))?
            .unwrap_or(0);
        let about = About { fps, bad_fps, orientations, last };
        Ok(DatabaseRows {
            path: path.to_path_buf(),
            database,
            query,
            page: Vec::new().into_iter(),
            last: i64::MIN,
            about,
            passed: Passed::default(),
        })
    }

    pub fn about(&self) -> &About {
        &self.about
    }

    pub fn passed(&self) -> Passed {
        self.passed
    }

    /// Body heights from the table `person_data`; rows that are not numbers are ignored.
    pub fn statures(&self) -> Statures {
        let mut statures = Statures::default();
        let read = |statures: &mut Statures| -> rusqlite::Result<()> {
            let mut statement = self.database.prepare("SELECT id, height_m FROM person_data")?;
            let mut rows = statement.query([])?;
            while let Some(row) = rows.next()? {
                if let (Ok(id), Ok(height_m)) = (row.get(0), row.get(1)) {
                    statures.note(id, height_m);
                }
            }
            Ok(())
        };
        // Most databases have no such table.
        let _ = read(&mut statures);
        statures
    }

    pub fn share_done(&self) -> f64 {
        (self.last as f64 / self.about.last.max(1) as f64).clamp(0.0, 1.0)
    }

    pub fn next(&mut self) -> Result<Option<TrajectoryRow>, RecordingError> {
        loop {
            if let Some(row) = self.page.next() {
                if row.at.x.is_nan() || row.at.y.is_nan() {
                    self.passed.nowhere += 1;
                    if self.passed.nowhere == 1 {
                        self.passed.first_nowhere = row.line;
                    }
                    continue;
                }
                return Ok(Some(row));
            }
            let page = self.read_page()?;
            if page.is_empty() {
                return Ok(None);
            }
            self.page = page.into_iter();
        }
    }

    fn read_page(&mut self) -> Result<Vec<TrajectoryRow>, RecordingError> {
        let mut page = Vec::with_capacity(PAGE as usize);
        let failed = |error: rusqlite::Error| damaged(&self.path, &error);
        let mut statement = self.database.prepare_cached(&self.query).map_err(failed)?;
        let mut found = statement.query(params![self.last]).map_err(failed)?;
        while let Some(found) = found.next().map_err(failed)? {
            let number: i64 = found.get(0).map_err(failed)?;
            let value = |at: usize| found.get_ref(at).map_err(failed);
            let bad = |problem: String| RecordingError::Line {
                path: self.path.clone(),
                line: number.max(0) as u64,
                problem: format!("in trajectory_data, {problem}"),
                hint: "the line is the row's number (rowid)".to_owned(),
            };
            let real = |at: usize, name: &str| -> Result<f64, RecordingError> {
                match value(at)? {
                    ValueRef::Real(value) if value.abs() <= LARGEST => Ok(value),
                    ValueRef::Integer(value) if (value as f64).abs() <= LARGEST => Ok(value as f64),
                    ValueRef::Null => Ok(f64::NAN),
                    other => Err(bad(format!("{name} is {}", told(other)))),
                }
            };
            let id = match value(2)? {
                ValueRef::Integer(id) if id >= 0 && (id as f64) < ID_LIMIT => id as u32,
                other => {
                    return Err(bad(format!(
                        "the id is {}: allowed are whole numbers from 0 to {ID_LIMIT}",
                        told(other)
                    )));
                }
            };
            let frame = real(1, "the frame")?;
            if frame != frame.trunc() {
                return Err(bad(format!("the frame is {frame}: frames are whole numbers")));
            }
            let facing = vec2(real(5, "ori_x")?, real(6, "ori_y")?);
            self.last = number;
            page.push(TrajectoryRow {
                id,
                line: number.max(0) as u64,
                time: frame,
                at: vec2(real(3, "pos_x")?, real(4, "pos_y")?),
                velocity: None,
                heading: facing.normalized().filter(|v: &Vec2| v.is_finite()),
                until: None,
            });
        }
        Ok(page)
    }
}

fn told(value: ValueRef<'_>) -> String {
    match value {
        ValueRef::Null => "nothing".to_owned(),
        ValueRef::Integer(value) => value.to_string(),
        ValueRef::Real(value) => value.to_string(),
        ValueRef::Text(text) | ValueRef::Blob(text) => super::layout::shown(text),
    }
}

fn columns_of(database: &Connection, table: &str) -> rusqlite::Result<Vec<String>> {
    let mut statement = database.prepare("SELECT name FROM pragma_table_info(?)")?;
    statement.query_map([table], |row| row.get::<_, String>(0))?.collect()
}

fn stated_fps(database: &Connection) -> rusqlite::Result<Option<String>> {
    let columns = columns_of(database, "metadata")?;
    if !["key", "value"].iter().all(|name| columns.iter().any(|column| column == name)) {
        return Ok(None);
    }
    let mut statement = database.prepare("SELECT CAST(value AS TEXT) FROM metadata WHERE key = 'fps'")?;
    statement.query_map([], |row| row.get::<_, Option<String>>(0))?.next().transpose().map(Option::flatten)
}

fn damaged(path: &Path, error: &rusqlite::Error) -> RecordingError {
    RecordingError::Database { path: path.to_path_buf(), problem: format!("the database cannot be read: {error}") }
}
