use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::database::DatabaseRows;
use super::layout::TextLayout;
use super::memory::{MemoryRows, Sorted};
use super::row::Numbering;
use super::rows::TrajectoryRows;
use super::scale::{Alignment, Scale};
use super::text_rows::TextRows;
use super::{RecordingError, Survey};
use crate::motion::Statures;

/// A surveyed recording, with all that is needed to read its rows again.
#[derive(Debug)]
pub(super) struct RecordingContent {
    pub path: PathBuf,
    pub survey: Survey,
    pub statures: Statures,
    pub source: RowSource,
    pub scale: Scale,
    pub alignment: Alignment,
    pub first_time: f64,
}

/// The source of the rows; it can be read several times.
#[derive(Clone, Debug)]
pub(super) enum RowSource {
    Text(Arc<TextLayout>, Numbering),
    Database,
    Memory(Arc<Sorted>),
}

impl RowSource {
    pub fn rows(&self, path: &Path) -> Result<TrajectoryRows, RecordingError> {
        Ok(match self {
            RowSource::Text(layout, numbering) => {
                TrajectoryRows::Text(Box::new(TextRows::open(path, layout, *numbering)?))
            }
            RowSource::Database => TrajectoryRows::Database(Box::new(DatabaseRows::open(path)?)),
            RowSource::Memory(sorted) => TrajectoryRows::Memory(MemoryRows::new(sorted)),
        })
    }
}
