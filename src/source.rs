//! Sources of motion and their ground.
//!
//! A source is a simulated crowd on a plan, or a given motion (recording, formation) on a plan or on open ground.

use crate::crowd::{Arrival, Simulation, Standstill, Stuck, Tally};
use crate::formation::{self, FormedCrowd};
use crate::marks::Origin;
use crate::math::{Rect, Vec2, sin_cos, vec2};
use crate::motion::{Ensemble, Frame, Motion, MotionError, Statures, Walker};
use crate::plan::{self, FloorPlan, PlanClass, Pose};
use crate::progress::{Progress, Stage, Stopwatch};
use crate::recordings::Recording;
use crate::routes::{Route, StopAt, StopKind, StopRequest};
use crate::scenario::Scenario;
use crate::walls::{Walls, WallsOptions};
use crate::{Error, export::PeopleReport};

/// Share of positions beyond the floor above which a given motion is probably misaligned.
const MOST_BEYOND: f64 = 0.05;

/// The floor and the walls of a motion.
#[derive(Debug)]
pub struct Ground {
    /// Floor plan.
    pub plan: FloorPlan,
    /// Walls of the plan.
    pub walls: Walls,
    /// Whether it is open ground without a plan; all positions are then in the map frame.
    pub open: bool,
}

impl Ground {
    /// Reads the plan of a scenario; without a plan, builds open ground around a given motion.
    ///
    /// # Errors
    /// The plan cannot be read or has no floor; the motion exceeds the largest plan.
    pub fn of_scenario(
        scenario: &Scenario,
        given: Option<&Given>,
        watch: &Stopwatch,
        progress: &dyn Progress,
    ) -> Result<Ground, Error> {
        let image = match (scenario.image_path(), given) {
            (None, Some(given)) => return Ground::around(given),
            (image, _) => image.unwrap_or_default(),
        };
        let plan = watch.busy(Stage::Plan, || plan::read(&image, &scenario.plan_options()))?;
        plan.warnings.iter().for_each(|warning| progress.warn(warning));
        let walls = watch.busy(Stage::Walls, || Walls::trace(&plan, &scenario.walls));
        // One looks over gates and counters, though plans draw them as walls.
        let served = |stop: &&StopRequest| matches!(stop.kind, StopKind::Gate | StopKind::Queue);
        let beside = scenario.routes.stops.iter().filter(served).map(|stop| match stop.at {
            StopAt::Point(point) => [point.to_m(&plan); 2],
            StopAt::Line(ends) => ends.map(|point| point.to_m(&plan)),
        });
        let beside: Vec<[Vec2; 2]> = beside.collect();
        let height_m = PlanClass::Counter.height_m().unwrap_or(1.0);
        Ok(Ground { walls: walls.lowered(&beside, height_m), plan, open: false })
    }

    /// Builds open ground without walls around a given motion; its frame becomes the map frame.
    ///
    /// # Errors
    /// The motion exceeds the largest plan.
    pub fn around(given: &Given) -> Result<Ground, Error> {
        let mut plan = FloorPlan::open_ground(given.bounds_m())?;
        let walls = Walls::trace(&plan, &WallsOptions::default());
        // Floor reaches all sides, but people do not come or go there.
        plan.openings.clear();
        Ok(Ground { plan, walls, open: true })
    }
}

/// A motion that is given instead of simulated.
#[derive(Clone, Debug)]
pub struct Given {
    content: Content,
    frame: CoordinateFrame,
}

#[derive(Clone, Debug)]
enum Content {
    Recording(Recording),
    Ensemble(Ensemble),
    FormedCrowd(FormedCrowd),
}

/// Coordinate frame of a motion's positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoordinateFrame {
    /// The map frame: that of the ROS map if the plan is one, else the plan frame.
    Map,
    /// The plan frame, with its origin at the lower-left corner.
    Plan,
}

impl Given {
    /// Wraps a recording; its positions are in the map frame.
    pub fn recording(recording: Recording) -> Given {
        Given { content: Content::Recording(recording), frame: CoordinateFrame::Map }
    }

    /// Wraps an ensemble, the same people at all times.
    pub fn ensemble(ensemble: Ensemble, frame: CoordinateFrame) -> Given {
        Given { content: Content::Ensemble(ensemble), frame }
    }

    /// Wraps a crowd in formations; its positions are in the plan frame.
    pub fn formation(formed: FormedCrowd) -> Given {
        Given { content: Content::FormedCrowd(formed), frame: CoordinateFrame::Plan }
    }

    /// Removes riders, who are carried and do not touch the floor.
    pub fn on_foot(self) -> Given {
        match self.content {
            Content::FormedCrowd(formed) if formed.riders() > 0 => Given::ensemble(formed.on_foot(), self.frame),
            content => Given { content, ..self },
        }
    }

    /// Opens the formation or the recording of a scenario; `None` if it has neither.
    ///
    /// # Errors
    /// The recording cannot be read; the formations are infeasible; [`Error::Interrupted`].
    pub fn of_scenario(
        scenario: &Scenario,
        watch: &Stopwatch,
        progress: &dyn Progress,
    ) -> Result<Option<Given>, Error> {
        if let Some(request) = &scenario.formation {
            let formed = watch.busy(Stage::Motion, || formation::form(request, &scenario.folder, progress))?;
            return Ok(Some(Given::formation(formed)));
        }
        let Some((path, options)) = scenario.given_recording() else { return Ok(None) };
        let recording = watch.busy(Stage::Motion, || Recording::open_watched(&path, options, progress))?;
        recording.survey().warnings.iter().for_each(|warning| progress.warn(warning));
        Ok(Some(Given::recording(recording)))
    }

    /// Bounding box of all positions, metres.
    pub fn bounds_m(&self) -> Rect {
        match &self.content {
            Content::Recording(recording) => recording.survey().bounds_m,
            Content::Ensemble(ensemble) | Content::FormedCrowd(FormedCrowd { ensemble, .. }) => ensemble.bounds_m(),
        }
    }

    /// Number of people.
    pub fn people(&self) -> u32 {
        let people = match &self.content {
            // A person who returns after a long gap counts as another person.
            Content::Recording(recording) => recording.survey().people + recording.survey().returns as usize,
            Content::Ensemble(ensemble) | Content::FormedCrowd(FormedCrowd { ensemble, .. }) => ensemble.people(),
        };
        people.min(u32::MAX as usize) as u32
    }

    /// Body heights of those whose recording tells them, by their ids in the motion.
    pub fn statures(&self) -> Statures {
        match &self.content {
            Content::Recording(recording) => recording.statures(),
            Content::Ensemble(ensemble) | Content::FormedCrowd(FormedCrowd { ensemble, .. }) => {
                ensemble.statures().clone()
            }
        }
    }

    /// Frame rate, frames per second.
    pub fn fps(&self) -> f64 {
        match &self.content {
            Content::Recording(recording) => recording.survey().fps,
            Content::Ensemble(ensemble) | Content::FormedCrowd(FormedCrowd { ensemble, .. }) => ensemble.fps,
        }
    }

    /// Time of the last frame, seconds.
    pub fn end_s(&self) -> f64 {
        match &self.content {
            Content::Recording(recording) => recording.survey().span_s[1],
            Content::Ensemble(ensemble) | Content::FormedCrowd(FormedCrowd { ensemble, .. }) => {
                ensemble.time_s(ensemble.moments().saturating_sub(1))
            }
        }
    }

    /// Returns the motion from its start, in its own frame.
    ///
    /// # Errors
    /// The recording can no longer be read.
    pub fn motion(&self) -> Result<Box<dyn Motion + Send + '_>, MotionError> {
        match &self.content {
            Content::Recording(recording) => recording.motion(),
            Content::Ensemble(ensemble) | Content::FormedCrowd(FormedCrowd { ensemble, .. }) => {
                Ok(Box::new(ensemble.motion()))
            }
        }
    }
}

/// A simulated or given motion on its ground, in the plan frame.
pub struct Source<'a> {
    mover: Mover<'a>,
    people: u32,
    expected_s: f64,
}

enum Mover<'a> {
    Crowd(Box<Simulation<'a>>),
    Given(Box<Placed<'a>>),
}

impl<'a> Source<'a> {
    /// Wraps a simulated crowd on these routes.
    pub fn of_crowd(crowd: Simulation<'a>, routes: &[Route]) -> Source<'a> {
        let (people, expected_s) = (crowd.arrivals().len() as u32, expected_s(crowd.arrivals(), routes));
        Source { mover: Mover::Crowd(Box::new(crowd)), people, expected_s }
    }

    /// Places a given motion on its ground.
    ///
    /// # Errors
    /// The recording can no longer be read.
    pub fn of_given(given: &'a Given, ground: &'a Ground) -> Result<Source<'a>, Error> {
        let pose = match given.frame {
            CoordinateFrame::Plan if !ground.open => Pose::default(),
            CoordinateFrame::Plan | CoordinateFrame::Map => ground.plan.map_from_plan,
        };
        let placed = Placed::new(given, pose, ground)?;
        Ok(Source { mover: Mover::Given(Box::new(placed)), people: given.people(), expected_s: given.end_s() })
    }

    /// Renumbers people from 0 in order of appearance, like those of a simulated crowd.
    pub fn numbered(mut self) -> Source<'a> {
        if let Mover::Given(placed) = &mut self.mover {
            placed.numbers = Some(Numbers::default());
        }
        self
    }

    /// Stage for progress and timing.
    pub fn stage(&self) -> Stage {
        match &self.mover {
            Mover::Crowd(_) => Stage::Crowd,
            Mover::Given(_) => Stage::Motion,
        }
    }

    /// Total number of people.
    pub fn people(&self) -> u32 {
        self.people
    }

    /// Expected duration without delays, seconds.
    pub fn expected_s(&self) -> f64 {
        self.expected_s
    }

    /// Arrivals of a simulated crowd; empty for a given motion.
    pub fn arrivals(&self) -> &[Arrival] {
        match &self.mover {
            Mover::Crowd(crowd) => crowd.arrivals(),
            Mover::Given(_) => &[],
        }
    }

    /// Origins of people by id, see [`Source::numbered`]. In a given motion all come from outside.
    pub fn origins(&self, fresh_people: u32) -> Vec<Origin> {
        match &self.mover {
            Mover::Crowd(crowd) => {
                Origin::of_arrivals(crowd.arrivals().iter().map(|arrival| arrival.from_outside), fresh_people)
            }
            Mover::Given(_) => Origin::of_arrivals((0..self.people as usize).map(|_| true), fresh_people),
        }
    }

    /// Body heights in metres of those who have appeared in the last frame, by their ids there, where a recording tells
    /// them.
    pub fn newcomers_statures(&self) -> impl Iterator<Item = (u32, f64)> {
        let placed = match &self.mover {
            Mover::Crowd(_) => None,
            Mover::Given(placed) => Some(placed),
        };
        placed.into_iter().flat_map(|placed| {
            placed.newcomers.iter().filter_map(|&id| Some((placed.id_in_frame(id), placed.statures.of(id)?)))
        })
    }

    /// Who has got stuck so far.
    pub fn stuck(&self) -> &[Stuck] {
        match &self.mover {
            Mover::Crowd(crowd) => crowd.stuck(),
            Mover::Given(_) => &[],
        }
    }

    /// Who has waited where so far while a simulated crowd hardly got on.
    pub(crate) fn standstills(&self) -> &[Standstill] {
        match &self.mover {
            Mover::Crowd(crowd) => crowd.standstills(),
            Mover::Given(_) => &[],
        }
    }

    /// Counts of people so far. In a given motion, people who left count as arrived.
    pub fn tally(&self) -> Tally {
        match &self.mover {
            Mover::Crowd(crowd) => crowd.tally(),
            Mover::Given(placed) => Tally {
                entered: placed.entered,
                arrived: placed.entered - placed.present.len() as u64,
                ..Tally::default()
            },
        }
    }

    /// The tally as a report.
    pub fn people_report(&self, routes: &[Route]) -> PeopleReport {
        PeopleReport::of(&self.tally(), routes)
    }

    /// A warning about the alignment of a given motion, after its end.
    pub fn warning(&self) -> Option<String> {
        let Mover::Given(placed) = &self.mover else { return None };
        let share = placed.beyond as f64 / placed.places.max(1) as f64;
        (share > MOST_BEYOND).then(|| {
            let percent = 100.0 * share;
            format!("{percent:.0} % of the motion's places lie beyond the plan's floor: align it by origin, shift and rotation")
        })
    }
}

impl Motion for Source<'_> {
    fn next_frame(&mut self, frame: &mut Frame) -> Result<bool, MotionError> {
        match &mut self.mover {
            Mover::Crowd(crowd) => crowd.next_frame(frame),
            Mover::Given(placed) => placed.next_frame(frame),
        }
    }

    fn share_done(&self) -> f64 {
        match &self.mover {
            Mover::Crowd(crowd) => crowd.share_done(),
            Mover::Given(placed) => placed.motion.share_done(),
        }
    }
}

/// Computes the expected duration of a crowd without delays, seconds.
fn expected_s(arrivals: &[Arrival], routes: &[Route]) -> f64 {
    const USUAL_M_S: f64 = 1.2;
    let last_s = arrivals.last().map_or(0.0, |arrival| arrival.time_s);
    last_s + routes.iter().map(|route| route.length_m).fold(0.0, f64::max) / USUAL_M_S
}

/// A given motion, transformed to the plan frame.
struct Placed<'a> {
    motion: Box<dyn Motion + Send + 'a>,
    statures: Statures,
    /// Who is in the frame and was not in the one before.
    newcomers: Vec<u32>,
    plan: &'a FloorPlan,
    origin_m: Vec2,
    /// Cosine and sine of the rotation from the map to the plan.
    turn: Vec2,
    numbers: Option<Numbers>,
    /// Ids of the people present, ascending.
    present: Vec<u32>,
    entered: u64,
    places: u64,
    beyond: u64,
}

impl<'a> Placed<'a> {
    fn new(given: &'a Given, pose: Pose, ground: &'a Ground) -> Result<Placed<'a>, MotionError> {
        let (sin, cos) = sin_cos(-pose.yaw_rad);
        Ok(Placed {
            motion: given.motion()?,
            statures: given.statures(),
            newcomers: Vec::new(),
            plan: &ground.plan,
            origin_m: pose.origin_m,
            turn: vec2(cos, sin),
            numbers: None,
            present: Vec::new(),
            entered: 0,
            places: 0,
            beyond: 0,
        })
    }

    fn id_in_frame(&self, own_id: u32) -> u32 {
        self.numbers.as_ref().and_then(|numbers| numbers.of(own_id)).unwrap_or(own_id)
    }

    fn next_frame(&mut self, frame: &mut Frame) -> Result<bool, MotionError> {
        if !self.motion.next_frame(frame)? {
            // At the end all people have left.
            self.present.clear();
            self.newcomers.clear();
            return Ok(false);
        }
        for walker in &mut frame.walkers {
            walker.position_m = (walker.position_m - self.origin_m).rotated(self.turn);
            walker.velocity_m_s = walker.velocity_m_s.rotated(self.turn);
            walker.heading = walker.heading.map(|heading| heading.rotated(self.turn));
            self.beyond += u64::from(!self.plan.is_floor(walker.position_m));
        }
        self.places += frame.walkers.len() as u64;
        let ids = frame.walkers.iter().map(|walker| walker.id);
        self.newcomers.clear();
        self.newcomers.extend(ids.filter(|id| self.present.binary_search(id).is_err()));
        self.entered += self.newcomers.len() as u64;
        self.present.clear();
        self.present.extend(frame.walkers.iter().map(|walker| walker.id));
        if let Some(numbers) = &mut self.numbers {
            numbers.give(&mut frame.walkers);
        }
        Ok(true)
    }
}

/// Numbers people from 0 in order of appearance.
#[derive(Debug, Default)]
struct Numbers {
    /// Ids of the people present, ascending, with their numbers.
    given: Vec<(u32, u32)>,
    next: u32,
}

impl Numbers {
    fn of(&self, id: u32) -> Option<u32> {
        self.given.binary_search_by_key(&id, |pair| pair.0).ok().map(|at| self.given[at].1)
    }

    fn give(&mut self, walkers: &mut [Walker]) {
        let before = std::mem::take(&mut self.given);
        for walker in walkers.iter_mut() {
            let number = match before.binary_search_by_key(&walker.id, |pair| pair.0) {
                Ok(at) => before[at].1,
                Err(_) => {
                    self.next += 1;
                    self.next - 1
                }
            };
            self.given.push((walker.id, number));
            walker.id = number;
        }
        walkers.sort_unstable_by_key(|walker| walker.id);
    }
}
