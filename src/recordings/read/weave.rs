//! Assembles frames from rows that are sorted by time.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;

use super::RecordingError;
use super::row::{ReadStop, TrajectoryRow};
use super::rows::TrajectoryRows;
use super::scale::{Alignment, Scale};
use crate::math::Vec2;
use crate::motion::{Frame, Motion, MotionError, Walker};

/// A missing person whose mean speed over the gap exceeds this has left, metres per second.
const FASTEST_M_S: f64 = 12.0;
/// A person faster than this between two frames was teleported, metres per second.
const PUT_ELSEWHERE_M_S: f64 = 20.0;
/// Largest displacement between two steps of a standing person, metres.
const STANDS_M: f64 = 0.05;
/// Times closer than this are equal, seconds.
const SAME_S: f64 = 1e-6;

/// A recording as a motion. A frame is returned once missing persons can no longer come back within the gap, about 1 s
/// after it was read; memory holds only these frames.
pub(super) struct Weaver {
    rows: TrajectoryRows,
    scale: Scale,
    align: Alignment,
    first_time: f64,
    /// Whether all rows were read.
    read: bool,
    /// Where everybody was last.
    tracks: FxHashMap<u32, LastPlace>,
    /// Tracks are looked through when there are so many.
    most_tracks: usize,
    /// Frames not yet returned, by number; without a common clock, the newest one is in `latest`.
    pending: BTreeMap<u64, PendingFrame>,
    latest: PendingFrame,
    /// Number and time of the newest frame.
    newest: u64,
    newest_s: f64,
    newest_raw: f64,
    /// Ids in use.
    known: IdSet,
    next_id: u32,
    /// The frame returned last.
    before: PendingFrame,
    /// Time of the last frame returned, seconds.
    returned_s: f64,
    /// Buffer for reuse.
    spare: Vec<(Walker, bool)>,
}

#[derive(Clone, Copy, Debug)]
struct LastPlace {
    /// Id in the motion.
    id: u32,
    number: u64,
    time_s: f64,
    at: Vec2,
    heading: Option<Vec2>,
    /// Whether the position is the end of a step.
    ahead: bool,
}

#[derive(Clone, Debug, Default)]
struct PendingFrame {
    time_s: f64,
    people: Vec<(Walker, bool)>,
}

impl PendingFrame {
    fn add(&mut self, id: u32, position_m: Vec2, velocity: Option<Vec2>, heading: Option<Vec2>) {
        let velocity_m_s = velocity.unwrap_or(Vec2::ZERO);
        self.people.push((Walker { id, position_m, velocity_m_s, heading }, velocity.is_some()));
    }

    fn sort(&mut self) {
        if !self.people.is_sorted_by_key(|(walker, _)| walker.id) {
            self.people.sort_by_key(|(walker, _)| walker.id);
        }
    }
}

/// A set of ids, as bits.
#[derive(Default)]
struct IdSet(Vec<u64>);

impl IdSet {
    /// Adds an id; returns whether it is new.
    fn insert(&mut self, id: u32) -> bool {
        let (word, bit) = (id as usize / 64, 1 << (id % 64));
        if word >= self.0.len() {
            self.0.resize((word + 1).next_power_of_two(), 0);
        }
        let new = self.0[word] & bit == 0;
        self.0[word] |= bit;
        new
    }
}

impl Weaver {
    pub fn new(rows: TrajectoryRows, scale: Scale, align: Alignment, first_time: f64, largest_id: u32) -> Weaver {
        Weaver {
            rows,
            scale,
            align,
            first_time,
            read: false,
            tracks: FxHashMap::default(),
            most_tracks: 1024,
            pending: BTreeMap::new(),
            latest: PendingFrame::default(),
            newest: 0,
            newest_s: f64::NEG_INFINITY,
            newest_raw: f64::NAN,
            known: IdSet::default(),
            next_id: largest_id.saturating_add(1),
            before: PendingFrame::default(),
            returned_s: f64::NEG_INFINITY,
            spare: Vec::new(),
        }
    }

    /// Time by which reading must be ahead of a frame before it is returned, seconds.
    fn look_ahead_s(&self) -> f64 {
        let tick_s = if self.scale.own_clock { 1.0 / self.scale.fps } else { 0.0 };
        self.scale.stand_s.unwrap_or(self.scale.gap_s) + tick_s + 2.0 * SAME_S
    }

    fn seconds(&self, raw: f64) -> f64 {
        self.scale.time.seconds(raw - self.first_time)
    }

    fn take(&mut self, row: &TrajectoryRow) {
        if row.time != self.newest_raw {
            let time_s = self.seconds(row.time);
            self.newest_raw = row.time;
            if self.newest_s + SAME_S <= time_s {
                self.newest_s = time_s;
                if !self.scale.own_clock {
                    self.settle_latest();
                    self.newest += 1;
                    self.latest.time_s = time_s;
                }
                self.forget();
            }
        }
        let velocity = row.velocity.filter(|_| self.scale.velocities).map(|v| self.align.velocity(v));
        let heading = row.heading.filter(|_| self.scale.headings).map(|heading| self.align.direction(heading));
        self.place(row.id, self.newest_s, row.at, velocity, heading, false);
        if let Some((time, at)) = row.until {
            self.place(row.id, self.seconds(time), at, None, heading, true);
        }
    }

    /// Moves the newest frame to the pending ones.
    fn settle_latest(&mut self) {
        if self.newest > 0 && !self.latest.people.is_empty() {
            let spare = PendingFrame { time_s: 0.0, people: std::mem::take(&mut self.spare) };
            let latest = std::mem::replace(&mut self.latest, spare);
            self.pending.insert(self.newest, latest);
        }
    }

    /// Adds a person's next position.
    fn place(
        &mut self,
        own_id: u32,
        time_s: f64,
        raw: Vec2,
        velocity: Option<Vec2>,
        heading: Option<Vec2>,
        ahead: bool,
    ) {
        let at = self.align.place(raw);
        let mut now = LastPlace { id: own_id, number: self.newest, time_s, at, heading, ahead };
        let Some(track) = self.tracks.get_mut(&own_id) else {
            self.begin(now, velocity);
            return;
        };
        let last = *track;
        if time_s < last.time_s + SAME_S {
            // A repeated row, or a step that begins before the last one ended.
            return;
        }
        let missing_s = time_s - last.time_s;
        let stood = (self.scale.stand_s)
            .is_some_and(|most_s| last.ahead && missing_s <= most_s + SAME_S && at.distance(last.at) <= STANDS_M);
        let next_to = !self.scale.own_clock && last.number + 1 == self.newest;
        // Consecutive moments may be far apart if no person was present in between.
        let bridged = (stood || missing_s <= self.scale.gap_s + SAME_S)
            && (next_to || at.distance(last.at) <= 1.0 + FASTEST_M_S * missing_s);
        if !bridged {
            self.tracks.remove(&own_id);
            self.begin(now, velocity);
            return;
        }
        now.id = last.id;
        *track = now;
        if self.scale.own_clock {
            self.show_between(&last, &now);
        } else {
            for number in last.number + 1..self.newest {
                if let Some(moment) = self.pending.get_mut(&number) {
                    let share = (moment.time_s - last.time_s) / missing_s;
                    moment.add(now.id, last.at.lerp(at, share), None, between(last.heading, heading, share));
                }
            }
            self.show(now.id, at, velocity, heading);
        }
    }

    /// Starts a track: of a new person, or of a returned one under a new id.
    fn begin(&mut self, mut now: LastPlace, velocity: Option<Vec2>) {
        let own_id = now.id;
        if !self.known.insert(own_id) {
            now.id = self.next_id;
            self.next_id = self.next_id.saturating_add(1);
        }
        if self.scale.own_clock {
            let tick = (now.time_s * self.scale.fps).round();
            if (tick / self.scale.fps - now.time_s).abs() < SAME_S {
                self.moment_at(tick as u64).add(now.id, now.at, velocity, now.heading);
            }
        } else {
            self.show(now.id, now.at, velocity, now.heading);
        }
        self.tracks.insert(own_id, now);
    }

    fn show(&mut self, id: u32, at: Vec2, velocity: Option<Vec2>, heading: Option<Vec2>) {
        self.latest.add(id, at, velocity, heading);
    }

    fn moment_at(&mut self, tick: u64) -> &mut PendingFrame {
        let time_s = tick as f64 / self.scale.fps;
        self.pending.entry(tick).or_insert_with(|| PendingFrame { time_s, people: Vec::new() })
    }

    /// Adds a person to all frames after `last` and up to `now`.
    fn show_between(&mut self, last: &LastPlace, now: &LastPlace) {
        let fps = self.scale.fps;
        let mut tick = ((last.time_s + SAME_S) * fps).floor() as u64 + 1;
        loop {
            let time_s = tick as f64 / fps;
            if time_s >= now.time_s + SAME_S {
                return;
            }
            let share = ((time_s - last.time_s) / (now.time_s - last.time_s)).clamp(0.0, 1.0);
            let heading = between(last.heading, now.heading, share);
            self.moment_at(tick).add(now.id, last.at.lerp(now.at, share), None, heading);
            tick += 1;
        }
    }

    /// Drops tracks that can no longer be continued.
    fn forget(&mut self) {
        if self.tracks.len() < self.most_tracks {
            return;
        }
        let since_s = self.newest_s - self.look_ahead_s();
        self.tracks.retain(|_, track| track.time_s >= since_s);
        self.most_tracks = 1024.max(2 * self.tracks.len());
    }

    /// Reads until the oldest pending frame is final.
    fn read_ahead(&mut self) -> Result<(), RecordingError> {
        let look_ahead_s = self.look_ahead_s();
        while !self.read {
            let oldest = self.pending.first_key_value();
            let ready_s = oldest.map_or(f64::INFINITY, |(_, oldest)| oldest.time_s + look_ahead_s);
            if self.newest_s > ready_s {
                return Ok(());
            }
            match self.rows.next() {
                Ok(Some(row)) => self.take(&row),
                Err(ReadStop::Error(error)) => return Err(error),
                // The survey found only numeric ids: the file has changed since, so reading ends.
                Ok(None) | Err(ReadStop::Name) => {
                    self.settle_latest();
                    self.read = true;
                }
            }
        }
        Ok(())
    }
}

impl Motion for Weaver {
    fn next_frame(&mut self, frame: &mut Frame) -> Result<bool, MotionError> {
        let mut now = loop {
            self.read_ahead().map_err(MotionError::of_source)?;
            let Some((_, now)) = self.pending.pop_first() else { return Ok(false) };
            // Ages from 0, frames lie closer than numbers do.
            if now.time_s > self.returned_s {
                break now;
            }
        };
        self.returned_s = now.time_s;
        now.sort();
        if let Some(mut next) = self.pending.first_entry() {
            next.get_mut().sort();
        }
        let empty = PendingFrame::default();
        let next = self.pending.first_key_value().map_or(&empty, |(_, next)| next);
        frame.time_s = now.time_s;
        frame.walkers.clear();
        let (mut earlier, mut later) = (self.before.people.iter().peekable(), next.people.iter().peekable());
        for (walker, has_velocity) in &mut now.people {
            let same_in = |others: &mut std::iter::Peekable<std::slice::Iter<'_, (Walker, bool)>>| {
                while others.next_if(|(other, _)| other.id < walker.id).is_some() {}
                others.next_if(|(other, _)| other.id == walker.id).map(|(other, _)| other.position_m)
            };
            let (was, will_be) = (same_in(&mut earlier), same_in(&mut later));
            if !*has_velocity {
                let here = (now.time_s, walker.position_m);
                let was = was.map_or(here, |at| reachable(here, (self.before.time_s, at)));
                let will_be = will_be.map_or(here, |at| reachable(here, (next.time_s, at)));
                let lasted_s = will_be.0 - was.0;
                walker.velocity_m_s = if lasted_s > 0.0 { (will_be.1 - was.1) / lasted_s } else { Vec2::ZERO };
            }
            frame.walkers.push(*walker);
        }
        self.spare = std::mem::replace(&mut self.before, now).people;
        self.spare.clear();
        Ok(true)
    }

    fn share_done(&self) -> f64 {
        self.rows.share_done()
    }
}

/// Returns the other position, or `here` if the person was teleported.
fn reachable(here: (f64, Vec2), other: (f64, Vec2)) -> (f64, Vec2) {
    let far = here.1.distance(other.1) > PUT_ELSEWHERE_M_S * (here.0 - other.0).abs() + 0.1;
    if far { here } else { other }
}

fn between(a: Option<Vec2>, b: Option<Vec2>, share: f64) -> Option<Vec2> {
    match (a, b) {
        // Opposite directions have no mean.
        (Some(a), Some(b)) => a.lerp(b, share).normalized().or(Some(b)),
        (a, b) => b.or(a),
    }
}
