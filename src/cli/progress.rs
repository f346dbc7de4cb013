//! Progress bars on a terminal, and warnings.

use std::collections::BTreeMap;
use std::io::{self, IsTerminal};
use std::sync::Mutex;

use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use trodden::{Progress, Stage};

use super::farm::Form;
use super::{Common, print, signals};

/// Steps of a full bar.
const PARTS: u64 = 1000;

/// Shows a progress bar for each running stage, if standard error is a terminal.
pub struct Watch<'a> {
    common: &'a Common,
    bars: MultiProgress,
    by_stage: Mutex<BTreeMap<Stage, ProgressBar>>,
    /// The form of a render farm in which progress is told too, and the stage and percent that were told last.
    form: Option<Form>,
    told: Mutex<Option<(Stage, u32)>>,
}

impl<'a> Watch<'a> {
    /// Starts to listen for signals: the first one stops the work, the second ends the program.
    pub fn new(common: &'a Common) -> Watch<'a> {
        Watch::telling(common, None)
    }

    /// The same, telling progress to a render farm too.
    pub fn telling(common: &'a Common, form: Option<Form>) -> Watch<'a> {
        signals::listen();
        let shown = !common.quiet && io::stderr().is_terminal();
        let target = if shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        Watch {
            common,
            bars: MultiProgress::with_draw_target(target),
            by_stage: Mutex::default(),
            form,
            told: Mutex::default(),
        }
    }

    fn bar(&self, stage: Stage) -> ProgressBar {
        let coloured = if self.common.colours(&io::stderr()) { ".cyan" } else { "" };
        let template = format!("{{prefix:>9}} {{bar:32{coloured}}} {{percent:>3}} %  {{eta}} left");
        let style = ProgressStyle::with_template(&template).unwrap_or_else(|_| ProgressStyle::default_bar());
        let bar = self.bars.add(ProgressBar::new(PARTS));
        bar.set_style(style.progress_chars("━━╌"));
        bar.set_prefix(stage.name());
        bar
    }
}

impl Drop for Watch<'_> {
    /// Clears the bars of unfinished work.
    fn drop(&mut self) {
        let _ = self.bars.clear();
    }
}

impl Progress for Watch<'_> {
    fn advance(&self, stage: Stage, share: f64) {
        if let Some(form) = self.form {
            let mut told = self.told.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
            let percent = (100.0 * share.clamp(0.0, 1.0)) as u32;
            if *told != Some((stage, percent)) {
                let is_new = told.is_none_or(|(last, _)| last != stage);
                // A farm that no longer listens does not stop the work.
                let _ = print::line(form.progress(is_new.then_some(stage.name()), percent));
                *told = Some((stage, percent));
            }
        }
        if self.bars.is_hidden() {
            return;
        }
        // A panic of another thread under the lock leaves at most a stale bar.
        let mut by_stage = self.by_stage.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        if share >= 1.0 {
            // A stage that runs again gets a new bar.
            if let Some(bar) = by_stage.remove(&stage) {
                bar.finish_and_clear();
            }
        } else {
            let bar = by_stage.entry(stage).or_insert_with(|| self.bar(stage));
            bar.set_position((share.max(0.0) * PARTS as f64) as u64);
        }
    }

    fn warn(&self, message: &str) {
        if !self.common.quiet {
            self.bars.suspend(|| print::to_stderr(&print::warning(message, self.common)));
        }
    }

    fn interrupted(&self) -> bool {
        signals::caught()
    }
}
