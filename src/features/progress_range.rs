use crate::progress::{Interrupted, Progress, Stage};

/// A part of some longer work: its shares are shares of the whole's part.
#[derive(Clone, Copy)]
pub(super) struct ProgressRange<'a> {
    progress: &'a dyn Progress,
    from: f64,
    to: f64,
}

impl<'a> ProgressRange<'a> {
    /// All of the work.
    pub(super) fn whole(progress: &'a dyn Progress) -> ProgressRange<'a> {
        ProgressRange { progress, from: 0.0, to: 1.0 }
    }

    /// A part of this part.
    pub(super) fn part(&self, from: f64, to: f64) -> ProgressRange<'a> {
        let at = |share: f64| self.from + (self.to - self.from) * share;
        ProgressRange { progress: self.progress, from: at(from), to: at(to) }
    }

    /// So much of the part is done.
    pub(super) fn advance(&self, share: f64) {
        self.progress.advance(Stage::Motion, self.from + (self.to - self.from) * share);
    }

    /// Gives up once the user wants the work to stop.
    pub(super) fn keep_on(&self) -> Result<(), Interrupted> {
        self.progress.keep_on()
    }
}
