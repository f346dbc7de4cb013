use crate::progress::{Interrupted, Progress, Stage};

/// A range of the progress bar: shares of a step are mapped into it.
#[derive(Clone, Copy)]
pub(super) struct ProgressRange<'a> {
    progress: &'a dyn Progress,
    from: f64,
    to: f64,
}

impl<'a> ProgressRange<'a> {
    /// The whole progress bar.
    pub(super) fn whole(progress: &'a dyn Progress) -> ProgressRange<'a> {
        ProgressRange { progress, from: 0.0, to: 1.0 }
    }

    /// A range within this range, from and to as shares of it.
    pub(super) fn range(&self, from: f64, to: f64) -> ProgressRange<'a> {
        let at = |share: f64| self.from + (self.to - self.from) * share;
        ProgressRange { progress: self.progress, from: at(from), to: at(to) }
    }

    /// Reports the share of the step that is done, 0 to 1.
    pub(super) fn advance(&self, share: f64) {
        self.progress.advance(Stage::Motion, self.from + (self.to - self.from) * share);
    }

    /// Returns an error once the user stops the calculation.
    pub(super) fn keep_on(&self) -> Result<(), Interrupted> {
        self.progress.keep_on()
    }
}
