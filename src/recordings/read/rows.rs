//! Rows of a recording, one by one, from wherever they are.

use super::database::DatabaseRows;
use super::memory::MemoryRows;
use super::row::{Passed, Row, Stop};
use super::text_rows::TextRows;

/// Where rows come from.
pub(super) enum Rows {
    Text(Box<TextRows>),
    Database(Box<DatabaseRows>),
    Memory(MemoryRows),
}

impl Rows {
    #[inline]
    pub fn next(&mut self) -> Result<Option<Row>, Stop> {
        match self {
            Rows::Text(rows) => rows.next(),
            Rows::Database(rows) => Ok(rows.next()?),
            Rows::Memory(rows) => Ok(rows.next()),
        }
    }

    pub fn share_done(&self) -> f64 {
        match self {
            Rows::Text(rows) => rows.share_done(),
            Rows::Database(rows) => rows.share_done(),
            Rows::Memory(rows) => rows.share_done(),
        }
    }

    pub fn passed(&self) -> Passed {
        match self {
            Rows::Text(rows) => rows.passed(),
            Rows::Database(rows) => rows.passed(),
            Rows::Memory(_) => Passed::default(),
        }
    }
}
