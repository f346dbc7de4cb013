use crate::Error;
use crate::marks::{Contact, Footfalls, Mark};
use crate::motion::{Frame, Motion};
use crate::plan::FloorPlan;
use crate::progress::{Progress, Stage, Stopwatch};
use crate::show::PathSampler;
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

/// Passes the marks of a motion to `stamp` in batches, filling the next while stamping one. Feet on floor that is kept
/// clean leave none.
pub(super) fn tread(
    source: &mut Source<'_>,
    footfalls: &mut Footfalls<'_>,
    plan: &FloorPlan,
    paths: &mut PathSampler,
    stamp: &mut (impl FnMut(&Marks) + Send),
    watch: &Stopwatch,
    progress: &dyn Progress,
) -> Result<(), Error> {
    let mut walked = Walk { source, footfalls, plan, paths, frame: Frame::default(), over: false };
    let (mut batch, mut next) = (Marks::default(), Marks::default());
    while !walked.over {
        let (walking, ()) =
            rayon::join(|| walked.fill(&mut next, watch, progress), || watch.busy(Stage::Stamps, || stamp(&batch)));
        walking?;
        std::mem::swap(&mut batch, &mut next);
        next.footfalls.clear();
        next.contacts.clear();
    }
    watch.busy(Stage::Stamps, || stamp(&batch));
    progress.advance(source.stage(), 1.0);
    Ok(())
}

/// Generates marks from frames.
struct Walk<'a, 'c, 'f> {
    source: &'a mut Source<'c>,
    footfalls: &'a mut Footfalls<'f>,
    plan: &'a FloorPlan,
    paths: &'a mut PathSampler,
    frame: Frame,
    over: bool,
}

impl Walk<'_, '_, '_> {
    /// Fills a batch, up to the end of the motion.
    fn fill(&mut self, marks: &mut Marks, watch: &Stopwatch, progress: &dyn Progress) -> Result<(), Error> {
        while marks.footfalls.len() < BATCH {
            progress.keep_on()?;
            if !watch.busy(self.source.stage(), || self.source.next_frame(&mut self.frame))? {
                watch.busy(Stage::Marks, || self.footfalls.finish(&mut marks.footfalls));
                self.over = true;
                break;
            }
            for (id, stature_m) in self.source.newcomers_statures() {
                self.footfalls.know_stature(id, stature_m);
            }
            watch.busy(Stage::Marks, || self.footfalls.push(&self.frame, &mut marks.footfalls));
            self.paths.push(&self.frame);
        }
        self.footfalls.take_lasting(&mut marks.footfalls);
        if !self.plan.painted.marks.is_empty() {
            marks.footfalls.retain(|mark| {
                let half = mark.heading * (0.5 * f64::from(mark.length_m));
                ![mark.place_m - half, mark.place_m, mark.place_m + half].iter().any(|&p| self.plan.is_kept_clean(p))
            });
        }
        self.footfalls.take_contacts(&mut marks.contacts);
        progress.advance(self.source.stage(), self.source.share_done());
        Ok(())
    }
}
