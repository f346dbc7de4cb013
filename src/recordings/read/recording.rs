use std::path::Path;
use std::sync::Arc;

use super::content::RecordingContent;
use super::open::open;
use super::weave::Weaver;
use super::{RecordingError, RecordingOptions, Survey};
use crate::motion::{Ensemble, Motion, MotionError, Statures};
use crate::progress::{Progress, Silent};

/// A recording: surveyed once, and read as often as is wanted.
#[derive(Clone, Debug)]
pub struct Recording {
    content: Arc<RecordingContent>,
}

impl Recording {
    /// Looks through a file, once; where its rows are not in the order of time, twice, and keeps them.
    ///
    /// # Errors
    /// A file that cannot be read or is none of the formats, with the line; a rate that nobody knows; places that are
    /// infinite; somebody at two places at once; options out of range.
    pub fn open(path: &Path, options: &RecordingOptions) -> Result<Recording, RecordingError> {
        Recording::open_watched(path, options, &Silent)
    }

    /// The same with progress shown.
    ///
    /// # Errors
    /// As [`Recording::open`]; [`RecordingError::Interrupted`].
    pub fn open_watched(
        path: &Path,
        options: &RecordingOptions,
        progress: &dyn Progress,
    ) -> Result<Recording, RecordingError> {
        Ok(Recording { content: Arc::new(open(path, options, progress)?) })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.content.path
    }

    /// What it holds.
    pub fn survey(&self) -> &Survey {
        &self.content.survey
    }

    /// Body heights of those for whom the file tells one: the first that a person may have. Somebody who comes back after
    /// a long gap as another person has none.
    pub fn statures(&self) -> Statures {
        self.content.statures.clone()
    }

    /// Reads it from its start. Times begin at 0 with the first frame; ids are those of the file where they are whole
    /// numbers below 10 million, else people are numbered from 1 as they appear.
    ///
    /// Frames are the file's moments; people who are seen at moments of their own are shown 10 to 60 times a second.
    /// Whoever is missing for up to a second, or 2.5 of the usual intervals if that is longer, is shown in between;
    /// whoever is missing for longer left, and is somebody else afterwards.
    ///
    /// Where rows are in the order of time, no more is held than the people of a gap's length of frames.
    ///
    /// # Errors
    /// The file cannot be read any more.
    pub fn motion(&self) -> Result<Box<dyn Motion + Send + '_>, MotionError> {
        let RecordingContent { path, survey, source, scale, alignment, first_time, .. } = &*self.content;
        let rows = source.rows(path).map_err(MotionError::of_source)?;
        let weaver = Weaver::new(rows, scale.clone(), *alignment, *first_time, survey.largest_id);
        Ok(Box::new(weaver))
    }

    /// Those who are there throughout a time, at a rate: `None` is the recording's own.
    ///
    /// # Errors
    /// The file cannot be read any more; nobody is there throughout.
    pub fn ensemble(&self, fps: Option<f64>, span_s: [f64; 2]) -> Result<Ensemble, MotionError> {
        let ensemble = Ensemble::of_motion(&mut *self.motion()?, fps.unwrap_or(self.survey().fps), span_s)?;
        Ok(ensemble.with_statures(self.statures()))
    }
}
