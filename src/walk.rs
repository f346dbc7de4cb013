//! The pipeline up to the motion. [`walk`] records a simulated crowd, [`show()`] a given motion.

use std::io;
use std::path::PathBuf;

use serde::Serialize;

use crate::Error;
use crate::crowd::{Simulation, Stuck};
use crate::export::{self, PeopleReport};
use crate::files::{FileError, WholeFile, check_not_input};
use crate::motion::{Frame, Mileage, Motion, People, Statures};
use crate::progress::{Progress, Stage, Stopwatch};
use crate::recordings::{RecordForm, Recorded, RecordedWorld, Recorder, RecordingFormat};
use crate::routes::{Navigation, Route};
use crate::scenario::Scenario;
use crate::show::{self, Animation, AnimationFormat, AnimationOptions, AnimationReport, PathSampler, encode_picture};
use crate::source::{Given, Ground, Source};

/// Outputs of a walk. All of them are optional; the [`WalkReport`] is always returned.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WalkOutputs {
    /// Motion: positions of all people over time.
    pub motion: Option<MotionOutput>,
    /// Format of the motion. `None`: by the file's name, or Juelich text on standard output.
    pub format: Option<RecordingFormat>,
    /// Frame rate of the motion, frames per second; `None` for that of the source.
    pub fps: Option<f64>,
    /// Animation (GIF or animated PNG, by its file name) and its options.
    pub animation: Option<(PathBuf, AnimationOptions)>,
    /// Picture (PNG) of the paths, and of the places where people got stuck.
    pub paths: Option<PathBuf>,
    /// Whether to replace existing files.
    pub force: bool,
}

impl WalkOutputs {
    /// Checks that no output is an input of the run.
    ///
    /// # Errors
    /// [`FileError::IsInput`].
    pub fn check_not_inputs(&self, inputs: &[PathBuf]) -> Result<(), FileError> {
        let motion = self.motion.iter().filter_map(|motion| match motion {
            MotionOutput::File(path) => Some(path),
            MotionOutput::StandardOutput => None,
        });
        let mut files = motion.chain(self.animation.iter().map(|(path, _)| path)).chain(&self.paths);
        files.try_for_each(|file| check_not_input(file, inputs))
    }
}

/// Destination of a motion.
#[derive(Clone, Debug, PartialEq)]
pub enum MotionOutput {
    /// A file; its name gives the format, see [`RecordForm`].
    File(PathBuf),
    /// Text to standard output.
    StandardOutput,
}

/// Statistics of a walk.
#[derive(Clone, Debug, Serialize)]
pub struct WalkReport {
    /// Counts of people who entered, arrived or got stuck.
    pub people: PeopleReport,
    /// Number of people still present at the end.
    pub walking: u64,
    /// Time from the start to the last frame, seconds.
    pub duration_s: f64,
    /// Total distance walked, metres.
    pub metres: f64,
    /// Total time of presence, seconds.
    pub person_seconds: f64,
    /// Distance walked per second of presence, m/s.
    pub mean_speed_m_s: f64,
    /// The written motion, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motion: Option<Recorded>,
    /// The written animation, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub animation: Option<AnimationReport>,
    /// Wall-clock seconds as `total`, and the busy seconds of each stage.
    pub seconds: std::collections::BTreeMap<String, f64>,
    /// Peak memory, MiB, if the system reports it.
    pub peak_memory_mib: Option<f64>,
}

/// Simulates a scenario's crowd, or plays its given motion, and writes the outputs.
///
/// Runs on the current rayon pool. Memory grows with the number of people present, not with the duration. The same
/// scenario gives the same bytes in every file, on any number of threads.
///
/// # Errors
/// Errors of the stages; files that exist, that cannot be written or that have an unknown extension;
/// [`Error::Interrupted`]. After an error no new files remain and earlier files are unchanged.
///
/// # Example
/// ```
/// use trodden::scenario::{Overrides, Scenario};
/// use trodden::walk::{MotionOutput, WalkOutputs, walk};
///
/// let options = Overrides { metres_per_pixel: Some(0.05), people: Some(3), ..Overrides::default() };
/// let scenario = Scenario::from_plan("floorplans/museum.png".as_ref(), &options)?;
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("paths.txt");
/// let outputs = WalkOutputs { motion: Some(MotionOutput::File(path.clone())), ..WalkOutputs::default() };
/// assert_eq!(walk(&scenario, &outputs, &trodden::Silent)?.people.entered, 3);
/// assert!(path.is_file());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn walk(scenario: &Scenario, outputs: &WalkOutputs, progress: &dyn Progress) -> Result<WalkReport, Error> {
    let watch = Stopwatch::start();
    outputs.check_not_inputs(&scenario.input_files())?;
    let files = Files::begin(outputs)?;
    let given = Given::of_scenario(scenario, &watch, progress)?;
    let ground = Ground::of_scenario(scenario, given.as_ref(), &watch, progress)?;
    if let Some(given) = &given {
        let people = scenario.people_of_day(0);
        let source = Source::of_given(given, &ground)?;
        return Walk { source, ground: &ground, routes: &[], people: &people, statures: given.statures() }.record(
            outputs,
            given.fps(),
            files,
            &watch,
            progress,
        );
    }
    let (plan, walls) = (&ground.plan, &ground.walls);
    let (routes, ways) =
        watch.busy(Stage::Routes, || Navigation::find_watched(plan, walls, &scenario.routes, progress))?;
    let scenario = &scenario.lived_in(ways.life().map(|life| &**life));
    let people = scenario.people_of_day(0);
    let mut crowd = watch.busy(Stage::Crowd, || {
        Simulation::with_spots(plan, walls, &routes, ways, &people, &scenario.crowd, &scenario.spots())
    })?;
    let overloads = watch.busy(Stage::Crowd, || crowd.foresee());
    overloads.iter().for_each(|overload| progress.warn(&overload.to_string()));
    let source = Source::of_crowd(crowd, &routes);
    let fps = 1.0 / scenario.crowd.time_step;
    let walk = Walk { source, ground: &ground, routes: &routes, people: &people, statures: Statures::default() };
    walk.record(outputs, fps, files, &watch, progress)
}

/// Plays a given motion on its ground and writes the requested outputs.
///
/// The caller has to protect the files of the motion with [`WalkOutputs::check_not_inputs`].
///
/// # Errors
/// The same as for [`walk`].
pub fn show(
    given: &Given,
    ground: &Ground,
    people: &People,
    outputs: &WalkOutputs,
    progress: &dyn Progress,
) -> Result<WalkReport, Error> {
    let watch = Stopwatch::start();
    let files = Files::begin(outputs)?;
    let source = Source::of_given(given, ground)?;
    let walk = Walk { source, ground, routes: &[], people, statures: given.statures() };
    walk.record(outputs, given.fps(), files, &watch, progress)
}

/// The output files until they are published.
struct Files {
    motion: Option<Sheet>,
    animation: Option<(WholeFile, AnimationFormat)>,
    paths: Option<WholeFile>,
}

/// Destination and format of a motion.
enum Sheet {
    File(RecordForm, WholeFile),
    StandardOutput(RecordingFormat),
}

impl Files {
    /// Creates all output files, so that errors appear before the walk.
    fn begin(outputs: &WalkOutputs) -> Result<Files, Error> {
        let begin = |path: &PathBuf| WholeFile::begin(path, outputs.force);
        let motion = match &outputs.motion {
            None => None,
            Some(MotionOutput::File(path)) => {
                let form = RecordForm::of(path, outputs.format)?;
                Some(Sheet::File(form, begin(path)?))
            }
            Some(MotionOutput::StandardOutput) => {
                Some(Sheet::StandardOutput(outputs.format.unwrap_or(RecordingFormat::Juelich)))
            }
        };
        let animation = match &outputs.animation {
            Some((path, _)) => {
                let format = AnimationFormat::of(path)?;
                Some((begin(path)?, format))
            }
            None => None,
        };
        Ok(Files { motion, animation, paths: outputs.paths.as_ref().map(begin).transpose()? })
    }
}

/// A motion that is ready to be played, and its ground.
struct Walk<'a> {
    source: Source<'a>,
    ground: &'a Ground,
    routes: &'a [Route],
    people: &'a People,
    /// Known statures of recorded people.
    statures: Statures,
}

impl Walk<'_> {
    fn record(
        self,
        outputs: &WalkOutputs,
        own_fps: f64,
        files: Files,
        watch: &Stopwatch,
        progress: &dyn Progress,
    ) -> Result<WalkReport, Error> {
        let Walk { mut source, ground: Ground { plan, walls, .. }, routes, people, statures } = self;
        let world = RecordedWorld { plan, walls, people };
        let fps = outputs.fps.unwrap_or(own_fps);
        let recorder = match files.motion {
            None => None,
            Some(Sheet::File(form, file)) => Some(Recorder::into_file(form, file, fps, world)?),
            Some(Sheet::StandardOutput(format)) => Some(Recorder::to_writer(io::stdout(), format, fps, world)?),
        };
        let recorder = recorder.map(|recorder| recorder.with_statures(statures));
        let arrivals = source.arrivals().to_vec();
        let animation = outputs.animation.as_ref();
        let animation =
            animation.map(|(_, options)| Animation::new(plan, walls, &arrivals, source.expected_s(), options));
        let mut onlookers = Onlookers {
            recorder,
            animation: animation.transpose()?,
            paths: outputs.paths.as_ref().map(|_| PathSampler::new(source.people())),
            mileage: Mileage::default(),
        };
        // On a thread of the pool: handing each step to it from outside would cost more than many a step.
        let duration_s = rayon::scope(|_| onlookers.watch(&mut source, watch, progress))?;
        let tally = source.tally();
        tally.describe(routes, outputs.paths.as_deref()).iter().for_each(|warning| progress.warn(warning));
        source.warning().iter().for_each(|warning| progress.warn(warning));

        let Onlookers { recorder, animation, paths, mileage } = onlookers;
        if let Some(speed) = animation.as_ref().and_then(Animation::speed_refused) {
            progress
                .warn(&format!("at {speed} times the speed the animation would last more than 10 min: it is faster"));
        }
        let animation = match (&animation, &files.animation) {
            (Some(animation), Some((file, format))) => {
                let written =
                    watch.busy(Stage::Export, || animation.write(file.create()?, *format).map_err(|e| file.failed(e)));
                Some(written?)
            }
            _ => None,
        };
        if let (Some(paths), Some(file)) = (&paths, &files.paths) {
            let picture = show::draw_paths(plan, walls, routes, paths.paths(), &tally.stuck);
            file.write(&encode_picture(&picture))?;
        }
        // Everything that can fail is done; publish the files.
        let motion = watch.busy(Stage::Export, || recorder.map(Recorder::finish).transpose())?;
        for file in [files.animation.map(|(file, _)| file), files.paths].into_iter().flatten() {
            file.publish()?;
        }
        Ok(WalkReport {
            walking: tally.entered - tally.arrived - tally.stuck.len() as u64,
            people: source.people_report(routes),
            duration_s,
            metres: mileage.metres(),
            person_seconds: mileage.person_seconds(),
            mean_speed_m_s: mileage.mean_speed_m_s(),
            motion,
            animation,
            seconds: watch.seconds(),
            peak_memory_mib: export::peak_memory_mib(),
        })
    }
}

/// Consumers of the frames of a motion.
struct Onlookers<'a> {
    recorder: Option<Recorder<'a>>,
    animation: Option<Animation<'a>>,
    paths: Option<PathSampler>,
    mileage: Mileage,
}

impl Onlookers<'_> {
    fn look(&mut self, frame: &Frame, stuck: &[Stuck]) -> Result<(), Error> {
        self.mileage.push(frame);
        if let Some(recorder) = &mut self.recorder {
            recorder.push(frame)?;
        }
        if let Some(animation) = &mut self.animation {
            animation.push(frame, stuck);
        }
        if let Some(paths) = &mut self.paths {
            paths.push(frame);
        }
        Ok(())
    }

    /// Plays the motion to its end and returns the time of the last frame, seconds.
    ///
    /// The consumers process one frame while the next is computed.
    fn watch(&mut self, source: &mut Source<'_>, watch: &Stopwatch, progress: &dyn Progress) -> Result<f64, Error> {
        let (mut frame, mut ahead) = (Frame::default(), Frame::default());
        let mut stuck: Vec<Stuck> = Vec::new();
        // A crowd has no people before its first frame; a given motion starts with its first frame, possibly at 0 s.
        let mut begun = source.stage() == Stage::Crowd;
        let mut told = 0;
        loop {
            progress.keep_on()?;
            let (goes_on, looked) = rayon::join(
                || watch.busy(source.stage(), || source.next_frame(&mut ahead)),
                || if begun { watch.busy(Stage::Export, || self.look(&frame, &stuck)) } else { Ok(()) },
            );
            begun = true;
            looked?;
            if !goes_on? {
                progress.advance(source.stage(), 1.0);
                return Ok(frame.time_s);
            }
            std::mem::swap(&mut frame, &mut ahead);
            let newly = source.stuck();
            if newly.len() > stuck.len() {
                stuck.extend_from_slice(&newly[stuck.len()..]);
            }
            source.standstills()[told..].iter().for_each(|standstill| progress.warn(&standstill.to_string()));
            told = source.standstills().len();
            progress.advance(source.stage(), source.share_done());
        }
    }
}
