//! Writes a motion as a trajectory file for PedPy, JuPedSim, JPSvis, Vadere or game engines.
//!
//! `form` finds the format from the file name; `text` writes lines, in the layout of `rows` (most formats) or `vadere`;
//! `jupedsim` writes a database.

use std::io::{self, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::files::{FileError, WholeFile};
use crate::motion::{Frame, Resampler, Statures, Walker};
use crate::recordings::{RecordingError, RecordingFormat};

mod form;
mod jupedsim;
mod place;
mod rows;
mod sheet;
mod text;
mod vadere;
mod wkt;
mod world;

pub use form::RecordForm;
use jupedsim::JupedsimDatabase;
use place::{MapFrame, RecordedPlace};
use rows::RowFormat;
use sheet::MotionSink;
use text::{LineFormat, Out, Text};
use vadere::StepFormat;
pub use world::RecordedWorld;

/// Longest period without people whose empty frames are written, seconds.
const LONG_ABSENCE_S: f64 = 3600.0;

/// Smallest and largest frames per second of a recording.
pub const FRAME_RATES: [f64; 2] = [0.1, 1000.0];

/// Summary of a written recording.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Recorded {
    /// File format.
    pub format: RecordingFormat,
    /// Frames per second.
    pub fps: f64,
    /// Number of frames, empty ones included. Frame `k` is at `k / fps` seconds.
    pub frames: u64,
    /// Number of positions written, summed over all frames.
    pub places: u64,
    /// Size of the file, bytes.
    pub bytes: u64,
}

/// Writes a motion at a given frame rate. Positions are interpolated between the motion's frames.
///
/// Holds only the people present, however long the motion is. [`Recorder::finish`] puts the complete file in its place;
/// if dropped before, the file is deleted. The same motion gives the same bytes.
pub struct Recorder<'a> {
    world: RecordedWorld<'a>,
    frame_of_map: MapFrame,
    resampler: Resampler,
    sheet: Box<dyn MotionSink + 'a>,
    file: Option<WholeFile>,
    written: Recorded,
    /// Ids present in the last frame, with body heights in metres.
    heights: Vec<(u32, f64)>,
    statures: Statures,
}

impl<'a> Recorder<'a> {
    /// Begins a file; its name gives the format, see [`RecordForm::ENDINGS`].
    ///
    /// # Errors
    /// The ending is unknown; the frame rate is outside [`FRAME_RATES`]; the file exists and `force` is not set, or
    /// cannot be written.
    pub fn create(
        path: &Path,
        force: bool,
        fps: f64,
        world: RecordedWorld<'a>,
    ) -> Result<Recorder<'a>, RecordingError> {
        Recorder::create_as(RecordForm::of(path, None)?, path, force, fps, world)
    }

    /// Begins a file in a given form; its name does not matter.
    ///
    /// # Errors
    /// As [`Recorder::create`], except for the ending; a database cannot be gzipped.
    pub fn create_as(
        form: RecordForm,
        path: &Path,
        force: bool,
        fps: f64,
        world: RecordedWorld<'a>,
    ) -> Result<Recorder<'a>, RecordingError> {
        Recorder::into_file(form, WholeFile::begin(path, force)?, fps, world)
    }

    /// Begins a recording in a file that is already reserved.
    ///
    /// # Errors
    /// As [`Recorder::create_as`], except for the path.
    pub fn into_file(
        form: RecordForm,
        file: WholeFile,
        fps: f64,
        world: RecordedWorld<'a>,
    ) -> Result<Recorder<'a>, RecordingError> {
        check(fps)?;
        let RecordForm { format, packed } = form;
        if packed && !format.is_text() {
            return Err(RecordingError::NoText { format });
        }
        if file.is_stream() && !format.is_text() {
            return Err(RecordingError::NoText { format });
        }
        let sheet: Box<dyn MotionSink> = match layout(format, fps) {
            Some(layout) => {
                let out = file.create()?;
                let out = if packed { Out::packed(out) } else { Out::Plain(out) };
                Box::new(Text::begin(out, layout).map_err(|source| file.failed(source))?)
            }
            None => {
                let begun = JupedsimDatabase::begin(file.path(), fps, &world);
                Box::new(begun.map_err(|source| file.failed(source))?)
            }
        };
        Ok(Recorder::new(world, fps, format, sheet, Some(file)))
    }

    /// Writes a text format to `out`.
    ///
    /// # Errors
    /// The frame rate is outside [`FRAME_RATES`]; the format is not text; `out` cannot be written to.
    pub fn to_writer(
        out: impl Write + Send + 'a,
        format: RecordingFormat,
        fps: f64,
        world: RecordedWorld<'a>,
    ) -> Result<Recorder<'a>, RecordingError> {
        check(fps)?;
        let Some(layout) = layout(format, fps) else { return Err(RecordingError::NoText { format }) };
        let out = Out::Plain(io::BufWriter::with_capacity(1 << 16, out));
        let text = Text::begin(out, layout).map_err(unnamed)?;
        Ok(Recorder::new(world, fps, format, Box::new(text), None))
    }

    fn new(
        world: RecordedWorld<'a>,
        fps: f64,
        format: RecordingFormat,
        sheet: Box<dyn MotionSink + 'a>,
        file: Option<WholeFile>,
    ) -> Recorder<'a> {
        Recorder {
            frame_of_map: MapFrame::of(&world.plan.map_from_plan),
            world,
            resampler: Resampler::new(fps),
            sheet,
            file,
            written: Recorded { format, fps, frames: 0, places: 0, bytes: 0 },
            heights: Vec::new(),
            statures: Statures::default(),
        }
    }

    /// The same with body heights that are known from elsewhere; those of the others are the world's people's.
    pub(crate) fn with_statures(self, statures: Statures) -> Recorder<'a> {
        Recorder { statures, ..self }
    }

    /// Adds the motion's next frame.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn push(&mut self, frame: &Frame) -> Result<(), RecordingError> {
        let absent_s = self.resampler.push(frame);
        // A short absence is written frame by frame: databases list empty frames.
        if absent_s > LONG_ABSENCE_S {
            self.resampler.pass_over_absence();
        }
        while let Some((number, walkers)) = self.resampler.next() {
            let (statures, people) = (&self.statures, self.world.people);
            measure_heights(&mut self.heights, &walkers, |id| {
                statures.of(id).unwrap_or_else(|| people.person(id).stature_m)
            });
            let places: Vec<RecordedPlace> = (walkers.iter().zip(&self.heights))
                .map(|(walker, &(_, height_m))| self.frame_of_map.place(walker, height_m))
                .collect();
            self.sheet.frame(number, &places).map_err(|source| failed(&self.file, source))?;
            self.written.frames = number + 1;
            self.written.places += places.len() as u64;
        }
        Ok(())
    }

    /// Completes the file and puts it in its place.
    ///
    /// # Errors
    /// The rest of the file cannot be written.
    pub fn finish(self) -> Result<Recorded, RecordingError> {
        let Recorder { sheet, file, mut written, .. } = self;
        written.bytes = sheet.close().map_err(|source| failed(&file, source))?;
        if let Some(file) = file {
            // The size of a stream is the number of bytes written.
            let is_stream = file.is_stream();
            let size = file.publish()?;
            written.bytes = if is_stream { written.bytes } else { size };
        }
        Ok(written)
    }
}

/// Returns the text layout of a format; `None` for the database.
fn layout(format: RecordingFormat, fps: f64) -> Option<Box<dyn LineFormat>> {
    match format {
        RecordingFormat::Vadere => Some(Box::new(StepFormat::new(fps))),
        format => RowFormat::of(format, fps).map(|rows| Box::new(rows) as Box<dyn LineFormat>),
    }
}

fn check(fps: f64) -> Result<(), RecordingError> {
    let [low, high] = FRAME_RATES;
    // NaN must be out of range.
    if fps >= low && fps <= high { Ok(()) } else { Err(RecordingError::FrameRate { fps, low, high }) }
}

fn failed(file: &Option<WholeFile>, source: io::Error) -> RecordingError {
    match file {
        Some(file) => file.failed(source).into(),
        None => unnamed(source),
    }
}

fn unnamed(source: io::Error) -> RecordingError {
    FileError::Write { path: "the motion".into(), source }.into()
}

/// Updates the heights to the persons present now; both lists ascend by id.
fn measure_heights(heights: &mut Vec<(u32, f64)>, walkers: &[Walker], height_m_of: impl Fn(u32) -> f64) {
    let before = std::mem::take(heights);
    let mut known = before.iter().peekable();
    heights.reserve(walkers.len());
    for walker in walkers {
        while known.next_if(|&&(id, _)| id < walker.id).is_some() {}
        let height_m = match known.next_if(|&&(id, _)| id == walker.id) {
            Some(&(_, height_m)) => height_m,
            None => height_m_of(walker.id),
        };
        heights.push((walker.id, height_m));
    }
}

#[cfg(test)]
mod tests;
