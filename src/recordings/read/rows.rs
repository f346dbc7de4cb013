//! Rows of a recording, one by one, from any source.

use super::database::DatabaseRows;
use super::memory::MemoryRows;
use super::row::{Passed, ReadStop, TrajectoryRow};
use super::text_rows::TextRows;
use crate::motion::Statures;

/// Source of rows.
pub(super) enum TrajectoryRows {
    Text(Box<TextRows>),
    Database(Box<DatabaseRows>),
    Memory(MemoryRows),
}

impl TrajectoryRows {
    #[inline]
    pub fn next(&mut self) -> Result<Option<TrajectoryRow>, ReadStop> {
        match self {
            TrajectoryRows::Text(rows) => rows.next(),
            TrajectoryRows::Database(rows) => Ok(rows.next()?),
            TrajectoryRows::Memory(rows) => Ok(rows.next()),
        }
    }

    pub fn share_done(&self) -> f64 {
        match self {
            TrajectoryRows::Text(rows) => rows.share_done(),
            TrajectoryRows::Database(rows) => rows.share_done(),
            TrajectoryRows::Memory(rows) => rows.share_done(),
        }
    }

    /// Starts to record body heights while rows are read.
    pub fn note_statures(&mut self) {
        if let TrajectoryRows::Text(rows) = self {
            rows.note_statures();
        }
    }

    /// The recorded body heights; a database reads them from a separate table.
    pub fn statures(&self) -> Statures {
        match self {
            TrajectoryRows::Text(rows) => rows.statures(),
            TrajectoryRows::Database(rows) => rows.statures(),
            TrajectoryRows::Memory(_) => Statures::default(),
        }
    }

    pub fn passed(&self) -> Passed {
        match self {
            TrajectoryRows::Text(rows) => rows.passed(),
            TrajectoryRows::Database(rows) => rows.passed(),
            TrajectoryRows::Memory(_) => Passed::default(),
        }
    }
}
