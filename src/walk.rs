//! The pipeline up to the motion, in one function: [`walk`] lets a crowd walk and writes down where everybody went.

use std::io;
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::crowd::{Arrival, Crowd, Stuck};
use crate::export::preview::{
    self, Animation, AnimationFormat, AnimationOptions, AnimationReport, PathSampler, encode_picture,
};
use crate::export::{self, PeopleReport};
use crate::files::WholeFile;
use crate::motion::{Frame, Mileage, Motion, People, Recorded, RecordedWorld, Recorder};
use crate::progress::{Progress, Stage, Stopwatch};
use crate::routes::{Navigation, Route};
use crate::scenario::Scenario;
use crate::walls::Walls;
use crate::{Error, plan};

/// What a walk leaves behind. Nothing is a choice too: then only the report says how it went.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WalkOutputs {
    /// Everybody's places over time.
    pub motion: Option<MotionOutput>,
    /// Frames per second of the motion; left out: those of the simulation.
    pub fps: Option<f64>,
    /// A moving picture (GIF or animated PNG, by its name) and how it looks.
    pub animation: Option<(PathBuf, AnimationOptions)>,
    /// A picture (PNG) of the ways that people took, and of where they got stuck.
    pub paths: Option<PathBuf>,
    /// Whether files that exist are replaced.
    pub force: bool,
}

/// Where a motion is written to.
#[derive(Clone, Debug, PartialEq)]
pub enum MotionOutput {
    /// A file whose name says its format, see [`RecordFormat`](crate::motion::RecordFormat).
    File(PathBuf),
    /// Juelich text to standard output.
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

/// Lets a scenario's crowd walk, and writes its motion, an animation and a picture of its paths, on the rayon pool that
/// it is called in. Memory is bounded by the people present, whatever is written.
///
/// The same scenario gives the same bytes in every file, on any number of threads.
///
/// # Errors
/// Whatever a stage says of its input; files that exist, that cannot be written or that have an unknown ending;
/// [`Error::Interrupted`]. In all these cases no file is left behind and earlier ones stay as they were.
pub fn walk(scenario: &Scenario, outputs: &WalkOutputs, progress: &dyn Progress) -> Result<WalkReport, Error> {
    let watch = Stopwatch::start();
    let drawn = outputs.animation.as_ref().map(|(path, _)| AnimationFormat::of(path)).transpose()?;
    let begin = |path: &PathBuf| WholeFile::begin(path, outputs.force);
    let animation_file = outputs.animation.as_ref().map(|(path, _)| begin(path)).transpose()?;
    let paths_file = outputs.paths.as_ref().map(begin).transpose()?;

    let plan = watch.busy(Stage::Plan, || plan::read(&scenario.image_path(), &scenario.plan_options()))?;
    plan.warnings.iter().for_each(|warning| progress.warn(warning));
    let walls = watch.busy(Stage::Walls, || Walls::trace(&plan, &scenario.walls))?;
    let world =
        RecordedWorld { plan: &plan, walls: &walls, people: &People::new(scenario.seed, scenario.bodies.clone()) };
    let recorder = begin_recording(outputs, scenario, world)?;
    let (routes, navigation) = watch.busy(Stage::Routes, || Navigation::find(&plan, &walls, &scenario.routes))?;
    let mut crowd = watch.busy(Stage::Crowd, || {
        Crowd::with_navigation(&plan, &walls, &routes, navigation, world.people, &scenario.crowd)
    })?;

    let arrivals = crowd.arrivals().to_vec();
    let expected_s = expected_s(&arrivals, &routes);
    let animation = outputs.animation.as_ref();
    let animation = animation.map(|(_, options)| Animation::new(&plan, &walls, &arrivals, expected_s, options));
    let mut onlookers = Onlookers {
        recorder,
        animation: animation.transpose()?,
        paths: outputs.paths.as_ref().map(|_| PathSampler::new(scenario.crowd.people)),
        mileage: Mileage::default(),
    };
    let duration_s = watch_crowd(&mut crowd, &mut onlookers, &watch, progress)?;
    let tally = crowd.tally();
    tally.describe(&routes, outputs.paths.as_deref()).iter().for_each(|warning| progress.warn(warning));

    let Onlookers { recorder, animation, paths, mileage } = onlookers;
    if let Some(speed) = animation.as_ref().and_then(Animation::speed_refused) {
        progress.warn(&format!("at {speed} times the speed the animation would last more than 10 min: it is faster"));
    }
    let animation = match (&animation, &animation_file, drawn) {
        (Some(animation), Some(file), Some(format)) => {
            let written =
                watch.busy(Stage::Export, || animation.write(file.create()?, format).map_err(|e| file.failed(e)));
            Some(written?)
        }
        _ => None,
    };
    if let (Some(paths), Some(file)) = (&paths, &paths_file) {
        let picture = preview::draw_paths(&plan, &walls, &routes, paths.paths(), &tally.stuck);
        std::fs::write(file.path(), encode_picture(&picture)).map_err(|source| file.failed(source))?;
    }
    // All that can fail has been done: now the files appear.
    let motion = watch.busy(Stage::Export, || recorder.map(Recorder::finish).transpose())?;
    for file in [animation_file, paths_file].into_iter().flatten() {
        file.publish()?;
    }
    Ok(WalkReport {
        walking: tally.entered - tally.arrived - tally.stuck.len() as u64,
        people: PeopleReport::of(&tally, &routes),
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

/// How long a crowd will walk if nothing holds it up, seconds.
fn expected_s(arrivals: &[Arrival], routes: &[Route]) -> f64 {
    const USUAL_M_S: f64 = 1.2;
    let last_s = arrivals.last().map_or(0.0, |arrival| arrival.time_s);
    last_s + routes.iter().map(|route| route.length_m).fold(0.0, f64::max) / USUAL_M_S
}

fn begin_recording<'a>(
    outputs: &WalkOutputs,
    scenario: &Scenario,
    world: RecordedWorld<'a>,
) -> Result<Option<Recorder<'a>>, Error> {
    let fps = outputs.fps.unwrap_or(1.0 / scenario.crowd.time_step);
    match &outputs.motion {
        None => Ok(None),
        Some(MotionOutput::File(path)) => Recorder::create(path, outputs.force, fps, world).map(Some),
        Some(MotionOutput::StandardOutput) => Recorder::to_writer(io::stdout(), fps, world).map(Some),
    }
}

/// Who looks on while the crowd walks.
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
}

/// Lets the crowd walk to the end: while onlookers take one step in, the next is walked. Gives the time of the last step.
fn watch_crowd(
    crowd: &mut Crowd<'_>,
    onlookers: &mut Onlookers<'_>,
    watch: &Stopwatch,
    progress: &dyn Progress,
) -> Result<f64, Error> {
    let (mut frame, mut ahead) = (Frame::default(), Frame::default());
    let mut stuck: Vec<Stuck> = Vec::new();
    loop {
        if progress.interrupted() {
            return Err(Error::Interrupted);
        }
        let (goes_on, looked) = rayon::join(
            || watch.busy(Stage::Crowd, || crowd.next_frame(&mut ahead)),
            || watch.busy(Stage::Export, || onlookers.look(&frame, &stuck)),
        );
        looked?;
        if !goes_on? {
            progress.advance(Stage::Crowd, 1.0);
            return Ok(frame.time_s);
        }
        std::mem::swap(&mut frame, &mut ahead);
        let newly = crowd.stuck();
        if newly.len() > stuck.len() {
            stuck.extend_from_slice(&newly[stuck.len()..]);
        }
        progress.advance(Stage::Crowd, crowd.share_done());
    }
}

/// Whether two outputs are the same file.
pub fn same_file(a: &Path, b: &Path) -> bool {
    let real = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    real(a) == real(b)
}
