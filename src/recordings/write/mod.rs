//! Writes a motion to a file that other programs read: PedPy, JuPedSim, JPSvis, Vadere, game engines.
//!
//! `form` tells the format by the file's name; `text` writes lines,
//! as `rows` (most formats) or `vadere` lay them out, `jupedsim` a database.

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

/// An absence of everybody for longer is passed over, seconds: its frames are not written one by one.
const LONG_ABSENCE_S: f64 = 3600.0;

/// Least and most frames per second of a recording.
pub const FRAME_RATES: [f64; 2] = [0.1, 1000.0];

/// What was recorded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Recorded {
    /// How it was written.
    pub format: RecordingFormat,
    /// Frames per second.
    pub fps: f64,
    /// Number of frames, those without anybody included. Frame `k` shows the moment `k / fps` seconds.
    pub frames: u64,
    /// Number of places written: people times the frames in which they are present.
    pub places: u64,
    /// Size of the file.
    pub bytes: u64,
}

/// Records a motion at a frame rate of its own: between the motion's frames, places are interpolated.
///
/// Holds only the people present, however long the motion is. The file appears under its name when
/// [`Recorder::finish`] has put it there, complete; dropped before that, nothing is left of it. The same motion gives
/// the same bytes.
pub struct Recorder<'a> {
    world: RecordedWorld<'a>,
    frame_of_map: MapFrame,
    resampler: Resampler,
    sheet: Box<dyn MotionSink + 'a>,
    file: Option<WholeFile>,
    written: Recorded,
    /// Who was present in the last frame, and how tall they are.
    heights: Vec<(u32, f64)>,
    statures: Statures,
}

impl<'a> Recorder<'a> {
    /// Begins a file whose name says its format, see [`RecordForm::ENDINGS`].
    ///
    /// # Errors
    /// An unknown ending, a frame rate out of [`FRAME_RATES`], a file that exists unless `force` is set, or that cannot
    /// be written.
    pub fn create(
        path: &Path,
        force: bool,
        fps: f64,
        world: RecordedWorld<'a>,
    ) -> Result<Recorder<'a>, RecordingError> {
        Recorder::create_as(RecordForm::of(path, None)?, path, force, fps, world)
    }

    /// Begins a file in a form of one's own choice, whatever its name.
    ///
    /// # Errors
    /// As [`Recorder::create`], but for the ending; a database that would have to be packed.
    pub fn create_as(
        form: RecordForm,
        path: &Path,
        force: bool,
        fps: f64,
        world: RecordedWorld<'a>,
    ) -> Result<Recorder<'a>, RecordingError> {
        Recorder::into_file(form, WholeFile::begin(path, force)?, fps, world)
    }

    /// Begins a file whose place is reserved already.
    ///
    /// # Errors
    /// As [`Recorder::create_as`], but for the place.
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

    /// Writes text to wherever `out` leads.
    ///
    /// # Errors
    /// A frame rate out of [`FRAME_RATES`]; a format that is no text; `out` cannot be written to.
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

    /// Takes the motion's next frame.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn push(&mut self, frame: &Frame) -> Result<(), RecordingError> {
        let absent_s = self.resampler.push(frame);
        // A short absence is written as it is: databases list its frames.
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

    /// Puts the finished file in its place.
    ///
    /// # Errors
    /// The rest cannot be written.
    pub fn finish(self) -> Result<Recorded, RecordingError> {
        let Recorder { sheet, file, mut written, .. } = self;
        written.bytes = sheet.close().map_err(|source| failed(&file, source))?;
        if let Some(file) = file {
            // Of a stream, only what was counted on the way is known.
            let is_stream = file.is_stream();
            let size = file.publish()?;
            written.bytes = if is_stream { written.bytes } else { size };
        }
        Ok(written)
    }
}

/// How a format's text looks; none for the database.
fn layout(format: RecordingFormat, fps: f64) -> Option<Box<dyn LineFormat>> {
    match format {
        RecordingFormat::Vadere => Some(Box::new(StepFormat::new(fps))),
        format => RowFormat::of(format, fps).map(|rows| Box::new(rows) as Box<dyn LineFormat>),
    }
}

fn check(fps: f64) -> Result<(), RecordingError> {
    let [low, high] = FRAME_RATES;
    // Written so that NaN is out of range.
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

/// Brings the list of heights up to those who are present now; both are in ascending order of ids.
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
