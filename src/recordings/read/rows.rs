//! Rows of a recording, one by one, from wherever they are.

use super::database::DatabaseRows;
use super::memory::MemoryRows;
use super::row::{Passed, ReadStop, TrajectoryRow};
use super::text_rows::TextRows;

/// Where rows come from.
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

    pub fn passed(&self) -> Passed {
        match self {
            TrajectoryRows::Text(rows) => rows.passed(),
            TrajectoryRows::Database(rows) => rows.passed(),
            TrajectoryRows::Memory(_) => Passed::default(),
        }
    }
}
