use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::Error;
use crate::crowd::Tally;
use crate::marks::{Contact, Footfalls, Mark};
use crate::motion::{Frame, Motion};
use crate::plan::FloorPlan;
use crate::progress::{Progress, Stage, Stopwatch};
use crate::show::{Path, PathSampler};
use crate::source::Source;

/// Footfalls in a batch: enough to stamp blocks in parallel, few enough to keep all cores busy.
const BATCH: usize = 16_384;

#[derive(Default)]
pub(super) struct Marks {
    /// Footfalls and heel marks.
    pub footfalls: Vec<Mark>,
    /// Wall contacts.
    pub contacts: Vec<Contact>,
}

/// A day: its people's motion, and the marks that they leave.
pub(super) struct Day<'a> {
    pub source: Source<'a>,
    pub footfalls: Footfalls<'a>,
    /// The paths of some of them.
    pub paths: PathSampler,
}

/// What has come of some days, beside their marks.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Walked {
    pub tally: Tally,
    pub people: u32,
    /// Number of people whose touches the wall sums hold.
    pub contact_people: u32,
    pub footfalls: u64,
    pub contacts: u64,
    /// Paths of the first day.
    pub paths: Vec<Path>,
    /// A warning about the motion.
    pub warning: Option<String>,
}

/// Passes the marks of these days to `stamp` in batches, filling the next ones while stamping some. As many days are
/// begun and walked at once as there are threads: their order does not matter, as sums are exact. Of a day that is over
/// only counts stay. Feet on floor that is kept clean leave no marks.
pub(super) fn tread<'a>(
    days: Range<u32>,
    stage: Stage,
    begin: impl Fn(u32) -> Result<Day<'a>, Error> + Sync,
    plan: &FloorPlan,
    stamp: &mut (impl FnMut(&Marks) + Send),
    watch: &Stopwatch,
    progress: &dyn Progress,
) -> Result<Walked, Error> {
    let (first, count) = (days.start, days.len());
    let mut lanes: Vec<Lane> = (0..count.min(rayon::current_num_threads())).map(|_| Lane::default()).collect();
    let rest = Mutex::new(days);
    let rest = || rest.lock().unwrap_or_else(PoisonError::into_inner);
    let open_next = || {
        let next = rest().next();
        let open = |number: u32| {
            let is_first = number == first;
            begin(number).map(|day| OpenDay { number, is_first, day, frame: Frame::default(), told: 0 })
        };
        next.map(open).transpose()
    };
    let mut batches: Vec<Marks> = Vec::new();
    while !rest().is_empty() || lanes.iter().any(|lane| lane.open.is_some()) {
        let fill = |lane: &mut Lane<'a>| lane.fill(open_next, plan, watch, progress);
        let (filled, ()) = rayon::join(
            || lanes.par_iter_mut().with_max_len(1).map(fill).collect::<Result<Vec<Marks>, Error>>(),
            || watch.busy(Stage::Stamps, || batches.iter().for_each(&mut *stamp)),
        );
        batches = filled?;
        progress.advance(stage, lanes.iter().map(Lane::days_done).sum::<f64>() / count as f64);
    }
    watch.busy(Stage::Stamps, || batches.iter().for_each(stamp));
    // Days end in any order.
    let mut ended: Vec<(u32, Walked)> = lanes.into_iter().flat_map(|lane| lane.ended).collect();
    ended.sort_unstable_by_key(|(number, _)| *number);
    let mut walked = Walked::default();
    ended.into_iter().for_each(|(_, day)| walked.add(day));
    Ok(walked)
}

/// Days that are walked one after another, beside those of other lanes.
#[derive(Default)]
struct Lane<'a> {
    open: Option<OpenDay<'a>>,
    /// Days that are over, by number.
    ended: Vec<(u32, Walked)>,
}

/// A day that is being walked.
struct OpenDay<'a> {
    number: u32,
    /// Whether it is the first one of those that are walked.
    is_first: bool,
    day: Day<'a>,
    frame: Frame,
    /// Number of standstills that have been told.
    told: usize,
}

impl<'a> Lane<'a> {
    /// The next batch of marks, up to the end of all days.
    fn fill(
        &mut self,
        open_next: impl Fn() -> Result<Option<OpenDay<'a>>, Error>,
        plan: &FloorPlan,
        watch: &Stopwatch,
        progress: &dyn Progress,
    ) -> Result<Marks, Error> {
        let mut marks = Marks::default();
        while marks.footfalls.len() < BATCH {
            let mut open = match self.open.take() {
                Some(open) => open,
                None => match open_next()? {
                    Some(open) => open,
                    None => break,
                },
            };
            if open.fill(&mut marks, watch, progress)? {
                self.ended.push((open.number, Walked::of_day(open.day)));
            } else {
                self.open = Some(open);
            }
        }
        if !plan.painted.marks.is_empty() {
            marks.footfalls.retain(|mark| {
                let half = mark.heading * (0.5 * f64::from(mark.length_m));
                ![mark.place_m - half, mark.place_m, mark.place_m + half].iter().any(|&p| plan.is_kept_clean(p))
            });
        }
        Ok(marks)
    }

    /// Number of days walked, the open one in part.
    fn days_done(&self) -> f64 {
        self.ended.len() as f64 + self.open.as_ref().map_or(0.0, |open| open.day.source.share_done())
    }
}

impl OpenDay<'_> {
    /// Adds the next marks, up to the end of the motion: whether that is reached.
    fn fill(&mut self, marks: &mut Marks, watch: &Stopwatch, progress: &dyn Progress) -> Result<bool, Error> {
        let Day { source, footfalls, paths } = &mut self.day;
        let mut is_over = false;
        while !is_over && marks.footfalls.len() < BATCH {
            progress.keep_on()?;
            if watch.busy(source.stage(), || source.next_frame(&mut self.frame))? {
                for (id, stature_m) in source.newcomers_statures() {
                    footfalls.know_stature(id, stature_m);
                }
                watch.busy(Stage::Marks, || footfalls.push(&self.frame, &mut marks.footfalls));
                if self.number == 0 {
                    paths.push(&self.frame);
                }
                // Days are alike: what stands in one stands in all.
                if self.is_first {
                    let standstills = source.standstills();
                    standstills[self.told..].iter().for_each(|standstill| progress.warn(&standstill.to_string()));
                    self.told = standstills.len();
                }
            } else {
                watch.busy(Stage::Marks, || footfalls.finish(&mut marks.footfalls));
                is_over = true;
            }
        }
        footfalls.take_lasting(&mut marks.footfalls);
        footfalls.take_contacts(&mut marks.contacts);
        Ok(is_over)
    }
}

impl Walked {
    fn of_day(Day { source, footfalls, paths }: Day<'_>) -> Walked {
        Walked {
            tally: source.tally(),
            people: source.people(),
            contact_people: footfalls.contact_people(),
            footfalls: footfalls.count(),
            contacts: footfalls.contact_count(),
            paths: paths.into_paths(),
            warning: source.warning(),
        }
    }

    /// Adds the days that follow.
    pub fn add(&mut self, later: Walked) {
        self.tally.add(later.tally);
        self.people = self.people.saturating_add(later.people);
        self.contact_people = later.contact_people;
        self.footfalls += later.footfalls;
        self.contacts += later.contacts;
        if self.paths.is_empty() {
            self.paths = later.paths;
        }
        self.warning = self.warning.take().or(later.warning);
    }
}
