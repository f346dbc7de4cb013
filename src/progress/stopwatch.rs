use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use super::Stage;

/// Measures how long each stage is at work, on whatever threads, and the whole by the clock on the wall.
#[derive(Debug)]
pub struct Stopwatch {
    start: Instant,
    /// Nanoseconds by stage.
    busy: [AtomicU64; Stage::ALL.len()],
}

impl Stopwatch {
    /// Starts to measure the whole.
    pub fn start() -> Stopwatch {
        Stopwatch { start: Instant::now(), busy: Default::default() }
    }

    /// Does some of a stage's work and adds the time that it took.
    pub fn busy<R>(&self, stage: Stage, work: impl FnOnce() -> R) -> R {
        let start = Instant::now();
        let result = work();
        self.add(stage, start.elapsed().as_secs_f64());
        result
    }

    /// Adds time that a stage measured for itself.
    pub fn add(&self, stage: Stage, seconds: f64) {
        self.busy[stage as usize].fetch_add((seconds.max(0.0) * 1e9) as u64, Ordering::Relaxed);
    }

    /// Wall-clock seconds so far as `total`, and the busy seconds of each stage that was at work, by its name.
    pub fn seconds(&self) -> BTreeMap<String, f64> {
        let busy = |stage: Stage| self.busy[stage as usize].load(Ordering::Relaxed) as f64 * 1e-9;
        let stages = Stage::ALL.into_iter().map(|stage| (stage.name().to_string(), busy(stage)));
        let mut seconds: BTreeMap<_, _> = stages.filter(|&(_, seconds)| seconds > 0.0).collect();
        seconds.insert("total".to_string(), self.start.elapsed().as_secs_f64());
        seconds
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_that_were_not_at_work_are_left_out() {
        let watch = Stopwatch::start();
        watch.add(Stage::Crowd, 1.5);
        watch.add(Stage::Crowd, 0.5);
        let seconds = watch.seconds();
        assert_eq!(seconds["crowd"], 2.0);
        assert_eq!(seconds.keys().map(String::as_str).collect::<Vec<_>>(), ["crowd", "total"]);
    }
}
