use crate::Error;
use crate::marks::{Contact, Footfalls, Mark};
use crate::motion::{Frame, Motion};
use crate::progress::{Progress, Stage, Stopwatch};
use crate::show::PathSampler;
use crate::source::Source;

/// Marks that are stamped at a time: enough that a block's marks are worth a thread, few enough that the crowd
/// and the stamping take turns often and both cores stay busy.
const BATCH: usize = 16_384;

/// A batch of what people leave.
#[derive(Default)]
pub(super) struct Marks {
    /// Footfalls and scuffs on the floor.
    pub footfalls: Vec<Mark>,
    /// Touches of walls.
    pub contacts: Vec<Contact>,
}

/// Lets people walk and hands their marks out in batches: while one batch is stamped, the next is walked.
pub(super) fn tread(
    source: &mut Source<'_>,
    footfalls: &mut Footfalls<'_>,
    paths: &mut PathSampler,
    stamp: &mut (impl FnMut(&Marks) + Send),
    watch: &Stopwatch,
    progress: &dyn Progress,
) -> Result<(), Error> {
    let mut walked = Walk { source, footfalls, paths, frame: Frame::default(), over: false };
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

/// The stream from frames to marks.
struct Walk<'a, 'c, 'f> {
    source: &'a mut Source<'c>,
    footfalls: &'a mut Footfalls<'f>,
    paths: &'a mut PathSampler,
    frame: Frame,
    over: bool,
}

impl Walk<'_, '_, '_> {
    /// Walks on until there is a batch of marks, or to the end.
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
        self.footfalls.take_contacts(&mut marks.contacts);
        progress.advance(self.source.stage(), self.source.share_done());
        Ok(())
    }
}
