use std::path::Path;
use std::sync::Arc;

use super::content::RecordingContent;
use super::open::open;
use super::weave::Weaver;
use super::{RecordingError, RecordingOptions, Survey};
use crate::motion::{Ensemble, Motion, MotionError, Statures};
use crate::progress::{Progress, Silent};

/// A trajectory recording: surveyed once, then read as often as needed.
#[derive(Clone, Debug)]
pub struct Recording {
    content: Arc<RecordingContent>,
}

impl Recording {
    /// Opens a file and surveys it in one pass. Unsorted files take a second pass and stay in memory.
    ///
    /// # Errors
    /// A file that cannot be read or has an unknown format, with the line; an unknown rate; places that are
    /// infinite; somebody at two places at once; options out of range.
    ///
    /// # Example
    /// ```
    /// use trodden::recordings::Recording;
    ///
    /// let folder = tempfile::tempdir()?;
    /// let path = folder.path().join("paths.txt");
    /// std::fs::write(&path, "# framerate: 10\n1 0 0.0 0.0\n1 1 0.1 0.0\n1 2 0.2 0.0\n")?;
    /// let recording = Recording::open(&path, &Default::default())?;
    /// assert_eq!((recording.survey().people, recording.survey().frames), (1, 3));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn open(path: &Path, options: &RecordingOptions) -> Result<Recording, RecordingError> {
        Recording::open_watched(path, options, &Silent)
    }

    /// Opens a file like [`Recording::open`] and reports progress.
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

    /// Path of the file.
    pub fn path(&self) -> &Path {
        &self.content.path
    }

    /// Survey of the content: numbers of people and frames, span, units, warnings.
    pub fn survey(&self) -> &Survey {
        &self.content.survey
    }

    /// Body heights of those for whom the file tells one: the first that a person may have. Somebody who comes back after
    /// a long gap as another person has none.
    pub fn statures(&self) -> Statures {
        self.content.statures.clone()
    }

    /// Reads the recording from its start. Times begin at 0 with the first frame. Ids are the file's if they are whole
    /// numbers below 10 million; otherwise people are numbered from 1 as they appear.
    ///
    /// The frames are the file's moments; if people have separate moments, frames are interpolated at 10 to 60 Hz. A
    /// person missing for up to 1 s, or 2.5 of the usual intervals if that is longer, is interpolated. After a longer
    /// gap, the person returns under a new id.
    ///
    /// If rows are sorted by time, memory holds only the frames within one gap.
    ///
    /// # Errors
    /// The file cannot be read any more.
    pub fn motion(&self) -> Result<Box<dyn Motion + Send + '_>, MotionError> {
        let RecordingContent { path, survey, source, scale, alignment, first_time, .. } = &*self.content;
        let rows = source.rows(path).map_err(MotionError::of_source)?;
        let weaver = Weaver::new(rows, scale.clone(), *alignment, *first_time, survey.largest_id);
        Ok(Box::new(weaver))
    }

    /// Ensemble of the persons present throughout `span_s`. `fps`: `None` is the recording's rate.
    ///
    /// # Errors
    /// The file cannot be read any more; no person is present throughout.
    pub fn ensemble(&self, fps: Option<f64>, span_s: [f64; 2]) -> Result<Ensemble, MotionError> {
        let ensemble = Ensemble::of_motion(&mut *self.motion()?, fps.unwrap_or(self.survey().fps), span_s)?;
        Ok(ensemble.with_statures(self.statures()))
    }
}
