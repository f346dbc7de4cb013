use std::ops::Range;

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
/// walked at once as there are threads: their order does not matter, as sums are exact. Of a day that is over only counts
/// stay. Feet on floor that is kept clean leave no marks.
pub(super) fn tread<'a>(
    days: Range<u32>,
    begin: impl Fn(u32) -> Result<Day<'a>, Error>,
    plan: &FloorPlan,
    stamp: &mut (impl FnMut(&Marks) + Send),
    watch: &Stopwatch,
    progress: &dyn Progress,
) -> Result<Walked, Error> {
    let open_day =
        |number| Ok::<_, Error>(OpenDay { number, day: begin(number)?, frame: Frame::default(), is_over: false });
    let (count, mut rest) = (days.len(), days);
    let at_once = count.min(rayon::current_num_threads());
    let mut open = rest.by_ref().take(at_once).map(open_day).collect::<Result<Vec<OpenDay>, Error>>()?;
    let mut ended: Vec<(u32, Walked)> = Vec::new();
    let mut batches: Vec<Marks> = Vec::new();
    while let Some(stage) = open.first().map(|open| open.day.source.stage()) {
        let (filled, ()) = rayon::join(
            || open.par_iter_mut().map(|open| open.fill(plan, watch, progress)).collect::<Result<Vec<Marks>, Error>>(),
            || watch.busy(Stage::Stamps, || batches.iter().for_each(&mut *stamp)),
        );
        batches = filled?;
        let walked: f64 = open.iter().map(|open| open.day.source.share_done()).sum();
        progress.advance(stage, (walked + ended.len() as f64) / count as f64);
        let over = open.extract_if(.., |open| open.is_over);
        ended.extend(over.map(|over| (over.number, Walked::of_day(over.day))));
        let fresh = rest.by_ref().take(at_once - open.len()).map(open_day);
        open.extend(fresh.collect::<Result<Vec<OpenDay>, Error>>()?);
    }
    watch.busy(Stage::Stamps, || batches.iter().for_each(stamp));
    // Days end in any order.
    ended.sort_unstable_by_key(|(number, _)| *number);
    let mut walked = Walked::default();
    ended.into_iter().for_each(|(_, day)| walked.add(day));
    Ok(walked)
}

/// A day that is being walked.
struct OpenDay<'a> {
    number: u32,
    day: Day<'a>,
    frame: Frame,
    is_over: bool,
}

impl OpenDay<'_> {
    /// The next batch of marks, up to the end of the motion.
    fn fill(&mut self, plan: &FloorPlan, watch: &Stopwatch, progress: &dyn Progress) -> Result<Marks, Error> {
        let Day { source, footfalls, paths } = &mut self.day;
        let mut marks = Marks::default();
        while marks.footfalls.len() < BATCH {
            progress.keep_on()?;
            if !watch.busy(source.stage(), || source.next_frame(&mut self.frame))? {
                watch.busy(Stage::Marks, || footfalls.finish(&mut marks.footfalls));
                self.is_over = true;
                break;
            }
            for (id, stature_m) in source.newcomers_statures() {
                footfalls.know_stature(id, stature_m);
            }
            watch.busy(Stage::Marks, || footfalls.push(&self.frame, &mut marks.footfalls));
            if self.number == 0 {
                paths.push(&self.frame);
            }
        }
        footfalls.take_lasting(&mut marks.footfalls);
        if !plan.painted.marks.is_empty() {
            marks.footfalls.retain(|mark| {
                let half = mark.heading * (0.5 * f64::from(mark.length_m));
                ![mark.place_m - half, mark.place_m, mark.place_m + half].iter().any(|&p| plan.is_kept_clean(p))
            });
        }
        footfalls.take_contacts(&mut marks.contacts);
        Ok(marks)
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
