use std::io;
use std::path::Path;

use rusqlite::{Connection, ErrorCode, params};

use super::place::{MapFrame, PER_UNIT, RecordedPlace};
use super::sheet::MotionSink;
use super::wkt;
use super::world::RecordedWorld;
use crate::math::Rect;

/// Tables of a JuPedSim database, version 2, as in its `sqlite_serialization.py`. The table of body heights is ours;
/// other programs ignore it.
const TABLES: &str = "
    CREATE TABLE trajectory_data (
        frame INTEGER NOT NULL, id INTEGER NOT NULL,
        pos_x REAL NOT NULL, pos_y REAL NOT NULL, ori_x REAL NOT NULL, ori_y REAL NOT NULL);
    CREATE TABLE metadata (key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);
    CREATE TABLE geometry (hash INTEGER NOT NULL, wkt TEXT NOT NULL);
    CREATE UNIQUE INDEX geometry_hash ON geometry (hash);
    CREATE TABLE frame_data (frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);
    CREATE INDEX frame_id_idx ON trajectory_data (frame, id);
    CREATE TABLE person_data (id INTEGER NOT NULL PRIMARY KEY, height_m REAL NOT NULL);";

/// An incomplete file is deleted, so it needs no journal and one transaction suffices.
const BEGIN: &str = "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; BEGIN;";

const INSERT_PLACE: &str = "INSERT INTO trajectory_data VALUES (?, ?, ?, ?, ?, ?)";
const INSERT_FRAME: &str = "INSERT INTO frame_data VALUES (?, ?)";

/// `OR IGNORE`, since a person who left may come back.
const INSERT_PERSON: &str = "INSERT OR IGNORE INTO person_data VALUES (?, ?)";

/// Writer of a JuPedSim database, version 2.
pub(super) struct JupedsimDatabase {
    database: Connection,
    geometry_hash: i64,
    /// Ids present in the last frame, ascending.
    before: Vec<u32>,
}

impl JupedsimDatabase {
    pub(super) fn begin(path: &Path, fps: f64, world: &RecordedWorld<'_>) -> io::Result<JupedsimDatabase> {
        let frame_of_map = MapFrame::of(&world.plan.map_from_plan);
        let floor = wkt::Floor::of(world.walls.outlines(), |p| frame_of_map.point(p));
        let geometry = floor.to_string();
        let geometry_hash = fnv1a(geometry.as_bytes());
        let begin = || {
            let database = Connection::open(path)?;
            database.execute_batch(BEGIN)?;
            database.execute_batch(TABLES)?;
            let Rect { min, max } = floor.bounds();
            let metadata = [
                ("version", "2".to_string()),
                ("fps", format!("{fps:?}")),
                ("xmin", format!("{:?}", min.x)),
                ("xmax", format!("{:?}", max.x)),
                ("ymin", format!("{:?}", min.y)),
                ("ymax", format!("{:?}", max.y)),
                ("generator", concat!("trodden ", env!("CARGO_PKG_VERSION")).to_string()),
            ];
            for (key, value) in metadata {
                database.execute("INSERT INTO metadata VALUES (?, ?)", [key, &value])?;
            }
            database.execute("INSERT INTO geometry VALUES (?, ?)", params![geometry_hash, geometry])?;
            Ok(database)
        };
        let database = begin().map_err(explain)?;
        Ok(JupedsimDatabase { database, geometry_hash, before: Vec::new() })
    }
}

impl MotionSink for JupedsimDatabase {
    fn frame(&mut self, number: u64, places: &[RecordedPlace]) -> io::Result<()> {
        // SQLite integers are signed.
        let number = number as i64;
        let insert = || {
            self.database.prepare_cached(INSERT_FRAME)?.execute(params![number, self.geometry_hash])?;
            let mut insert = self.database.prepare_cached(INSERT_PLACE)?;
            let mut insert_person = self.database.prepare_cached(INSERT_PERSON)?;
            for place in places {
                if self.before.binary_search(&place.id).is_err() {
                    insert_person.execute(params![place.id, (place.height_m * PER_UNIT).round() / PER_UNIT])?;
                }
                let [at, facing] = [place.at, place.facing];
                insert.execute(params![number, place.id, at.x, at.y, facing.x, facing.y])?;
            }
            Ok(())
        };
        insert().map_err(explain)?;
        self.before.clear();
        self.before.extend(places.iter().map(|place| place.id));
        Ok(())
    }

    fn close(self: Box<Self>) -> io::Result<u64> {
        self.database.execute_batch("COMMIT").map_err(explain)?;
        self.database.close().map_err(|(_, error)| explain(error))?;
        Ok(0)
    }
}

/// Converts an SQLite error to an I/O error.
fn explain(error: rusqlite::Error) -> io::Error {
    let kind = match error.sqlite_error_code() {
        Some(ErrorCode::DiskFull) => io::ErrorKind::StorageFull,
        Some(ErrorCode::PermissionDenied | ErrorCode::CannotOpen) => io::ErrorKind::PermissionDenied,
        Some(ErrorCode::ReadOnly) => io::ErrorKind::ReadOnlyFilesystem,
        _ => io::ErrorKind::Other,
    };
    io::Error::new(kind, error)
}

/// Computes the FNV-1a hash (Fowler, Noll, Vo) of a geometry. JuPedSim uses Python's hash, which varies between runs.
fn fnv1a(bytes: &[u8]) -> i64 {
    let hash = bytes
        .iter()
        .fold(0xcbf2_9ce4_8422_2325, |hash: u64, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3));
    hash as i64
}
