//! Statistics of one pass over the rows of a recording, in the file's own numbers.

use rustc_hash::FxHashMap;

use super::histogram::Histogram;
use super::row::TrajectoryRow;
use crate::math::{Rect, Vec2};

/// Rows of one person per speed sample: long enough that noise and body sway count little.
const STRIDE: u32 = 5;
/// Distance within which two positions at one moment count as the same, file units.
pub(super) const SAME: f64 = 1e-3;

/// The counts and histograms of a recording.
#[derive(Debug, Default)]
pub(super) struct Census {
    people: FxHashMap<u32, PersonRecord>,
    pub first_time: f64,
    pub last_time: f64,
    /// End of the last step, if it is later than `last_time`.
    pub end_time: f64,
    /// Number of distinct moments.
    pub moments: usize,
    pub places: usize,
    pub largest_id: u32,
    /// Bounding box of all positions after `turn`.
    pub bounds: Option<Rect>,
    turn: Option<Vec2>,
    /// Times between consecutive positions of one person.
    pub intervals: Histogram,
    /// Times between consecutive moments.
    pub moment_intervals: Histogram,
    /// Speeds over [`STRIDE`] rows; speeds of 0 are counted in `standing`.
    pub speeds: Histogram,
    pub standing: u64,
    /// Displacement / (time * the file's velocity): seconds per time unit if velocities are in length unit/s.
    pub own_speeds: Histogram,
    /// Distance walked along the heading, and distance walked by rows that have a heading.
    pub forward: f64,
    pub faced: f64,
    /// Total distance and time behind `speeds`.
    pub way: f64,
    pub time: f64,
    /// Number of rows that repeat another one.
    pub repeated: usize,
    /// Whether rows give the end of a step.
    pub steps: bool,
}

#[derive(Debug)]
struct PersonRecord {
    time: f64,
    at: Vec2,
    velocity: Option<Vec2>,
    /// Whether the position is the end of a step yet to come.
    ahead: bool,
    anchor: (f64, Vec2),
    rows: u32,
}

/// Why counting stopped.
#[derive(Debug)]
pub(super) enum Objection {
    /// Rows are not sorted by time.
    Disorder,
    /// The person has this second position at the same moment.
    Twice(Vec2),
}

impl Census {
    /// Starts an empty count; `bounds` are taken after a rotation by `turn`, (cos, sin).
    pub fn new(turn: Option<Vec2>) -> Census {
        Census { turn, ..Census::default() }
    }

    fn reach(&mut self, at: Vec2) {
        let p = self.turn.map_or(at, |by| at.rotated(by));
        let Rect { min, max } = self.bounds.unwrap_or(Rect { min: p, max: p });
        self.bounds = Some(Rect {
            min: Vec2 { x: min.x.min(p.x), y: min.y.min(p.y) },
            max: Vec2 { x: max.x.max(p.x), y: max.y.max(p.y) },
        });
    }

    /// Number of persons.
    pub fn people(&self) -> usize {
        self.people.len()
    }

    /// Sum of all persons' times present; gaps up to `longest_gap` are included.
    pub fn present(&mut self, longest_gap: f64) -> f64 {
        self.intervals.sum_up_to(longest_gap * (1.0 + 1e-9))
    }

    /// Counts one row; rows must be sorted by time.
    pub fn add(&mut self, row: &TrajectoryRow) -> Result<(), Objection> {
        if self.moments == 0 {
            self.first_time = row.time;
            self.moments = 1;
        } else if row.time > self.last_time {
            self.moment_intervals.add(row.time - self.last_time);
            self.moments += 1;
        } else if row.time < self.last_time {
            return Err(Objection::Disorder);
        }
        self.last_time = row.time;
        self.end_time = if self.moments == 1 { row.time } else { self.end_time.max(row.time) };
        if !self.place(row.id, (row.time, row.at), row.velocity, row.heading, false)? {
            self.repeated += 1;
            return Ok(());
        }
        self.places += 1;
        self.largest_id = self.largest_id.max(row.id);
        self.reach(row.at);
        if let Some((time, at)) = row.until {
            self.steps = true;
            self.end_time = self.end_time.max(time);
            self.place(row.id, (time, at), None, row.heading, true)?;
            self.reach(at);
        }
        Ok(())
    }

    /// Records a person's next position; returns whether it differs from the last one.
    fn place(
        &mut self,
        id: u32,
        (time, at): (f64, Vec2),
        velocity: Option<Vec2>,
        heading: Option<Vec2>,
        ahead: bool,
    ) -> Result<bool, Objection> {
        let seen = match self.people.entry(id) {
            std::collections::hash_map::Entry::Occupied(seen) => seen.into_mut(),
            std::collections::hash_map::Entry::Vacant(new) => {
                new.insert(PersonRecord { time, at, velocity, ahead, anchor: (time, at), rows: 0 });
                return Ok(true);
            }
        };
        if time <= seen.time {
            let twice = time == seen.time && !seen.ahead && !ahead && !same(seen.at, at);
            return if twice { Err(Objection::Twice(seen.at)) } else { Ok(seen.ahead && !ahead) };
        }
        let elapsed = time - seen.time;
        self.intervals.add(elapsed);
        let moved = at.distance(seen.at);
        if let (Some(before), Some(now)) = (seen.velocity, velocity) {
            let speed = ((before + now) * 0.5).length();
            if speed > 0.0 {
                self.own_speeds.add(moved / elapsed / speed);
            }
        }
        (seen.time, seen.at, seen.velocity, seen.ahead) = (time, at, velocity, ahead);
        seen.rows += 1;
        if seen.rows == STRIDE {
            let (from, anchor) = seen.anchor;
            let (way, lasted) = (at.distance(anchor), time - from);
            (seen.rows, seen.anchor) = (0, (time, at));
            if let Some(heading) = heading {
                self.forward += heading.dot(at - anchor);
                self.faced += way;
            }
            self.speed(way, lasted);
        }
        Ok(true)
    }

    fn speed(&mut self, way: f64, lasted: f64) {
        self.way += way;
        self.time += lasted;
        self.speeds.add(way / lasted);
        self.standing += u64::from(way == 0.0);
    }

    /// Ends the count. If no person had [`STRIDE`] rows, speeds are taken over the rows there are.
    pub fn finish(&mut self) {
        if self.time > 0.0 {
            return;
        }
        let mut short: Vec<(f64, f64)> = (self.people.values())
            .filter(|seen| seen.rows > 0)
            .map(|seen| (seen.at.distance(seen.anchor.1), seen.time - seen.anchor.0))
            .collect();
        // The order of a sum decides its last bit.
        short.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        for (way, lasted) in short {
            self.speed(way, lasted);
        }
    }

    /// Median speed, standing persons included.
    pub fn median_speed(&mut self) -> Option<f64> {
        self.speed_quantile(0.5)
    }

    /// Quantile `share` of all speeds, standing persons included.
    pub fn speed_quantile(&mut self, share: f64) -> Option<f64> {
        let moving = self.speeds.count_above(0.0) as f64;
        let all = moving + self.standing as f64;
        if all == 0.0 {
            return None;
        }
        let among = (share * all - self.standing as f64) / moving;
        if among > 0.0 { self.speeds.quantile(among) } else { Some(0.0) }
    }
}

/// Whether two positions agree to within [`SAME`].
pub(super) fn same(a: Vec2, b: Vec2) -> bool {
    (a.x - b.x).abs() <= SAME && (a.y - b.y).abs() <= SAME
}
