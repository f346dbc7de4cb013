//! The pipeline up to the motion: [`walk`] lets a crowd walk and writes down where everybody went; [`show()`] does the
//! same for a motion that is given.

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

/// What a walk leaves behind. Nothing is a choice too: then only the report says how it went.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WalkOutputs {
    /// Everybody's places over time.
    pub motion: Option<MotionOutput>,
    /// How the motion is written; left out: as the file's name says, Juelich text to standard output.
    pub format: Option<RecordingFormat>,
    /// Frames per second of the motion; left out: those of the simulation.
    pub fps: Option<f64>,
    /// A moving picture (GIF or animated PNG, by its name) and how it looks.
    pub animation: Option<(PathBuf, AnimationOptions)>,
    /// A picture (PNG) of the ways that people took, and of where they got stuck.
    pub paths: Option<PathBuf>,
    /// Whether files that exist are replaced.
    pub force: bool,
}

impl WalkOutputs {
    /// Makes sure that no file is to be written that the run reads.
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

/// Where a motion is written to.
#[derive(Clone, Debug, PartialEq)]
pub enum MotionOutput {
    /// A file whose name says its format, see [`RecordForm`].
    File(PathBuf),
    /// Text to standard output.
    StandardOutput,
}

/// How a walk went.
#[derive(Clone, Debug, Serialize)]
pub struct WalkReport {
    /// What became of everybody.
    pub people: PeopleReport,
    /// How many were still on their way when time was up.
    pub walking: u64,
    /// How long it took from the start until the last one was gone, seconds.
    pub duration_s: f64,
    /// Metres that all walked together.
    pub metres: f64,
    /// Seconds that all were present together.
    pub person_seconds: f64,
    /// Metres walked in a second of somebody's presence.
    pub mean_speed_m_s: f64,
    /// The motion, where it was written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motion: Option<Recorded>,
    /// The animation, where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub animation: Option<AnimationReport>,
    /// Wall-clock seconds as `total`, and the busy seconds of each stage.
    pub seconds: std::collections::BTreeMap<String, f64>,
    /// The most memory held at once, MiB, where the system tells.
    pub peak_memory_mib: Option<f64>,
}

/// Lets a scenario's crowd walk, or plays the motion that takes its place, and writes the motion, an animation and a
/// picture of its paths, on the rayon pool that it is called in. Memory is bounded by the people present, whatever is
/// written.
///
/// The same scenario gives the same bytes in every file, on any number of threads.
///
/// # Errors
/// Whatever a stage says of its input; files that exist, that cannot be written or that have an unknown ending;
/// [`Error::Interrupted`]. In all these cases no file is left behind and earlier ones stay as they were.
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
    let people = People::new(scenario.seed, scenario.bodies.clone());
    if let Some(given) = &given {
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
    let crowd = watch.busy(Stage::Crowd, || {
        Simulation::with_spots(plan, walls, &routes, ways, &people, &scenario.crowd, &scenario.spots())
    })?;
    let source = Source::of_crowd(crowd, &routes);
    let fps = 1.0 / scenario.crowd.time_step;
    let walk = Walk { source, ground: &ground, routes: &routes, people: &people, statures: Statures::default() };
    walk.record(outputs, fps, files, &watch, progress)
}

/// Plays a given motion on its ground, and writes it, an animation and a picture of its paths. The files that the motion
/// was read from are not known here: see [`WalkOutputs::check_not_inputs`].
///
/// # Errors
/// As [`walk`].
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

/// The files in the making.
struct Files {
    motion: Option<Sheet>,
    animation: Option<(WholeFile, AnimationFormat)>,
    paths: Option<WholeFile>,
}

/// Where the motion goes, and how it is written.
enum Sheet {
    File(RecordForm, WholeFile),
    StandardOutput(RecordingFormat),
}

impl Files {
    /// Makes sure that all files can be written, before anybody walks.
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

/// A motion about to be played.
struct Walk<'a> {
    source: Source<'a>,
    ground: &'a Ground,
    routes: &'a [Route],
    people: &'a People,
    /// Of those whose body height is known from elsewhere.
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
        let duration_s = onlookers.watch(&mut source, watch, progress)?;
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
        // All that can fail has been done: now the files appear.
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

/// Who looks on while people walk.
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

    /// Lets people walk to the end: while onlookers take one step in, the next is walked. Gives the time of the last step.
    fn watch(&mut self, source: &mut Source<'_>, watch: &Stopwatch, progress: &dyn Progress) -> Result<f64, Error> {
        let (mut frame, mut ahead) = (Frame::default(), Frame::default());
        let mut stuck: Vec<Stuck> = Vec::new();
        // Before a crowd's first step nobody is there; a given motion begins with its own first frame, which may be at 0.
        let mut begun = source.stage() == Stage::Crowd;
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
            progress.advance(source.stage(), source.share_done());
        }
    }
}
