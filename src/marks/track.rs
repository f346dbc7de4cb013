//! The smoothed path of one person.

use crate::math::Vec2;

/// Time step of resampled paths, seconds: the same for every source.
pub(super) const TICK_S: f64 = 0.1;
/// Ticks on either side of the smoothing window; also its delay.
const REACH: usize = 20;
/// Ticks of a full window.
const WINDOW: usize = 2 * REACH + 1;
/// Capacity in points: the window moves to the front once per `HELD - WINDOW` ticks.
const HELD: usize = 96;
/// Gap in time, seconds, and speed of a jump, metres per second, that interrupt a path.
const GAP_S: f64 = 5.0;
const JUMP_M_S: f64 = 12.0;

/// Ticks on either side over which headings are smoothed: a stride at 0.7 m/s, for headings that sway with the head.
const FACING_REACH: usize = 10;
/// A body that moves less than this distance, metres, in this many ticks stands; more than the sway of standing.
const REST_M: f64 = 0.08;
const REST_TICKS: usize = 7;

/// A tick of the smoothed path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TrackSample {
    pub position_m: Vec2,
    pub velocity_m_s: Vec2,
    /// Unit vector: where the body faces, if the source says so.
    pub facing: Option<Vec2>,
    /// Displacement of the body two seconds later, metres.
    pub ahead_m: Vec2,
    /// Whether the body stands by then.
    pub comes_to_rest: bool,
}

/// One person's smoothed path: takes raw positions, returns samples two seconds later.
///
/// A sample is the local quadratic fit to the positions around it (weights `1 - (t/h)^2`, h about one stride, 0.8 to
/// 2 s). The fit removes the sway of strides and steps (3 to 7 cm in recordings) and the jitter of collisions. It keeps
/// a turn of 0.7 m radius within 4 cm, where a moving average would cut it by 10 cm. A path is extended by its point
/// reflection in its ends, so that straight paths stay straight.
pub(super) struct SmoothedPath {
    points: Vec<Vec2>,
    /// Facing at each point; zero where unknown. Empty until the first is known.
    facings: Vec<Vec2>,
    /// Index of the window's first point within `points`.
    start: usize,
    /// The last raw position and its time.
    last: (f64, Vec2),
    last_facing: Option<Vec2>,
    /// The next tick of the clock.
    next_tick: f64,
    /// Whether the reflection before the start is in place.
    begun: bool,
}

impl SmoothedPath {
    pub fn new(time_s: f64, position_m: Vec2, facing: Option<Vec2>) -> SmoothedPath {
        let facing = facing.and_then(unit);
        let mut track = SmoothedPath {
            points: Vec::with_capacity(HELD),
            facings: Vec::with_capacity(if facing.is_some() { HELD } else { 0 }),
            start: 0,
            last: (time_s, position_m),
            last_facing: facing,
            next_tick: (time_s / TICK_S).ceil(),
            begun: false,
        };
        if track.next_tick * TICK_S == time_s {
            track.add(position_m, facing, &mut |_| ());
            track.next_tick += 1.0;
        }
        track
    }

    /// Whether a position continues this path without a gap or a jump.
    pub fn continues(&self, time_s: f64, position_m: Vec2) -> bool {
        let elapsed = time_s - self.last.0;
        elapsed <= GAP_S && position_m.distance(self.last.1) <= 0.5 + JUMP_M_S * elapsed.max(0.0)
    }

    /// Takes the next raw position and facing; calls `each` with the completed samples.
    pub fn push(&mut self, time_s: f64, position_m: Vec2, facing: Option<Vec2>, mut each: impl FnMut(TrackSample)) {
        let (last_s, last_m) = self.last;
        if time_s <= last_s {
            return;
        }
        let facing = facing.and_then(unit);
        while self.next_tick * TICK_S <= time_s {
            let share = ((self.next_tick * TICK_S - last_s) / (time_s - last_s)).clamp(0.0, 1.0);
            self.next_tick += 1.0;
            let between = match (self.last_facing, facing) {
                (Some(last), Some(next)) => unit(last.lerp(next, share)).or(facing),
                (last, next) => next.or(last),
            };
            self.add(last_m.lerp(position_m, share), between, &mut each);
        }
        self.last = (time_s, position_m);
        self.last_facing = facing;
    }

    /// Ends the path; calls `each` with the remaining samples.
    pub fn finish(&mut self, mut each: impl FnMut(TrackSample)) {
        let Some(&end) = self.points.last() else { return };
        let newest = self.points.len() - 1;
        let oldest = if self.begun { self.start } else { 0 };
        let tail: Vec<Vec2> =
            (1..=REACH).map(|n| end * 2.0 - self.points[newest.saturating_sub(n).max(oldest)]).collect();
        // A person who leaves keeps their facing.
        let facing = self.last_facing;
        for point in tail {
            self.add(point, facing, &mut each);
        }
        self.points.clear();
        self.facings.clear();
        self.start = 0;
        self.begun = false;
    }

    fn add(&mut self, point: Vec2, facing: Option<Vec2>, each: &mut impl FnMut(TrackSample)) {
        if self.points.len() == HELD {
            for list in [&mut self.points, &mut self.facings] {
                list.drain(..self.start.min(list.len()));
            }
            self.start = 0;
        }
        if facing.is_some() && self.facings.is_empty() {
            self.facings.resize(self.points.len(), Vec2::ZERO);
        }
        self.points.push(point);
        if !self.facings.is_empty() || facing.is_some() {
            self.facings.push(facing.unwrap_or(Vec2::ZERO));
        }
        if !self.begun && self.points.len() > REACH {
            self.begun = true;
            let first = self.points[0];
            let before: Vec<Vec2> = (1..=REACH).rev().map(|n| first * 2.0 - self.points[n]).collect();
            self.points.splice(0..0, before);
            if let Some(&first) = self.facings.first() {
                self.facings.splice(0..0, [first; REACH]);
            }
        }
        if self.begun {
            let window = self.start..self.start + WINDOW;
            let facing = self.facings.get(window.clone()).and_then(evened_out);
            each(TrackSample { facing, ..smooth(&self.points[window]) });
            self.start += 1;
        }
    }
}

/// Unit vector of a finite vector other than zero.
fn unit(v: Vec2) -> Option<Vec2> {
    v.normalized().filter(|v| v.is_finite())
}

/// Smoothed facing in the middle of a window, with the weights of positions.
fn evened_out(window: &[Vec2]) -> Option<Vec2> {
    let reach = (FACING_REACH * FACING_REACH) as f64;
    let mut sum = window[REACH];
    if sum == Vec2::ZERO {
        return None;
    }
    for n in 1..FACING_REACH {
        sum += (window[REACH - n] + window[REACH + n]) * (1.0 - (n * n) as f64 / reach);
    }
    unit(sum).or(Some(window[REACH]))
}

/// Local quadratic fit in the middle of a window.
fn smooth(window: &[Vec2]) -> TrackSample {
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
    let position_m = middle + (even * s4 - even2 * s2) / (s0 * s4 - s2 * s2);
    let around = |n: usize| (window[n - 1] + window[n] + window[n + 1]) * (1.0 / 3.0);
    let end_m = around(WINDOW - 2);
    TrackSample {
        position_m,
        velocity_m_s: odd / (s2 * TICK_S),
        facing: None,
        ahead_m: end_m - position_m,
        comes_to_rest: end_m.distance(around(WINDOW - 2 - REST_TICKS)) < REST_M,
    }
}

/// Half width of the smoothing window in ticks: one stride (two steps) at the mean speed over two seconds.
///
/// At this width the sway falls into the first null of the filter.
fn half_width_ticks(window: &[Vec2]) -> f64 {
    const SPAN: usize = 10;
    let speed = window[REACH + SPAN].distance(window[REACH - SPAN]) / (2.0 * SPAN as f64 * TICK_S);
    let step_m = 0.247 + 0.344 * speed;
    (1.03 * 2.0 * step_m / speed.max(0.05) / TICK_S).clamp(8.0, REACH as f64)
}
