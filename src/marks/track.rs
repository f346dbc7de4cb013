//! The smoothed path of one person.

use crate::math::Vec2;

/// The clock on which paths are kept, seconds. It is the same for every source, so what follows does not depend on
/// the source's time step.
pub(super) const TICK_S: f64 = 0.1;
/// Ticks on either side that the smoothing may use; also its delay.
const REACH: usize = 20;
/// Ticks of a full window.
const WINDOW: usize = 2 * REACH + 1;
/// Points held: windows are moved to the front once per `HELD - WINDOW` ticks.
const HELD: usize = 96;
/// A gap in time, or a jump, beyond which a person is taken to have been elsewhere in between.
const GAP_S: f64 = 5.0;
const JUMP_M_S: f64 = 12.0;

/// A tick of the smoothed path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sample {
    pub position_m: Vec2,
    pub velocity_m_s: Vec2,
}

/// One person's path: raw positions in, smoothed samples out, two seconds later.
///
/// Each sample is the local quadratic through the positions around it (weights `1 - (t/h)^2`, h about one stride, 0.8
/// to 2 s). That takes out the sway of a stride and of a step (3 to 7 cm in recordings) and the jitter of collisions, and leaves
/// a turn of 0.7 m radius within 4 cm, where a running mean would cut it by 10. Beyond its ends a path is continued
/// by its reflection in the end point, so that straight paths stay straight.
pub(super) struct Track {
    points: Vec<Vec2>,
    /// Index of the window's first point within `points`.
    start: usize,
    /// The last raw position and its time.
    last: (f64, Vec2),
    /// The next tick of the clock.
    next_tick: f64,
    /// Whether the reflection before the start is in place.
    begun: bool,
}

impl Track {
    pub fn new(time_s: f64, position_m: Vec2) -> Track {
        let mut track = Track {
            points: Vec::with_capacity(HELD),
            start: 0,
            last: (time_s, position_m),
            next_tick: (time_s / TICK_S).ceil(),
            begun: false,
        };
        if track.next_tick * TICK_S == time_s {
            track.points.push(position_m);
            track.next_tick += 1.0;
        }
        track
    }

    /// Whether a position continues this path, rather than that of somebody who was elsewhere in between.
    pub fn continues(&self, time_s: f64, position_m: Vec2) -> bool {
        let elapsed = time_s - self.last.0;
        elapsed <= GAP_S && position_m.distance(self.last.1) <= 0.5 + JUMP_M_S * elapsed.max(0.0)
    }

    /// Takes the next raw position; gives the samples that are now known to `each`.
    pub fn push(&mut self, time_s: f64, position_m: Vec2, mut each: impl FnMut(Sample)) {
        let (last_s, last_m) = self.last;
        if time_s <= last_s {
            return;
        }
        while self.next_tick * TICK_S <= time_s {
            let share = (self.next_tick * TICK_S - last_s) / (time_s - last_s);
            self.next_tick += 1.0;
            self.add(last_m.lerp(position_m, share.clamp(0.0, 1.0)), &mut each);
        }
        self.last = (time_s, position_m);
    }

    /// Ends the path; gives the samples that are left to `each`.
    pub fn finish(&mut self, mut each: impl FnMut(Sample)) {
        let Some(&end) = self.points.last() else { return };
        let newest = self.points.len() - 1;
        let oldest = if self.begun { self.start } else { 0 };
        let tail: Vec<Vec2> =
            (1..=REACH).map(|n| end * 2.0 - self.points[newest.saturating_sub(n).max(oldest)]).collect();
        for point in tail {
            self.add(point, &mut each);
        }
        self.points.clear();
        self.start = 0;
        self.begun = false;
    }

    fn add(&mut self, point: Vec2, each: &mut impl FnMut(Sample)) {
        if self.points.len() == HELD {
            self.points.copy_within(self.start.., 0);
            self.points.truncate(HELD - self.start);
            self.start = 0;
        }
        self.points.push(point);
        if !self.begun && self.points.len() > REACH {
            self.begun = true;
            let first = self.points[0];
            let before: Vec<Vec2> = (1..=REACH).rev().map(|n| first * 2.0 - self.points[n]).collect();
            self.points.splice(0..0, before);
        }
        if self.begun {
            each(smooth(&self.points[self.start..self.start + WINDOW]));
            self.start += 1;
        }
    }
}

/// The local quadratic in the middle of a window.
fn smooth(window: &[Vec2]) -> Sample {
    let middle = window[REACH];
    let reach = half_width_ticks(window);
    let shrink = 1.0 / (reach * reach);
    // Moments of the weights, and of the positions about the middle one.
    let (mut s0, mut s2, mut s4) = (1.0, 0.0, 0.0);
    let (mut even, mut even2, mut odd) = (Vec2::ZERO, Vec2::ZERO, Vec2::ZERO);
    for n in 1..=(reach as usize).min(REACH) {
        let square = (n * n) as f64;
        let weight = 1.0 - square * shrink;
        let (ahead, behind) = (window[REACH + n] - middle, window[REACH - n] - middle);
        s0 += 2.0 * weight;
        s2 += 2.0 * weight * square;
        s4 += 2.0 * weight * square * square;
        even += (ahead + behind) * weight;
        even2 += (ahead + behind) * (weight * square);
        odd += (ahead - behind) * (weight * n as f64);
    }
    let offset = (even * s4 - even2 * s2) / (s0 * s4 - s2 * s2);
    Sample { position_m: middle + offset, velocity_m_s: odd / (s2 * TICK_S) }
}

/// Half width of the smoothing: the stride (two steps) at the speed over the two seconds around, at which the sway
/// falls into the first null of the filter.
fn half_width_ticks(window: &[Vec2]) -> f64 {
    const SPAN: usize = 10;
    let speed = window[REACH + SPAN].distance(window[REACH - SPAN]) / (2.0 * SPAN as f64 * TICK_S);
    let step_m = 0.247 + 0.344 * speed;
    (1.03 * 2.0 * step_m / speed.max(0.05) / TICK_S).clamp(8.0, REACH as f64)
}
