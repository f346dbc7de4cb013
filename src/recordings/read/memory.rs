//! Rows sorted by time in memory, for files that are not sorted.

use std::path::Path;
use std::sync::Arc;

use super::RecordingError;
use super::row::TrajectoryRow;
use crate::math::{Vec2, vec2};

/// Rows sorted by time, then id, then file order.
#[derive(Debug, Default)]
pub(super) struct Sorted {
    rows: Vec<Compact>,
    /// Line numbers, in file order.
    lines: Vec<u32>,
    /// Velocities, headings and step ends, in file order; empty if no row has any.
    extras: Vec<Extra>,
}

#[derive(Clone, Copy, Debug)]
struct Compact {
    time: f64,
    x: f64,
    y: f64,
    id: u32,
    order: u32,
}

#[derive(Clone, Copy, Debug, Default)]
struct Extra {
    velocity: Option<Vec2>,
    heading: Option<Vec2>,
    until: Option<(f64, Vec2)>,
}

impl Sorted {
    /// Adds a row.
    ///
    /// # Errors
    /// More than 4 billion rows.
    pub fn push(&mut self, row: TrajectoryRow, path: &Path) -> Result<(), RecordingError> {
        let Ok(order) = u32::try_from(self.rows.len()) else {
            let (path, hint) = (path.to_path_buf(), "sort it by time first");
            let problem = "more than 4 billion rows that are not in the order of time".to_owned();
            return Err(RecordingError::Unreadable { path, problem, hint });
        };
        let TrajectoryRow { id, line, time, at, velocity, heading, until } = row;
        let extra = velocity.is_some() || heading.is_some() || until.is_some();
        if extra || !self.extras.is_empty() {
            self.extras.resize(order as usize, Extra::default());
            self.extras.push(Extra { velocity, heading, until });
        }
        if self.rows.try_reserve(1).is_err() || self.lines.try_reserve(1).is_err() {
            let (path, hint) = (path.to_path_buf(), "sort it by time first");
            let problem =
                format!("there is no memory for its rows, {order} so far, which are not in the order of time");
            return Err(RecordingError::Unreadable { path, problem, hint });
        }
        self.lines.push(u32::try_from(line).unwrap_or(u32::MAX));
        self.rows.push(Compact { time, x: at.x, y: at.y, id, order });
        Ok(())
    }

    /// Sorts all rows by time, then id, then file order.
    pub fn sort(&mut self) {
        self.rows.sort_unstable_by(|a, b| a.time.total_cmp(&b.time).then((a.id, a.order).cmp(&(b.id, b.order))));
    }

    fn row(&self, at: usize) -> Option<TrajectoryRow> {
        let &Compact { time, x, y, id, order } = self.rows.get(at)?;
        let Extra { velocity, heading, until } = self.extras.get(order as usize).copied().unwrap_or_default();
        let line = u64::from(self.lines[order as usize]);
        Some(TrajectoryRow { id, line, time, at: vec2(x, y), velocity, heading, until })
    }
}

/// Iterates over sorted rows.
pub(super) struct MemoryRows {
    sorted: Arc<Sorted>,
    next: usize,
}

impl MemoryRows {
    pub fn new(sorted: &Arc<Sorted>) -> MemoryRows {
        MemoryRows { sorted: Arc::clone(sorted), next: 0 }
    }

    #[inline]
    pub fn next(&mut self) -> Option<TrajectoryRow> {
        let row = self.sorted.row(self.next)?;
        self.next += 1;
        Some(row)
    }

    pub fn share_done(&self) -> f64 {
        self.next as f64 / self.sorted.rows.len().max(1) as f64
    }
}
