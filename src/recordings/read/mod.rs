//! Reads what others recorded or simulated: whatever the format, out comes a [`Motion`].
//!
//! 1. `detect`: how a text is laid out, by its beginning: `columns` knows names, `guess` numbers without names;
//! 2. `input`, `layout`, `number`: lines, fields, numbers; `rows`: somebody's places, from a text, a `database`, or, where
//!    a file is not in the order of time, from `memory`;
//! 3. `census`: one pass over all rows, which finds what there is; `scale`: what its numbers mean in metres and seconds;
//! 4. `weave`: frames.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::math::Rect;
use crate::motion::{Ensemble, Motion, MotionError, Statures};
use crate::progress::{Progress, Silent};

mod census;
mod columns;
mod database;
mod detect;
mod error;
mod format;
mod guess;
mod histogram;
mod input;
mod layout;
mod memory;
mod number;
mod open;
mod rows;
mod scale;
mod weave;

pub use error::RecordingError;
pub use format::RecordingFormat;

use open::Source;
use scale::{Alignment, Scale};
use weave::Weaver;

/// Unit of the lengths in a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum LengthUnit {
    /// Metres.
    #[serde(rename = "m")]
    Metre,
    /// Centimetres.
    #[serde(rename = "cm")]
    Centimetre,
    /// Millimetres.
    #[serde(rename = "mm")]
    Millimetre,
    /// Feet.
    #[serde(rename = "ft")]
    Foot,
}

impl LengthUnit {
    /// All units.
    pub const ALL: [LengthUnit; 4] =
        [LengthUnit::Metre, LengthUnit::Centimetre, LengthUnit::Millimetre, LengthUnit::Foot];

    /// What it is called in scenarios and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            LengthUnit::Metre => "m",
            LengthUnit::Centimetre => "cm",
            LengthUnit::Millimetre => "mm",
            LengthUnit::Foot => "ft",
        }
    }

    /// Metres in one of it.
    pub const fn metres(self) -> f64 {
        match self {
            LengthUnit::Metre => 1.0,
            LengthUnit::Centimetre => 0.01,
            LengthUnit::Millimetre => 0.001,
            LengthUnit::Foot => 0.3048,
        }
    }
}

/// How a recording is read; what is left out is found in the file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RecordingOptions {
    /// How it is written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub format: Option<RecordingFormat>,
    /// Unit of its lengths.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<LengthUnit>,
    /// Frames per second, for files that count frames.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fps: Option<f64>,
    /// What columns mean, in their order, as `id,frame,x,y`; `-` for one that is of no use.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub columns: Option<String>,
    /// The point of the recording that stays where it is when it is turned, metres.
    pub origin: [f64; 2],
    /// How far it is moved, metres.
    pub shift: [f64; 2],
    /// How far it is turned around `origin`, degrees counter-clockwise.
    pub rotation_deg: f64,
}

impl RecordingOptions {
    /// These options, with those of `others` that are not left out.
    pub fn overridden_by(&self, others: &RecordingOptions) -> RecordingOptions {
        let default = RecordingOptions::default();
        let pick = |own: [f64; 2], other: [f64; 2], none: [f64; 2]| if other == none { own } else { other };
        RecordingOptions {
            format: others.format.or(self.format),
            unit: others.unit.or(self.unit),
            fps: others.fps.or(self.fps),
            columns: others.columns.clone().or_else(|| self.columns.clone()),
            origin: pick(self.origin, others.origin, default.origin),
            shift: pick(self.shift, others.shift, default.shift),
            rotation_deg: if others.rotation_deg == 0.0 { self.rotation_deg } else { others.rotation_deg },
        }
    }
}

/// What a recording holds, found in one pass.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Survey {
    /// How it is written.
    pub format: RecordingFormat,
    /// Unit of its lengths.
    pub unit: LengthUnit,
    /// Frames per second of the motion; the usual rate where it changes.
    pub fps: f64,
    /// Number of people in the file.
    pub people: usize,
    /// The largest id in the file. Who comes back after a long gap gets one above it.
    pub largest_id: u32,
    /// How often somebody was missing for longer than a gap, and came back: as another person.
    pub returns: u64,
    /// Number of moments at which anybody is there.
    pub frames: usize,
    /// Number of places: people times the moments in which they are there.
    pub places: usize,
    /// First and last moment, seconds.
    pub span_s: [f64; 2],
    /// Seconds that all are present together.
    pub person_seconds: f64,
    /// Metres walked in a second of somebody's presence, sway and noise taken out as far as five rows in a row tell.
    pub mean_speed_m_s: f64,
    /// The rectangle around all places, after the alignment, metres.
    pub bounds_m: Rect,
    /// Whether rows come in the order of time: if not, they are held in memory and sorted.
    pub in_order: bool,
    /// What a user should be told, such as a unit or a rate that was assumed.
    pub warnings: Vec<String>,
}

/// A recording: surveyed once, and read as often as is wanted.
#[derive(Clone, Debug)]
pub struct Recording {
    content: Arc<Content>,
}

#[derive(Debug)]
struct Content {
    path: PathBuf,
    survey: Survey,
    statures: Statures,
    source: Source,
    scale: Scale,
    alignment: Alignment,
    first_time: f64,
}

impl Recording {
    /// Looks through a file, once; where its rows are not in the order of time, twice, and keeps them.
    ///
    /// # Errors
    /// A file that cannot be read or is none of the formats, with the line; a rate that nobody knows; places that are
    /// infinite; somebody at two places at once; options out of range.
    pub fn open(path: &Path, options: &RecordingOptions) -> Result<Recording, RecordingError> {
        open::open(path, options, &Silent)
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
        open::open(path, options, progress)
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
        let Content { path, survey, source, scale, alignment, first_time, .. } = &*self.content;
        let rows = source.rows(path).map_err(MotionError::of_source)?;
        let weaver = Weaver::new(rows, scale.clone(), *alignment, *first_time, survey.largest_id);
        Ok(Box::new(weaver))
    }

    /// Those who are there throughout a time, at a rate: `None` is the recording's own.
    ///
    /// # Errors
    /// The file cannot be read any more; nobody is there throughout.
    pub fn ensemble(&self, fps: Option<f64>, span_s: [f64; 2]) -> Result<Ensemble, MotionError> {
        Ensemble::of_motion(&mut *self.motion()?, fps.unwrap_or(self.survey().fps), span_s)
    }
}
